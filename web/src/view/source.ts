// Calls from files that may come from anybody: bytes of a call, scene files, and PNG files that carry their call.

import { InputError } from "../errors.js";
import { fromHex, inflate } from "../evm/bytes.js";
import { encode } from "../scene/encode.js";
import { parseScene } from "../scene/file.js";

/** The most bytes of a file, compressed or not. */
export const MAX_FILE = 1 << 24;
const PNG = [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a];
const GZIP = [0x1f, 0x8b];
/** What a chunk zTXt begins with: the keyword, and the number of the compression. */
const KEYWORD = new TextEncoder().encode("shackled\0\0");

/**
 * Return the call in a file: its bytes, or "0x" and hexadecimal digits; a scene file in JSON; a PNG file that Shackled
 * wrote; each also in gzip.
 */
export async function readFile(file: Uint8Array<ArrayBuffer>): Promise<Uint8Array<ArrayBuffer>> {
    let bytes = file;
    if (startsWith(bytes, GZIP)) bytes = await inflate(bytes, "gzip", MAX_FILE, "the file");
    if (bytes.length > MAX_FILE) throw new InputError(`a file must have up to ${MAX_FILE.toLocaleString("en")} bytes`);
    if (startsWith(bytes, PNG)) return fromHex(await textOfPng(bytes));
    const start = new TextDecoder().decode(bytes.subarray(0, 64)).trimStart();
    if (start.startsWith("0x")) return fromHex(new TextDecoder().decode(bytes).trim());
    if (start.startsWith("{")) return new Uint8Array(encode(parseScene(new TextDecoder().decode(bytes))));
    return bytes;
}

/** Return the text of the chunk in which Shackled writes the call. */
async function textOfPng(bytes: Uint8Array<ArrayBuffer>): Promise<string> {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    for (let place = PNG.length; place + 12 <= bytes.length;) {
        const size = view.getUint32(place);
        const content = bytes.subarray(place + 8, place + 8 + size);
        const type = new TextDecoder("latin1").decode(bytes.subarray(place + 4, place + 8));
        if (type === "zTXt" && startsWith(content, KEYWORD)) {
            const text = await inflate(
                content.slice(KEYWORD.length),
                "deflate",
                2 * MAX_FILE,
                "the scene in the PNG file",
            );
            return new TextDecoder().decode(text);
        }
        place += 12 + size;
    }
    throw new InputError("the PNG file carries no scene: Shackled did not write it, or without the scene");
}

function startsWith(bytes: Uint8Array, start: ArrayLike<number>): boolean {
    return bytes.length >= start.length && Array.from(start).every((value, index) => bytes[index] === value);
}
