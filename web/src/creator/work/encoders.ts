// Files of pictures and scenes, as contracts encode them; GIF, which none does, by gifenc.

import { GIFEncoder, applyPalette, quantize } from "gifenc";
import { InputError } from "../../errors.js";
import { bytesAt, deflate, joined, toHex } from "../../evm/bytes.js";
import { drawCall } from "../../picture.js";
import { encode } from "../../scene/encode.js";
import type { Scene } from "../../scene/types.js";
import { SELECTORS, callOf, structOf } from "./calls.js";
import type { Machine } from "./machine.js";
import { MAX_FILE_SIDE, type Film, type Format, type Requests } from "./protocol.js";

/** The most bytes of the chunk with the scene in a PNG file, and the most characters of its text. */
const MAX_CHUNK = 64 * 1024;
const MAX_TEXT = 2 ** 20;
/** Bytes of a PNG file up to the end of its chunk IHDR, behind which the scene is. */
const PNG_HEADER = 33;
const KEYWORD = new TextEncoder().encode("shackled\0\0");
/** The frames of which the colours of a GIF are chosen. */
const SAMPLED = 16;
const ONE = 2n ** 32n;

/** Return a file as a contract makes it. scale: side of the square that each pixel becomes. */
export async function fileOf(
    machine: Machine,
    scene: Scene,
    { format, scale = 1, frames = 2, duration = 80 }: { format: Format } & Partial<Film>,
): Promise<Uint8Array<ArrayBuffer>> {
    const ask = (name: "PngEncoder" | "GlbEncoder" | "Turntable", call: Uint8Array): Uint8Array<ArrayBuffer> =>
        bytesAt(machine.evm.call(machine.addressOf(name), call).output, 0).slice();
    const call = encode(scene);
    checkSide(scene, scale);
    if (format === "glb") return ask("GlbEncoder", callOf(SELECTORS.GlbEncoder.encode, structOf(call)));
    if (format === "apng") {
        const turn = [frames, duration, scale, 0, ONE, 0, 1];
        return ask("Turntable", callOf(SELECTORS.Turntable.animate, structOf(call), ...turn));
    }
    if (format === "transparent") {
        const over = (background: string): { bytes: Uint8Array } => ({
            bytes: machine.draw({ ...scene, background }, true).bmp!,
        });
        const pair = [over("#000000"), over("#ffffff")];
        if (scene.invert) pair.reverse();
        return withScene(ask("PngEncoder", callOf(SELECTORS.PngEncoder.encodeTransparent, ...pair, scale)), call);
    }
    const { bmp } = drawCall(machine.evm, call);
    if (format === "svg") return ask("PngEncoder", callOf(SELECTORS.PngEncoder.svg, { bytes: bmp }, scale));
    return withScene(ask("PngEncoder", callOf(SELECTORS.PngEncoder.encode, { bytes: bmp }, scale)), call);
}

function checkSide({ width = 128, height = 128 }: Pick<Scene, "width" | "height">, scale: number): void {
    if (Math.max(width, height) * scale > MAX_FILE_SIDE) {
        throw new InputError(
            `A file can have up to ${MAX_FILE_SIDE.toLocaleString("en")} pixels a side: choose a smaller scale`,
        );
    }
}

/** Return a PNG file that carries its scene, as docs/scene-files.md says; the same file if the scene is large. */
export async function withScene(png: Uint8Array<ArrayBuffer>, call: Uint8Array): Promise<Uint8Array<ArrayBuffer>> {
    const text = toHex(call);
    if (text.length > MAX_TEXT) return png;
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

/** Return an endless GIF. Its frames have one palette, so that none flickers. */
export function gifOf({ frames, duration, scale }: Requests["gif"][0]): Uint8Array<ArrayBuffer> {
    const [first] = frames;
    if (!first) throw new InputError("A GIF needs frames");
    checkSide(first, scale);
    const step = Math.ceil(frames.length / SAMPLED);
    const chosen = frames.filter((_, index) => index % step === 0);
    const palette = quantize(joined(chosen.map(({ pixels }) => new Uint8Array(pixels.buffer))), 256);
    const gif = GIFEncoder();
    frames.forEach(({ pixels }, number) => {
        const indexes = enlarged(applyPalette(pixels, palette), first.width, scale);
        const options = { ...(number ? {} : { palette }), delay: duration };
        gif.writeFrame(indexes, first.width * scale, first.height * scale, options);
    });
    gif.finish();
    return gif.bytes() as Uint8Array<ArrayBuffer>;
}

function enlarged(indexes: Uint8Array, width: number, scale: number): Uint8Array {
    const [row, rows] = [width * scale, (indexes.length / width) * scale];
    const large = new Uint8Array(row * rows);
    for (let y = 0; y < rows; y++) {
        const from = Math.floor(y / scale) * width;
        for (let x = 0; x < row; x++) large[y * row + x] = indexes[from + Math.floor(x / scale)];
    }
    return large;
}
