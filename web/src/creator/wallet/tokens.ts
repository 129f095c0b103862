// Tokens as the chain returns them: whose they are, and their pictures.

import { isAddressEqual, parseEventLogs, type Address, type Log, type TransactionReceipt } from "viem";
import { readContract } from "viem/actions";
import { InputError } from "../../errors.js";
import { fromBase64 } from "../../bytes.js";
import { TOKENS } from "./abi.js";
import type { Session } from "./wallet.js";

/** A token: its name and its picture, a data URL. */
export interface Token {
    number: bigint;
    name: string;
    image: string;
}

/** Return what `read` finds in the events of a contract in a receipt. InputError where they are none. */
export function eventsOf<T>({ logs }: TransactionReceipt, address: Address, read: (logs: Log[]) => T): T {
    try {
        return read(logs.filter((log) => isAddressEqual(log.address, address)));
    } catch {
        throw new InputError("The transaction succeeded, but its receipt has events that are none");
    }
}

/** Return the first token that a transaction minted to the account. InputError if there is none. */
export async function mintedIn(
    receipt: TransactionReceipt,
    { client, account }: Session,
    address: Address,
): Promise<Token> {
    const read = (logs: Log[]) => parseEventLogs({ abi: TOKENS, eventName: "Transfer", logs, strict: true });
    const number = eventsOf(receipt, address, read)[0]?.args.tokenId;
    if (number === undefined) throw new InputError("The transaction succeeded, but its receipt names no new token");
    const token = { address, abi: TOKENS, args: [number] } as const;
    const owner = await readContract(client, { ...token, functionName: "ownerOf" });
    if (!isAddressEqual(owner, account)) throw new InputError(`Token ${number}, which the receipt names, is not yours`);
    return { number, ...metadataOf(await readContract(client, { ...token, functionName: "tokenURI" })) };
}

/** Return name and picture from the metadata of a token, a data URL. */
export function metadataOf(uri: string): { name: string; image: string } {
    try {
        const json = new TextDecoder().decode(decoded(uri, "application/json"));
        const { name, image } = JSON.parse(json) as Record<string, unknown>;
        if (typeof image === "string" && image.startsWith("data:image/")) return { name: String(name), image };
    } catch {
        // said below
    }
    throw new InputError("What the chain returns for the token has no picture in it");
}

/** Return whether a picture is that of a PNG file, whatever else these carry. */
export async function isSame(image: string, png: Blob): Promise<boolean> {
    return pictureIn(decoded(image, "image/png")) === pictureIn(new Uint8Array(await png.arrayBuffer()));
}

/** Return the chunks of a PNG file that make its picture. */
function pictureIn(png: Uint8Array): string {
    const view = new DataView(png.buffer);
    const found: Uint8Array[] = [];
    for (let at = 8; at + 12 <= png.length; at += 12 + view.getUint32(at)) {
        // the names of those that are needed begin with a capital letter
        if (!(png[at + 4] & 0x20)) found.push(png.subarray(at + 4, at + 8 + view.getUint32(at)));
    }
    return found.join();
}

/** Return the bytes of a data URL of this type; none where it has another. */
function decoded(url: string, type: string): Uint8Array<ArrayBuffer> {
    return fromBase64(url.split(`data:${type};base64,`)[1] ?? "") ?? new Uint8Array();
}
