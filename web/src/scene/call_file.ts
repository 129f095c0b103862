// Calls in files. Those that are read may come from anybody: bytes of a call, scene files, and PNG files that carry their call.

import { InputError } from "../errors.js";
import { deflate, fromHex, inflate, isGzip, joined, toHex } from "../bytes.js";
import { encode } from "./encode.js";
import { parseScene } from "./file.js";

/** The most bytes of a file, compressed or not. */
export const MAX_FILE = 1 << 24;
/** The most characters of the text of a call in a PNG file that is read; and in one that is written, with the bytes of its chunk. */
const MAX_TEXT = 8_000_000;
const [MAX_WRITTEN, MAX_CHUNK] = [2 ** 20, 64 * 1024];
/** Bytes of a PNG file up to the end of its chunk IHDR, behind which the call is written. */
const PNG_HEADER = 33;
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

/** Return a PNG file that carries its scene, as docs/scene-files.md says; the same file if the scene is large. */
export async function withCall(png: Uint8Array<ArrayBuffer>, call: Uint8Array): Promise<Uint8Array<ArrayBuffer>> {
    const text = toHex(call);
    if (text.length > MAX_WRITTEN) return png;
    const content = joined([KEYWORD, await deflate(text, "deflate")]);
    if (content.length > MAX_CHUNK) return png;
    return joined([png.subarray(0, PNG_HEADER), chunk("zTXt", content), png.subarray(PNG_HEADER)]);
}

function chunk(kind: string, content: Uint8Array): Uint8Array {
    const made = new Uint8Array(12 + content.length);
    const view = new DataView(made.buffer);
    view.setUint32(0, content.length);
    made.set(new TextEncoder().encode(kind), 4);
    made.set(content, 8);
    view.setUint32(8 + content.length, crc32(made.subarray(4, 8 + content.length)));
    return made;
}

function crc32(bytes: Uint8Array): number {
    let crc = -1;
    for (const byte of bytes) {
        crc ^= byte;
        for (let bit = 0; bit < 8; bit++) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
    }
    return ~crc >>> 0;
}

function startsWith(bytes: Uint8Array, start: ArrayLike<number>): boolean {
    return bytes.length >= start.length && Array.from(start).every((value, index) => bytes[index] === value);
}
