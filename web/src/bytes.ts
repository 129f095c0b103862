// Bytes as hexadecimal text and base64, words of the ABI, and streams of bounded size.

import { InputError } from "./errors.js";

/** Compressed bytes that are inflated at a time. */
const STEP = 1 << 13;

/** Return the bytes of "0x" and hexadecimal digits. */
export function fromHex(text: string): Uint8Array<ArrayBuffer> {
    if (!/^0x(?:[0-9a-f]{2})*$/i.test(text)) throw new InputError("the text is not 0x and pairs of hexadecimal digits");
    const bytes = new Uint8Array(text.length / 2 - 1);
    for (let index = 0; index < bytes.length; index++) {
        bytes[index] = Number.parseInt(text.slice(2 + 2 * index, 4 + 2 * index), 16);
    }
    return bytes;
}

/** Return bytes as "0x", or another start, and hexadecimal digits. */
export function toHex(bytes: ArrayLike<number>, start = "0x"): string {
    return start + Array.from(bytes, (byte) => byte.toString(16).padStart(2, "0")).join("");
}

/** Return the bytes of a text in base64; undefined where it is none. */
export function fromBase64(text: string): Uint8Array<ArrayBuffer> | undefined {
    try {
        return Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    } catch {
        return undefined;
    }
}

export function toBase64(bytes: Uint8Array): string {
    const parts: string[] = [];
    for (let at = 0; at < bytes.length; at += 0x8000)
        parts.push(String.fromCharCode(...bytes.subarray(at, at + 0x8000)));
    return btoa(parts.join(""));
}

/** Return bytes one after the other. */
export function joined(parts: readonly Uint8Array[]): Uint8Array<ArrayBuffer> {
    const bytes = new Uint8Array(parts.reduce((size, part) => size + part.length, 0));
    let place = 0;
    for (const part of parts) bytes.set(part, (place += part.length) - part.length);
    return bytes;
}

/** Return the number of a word of 32 bytes, if it is whole and at most `most`; otherwise -1. */
export function wordAt(bytes: Uint8Array, place: number, most: number): number {
    if (!(place >= 0 && place + 32 <= bytes.length)) return -1;
    const view = new DataView(bytes.buffer, bytes.byteOffset + place, 32);
    const high = view.getBigUint64(0) | view.getBigUint64(8) | view.getBigUint64(16);
    const value = view.getBigUint64(24);
    return high === 0n && value <= BigInt(most) ? Number(value) : -1;
}

/** Return the `bytes` that the ABI encodes, whose offset is at `place`. InputError where they are cut off. */
export function bytesAt(data: Uint8Array, place: number): Uint8Array {
    const start = wordAt(data, place, data.length);
    const size = start < 0 ? -1 : wordAt(data, start, data.length);
    if (size < 0 || start + 32 + size > data.length)
        throw new InputError("the answer is not bytes that the ABI encodes");
    return data.subarray(start + 32, start + 32 + size);
}

/** Return all bytes of a stream. InputError above `most`; then the rest is not read. */
export async function readStream(
    stream: ReadableStream<Uint8Array>,
    most: number,
    name: string,
): Promise<Uint8Array<ArrayBuffer>> {
    const parts: Uint8Array[] = [];
    let size = 0;
    const reader = stream.getReader();
    for (;;) {
        const { done, value } = await reader.read();
        if (done) break;
        size += value.length;
        if (size > most) {
            await reader.cancel().catch(() => undefined);
            throw new InputError(`${name} must have up to ${most.toLocaleString("en")} bytes`);
        }
        parts.push(value);
    }
    return joined(parts);
}

/** Return whether bytes are in gzip. */
export function isGzip(bytes: Uint8Array): boolean {
    return bytes[0] === 0x1f && bytes[1] === 0x8b;
}

/** Return the stream of what compressed bytes contain. */
export function inflating(bytes: Uint8Array<ArrayBuffer>, format: CompressionFormat): ReadableStream<Uint8Array> {
    let at = 0;
    // a few at a time: browsers inflate all that they are given, to a thousand times as much, before any of it is read
    const parts = new ReadableStream<Uint8Array<ArrayBuffer>>({
        pull: (stream) => (at < bytes.length ? stream.enqueue(bytes.slice(at, (at += STEP))) : stream.close()),
    });
    return parts.pipeThrough(new DecompressionStream(format));
}

/** Return what compressed bytes contain. InputError above `most` bytes, or where they are damaged. */
export async function inflate(
    bytes: Uint8Array<ArrayBuffer>,
    format: CompressionFormat,
    most: number,
    name: string,
): Promise<Uint8Array<ArrayBuffer>> {
    try {
        return await readStream(inflating(bytes, format), most, name);
    } catch (error) {
        throw error instanceof InputError ? error : new InputError(`${name}: the compressed bytes are damaged`);
    }
}

export async function deflate(
    content: Uint8Array<ArrayBuffer> | string,
    format: CompressionFormat,
): Promise<Uint8Array<ArrayBuffer>> {
    const stream = new Blob([content]).stream().pipeThrough(new CompressionStream(format));
    return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Return the bytes of a text in base64 of bytes in gzip, as pages carry files in themselves. */
export async function unpack(text: string, most: number, name: string): Promise<Uint8Array<ArrayBuffer>> {
    const bytes = fromBase64(text.trim());
    if (!bytes) throw new InputError(`${name} is not base64`);
    return inflate(bytes, "gzip", most, name);
}
