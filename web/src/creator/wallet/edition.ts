// The picture as an edition: its terms, what it costs, and adding it. Nothing that the wallet or its node says is trusted.

import { isAddressEqual, parseEther, parseEventLogs, toHex as hex, type Address, type Hex, type Log } from "viem";
import { getCode, getContractEvents, readContract } from "viem/actions";
import { InputError } from "../../errors.js";
import type { App } from "../app.js";
import type { Document } from "../../document/document.js";
import { oneLine } from "../programs/subject.js";
import { OPEN_SUPPLY } from "../work/protocol.js";
import type { EditionTerms, Quote } from "../work/work.js";
import { EDITIONS } from "./abi.js";
import { chainName } from "./chains.js";
import { eventsOf, isSame, mintedIn, type Token } from "./tokens.js";
import { check, priced, send, withMargin, type Call, type Priced, type Session, type Tell } from "./wallet.js";

const MAX_ROYALTY = 10;

/** What the form has. */
export interface Fields {
    name: string;
    price: string;
    supply: string;
    royalty: string;
    licence: string;
    model: boolean;
}

/** Return the terms that the form states. InputError where it has none. */
export function termsOf({ name, price, supply, royalty, model }: Fields): EditionTerms {
    const [amount, most, percent] = [price.replace(/ether/, "").trim(), supply.trim(), royalty.trim()];
    if (!/^\d{1,20}(\.\d{1,18})?$/.test(amount)) throw new InputError("The price is an amount of ether, such as 0.01");
    if (!/^\d{0,10}$/.test(most)) throw new InputError("The number of tokens is a whole number, or empty for no limit");
    if (!/^\d+(\.\d+)?$/.test(percent) || Number(percent) > MAX_ROYALTY) {
        throw new InputError(`The royalty is 0 to ${MAX_ROYALTY} percent`);
    }
    const numbers = { supply: most ? Number(most) : null, royalty: Math.round(100 * Number(percent)), copies: 1 };
    return { name: oneLine(name), price: parseEther(amount), ...numbers, model };
}

/** A quote, and what it is for. */
export interface Quoted {
    doc: Document;
    terms: EditionTerms;
    quote: Quote;
}

/** What the wallet will be asked to sign. */
export interface Plan extends Quoted, Omit<Priced, "call"> {
    /** What is not stored on the chain yet, and last the edition. */
    calls: (Call & { kept?: { code: Hex; pointer: Address } })[];
    /** Whether this account has added this very scene, as far as is known. */
    isKnown: boolean;
}

/** Scenes that were added since the page was opened, by chain and pointer. */
const added = new Set<string>();

function pointerOf({ storing }: Quote): Address {
    return storing.at(-1)!.pointer as Address;
}

/** Return what a quote takes on the chain of the wallet; null where that has no collection of editions. */
export async function planOf(session: Session, quoted: Quoted): Promise<Plan | null> {
    const { client, account, chain } = session;
    const { quote } = quoted;
    const [address, to, scene] = [quote.collection as Address, quote.studio as Address, pointerOf(quote)];
    if ((await getCode(client, { address })) !== hex(quote.code)) return null;
    const parts = quote.storing.map(async ({ data, code, gas, pointer }) => {
        const kept = { code: hex(code), pointer: pointer as Address };
        const isThere = (await getCode(client, { address: kept.pointer })) === kept.code;
        return isThere ? [] : [{ to, data: hex(data), gas: withMargin(BigInt(gas)), kept }];
    });
    const add = { to: address, data: hex(quote.add.data), gas: BigInt(quote.add.limit) };
    const own = [...(await Promise.all(parts)).flat(), add];
    const event = { address, abi: EDITIONS, eventName: "EditionAdded", args: { artist: account, scene } } as const;
    const [first, known] = await Promise.all([
        priced(session, own[0], Number(own[0].gas)),
        // nodes may not look back so far
        getContractEvents(client, { ...event, fromBlock: 0n }).catch(() => []),
    ]);
    const { fees, balance } = first;
    const [usual, gas] = [withMargin(own[0].gas), first.call.gas];
    // some chains count gas otherwise; what comes later cannot be estimated yet, and is taken to be alike
    const calls = gas > usual ? own.map((call) => ({ ...call, gas: withMargin((call.gas * gas) / usual) })) : own;
    const most = calls.reduce((sum, { gas }) => sum + gas * fees.max, 0n);
    const isKnown = added.has(`${chain} ${scene}`) || known.length > 0;
    return { ...quoted, session, calls, fees, most, balance, isKnown };
}

/** What was added. isSame: whether the picture read from the chain is that of the page. */
export interface Added {
    number: bigint;
    token: Token;
    isSame: boolean;
}

/** Store what is missing, add the edition, and return it as the chain has it. */
export async function add(app: App, { session, doc, terms, quote, calls, fees }: Plan, tell: Tell): Promise<Added> {
    const { client, account, chain } = session;
    const [address, scene] = [quote.collection as Address, pointerOf(quote)];
    let receipt;
    for (const [index, { kept, ...call }] of calls.entries()) {
        const what = kept ? "Storing the scene" : `Adding the edition “${terms.name}”; this cannot be changed later`;
        tell(`${what} (${index + 1} of ${calls.length}). Confirm it in the wallet …`);
        receipt = await send(session, call, fees, tell);
        if (!kept) break;
        await check(session);
        if ((await getCode(client, { address: kept.pointer })) === kept.code) continue;
        throw new InputError(
            `The transaction succeeded, but the scene is not at ${kept.pointer} on ${chainName(chain)}`,
        );
    }
    // whatever is said of it from here on, it is not to be added again
    added.add(`${chain} ${scene}`);
    tell("Added. Reading it from the chain …");
    const read = (logs: Log[]) => parseEventLogs({ abi: EDITIONS, eventName: "EditionAdded", logs, strict: true });
    const number = eventsOf(receipt!, address, read)[0]?.args.edition;
    if (number === undefined) throw new InputError("The transaction succeeded, but its receipt names no new edition");
    const found = await readContract(client, { address, abi: EDITIONS, functionName: "editionAt", args: [number] });
    const has = [found.name, found.price, found.supply, found.royalty, found.scale, found.model];
    const wanted = [terms.name, terms.price, terms.supply ?? OPEN_SUPPLY, terms.royalty, quote.scale, terms.model];
    const isMine = isAddressEqual(found.artist, account) && isAddressEqual(found.scene, scene);
    if (!isMine || has.join() !== wanted.join()) {
        throw new InputError(`Edition ${number}, which the receipt names, is not the one that was sent`);
    }
    const [token, png] = await Promise.all([
        mintedIn(receipt!, session, address),
        app.work.png(doc, { scale: quote.scale }),
    ]);
    return { number, token, isSame: await isSame(token.image, png) };
}
