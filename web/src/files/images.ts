// Images of textures: their pixels, and what of them a mesh needs.

import { InputError } from "../errors.js";
import type { Texture } from "../scene/checked.js";
import { baseOf, fileBeside, type Source } from "./source.js";

/** Rows from the top; red, green, blue and alpha of each pixel. */
export interface Image {
    width: number;
    height: number;
    pixels: Uint8Array;
}

/** An image as a file names it. name: for notes. hasAlpha: whether its alpha counts. cutoff: as in Texture. */
export interface Picture {
    image: Image;
    name: string;
    hasAlpha: boolean;
    filter: Texture["filter"];
    wraps: readonly [Texture["wrap"], Texture["wrap"]];
    cutoff: number;
}

const MAX_PIXELS = 1 << 26;
const MAX_SIDE = 256;
/** How many textures of the full size a file may have; a quarter of the texels allows four times as many. */
const FULL_SIZE = 4;
/** Coordinates outside of 0..1 by less are taken as rounded; beyond the second number they are moved by whole images. */
const [ROUNDING, FAR] = [1e-4, 100];

/** What makes pixels of the bytes of an image; browsers have it built in, Node has not. */
let decoder: (bytes: Uint8Array) => Image | Promise<Image> = async (bytes) => {
    const options = { premultiplyAlpha: "none", colorSpaceConversion: "none" } as const;
    const bitmap = await createImageBitmap(new Blob([bytes as Uint8Array<ArrayBuffer>]), options);
    const { width, height } = bitmap;
    checkSize(width, height);
    const context = new OffscreenCanvas(width, height).getContext("2d") as OffscreenCanvasRenderingContext2D;
    context.drawImage(bitmap, 0, 0);
    bitmap.close();
    return { width, height, pixels: new Uint8Array(context.getImageData(0, 0, width, height).data.buffer) };
};

/** Let another function decode images. */
export function decodeImagesBy(decode: typeof decoder): void {
    decoder = decode;
}

function checkSize(width: number, height: number): void {
    if (width * height > MAX_PIXELS)
        throw new InputError(`it has ${width} x ${height} pixels; up to ${MAX_PIXELS.toLocaleString("en")} are read`);
}

/** Return the image in bytes; undefined, with a note, if there is none that can be read. */
export async function imageOf(bytes: Uint8Array, name: string, { tell }: Source): Promise<Image | undefined> {
    try {
        const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
        // of PNG files: before anything is unpacked
        if (bytes[0] === 0x89 && bytes.length > 24) checkSize(view.getUint32(16), view.getUint32(20));
        return await decoder(bytes);
    } catch (error) {
        const why = error instanceof InputError ? error.message : "it is not an image that can be read here";
        tell(`the texture ${name} is left out: ${why}`);
        return undefined;
    }
}

/** Return the picture that a file names; undefined, with a note, if it cannot be read. */
export async function pictureBeside(source: Source, name: string): Promise<Picture | undefined> {
    const file = fileBeside(source, name);
    if (!file) source.tell(`the texture ${baseOf(name)} is left out: it is not among the files that were given`);
    const image = file && (await imageOf(file.bytes, baseOf(name), source));
    return image && { image, name, hasAlpha: false, filter: "bilinear", wraps: ["repeat", "repeat"], cutoff: 0 };
}

/** Return whether an image is not opaque everywhere. */
export function hides({ pixels }: Image): boolean {
    for (let at = 3; at < pixels.length; at += 4) if (pixels[at] < 255) return true;
    return false;
}

/**
 * Return whether each of some triangles shows one colour only, as where colours are kept in a palette image. Those that
 * reach beyond the image do not count as plain. uvs: of all corners.
 */
export function isPlain(
    { image, hasAlpha, filter }: Picture,
    uvs: Float64Array,
    triangles: readonly number[],
): boolean {
    const { width, height, pixels } = image;
    if (hasAlpha) return false;
    if (pixels.every((level, at) => at % 4 === 3 || level === pixels[at % 4])) return true;
    const colorAt = (x: number, y: number): number => {
        const at = 4 * (y * width + x);
        return (pixels[at] << 16) | (pixels[at + 1] << 8) | pixels[at + 2];
    };
    const shift = filter === "bilinear" ? 0.5 : 0;
    /** The first and the last texel along an axis: those between whose centres, or in which, a triangle lies. */
    const range = (at: number, size: number): [number, number] => {
        const places = [uvs[at], uvs[at + 2], uvs[at + 4]];
        const low = Math.floor(Math.min(...places) * size - shift + 1e-3);
        const high = Math.ceil(Math.max(...places) * size - shift - 1e-3);
        return [low, Math.max(low, shift ? high : high - 1)];
    };
    return triangles.every((triangle) => {
        const [[left, right], [top, bottom]] = [range(6 * triangle, width), range(6 * triangle + 1, height)];
        if (!(left >= 0 && top >= 0 && right < width && bottom < height)) return false;
        const color = colorAt(left, top);
        for (let y = top; y <= bottom; y++)
            for (let x = left; x <= right; x++) if (colorAt(x, y) !== color) return false;
        return true;
    });
}

