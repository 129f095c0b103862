// Deflated bytes and ZIP files, of which no more is inflated than they may hold: fflate alone would inflate all of it.

import { Inflate } from "fflate";
import { InputError } from "../errors.js";
import { joined } from "../evm/bytes.js";
import type { Given } from "./source.js";

/** Deflated bytes that are inflated at a time, to at most some thousand times as many. */
const STEP = 1 << 13;
/** What begins an entry of the directory of a ZIP file, and the end of the directory; bytes of the latter. */
const [ENTRY, END, END_SIZE] = [0x02014b50, 0x06054b50, 22];

/** Return what deflated bytes hold. InputError, the message, above `most` bytes; another error where they are damaged. */
export function inflated(
    bytes: Uint8Array,
    most: number,
    message: string,
    dictionary?: Uint8Array,
): Uint8Array<ArrayBuffer> {
    const parts: Uint8Array[] = [];
    let size = 0;
    const stream = new Inflate(dictionary ? { dictionary } : {}, (part) => {
        size += part.length;
        if (size > most) throw new InputError(message);
        parts.push(part);
    });
    for (let at = 0, end = STEP; at < bytes.length; at = end, end += STEP)
        stream.push(bytes.subarray(at, end), end >= bytes.length);
    return joined(parts);
}

/** Return names and bytes of the files in a ZIP file. takes: whether one is wanted, by its name and size. Error where it is damaged. */
export function unzipped(zip: Uint8Array<ArrayBuffer>, takes: (name: string, size: number) => boolean): Given[] {
    const view = new DataView(zip.buffer, zip.byteOffset, zip.length);
    const [half, word] = [(at: number) => view.getUint16(at, true), (at: number) => view.getUint32(at, true)];
    // a comment may follow
    let end = zip.length - END_SIZE;
    while (end >= 0 && word(end) !== END) end--;
    if (end < 0) throw new Error("it has no directory");
    const found: Given[] = [];
    for (let left = half(end + 10), at = word(end + 16); left > 0; left--) {
        if (word(at) !== ENTRY) throw new Error("its directory is damaged");
        const [flags, method, packed, size] = [half(at + 8), half(at + 10), word(at + 20), word(at + 24)];
        const [local, next] = [word(at + 42), at + 46 + half(at + 28)];
        const name = new TextDecoder(flags & 0x800 ? "utf-8" : "latin1").decode(zip.subarray(at + 46, next));
        at = next + half(at + 30) + half(at + 32);
        if (!takes(name, size)) continue;
        if (flags & 1) throw new Error("its files are encrypted");
        const from = local + 30 + half(local + 26) + half(local + 28);
        const data = zip.subarray(from, from + packed);
        if (method && method !== 8) throw new Error(`${name} is compressed by method ${method}`);
        const bytes = method ? inflated(data, size, `${name} in the ZIP file is larger than it says.`) : data.slice();
        if (bytes.length !== size) throw new Error(`${name} is cut off`);
        found.push({ name, bytes });
    }
    return found;
}
