// One token of a collection, bought by the visitor's wallet: Editions, to which anyone adds, and those in the address book.

import { encodeFunctionData, hexToBytes, isAddress, type Address, type Hex } from "viem";
import { getCode, readContract } from "viem/actions";
import { InputError } from "../../errors.js";
import type { App } from "../app.js";
import { oneLine, titleOf } from "../programs/subject.js";
import { USUAL_GAS } from "../../document/settings.js";
import { intrinsicGas } from "../work/calls.js";
import { OPEN_SUPPLY, type More } from "../work/protocol.js";
import { EDITIONS, GENESIS, ICONS, TOKENS } from "./abi.js";
import { addressBook } from "./chains.js";
import { ether, short } from "./widgets.js";
import { metadataOf, mintedIn, type Token } from "./tokens.js";
import { priced, send, type Priced, type Session, type Tell } from "./wallet.js";

type Client = Session["client"];

/** The titles of collections, as their contracts have them, by the names of these. */
export const TITLES = {
    GenesisCollection: "Shackled Genesis",
    IconsCollection: "Shackled Icons",
    Editions: "Shackled Editions",
} as const;

const PHASES = ["closed", "open for the allow list", "open for all"];
/** The most icons or editions that are offered, the last ones; and how many are read at once. */
const MOST = 1000;
/** How many a collection can have. */
const MOST_KINDS = 1 << 24;
const AT_ONCE = 16;

/** A collection on the chain of the wallet. kinds: what can be minted, null where all tokens are of one kind. */
export interface Shop {
    contract: keyof typeof TITLES;
    address: Address;
    kinds: readonly { number: number; name: string }[] | null;
    /** What is offered first. */
    first: number;
}

/** What one token costs. image: a data URL, or "". */
export interface Offer extends Priced {
    words: string;
    image: string;
}

/** Return the collections that are on the chain of the wallet. */
export async function shopsOf(app: App, { client, chain }: Session): Promise<Shop[]> {
    const [book, more] = await Promise.all([addressBook(), app.assets.json<More>("more.json")]);
    const { address: usual, code } = more.contracts.Editions!;
    const places = { ...book[chain], Editions: usual } as Record<string, string>;
    const shops: Shop[] = [];
    for (const contract of Object.keys(TITLES) as Shop["contract"][]) {
        const address = places[contract] ?? "";
        if (!isAddress(address, { strict: false })) continue;
        // the code of collections with an owner depends on their terms
        const name = (): Promise<string> => readContract(client, { address, abi: TOKENS, functionName: "name" });
        const isThere =
            contract === "Editions"
                ? (await getCode(client, { address })) === code
                : (await name().catch(() => "")) === TITLES[contract];
        if (!isThere) continue;
        const kinds = contract === "GenesisCollection" ? null : await kindsOf(client, contract, address);
        // that of the page, which the collection knows by its name
        const pieces = app.doc.value.objects.map(({ mesh }) => ("piece" in mesh ? mesh.piece : ""));
        const wanted = [titleOf(app.doc.value), ...pieces].join("/").toLowerCase().split("/");
        const shown = kinds?.find((each) => wanted.includes(each.name.toLowerCase()));
        shops.push({ contract, address, kinds, first: (shown ?? kinds?.at(-1))?.number ?? 0 });
    }
    return shops;
}

async function kindsOf(
    client: Client,
    contract: "IconsCollection" | "Editions",
    address: Address,
): Promise<Shop["kinds"]> {
    const [editions, icons] = [{ address, abi: EDITIONS } as const, { address, abi: ICONS } as const];
    const isEdition = contract === "Editions";
    const count = isEdition
        ? await readContract(client, { ...editions, functionName: "editionCount" })
        : await readContract(client, { ...icons, functionName: "iconCount" });
    if (count > MOST_KINDS)
        throw new InputError(`The wallet says that ${TITLES[contract]} has ${count} kinds of tokens`);
    const nameOf = async (number: number): Promise<string> => {
        const args = [BigInt(number)] as const;
        if (isEdition)
            return `${number}: ${(await readContract(client, { ...editions, functionName: "editionAt", args })).name}`;
        return (await readContract(client, { ...icons, functionName: "iconAt", args })).name;
    };
    const kinds: { number: number; name: string }[] = [];
    for (let at = Math.max(0, Number(count) - MOST); at < count; at += AT_ONCE) {
        const numbers = Array.from({ length: Math.min(AT_ONCE, Number(count) - at) }, (_, index) => at + index);
        const kindOf = async (number: number) => ({ number, name: oneLine(await nameOf(number)) });
        kinds.push(...(await Promise.all(numbers.map(kindOf))));
    }
    return kinds;
}

