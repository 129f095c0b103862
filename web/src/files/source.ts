// What readers get: a file, the files beside it, and where notes go.

import { InputError } from "../errors.js";
import type { Images } from "./images.js";

/** A file by its name, which may have folders in it. used: whether another one names it. */
export interface Given {
    name: string;
    bytes: Uint8Array<ArrayBuffer>;
    used?: boolean;
}

/** A file that is read, and those that were given with it. tell: takes a note, a sentence without the name of the file. */
export interface Source extends Given {
    folder: readonly Given[];
    /** Returns a file beside these. */
    beside: ((name: string) => Given | undefined) | undefined;
    tell: (note: string) => void;
    images: Images;
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

/** Return the text of bytes, with line ends of Unix; what is not UTF-8 is taken as the code page of Windows. */
export function textOf(bytes: Uint8Array): string {
    if (bytes.includes(0)) throw new InputError("it is not a text file, as one of this kind should be");
    let text: string;
    try {
        text = new TextDecoder("utf-8", { fatal: true }).decode(bytes);
    } catch {
        text = new TextDecoder("windows-1252").decode(bytes);
    }
    return text.includes("\r") ? text.replace(/\r\n?/g, "\n") : text;
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
