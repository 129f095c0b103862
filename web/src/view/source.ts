// Calls from files that may come from anybody: bytes of a call, scene files, and PNG files that carry their call.

import { InputError } from "../errors.js";
import { fromHex, inflate, isGzip } from "../evm/bytes.js";
import { encode } from "../scene/encode.js";
import { parseScene } from "../scene/file.js";

/** The most bytes of a file, compressed or not. */
export const MAX_FILE = 1 << 24;
/** The most characters of the text of a call in a PNG file. */
const MAX_TEXT = 8_000_000;
const PNG = [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a];
/** What a chunk zTXt begins with: the keyword, and the number of the compression. */
const KEYWORD = new TextEncoder().encode("shackled\0\0");

/**
 * Return the call in a file: its bytes, or "0x" and hexadecimal digits; a scene file in JSON; a PNG file that Shackled
 * wrote; each also in gzip.
 */
export async function readFile(file: Uint8Array<ArrayBuffer>): Promise<Uint8Array<ArrayBuffer>> {
    let bytes = file;
    if (isGzip(bytes)) bytes = await inflate(bytes, "gzip", MAX_FILE, "the file");
    if (bytes.length > MAX_FILE) throw new InputError(`a file must have up to ${MAX_FILE.toLocaleString("en")} bytes`);
    if (startsWith(bytes, PNG)) return fromHex(await textOfPng(bytes));
    const start = new TextDecoder().decode(bytes.subarray(0, 64)).trimStart();
    if (start.startsWith("0x")) return fromHex(new TextDecoder().decode(bytes).trim());
    if (start.startsWith("{")) return new Uint8Array(encode(parseScene(new TextDecoder().decode(bytes))));
    return bytes;
}

/** Return the text of the chunk in which Shackled writes the call. docs/scene-files.md documents it. */
async function textOfPng(bytes: Uint8Array<ArrayBuffer>): Promise<string> {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const found: Uint8Array<ArrayBuffer>[] = [];
    for (let place = PNG.length, type = ""; type !== "IEND" && place + 12 <= bytes.length;) {
        const end = place + 8 + view.getUint32(place);
        type = new TextDecoder("latin1").decode(bytes.subarray(place + 4, place + 8));
        const content = bytes.slice(place + 8, end);
        if (type === "zTXt" && startsWith(content, KEYWORD)) found.push(content.subarray(KEYWORD.length));
        place = end + 4;
    }
    const [content] = found;
    if (!content) throw new InputError("the picture carries no scene: it has no chunk zTXt with the keyword shackled");
    if (found.length > 1) throw new InputError(`the picture carries ${found.length} scenes; one is right`);
    return new TextDecoder().decode(await inflate(content, "deflate", MAX_TEXT, "the text of the scene"));
}

function startsWith(bytes: Uint8Array, start: ArrayLike<number>): boolean {
    return bytes.length >= start.length && Array.from(start).every((value, index) => bytes[index] === value);
}