/** What a collection says of a token. left: null for no limit. phase: of its sale. */
interface Ware {
    phase: number;
    price: bigint;
    left: bigint | null;
    words: string;
    image: string;
    data: Hex;
}

const WARES: Record<Shop["contract"], (client: Client, address: Address, number: bigint) => Promise<Ware>> = {
    async GenesisCollection(client, address) {
        const own = { address, abi: GENESIS } as const;
        const [phase, price, left] = await Promise.all([
            readContract(client, { ...own, functionName: "phase" }),
            readContract(client, { ...own, functionName: "price" }),
            readContract(client, { ...own, functionName: "left" }),
        ]);
        const data = encodeFunctionData({ abi: GENESIS, functionName: "mint", args: [1n] });
        return { phase, price, left, words: "The piece is drawn by lot after minting.", image: "", data };
    },
    async IconsCollection(client, address, number) {
        const own = { address, abi: ICONS, args: [number] } as const;
        const [phase, { name, price }, left] = await Promise.all([
            readContract(client, { address, abi: ICONS, functionName: "phase" }),
            readContract(client, { ...own, functionName: "iconAt" }),
            readContract(client, { ...own, functionName: "left" }),
        ]);
        const data = encodeFunctionData({ abi: ICONS, functionName: "mint", args: [number, 1n] });
        const words = `“${oneLine(name)}” as the collection has it, without your changes.`;
        return { phase, price, left, words, image: "", data };
    },
    async Editions(client, address, number) {
        const own = { address, abi: EDITIONS, args: [number] } as const;
        const [{ name, artist, price, supply }, left, uri] = await Promise.all([
            readContract(client, { ...own, functionName: "editionAt" }),
            readContract(client, { ...own, functionName: "left" }),
            readContract(client, { ...own, functionName: "editionURI" }),
        ]);
        const data = encodeFunctionData({ abi: EDITIONS, functionName: "mint", args: [number, 1n] });
        const [words, { image }] = [`“${oneLine(name)}” by ${short(artist)}.`, metadataOf(uri)];
        return { phase: 2, price, left: left && Number(supply) === OPEN_SUPPLY ? null : left, words, image, data };
    },
};

/** Return what a token costs. number: of the icon or edition. InputError if it is not on sale. */
export async function offerOf(session: Session, { contract, address }: Shop, number: number): Promise<Offer> {
    const { phase, price, left, words, image, data } = await WARES[contract](session.client, address, BigInt(number));
    if (phase !== PHASES.length - 1) throw new InputError(`The sale is ${PHASES[phase] ?? "in a phase that is none"}`);
    if (left === 0n) throw new InputError("It is sold out, or was closed by its artist");
    const counted = USUAL_GAS.mint + intrinsicGas(hexToBytes(data));
    const cost = await priced(session, { to: address, data, value: price }, counted);
    const stock = left === null ? "" : `, ${left} left`;
    return { ...cost, words: `${words} Price: ${ether(price)}${stock}.`, image };
}

/** Mint the token, and return it as the chain has it. */
export async function mint({ session, call, fees }: Offer, tell: Tell): Promise<Token> {
    tell(`The price is ${ether(call.value)}. Confirm it in the wallet …`);
    const receipt = await send(session, call, fees, tell);
    tell("Minted. Reading it from the chain …");
    return mintedIn(receipt, session, call.to);
}
