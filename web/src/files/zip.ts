// The files in a ZIP file, of which no more is inflated than its directory says.

import { inflate } from "../bytes.js";
import type { Given } from "./source.js";

/** What begins an entry of the directory of a ZIP file, and the end of the directory; bytes of the latter. */
const [ENTRY, END, END_SIZE] = [0x02014b50, 0x06054b50, 22];

/** Return names and bytes of the files in a ZIP file. takes: whether one is wanted, by its name and size. Error where it is damaged. */
export async function unzipped(
    zip: Uint8Array<ArrayBuffer>,
    takes: (name: string, size: number) => boolean,
): Promise<Given[]> {
    const view = new DataView(zip.buffer, zip.byteOffset, zip.length);
    const [half, word] = [(at: number) => view.getUint16(at, true), (at: number) => view.getUint32(at, true)];
    // a comment may follow
    let end = zip.length - END_SIZE;
    while (end >= 0 && word(end) !== END) end--;
    if (end < 0) throw new Error("it has no directory");
    const found: Given[] = [];
    for (let left = half(end + 10), at = word(end + 16); left > 0; left--) {
        if (word(at) !== ENTRY) throw new Error("its directory is damaged");
        const [flags, method, next] = [half(at + 8), half(at + 10), at + 46 + half(at + 28)];
        const name = new TextDecoder(flags & 0x800 ? "utf-8" : "latin1").decode(zip.subarray(at + 46, next));
        // numbers of eight bytes follow the name (ZIP64)
        let wide = next + 4;
        const [size, packed, local] = [24, 20, 42].map((place) =>
            word(at + place) < 0xffffffff ? word(at + place) : Number(view.getBigUint64((wide += 8) - 8, true)),
        ) as [number, number, number];
        at = next + half(at + 30) + half(at + 32);
        if (!takes(name, size)) continue;
        if (flags & 1) throw new Error("its files are encrypted");
        if (method && method !== 8) throw new Error(`${name} is compressed by method ${method}`);
        const from = local + 30 + half(local + 26) + half(local + 28);
        const data = zip.slice(from, from + packed);
        const bytes = method ? await inflate(data, "deflate-raw", size, `by the directory, ${name}`) : data;
        if (bytes.length !== size) throw new Error(`${name} is cut off`);
        found.push({ name, bytes });
    }
    return found;
}
