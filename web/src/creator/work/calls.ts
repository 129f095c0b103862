// Calls of the contracts beside the Renderer: their selectors, the ABI encoding of arguments, and the gas of transactions.

import { fromHex, joined } from "../../bytes.js";
import { WORD, dynamicBytes, selectorOf } from "../../scene/encode.js";

/** The selectors of the functions that are called, by contract. */
export const SELECTORS = {
    PngEncoder: { encode: 0xa8c06a13, encodeTransparent: 0xe2a2b514, svg: 0x8faf49d5 },
    Turntable: { animate: 0xc1b8da58 },
    GlbEncoder: { encode: 0xf8e8849f },
    Genesis: { scene: 0x5e298f3d },
    Studio: {
        storeMesh: 0x3f2c0695,
        storeScene: 0x367af679,
        storePart: 0x5e0bbfde,
        join: 0xd0ecec95,
        renderDataURI: 0x819dcf32,
        glbDataURI: 0xf32b635f,
    },
    Editions: { add: 0xa12b681c, mint: 0x1b2ef1ca, tokenURI: 0xc87b56dd },
} as const;
export type Helper = keyof typeof SELECTORS;

/** The largest transaction that nodes relay, in bytes (four slots of 32 KiB), and what it has besides its data. */
export const MAX_TRANSACTION = 4 * 32 * 1024;
const ENVELOPE = 512;

/** The selector of a call, and the offset of its only argument, before a struct. */
const BEFORE_STRUCT = 4 + WORD;

/** A word; an address as its 20 bytes; `bytes` or text; what is encoded already, of dynamic size. */
export type Argument = bigint | number | { address: Uint8Array } | { bytes: Uint8Array } | { encoded: Uint8Array };

/** Return a call. Fields of a struct of fixed size are arguments of their own. */
export function callOf(selector: number, ...values: readonly Argument[]): Uint8Array<ArrayBuffer> {
    const tails: Uint8Array[] = [];
    let end = WORD * values.length;
    const heads = values.map((value) => {
        if (typeof value !== "object") return word(value);
        if ("address" in value) return joined([new Uint8Array(12), value.address]);
        const tail = "bytes" in value ? dynamicBytes(value.bytes) : value.encoded;
        tails.push(tail);
        end += tail.length;
        return word(end - tail.length);
    });
    return joined([selectorOf(selector), ...heads, ...tails]);
}

/** Return the struct Scene in a call of `render`, as an argument of other calls. */
export function structOf(call: Uint8Array): { encoded: Uint8Array } {
    return { encoded: call.subarray(BEFORE_STRUCT) };
}

export function word(value: bigint | number): Uint8Array<ArrayBuffer> {
    return fromHex(`0x${BigInt.asUintN(256, BigInt(value)).toString(16).padStart(64, "0")}`);
}

/** Return the address in a word that a contract returned. */
export function addressIn(output: Uint8Array): Uint8Array<ArrayBuffer> {
    return output.slice(12, WORD);
}

/** Return whether nodes relay a transaction with this data. */
export function isRelayed(data: Uint8Array): boolean {
    return data.length + ENVELOPE <= MAX_TRANSACTION;
}

/** Return the gas of a transaction before its execution, by the rules of Cancun. */
export function intrinsicGas(data: Uint8Array): number {
    let zeros = 0;
    for (const byte of data) if (!byte) zeros++;
    return 21_000 + 4 * zeros + 16 * (data.length - zeros);
}

/** Return the least gas that a transaction with this data costs since Prague (EIP-7623). */
export function floorGas(data: Uint8Array): number {
    let tokens = 0;
    for (const byte of data) tokens += byte ? 4 : 1;
    return 21_000 + 10 * tokens;
}
