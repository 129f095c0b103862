// Files of pictures and scenes, as contracts encode them; GIF, which none does, by gifenc.

import { GIFEncoder, applyPalette, quantize } from "gifenc";
import { InputError } from "../../errors.js";
import { bytesAt, joined } from "../../bytes.js";
import { drawCall } from "../../picture.js";
import { withCall } from "../../scene/call_file.js";
import { encode } from "../../scene/encode.js";
import type { Scene } from "../../scene/types.js";
import { SELECTORS, callOf, structOf } from "./calls.js";
import type { Host } from "./host.js";
import { MAX_FILE_SIDE, type Film, type Format, type Requests } from "./protocol.js";

/** The frames of which the colours of a GIF are chosen. */
const SAMPLED = 16;
const ONE = 2n ** 32n;

/** Return a file as a contract makes it. scale: side of the square that each pixel becomes. */
export async function fileOf(
    host: Host,
    scene: Scene,
    { format, scale = 1, frames = 2, duration = 80 }: { format: Format } & Partial<Film>,
): Promise<Uint8Array<ArrayBuffer>> {
    const ask = (name: "PngEncoder" | "GlbEncoder" | "Turntable", call: Uint8Array): Uint8Array<ArrayBuffer> =>
        bytesAt(host.evm.call(host.addressOf(name), call).output, 0).slice();
    const call = encode(scene);
    checkSide(scene, scale);
    if (format === "glb") return ask("GlbEncoder", callOf(SELECTORS.GlbEncoder.encode, structOf(call)));
    if (format === "apng") {
        const turn = [frames, duration, scale, 0, ONE, 0, 1];
        return ask("Turntable", callOf(SELECTORS.Turntable.animate, structOf(call), ...turn));
    }
    if (format === "transparent") {
        const pair = ["#000000", "#ffffff"].map((background) => ({
            bytes: host.draw({ ...scene, background }, true).bmp!,
        }));
        if (scene.invert) pair.reverse();
        return withCall(ask("PngEncoder", callOf(SELECTORS.PngEncoder.encodeTransparent, ...pair, scale)), call);
    }
    const { bmp } = drawCall(host.evm, call);
    if (format === "svg") return ask("PngEncoder", callOf(SELECTORS.PngEncoder.svg, { bytes: bmp }, scale));
    return withCall(ask("PngEncoder", callOf(SELECTORS.PngEncoder.encode, { bytes: bmp }, scale)), call);
}

function checkSide({ width = 128, height = 128 }: Pick<Scene, "width" | "height">, scale: number): void {
    if (Math.max(width, height) * scale > MAX_FILE_SIDE) {
        const most = MAX_FILE_SIDE.toLocaleString("en");
        throw new InputError(`A file can have up to ${most} pixels a side: choose a smaller scale`);
    }
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