/** Multiply the colours of triangles, each of which shows one colour of a picture, by that colour. */
export function tint(colors: Uint8Array, { image }: Picture, uvs: Float64Array, triangles: readonly number[]): void {
    const texel = (place: number, size: number): number => Math.min(Math.max(Math.floor(place * size), 0), size - 1);
    for (const triangle of triangles) {
        for (let corner = 3 * triangle; corner < 3 * triangle + 3; corner++) {
            const [x, y] = [texel(uvs[2 * corner], image.width), texel(uvs[2 * corner + 1], image.height)];
            for (let channel = 0; channel < 3; channel++) {
                const level = image.pixels[4 * (y * image.width + x) + channel];
                colors[4 * corner + channel] = Math.round((colors[4 * corner + channel] * level) / 255);
            }
        }
    }
}

/** Return the texture of a picture, and texture coordinates of corners on it. count: of the textures of the file. */
export function textureOf(
    picture: Picture,
    given: Float64Array,
    count: number,
    { tell }: Source,
): { texture: Texture; uvs: Float64Array } {
    const uvs = given.slice();
    const { name, filter, hasAlpha, cutoff } = picture;
    const isOutside = (axis: number) => (x: number, at: number) =>
        at % 2 === axis && !(x >= -ROUNDING && x <= 1 + ROUNDING);
    const outside = [0, 1].map((axis) => uvs.some(isOutside(axis)));
    const isAny = outside.includes(true);
    const wraps = new Set(isAny ? picture.wraps.filter((_, axis) => outside[axis]) : picture.wraps);
    const wrap = wraps.size === 1 ? [...wraps][0] : isAny ? "repeat" : "clamp";
    if (wraps.size > 1 && isAny)
        tell(`the texture ${name} repeats in one direction only; it is shown as repeating in both`);
    if (wrap === "repeat" && uvs.some((x) => Math.abs(x) > FAR)) {
        for (let at = 0; at < uvs.length; at += at % 2 ? 5 : 1) {
            const whole = Math.floor(Math.min(uvs[at], uvs[at + 2], uvs[at + 4]));
            for (const each of [at, at + 2, at + 4]) uvs[each] -= whole;
        }
    }
    let side = MAX_SIDE;
    for (let left = count; left > FULL_SIZE && side > 1; left = Math.floor((left + 3) / 4)) side /= 2;
    let image = reduced(picture.image, side, hasAlpha);
    const [{ width, height }, { width: wide, height: high }] = [image, picture.image];
    if (wide > width) tell(`the texture ${name} is reduced from ${wide} x ${high} to ${width} x ${height} texels`);
    if (hasAlpha) image = unhidden(image);
    const pixels = image.pixels.filter((_, at) => at % 4 < 3);
    const alpha = hasAlpha ? image.pixels.filter((_, at) => at % 4 === 3) : undefined;
    return { texture: { width, height, pixels, filter, wrap, alpha, cutoff }, uvs };
}

/** Return an image of at most so many pixels a side, each the mean of those that it covers; of colours by alpha, if that counts. */
function reduced({ width, height, pixels }: Image, side: number, byAlpha: boolean): Image {
    const scale = Math.max(width, height) / side;
    if (scale <= 1) return { width, height, pixels };
    const [wide, high] = [width, height].map((each) => Math.max(Math.round(each / scale), 1));
    const found = new Uint8Array(4 * wide * high);
    /** The old pixels that a new one covers, and their shares, along an axis. */
    const covered = (size: number, old: number): [number, number][][] =>
        Array.from({ length: size }, (_, at) => {
            const [begin, end] = [(at * old) / size, ((at + 1) * old) / size];
            const pixels = Array.from(
                { length: Math.ceil(end) - Math.floor(begin) },
                (_, step) => Math.floor(begin) + step,
            );
            return pixels.map((each) => [each, Math.min(each + 1, end) - Math.max(each, begin)]);
        });
    const [columns, rows] = [covered(wide, width), covered(high, height)];
    for (let pixel = 0; pixel < wide * high; pixel++) {
        const sums = [0, 0, 0, 0];
        let [weights, area] = [0, 0];
        for (const [row, up] of rows[Math.floor(pixel / wide)]) {
            for (const [column, across] of columns[pixel % wide]) {
                const at = 4 * (row * width + column);
                const weight = up * across * (byAlpha ? pixels[at + 3] : 1);
                for (let channel = 0; channel < 3; channel++) sums[channel] += weight * pixels[at + channel];
                sums[3] += up * across * pixels[at + 3];
                weights += weight;
                area += up * across;
            }
        }
        sums.forEach((sum, at) => (found[4 * pixel + at] = Math.round(sum / (at < 3 ? weights || 1 : area))));
    }
    return { width: wide, height: high, pixels: found };
}

/**
 * Return an image whose hidden pixels have the colours of neighbours that are seen: colours are interpolated between
 * texels, so those of hidden ones would be seen at the borders of the others.
 */
function unhidden({ width, height, pixels }: Image): Image {
    const found = pixels.slice();
    const known = Array.from({ length: width * height }, (_, texel) => pixels[4 * texel + 3] > 0);
    let rim = [...known.keys()].filter((texel) => known[texel]);
    while (rim.length) {
        const next: number[] = [];
        for (const texel of rim) {
            const steps = [-width, width, ...(texel % width ? [-1] : []), ...((texel + 1) % width ? [1] : [])];
            for (const step of steps) {
                if (known[texel + step] !== false) continue;
                known[texel + step] = true;
                found.copyWithin(4 * (texel + step), 4 * texel, 4 * texel + 3);
                next.push(texel + step);
            }
        }
        rim = next;
    }
    return { width, height, pixels: found };
}
