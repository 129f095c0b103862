// What a file is by its content.

import tables from "toml:scene/_files/signatures.toml";
import { InputError } from "../errors.js";
import { inflate, isGzip } from "../bytes.js";
import { extensionOf, unmarked, type Given, type Source } from "./source.js";

/** What a file is: the table explains the keys. */
interface Kind {
    name: string;
    format?: string;
    do?: string;
}
interface Signature extends Kind {
    begins: string;
    case?: boolean;
    text?: boolean;
}

const { signature: SIGNATURES, damaged: DAMAGED } = tables as {
    signature: Signature[];
    damaged: Kind & { least: number };
};
/** So much of a file is compared with the signatures; and what a file of .gz may unpack to. */
const [HEAD, MOST_UNPACKED] = [1 << 16, 64 * 2 ** 20];
/** Bytes of the header of a binary STL file, which ends with the count of facets; and of a facet, the last two of which are its attribute. */
export const [STL_HEADER, STL_FACET] = [84, 50];
const BINARY_STL: Kind = { name: "a binary STL file", format: ".stl" };
/** The extensions of formats that are read. */
const FORMATS = new Set(SIGNATURES.flatMap((row) => (row.format && !row.do ? row.format : [])));
const EXPRESSIONS = SIGNATURES.map((row) => new RegExp(`^(?:${row.begins})`, row.case === false ? "i" : ""));

/** Return what the bytes of a file are, if that is known. */
export function kindOf(bytes: Uint8Array): Kind | undefined {
    const count = bytes.length < STL_HEADER ? NaN : new DataView(bytes.buffer, bytes.byteOffset).getUint32(80, true);
    if (bytes.length === STL_HEADER + STL_FACET * count) return BINARY_STL;
    if (isDamaged(bytes)) return DAMAGED;
    const start = unmarked(bytes.subarray(0, HEAD));
    const head = new TextDecoder("latin1").decode(start.subarray(0, start.findLastIndex((byte) => byte) + 1));
    return SIGNATURES.find((row, at) => EXPRESSIONS[at].test(head) && !(row.text && head.includes("\0")));
}

/** Return whether binary data was copied as text: U+FFFD stands for what was no UTF-8. */
function isDamaged(bytes: Uint8Array): boolean {
    let count = 0;
    for (let at = bytes.indexOf(0xef); at >= 0 && count < DAMAGED.least; at = bytes.indexOf(0xef, at + 1))
        if (bytes[at + 1] === 0xbf && bytes[at + 2] === 0xbd) count++;
    if (count < DAMAGED.least || !bytes.includes(0)) return false;
    try {
        return Boolean(new TextDecoder("utf-8", { fatal: true }).decode(bytes));
    } catch {
        return false;
    }
}

/** Return a file, unpacked if it is one of gzip, without the extension of that. */
export async function gunzipped(file: Given): Promise<Given> {
    if (!isGzip(file.bytes)) return file;
    const name = file.name.replace(/\.gz$/i, "");
    return { ...file, name, bytes: await inflate(file.bytes, "gzip", MOST_UNPACKED, "what it holds") };
}

/** Return the extension of the format of a file, by its content, or else by its name. */
export function formatOf({ name, bytes }: Given): string {
    const named = namedFormat(name);
    const format = kindOf(bytes)?.format;
    if (!format) return named;
    // any JSON or TOML begins as a scene file does, and all of glTF has one reader
    const isAlike = /json|toml/.test(format) || [format, named].every((each) => /^\.gl(b|tf)$/.test(each));
    return isAlike && FORMATS.has(named) ? named : format;
}

/** Return the extension of the format that the name of a file tells. */
export function namedFormat(name: string): string {
    const extension = extensionOf(name);
    return extension === ".vrm" ? ".glb" : extension;
}

/** Return the bytes of a file that is read, without a byte order mark. InputError if it is known to be something else. */
export function contentOf({ name, bytes, tell }: Pick<Source, "name" | "bytes" | "tell">): Uint8Array<ArrayBuffer> {
    const kind = kindOf(bytes);
    if (kind?.do) throw new InputError(`it is ${kind.name}: ${kind.do}`);
    const named = namedFormat(name);
    if (kind && FORMATS.has(named) && formatOf({ name, bytes }) !== named)
        tell(`it is ${kind.name}, and is read as one`);
    return kind === BINARY_STL ? bytes : unmarked(bytes);
}
