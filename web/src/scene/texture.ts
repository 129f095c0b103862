// Packed textures, in the format of contracts/src/effects/Texture.sol.

import { InputError } from "../errors.js";
import { rint } from "./arithmetic.js";
import type { Texture } from "./checked.js";
import { remembered } from "./memory.js";
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
export const packTexture = remembered((texture: Texture, uvs: Float64Array): Uint8Array => {
    const image = packImage(texture, texture.pixels);
    const uvsAt = image.length;
    const bytes = words(uvsAt + 3 * uvs.length);
    bytes.set(image);
    const view = new DataView(bytes.buffer);
    uvs.forEach((value, index) => {
        if (!(value >= -LARGEST_UV && value <= LARGEST_UV - 1 / UV_ONE)) {
            const vertex = Math.floor(index / 2);
            const range = `from ${-LARGEST_UV} to below ${LARGEST_UV}`;
            throw new InputError(`the texture coordinates of vertex ${vertex} must be ${range}, not ${value}`);
        }
        const fixed = rint(value * UV_ONE);
        view.setInt8(uvsAt + 3 * index, fixed >> 16);
        view.setUint16(uvsAt + 3 * index + 1, fixed & 0xffff);
    });
    return bytes;
});

/** Return the bytes of the record ALPHA of a texture that has an alpha, in whole words. */
export const packAlpha = remembered((texture: Texture, alpha: Uint8Array): Uint8Array => {
    const greys = Uint8Array.from({ length: 3 * alpha.length }, (_, at) => alpha[Math.floor(at / 3)]);
    const image = packImage(texture, greys);
    const bytes = words(1 + image.length);
    bytes[0] = texture.cutoff;
    bytes.set(image, 1);
    return bytes;
});

/** Return the texture and the coordinates of so many vertices of what `packTexture` made, or would make otherwise. */
export function unpackTexture(packed: Uint8Array, vertices: number): { texture: Texture; uvs: Float64Array } {
    const { texture, end } = unpackImage(packed, 6 * vertices);
    const view = new DataView(packed.buffer, packed.byteOffset + end);
    const uv = (_: unknown, at: number): number => (view.getInt8(3 * at) * 65536 + view.getUint16(3 * at + 1)) / UV_ONE;
    return { texture, uvs: Float64Array.from({ length: 2 * vertices }, uv) };
}

/** Return the texture with the alpha of what `packAlpha` made, or would make otherwise. */
export function unpackAlpha(packed: Uint8Array, texture: Texture): Texture {
    const { pixels, width, height } = unpackImage(packed.subarray(1), 0).texture;
    if (width !== texture.width || height !== texture.height) {
        throw new InputError("the alpha of a texture must have the size of its colours");
    }
    return { ...texture, alpha: pixels.filter((_, at) => at % 3 === 2), cutoff: packed[0] };
}

/** Return the texture of header, palette and texels, and where they end; so many bytes must follow at least. */
function unpackImage(packed: Uint8Array, more: number): { texture: Texture; end: number } {
    const [flags, width, height, bits] = [packed[0], packed[1] + 1, packed[2] + 1, packed[3]];
    const isIndexed = INDEX_BITS.some((each) => each === bits);
    const begin = HEADER + (isIndexed ? 3 << bits : 0);
    const end = begin + Math.ceil((width * height * bits) / 8);
    if ((!isIndexed && bits !== COLOR_BITS) || !(end + more <= packed.length)) {
        throw new InputError("a packed texture is cut off, or its texels have not 1, 2, 4, 8 or 24 bits");
    }
    const pixels = new Uint8Array(3 * width * height);
    for (let texel = 0; texel < width * height; texel++) {
        const place = begin + ((texel * bits) >> 3);
        const number = (packed[place] >> (8 - bits - ((texel * bits) & 7))) & ((1 << bits) - 1);
        const from = isIndexed ? HEADER + 3 * number : place;
        for (let channel = 0; channel < 3; channel++) pixels[3 * texel + channel] = packed[from + channel];
    }
    const filter = flags & TEXTURE_BILINEAR ? "bilinear" : "nearest";
    const wrap = flags & TEXTURE_CLAMP ? "clamp" : "repeat";
    return { texture: { width, height, pixels, filter, wrap, alpha: undefined, cutoff: 0 }, end };
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
        bytes[place] = bytes[place] | ((numbers.get(color) as number) << at);
    });
    return bytes;
}
