// Revealing tokens of Genesis: the header of the block whose randomness gives the seeds is proved to the collection.
//
// Nothing that the node says is trusted: each header is compared with the hash that the collection has of its block.

import { encodeFunctionData, keccak256, numberToHex, pad, toRlp, type Address, type Hex } from "viem";
import { readContract } from "viem/actions";
import { InputError } from "../../errors.js";
import { plural } from "../../files/source.js";
import { count } from "../dialogs/widgets.js";
import { USUAL_GAS } from "../../document/settings.js";
import { GENESIS, TOKENS } from "./abi.js";
import { chainName } from "./chains.js";
import { TITLES } from "./mint.js";
import { check, number, priced, send, type Priced, type Session, type Tell } from "./wallet.js";

export const COMMAND = "shackled token reveal";
/** Rounds in a transaction. */
const ROUNDS_AT_ONCE = 40;
/** Blocks whose hashes every chain still has, less a margin until a transaction is mined. */
const KNOWN_BLOCKS = 240;
const MOST_TOKENS = 1024;
const TOKENS_AT_ONCE = 256;
/** Milliseconds between two looks at the chain, and how many in a row may fail. */
const PAUSE = 4000;
const TRIES = 10;
/** The fields of a header in their order, with their sizes in bytes: 0 for a number, -1 for any. */
const FIELDS =
    "parentHash 32 sha3Uncles 32 miner 20 stateRoot 32 transactionsRoot 32 receiptsRoot 32 logsBloom 256 difficulty 0 " +
    "number 0 gasLimit 0 gasUsed 0 timestamp 0 extraData -1 mixHash 32 nonce 8";
/** Those that forks have added: a header has the first of them. */
const LATER =
    "baseFeePerGas 0 withdrawalsRoot 32 blobGasUsed 0 excessBlobGas 0 parentBeaconBlockRoot 32 requestsHash 32 " +
    "blockAccessListHash 32";

/** Numbers of a round, and of the block that determines its seeds. */
interface Round {
    number: bigint;
    block: number;
}

/** A transaction that reveals rounds. later: what it does not reveal, in words, or "". */
export interface Reveal extends Priced {
    rounds: Round[];
    randomness: Hex[];
    later: string;
}

/**
 * Return the transaction that reveals what can be revealed; null if there is nothing. If no block of a hidden round is mined
 * yet, wait for the first.
 */
export async function findReveal(
    from: Session,
    address: Address,
    tell: Tell,
    signal: AbortSignal,
): Promise<Reveal | null> {
    const { client, chain } = from;
    const name = await readContract(client, { address, abi: TOKENS, functionName: "name" }).catch(() => "");
    if (name !== TITLES.GenesisCollection) {
        throw new InputError(
            `There is no ${TITLES.GenesisCollection} collection at ${address} on ${chainName(chain)}: check the address, or ` +
                "switch the wallet to the chain of the collection",
        );
    }
    tell("Reading the collection");
    let rounds = await hiddenRounds(from, address);
    let latest = Number(await number(client, "eth_blockNumber"));
    for (let failures = 0; rounds[0] && missing(rounds[0], latest);) {
        const [block, left] = [count(rounds[0].block), plural(missing(rounds[0], latest), "block")];
        tell(`The seeds come from block ${block}. Waiting for ${left} until they can be revealed`);
        await new Promise((resume) => setTimeout(resume, PAUSE));
        signal.throwIfAborted();
        await check(from);
        try {
            latest = Number(await number(client, "eth_blockNumber"));
            failures = 0;
        } catch (error) {
            // the node of the wallet may fail now and then while the page waits for half an hour
            if (++failures === TRIES) throw error;
        }
        if (!missing(rounds[0], latest)) rounds = await hiddenRounds(from, address);
    }
    const mined = rounds.filter((each) => !missing(each, latest));
    const read = { address, abi: GENESIS, functionName: "hashOf" } as const;
    const hashes = mined.map(({ block }) => readContract(client, { ...read, args: [BigInt(block)] }));
    const hashed = (await Promise.all(hashes)).map((hash, index) => ({ ...mined[index], hash }));
    const known = hashed.filter(({ hash }) => BigInt(hash) !== 0n);
    const later = leftOver(rounds, mined, known.length);
    if (!rounds.length) return null;
    if (!known.length) {
        const isRecent = mined.some(({ block }) => latest - block < KNOWN_BLOCKS);
        throw new InputError(isRecent ? "The collection cannot read the hash of the block yet: try again" : later);
    }
    const chosen = known.slice(0, ROUNDS_AT_ONCE);
    const headers = await Promise.all(chosen.map(({ block, hash }) => headerOf(from, block, hash)));
    const args = [chosen.map((each) => each.number), headers.map(({ header }) => header)] as const;
    const transaction = { to: address, data: encodeFunctionData({ abi: GENESIS, functionName: "reveal", args }) };
    const cost = await priced(from, transaction, USUAL_GAS.reveal + USUAL_GAS.round * chosen.length);
    return { ...cost, rounds: chosen, randomness: headers.map((each) => each.randomness), later };
}

