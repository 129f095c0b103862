// Packed textures, in the format of contracts/src/effects/Texture.sol.

import { InputError } from "../errors.js";
import { rint } from "./arithmetic.js";
import type { Texture } from "./checked.js";
import { TEXTURE_BILINEAR, TEXTURE_CLAMP } from "./records.js";

/** Bytes before the palette: flags, width - 1, height - 1, bits of a texel. */
const HEADER = 4;
/** Bits of a texel that is the number of a colour in a palette of 2^bits colours, and of one that is a colour. */
const INDEX_BITS = [1, 2, 4, 8] as const;
const COLOR_BITS = 24;
/** One, in texture coordinates, and what they are below. */
const UV_ONE = 2 ** 16;
const LARGEST_UV = 128;
const WORD = 32;

/** Return the bytes of a texture with the coordinates of vertices, two numbers each, in whole words. */
export function packTexture(texture: Texture, uvs: Float64Array, where: string): Uint8Array {
    const image = packImage(texture, texture.pixels);
    const uvsAt = image.length;
    const bytes = words(uvsAt + 3 * uvs.length);
    bytes.set(image);
    const view = new DataView(bytes.buffer);
    uvs.forEach((value, index) => {
        if (!(value >= -LARGEST_UV && value <= LARGEST_UV - 1 / UV_ONE)) {
            const vertex = Math.floor(index / 2);
            const range = `from ${-LARGEST_UV} to below ${LARGEST_UV}`;
            throw new InputError(
                `${where}: the texture coordinates of vertex ${vertex} must be ${range}, not ${value}`,
            );
        }
        const fixed = rint(value * UV_ONE);
        view.setInt8(uvsAt + 3 * index, fixed >> 16);
        view.setUint16(uvsAt + 3 * index + 1, fixed & 0xffff);
    });
    return bytes;
}

/** Return the bytes of the record ALPHA of a texture that has an alpha, in whole words. */
export function packAlpha(texture: Texture, alpha: Uint8Array): Uint8Array {
    const image = packImage(
        texture,
        Uint8Array.from({ length: 3 * alpha.length }, (_, at) => alpha[Math.floor(at / 3)] as number),
    );
    const bytes = words(1 + image.length);
    bytes[0] = texture.cutoff;
    bytes.set(image, 1);
    return bytes;
}

function words(size: number): Uint8Array {
    return new Uint8Array(size + (-size & (WORD - 1)));
}

/** Return header, palette and texels of an image. */
function packImage({ width, height, filter, wrap }: Texture, pixels: Uint8Array): Uint8Array {
    const texels = Array.from({ length: width * height }, (_, texel) => {
        const [red, green, blue] = pixels.subarray(3 * texel, 3 * texel + 3) as unknown as [number, number, number];
        return (red << 16) | (green << 8) | blue;
    });
    const palette = [...new Set(texels)].sort((a, b) => a - b);
    const bits = INDEX_BITS.find((each) => palette.length <= 1 << each) ?? COLOR_BITS;
    const begin = HEADER + (bits === COLOR_BITS ? 0 : 3 << bits);
    const bytes = new Uint8Array(begin + Math.ceil((texels.length * bits) / 8));
    const flags = (filter === "bilinear" ? TEXTURE_BILINEAR : 0) | (wrap === "clamp" ? TEXTURE_CLAMP : 0);
    bytes.set([flags, width - 1, height - 1, bits]);
    if (bits === COLOR_BITS) {
        bytes.set(pixels, begin);
        return bytes;
    }
    palette.forEach((color, index) => bytes.set([color >> 16, (color >> 8) & 255, color & 255], HEADER + 3 * index));
    const numbers = new Map(palette.map((color, index) => [color, index]));
    texels.forEach((color, texel) => {
        const [place, at] = [begin + ((texel * bits) >> 3), 8 - bits - ((texel * bits) & 7)];
        bytes[place] = (bytes[place] as number) | ((numbers.get(color) as number) << at);
    });
    return bytes;
}
