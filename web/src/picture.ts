// What the Renderer returns for a call: bitmaps, their pixels, and the hash of those.

import { InputError } from "./errors.js";
import { bytesAt, toHex, wordAt } from "./bytes.js";
import type { ContractEvm } from "./evm/contracts.js";
import { FUNCTIONS, functionOf, type FunctionName } from "./scene/encode.js";
import { MAX_SIDE } from "./scene/fields.js";

/** A picture as a contract made it. */
export interface Picture {
    width: number;
    height: number;
    /** Red, green, blue and 255 for each pixel, rows from the top. */
    pixels: Uint8ClampedArray<ArrayBuffer>;
    /** The file that the contract returned: a Windows bitmap of 24 bits a pixel. */
    bmp: Uint8Array;
    /** The gas of the execution. */
    gas: number;
    /** The triangles left after culling and clipping; of calls that count them. */
    triangles?: number;
    /** The pixels that any triangle covers; of calls that count them. */
    litPixels?: number;
}

/** The head of a Windows bitmap. */
const HEADER = 54;

/** The functions that return a bitmap. */
const BITMAPS: readonly FunctionName[] = ["render", "renderTile", "renderCounted", "renderTileCounted"];

/** Return the picture of a call of the Renderer. */
export function drawCall(evm: ContractEvm, call: Uint8Array, gas?: number): Picture {
    const name = functionOf(call);
    if (!name || !BITMAPS.includes(name)) {
        throw new InputError(`the call must be one of ${BITMAPS.join(", ")}${name ? `, not ${name}` : ""}`);
    }
    const answer = evm.call(evm.renderer, call, gas);
    const bmp = bytesAt(answer.output, 0);
    const counts = name.endsWith("Counted")
        ? { triangles: wordAt(answer.output, 32, 2 ** 32), litPixels: wordAt(answer.output, 64, 2 ** 32) }
        : {};
    return { ...decodeBitmap(bmp), bmp, gas: answer.gas, ...counts };
}

/** Return the same call of another function that takes the same arguments. */
export function withFunction(call: Uint8Array, name: FunctionName): Uint8Array<ArrayBuffer> {
    const bytes = new Uint8Array(call);
    new DataView(bytes.buffer).setUint32(0, FUNCTIONS[name]);
    return bytes;
}

/** Return the pixels of a bitmap as contracts write it. InputError for any other. */
export function decodeBitmap(bmp: Uint8Array): Pick<Picture, "width" | "height" | "pixels"> {
    const view = new DataView(bmp.buffer, bmp.byteOffset, bmp.byteLength);
    if (bmp.length < HEADER || view.getUint16(0) !== 0x424d) throw new InputError("the answer is not a bitmap");
    const [begin, width, height] = [view.getUint32(10, true), view.getInt32(18, true), view.getInt32(22, true)];
    const row = (3 * width + 3) & ~3;
    const inside = (side: number): boolean => side >= 1 && side <= MAX_SIDE;
    if (!inside(width) || !inside(height) || begin + row * height > bmp.length) {
        throw new InputError("the answer is not a whole bitmap of 24 bits a pixel");
    }
    const pixels = new Uint8ClampedArray(4 * width * height);
    for (let y = 0, to = 0; y < height; y++) {
        let from = begin + row * (height - 1 - y);
        for (let x = 0; x < width; x++, from += 3, to += 4) {
            pixels[to] = bmp[from + 2];
            pixels[to + 1] = bmp[from + 1];
            pixels[to + 2] = bmp[from];
            pixels[to + 3] = 255;
        }
    }
    return { width, height, pixels };
}

/** Return the SHA-256 of the red, green and blue of all pixels, rows from the top; null where the platform has none. */
export async function hashPixels(pixels: Uint8ClampedArray): Promise<string | null> {
    // browsers offer it to pages from https, localhost and files only
    const subtle = (globalThis.crypto as Crypto | undefined)?.subtle as SubtleCrypto | undefined;
    if (!subtle) return null;
    const rgb = new Uint8Array((pixels.length / 4) * 3);
    for (let from = 0, to = 0; from < pixels.length; from += 4, to += 3) {
        rgb[to] = pixels[from];
        rgb[to + 1] = pixels[from + 1];
        rgb[to + 2] = pixels[from + 2];
    }
    return toHex(new Uint8Array(await subtle.digest("SHA-256", rgb)), "");
}
