// Images in Node, which decodes none itself.

import { convertIndexedToRgb, decode } from "fast-png";
import jpeg from "jpeg-js";
import { InputError } from "../errors.js";
import type { Image } from "./source.js";

/** Of JPEG files and of PNG files with 16 bits a channel, which take most of the memory, so many million pixels are read. */
const MOST_MILLIONS = 45;

/** Return the pixels of a PNG or JPEG file. */
export function decodeInNode(bytes: Uint8Array): Image {
    const tooMany = new InputError(`it has more than the ${MOST_MILLIONS} million pixels that are read of such a file`);
    if (bytes[0] !== 0x89) {
        try {
            const options = { useTArray: true, maxResolutionInMP: MOST_MILLIONS, maxMemoryUsageInMB: 1024 } as const;
            const { width, height, data } = jpeg.decode(bytes, options);
            return { width, height, pixels: data };
        } catch (error) {
            throw /limit exceeded/.test((error as Error).message) ? tooMany : error;
        }
    }
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
    if (bytes[24] === 16 && view.getUint32(16) * view.getUint32(20) > MOST_MILLIONS * 1e6) throw tooMany;
    const png = decode(bytes);
    const { width, height, depth } = png;
    // greys of less than a byte are packed as numbers of colours are
    const grey = (_: unknown, level: number): number[] => Array<number>(3).fill((255 * level) / (2 ** depth - 1));
    const palette = png.palette ?? (depth < 8 ? Array.from({ length: 2 ** depth }, grey) : undefined);
    const data = palette ? convertIndexedToRgb({ ...png, palette }) : png.data;
    const [channels, shift] = [data.length / (width * height), depth === 16 ? 8 : 0];
    const pixels = new Uint8Array(4 * width * height).fill(255);
    // two channels are grey and alpha
    const [green, blue] = channels > 2 ? [1, 2] : [0, 0];
    for (let from = 0, to = 0; to < pixels.length; from += channels, to += 4) {
        pixels[to] = data[from] >> shift;
        pixels[to + 1] = data[from + green] >> shift;
        pixels[to + 2] = data[from + blue] >> shift;
        if (channels % 2 === 0) pixels[to + 3] = data[from + channels - 1] >> shift;
    }
    return { width, height, pixels };
}
