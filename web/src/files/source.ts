// What readers get: a file, the files beside it, and where notes go.

import { InputError } from "../errors.js";

/** A file by its name, which may have folders in it. used: whether another one names it. */
export interface Given {
    name: string;
    bytes: Uint8Array<ArrayBuffer>;
    used?: boolean;
}

/**
 * An image: rows from the top; red, green, blue and alpha of each pixel. given: the size in the file, where it was reduced.
 * The rest is kept for all surfaces that show it: what `hides` returned, whether it has one colour, how many pixels
 * `isPlain` has looked at, and smaller images of it.
 */
export interface Image {
    width: number;
    height: number;
    pixels: Uint8Array;
    given?: string;
    hides?: boolean;
    isOne?: boolean;
    steps?: number;
    smaller?: Map<string, Image>;
}

/** A file that is read, and those that were given with it. tell: takes a note, a sentence without the name of the file. */
export interface Source extends Given {
    folder: readonly Given[];
    /** Returns a file beside these. */
    beside: ((name: string) => Given | undefined) | undefined;
    tell: (note: string) => void;
    images: { get(bytes: Uint8Array): Promise<Image> };
    /** Return the decoder of Draco's meshes. */
    draco: () => Promise<Uint8Array>;
}

/** Return a count with a noun, such as "1,024 faces". */
export function plural(count: number, one: string, several = `${one}s`): string {
    return `${count.toLocaleString("en")} ${count === 1 ? one : several}`;
}

/** Return a name without its folders. */
export function baseOf(name: string): string {
    return name.replaceAll("\\", "/").replace(/.*\//, "");
}

/** Return the name of a file without folders and extension. */
export function titleOf({ name }: Given): string {
    return baseOf(name).replace(/\.[^.]*$/, "");
}

/** Return the extension of a name in small letters, with its dot. */
export function extensionOf(name: string): string {
    return /\.[^./]+$/.exec(name)?.[0].toLowerCase() ?? "";
}

/** Return bytes as UTF-8 without a byte order mark, if they begin with one. */
export function unmarked(bytes: Uint8Array): Uint8Array<ArrayBuffer> {
    const mark = `${bytes[0]} ${bytes[1]}`;
    const kind = mark === "255 254" ? "utf-16le" : mark === "254 255" ? "utf-16be" : undefined;
    if (kind) return new TextEncoder().encode(new TextDecoder(kind).decode(bytes));
    const hasMark = bytes[0] === 0xef && bytes[1] === 0xbb && bytes[2] === 0xbf;
    return bytes.subarray(hasMark ? 3 : 0) as Uint8Array<ArrayBuffer>;
}

/** Return the text of bytes, with line ends of Unix; what is not UTF-8 is taken as the code page of Windows. */
export function textOf(given: Uint8Array): string {
    const whole = unmarked(given);
    // some writers fill up with zeros
    const bytes = whole.subarray(0, whole.findLastIndex((byte) => byte) + 1);
    if (bytes.includes(0)) throw new InputError("it is not a text file, as one of this kind should be");
    let text: string;
    try {
        text = new TextDecoder("utf-8", { fatal: true }).decode(bytes);
    } catch {
        text = new TextDecoder("windows-1252").decode(bytes);
    }
    return text.includes("\r") ? text.replace(/\r\n?/g, "\n") : text;
}

/**
 * Return a text with points for decimal commas, of which a note tells, in lines that begin with a keyword, by default any.
 * What is behind # stays.
 */
export function withPoints(text: string, { tell }: Source, keywords = "[^\\s#]*"): string {
    if (!text.includes(",")) return text;
    const lines = new RegExp(`^[ \\t]*(?:${keywords})(?!\\S)[^\\n#]*`, "gm");
    const comma = /(?<!\S)([-+]?\d+),(\d+(?:e[-+]?\d+)?)(?!\S)/gi;
    const found = text.replace(lines, (line) => line.replace(comma, "$1.$2"));
    if (found !== text) tell("its numbers have decimal commas, which are read as points");
    return found;
}

/** Return the number of a word: NaN for one that says that it is none, undefined for anything else. */
export function numberOf(word: string): number | undefined {
    const value = Number(word);
    if (value === value) return value;
    return /^[-+]?(1\.#\w+|nan(\(\w*\))?|inf\w*)$/i.test(word) ? NaN : undefined;
}

/**
 * Return the file that another one names. The name may be an address, or that of the machine of its author: then it is the
 * file of that name in any folder, in any letter case.
 */
export function fileBeside({ name: from, folder, beside }: Source, name: string): Given | undefined {
    const decoded = (codes: string): string =>
        new TextDecoder().decode(Uint8Array.from(codes.slice(1).split("%"), (code) => parseInt(code, 16)));
    const plain = (text: string): string => text.replace(/(?:%[0-9a-f]{2})+/gi, decoded).replaceAll("\\", "/");
    for (const each of new Set([name.replaceAll("\\", "/"), plain(name), plain(name.replace(/[?#].*/, ""))])) {
        const parts = from.split("/").slice(0, -1);
        for (const part of each.split("/")) {
            if (part === "..") parts.pop();
            else if (part && part !== ".") parts.push(part);
        }
        const path = parts.join("/");
        const isSame = (other: Given): boolean => baseOf(other.name).toLowerCase() === baseOf(each).toLowerCase();
        const found = folder.find((other) => other.name === path) ?? folder.find(isSame) ?? beside?.(path);
        if (found) return Object.assign(found, { used: true });
    }
    return undefined;
}