/** Have the wallet send the transaction, and return what it revealed, in words. */
export async function sendReveal(
    { session, rounds, randomness, call, fees, later }: Reveal,
    tell: Tell,
): Promise<string> {
    const own = { address: call.to, abi: GENESIS, functionName: "randomnessOf" } as const;
    const read = (): Promise<Hex[]> =>
        Promise.all(rounds.map(({ number }) => readContract(session.client, { ...own, args: [number] })));
    await check(session);
    if ((await read()).every(BigInt)) throw new InputError("These tokens are revealed already");
    tell("Confirm it in the wallet …");
    await send(session, call, fees, tell);
    if ((await read()).join() !== randomness.join()) {
        throw new InputError(
            "The transaction succeeded, but the collection does not have the randomness of the blocks",
        );
    }
    return `Revealed: ${plural(rounds.length, "round")}. ${later}`.trim();
}

/** Return the rounds with tokens that are not revealed, in order. */
async function hiddenRounds({ client }: Session, address: Address): Promise<Round[]> {
    const minted = Number(await readContract(client, { address, abi: TOKENS, functionName: "totalSupply" }));
    if (minted > MOST_TOKENS) throw new InputError(`The wallet says that the collection has ${count(minted)} tokens`);
    const numbers = new Set<bigint>();
    const own = { address, abi: GENESIS } as const;
    for (let first = 0; first < minted; first += TOKENS_AT_ONCE) {
        const args = [BigInt(first), BigInt(Math.min(first + TOKENS_AT_ONCE, minted) - 1)] as const;
        for (const each of await readContract(client, { ...own, functionName: "hiddenRounds", args }))
            numbers.add(each);
    }
    const found = [...numbers].map(async (number) => {
        const block = await readContract(client, { ...own, functionName: "blockOf", args: [number] });
        return { number, block: Number(block) };
    });
    return (await Promise.all(found)).sort((one, other) => one.block - other.block);
}

/** Return how many blocks must follow: contracts read the hashes of earlier blocks only, and calls run in the latest. */
function missing({ block }: Round, latest: number): number {
    return Math.max(0, block + 1 - latest);
}

/** Return the header of a block in RLP, and its PREVRANDAO. expected: its hash, as the collection has it. */
async function headerOf({ client }: Session, at: number, expected: Hex): Promise<{ header: Hex; randomness: Hex }> {
    const request = { method: "eth_getBlockByNumber", params: [numberToHex(at), false] } as never;
    const block: Record<string, unknown> | null = await client.request(request);
    if (!block) throw new InputError(`The node of the wallet does not have block ${count(at)}: use another one`);
    const items: Hex[] = [];
    for (const [field, name, size] of `${FIELDS} ${LATER}`.matchAll(/(\w+) (-?\d+)/g)) {
        const value = block[name!] ?? null;
        if (value === null && LATER.includes(field)) break;
        const digits = /^0x([0-9a-f]*)$/i.exec(String(value))?.[1]?.replace(size === "0" ? /^0+/ : /^(?!)/, "");
        const even: Hex = `0x${digits && digits.length % 2 ? "0" : ""}${digits}`;
        if (digits === undefined || digits.length > 2 * 1024) {
            throw new InputError(`The node of the wallet returned block ${count(at)} without its ${name}`);
        }
        items.push(Number(size) > 0 ? pad(even, { size: Math.max(Number(size), even.length / 2 - 1) }) : even);
    }
    const header = toRlp(items);
    if (keccak256(header) === expected) return { header, randomness: items[FIELDS.split(" ").indexOf("mixHash") / 2] };
    throw new InputError(
        `The node of the wallet returned a wrong header of block ${count(at)}: its hash is not the one that the collection reads`,
    );
}

/** Return what is said of rounds that cannot be revealed now, or that do not fit in; "" if there are none. */
function leftOver(rounds: Round[], mined: Round[], known: number): string {
    const [more, old, coming] = [known - ROUNDS_AT_ONCE, mined.length - known, rounds[mined.length]];
    const words = [
        more > 0 && `${plural(more, "more round")} can be revealed afterwards.`,
        old > 0 &&
            `${plural(old, "round")} cannot be revealed from this page, because the chain keeps no hashes of such old ` +
                `blocks: the command ${COMMAND} proves them, with --calldata FILE for a wallet.`,
        coming &&
            `${plural(rounds.length - mined.length, "round")} must wait; the next needs block ${count(coming.block)}.`,
    ];
    return words.filter(Boolean).join(" ");
}
