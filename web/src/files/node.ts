// Images in Node, which decodes none itself.

import { convertIndexedToRgb, decode } from "fast-png";
import jpeg from "jpeg-js";
import type { Image } from "./images.js";

/** Return the pixels of a PNG or JPEG file. */
export function decodeInNode(bytes: Uint8Array): Image {
    if (bytes[0] !== 0x89) {
        const { width, height, data } = jpeg.decode(bytes, { useTArray: true, maxMemoryUsageInMB: 1024 });
        return { width, height, pixels: Uint8Array.from(data) };
    }
    const png = decode(bytes);
    const { width, height, depth } = png;
    // greys of less than a byte are packed as numbers of colours are
    const grey = (_: unknown, level: number): number[] => Array<number>(3).fill((255 * level) / (2 ** depth - 1));
    const palette = png.palette ?? (depth < 8 ? Array.from({ length: 2 ** depth }, grey) : undefined);
    const data = palette ? convertIndexedToRgb({ ...png, palette }) : png.data;
    const channels = data.length / (width * height);
    const level = (pixel: number, channel: number): number =>
        data[channels * pixel + channel] >> (depth === 16 ? 8 : 0);
    const pixels = Uint8Array.from({ length: 4 * width * height }, (_, at) => {
        const [pixel, channel] = [Math.floor(at / 4), at % 4];
        if (channel === 3) return channels % 2 ? 255 : level(pixel, channels - 1);
        return level(pixel, channels > 2 ? channel : 0);
    });
    return { width, height, pixels };
}
