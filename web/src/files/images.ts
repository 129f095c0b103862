// Images of textures: their pixels, and what of them a mesh needs.

import { InputError } from "../errors.js";
import { clamped } from "../scene/arithmetic.js";
import type { Texture } from "../scene/checked.js";
import { baseOf, fileBeside, type Image, type Source } from "./source.js";

/** An image as a file names it. name: for notes. hasAlpha: whether its alpha counts. cutoff: as in Texture. */
export interface Picture {
    image: Image;
    name: string;
    hasAlpha: boolean;
    filter: Texture["filter"];
    wraps: readonly [Texture["wrap"], Texture["wrap"]];
    cutoff: number;
}

/** The most pixels of an image, and of all that are read together. */
const [MAX_PIXELS, MAX_ALL] = [1 << 26, 1 << 28];
/** The most pixels of an image that is kept as it is, and of all of these. Larger ones have at most so many pixels a side. */
const [MAX_KEPT, MAX_ALL_KEPT, KEPT_SIDE] = [1 << 24, 1 << 26, 1024];
/** How many pixels are looked at to find triangles of one colour. */
const MAX_STEPS = 1 << 28;
const MAX_SIDE = 256;
/** How many textures of the full size a file may have; a quarter of the texels allows four times as many. */
const FULL_SIZE = 4;
/** Coordinates outside of 0..1 by less are taken as rounded; beyond the second number they are moved by whole images. */
const [ROUNDING, FAR] = [1e-4, 100];

/** What makes pixels of the bytes of an image, fewer if there are more than `most`; browsers have it built in, Node has not. */
let decoder: (bytes: Uint8Array, most: number) => Image | Promise<Image> = async (bytes, most) => {
    const options = { premultiplyAlpha: "none", colorSpaceConversion: "none" } as const;
    const bitmap = await createImageBitmap(new Blob([bytes as Uint8Array<ArrayBuffer>]), options);
    checkSize(bitmap.width, bitmap.height);
    const [width, height] = sizeWithin(bitmap, bitmap.width * bitmap.height > most ? KEPT_SIDE : Infinity);
    const context = new OffscreenCanvas(width, height).getContext("2d") as OffscreenCanvasRenderingContext2D;
    context.imageSmoothingQuality = "high";
    context.drawImage(bitmap, 0, 0, width, height);
    const given = `${bitmap.width} x ${bitmap.height}`;
    bitmap.close();
    return { width, height, given, pixels: new Uint8Array(context.getImageData(0, 0, width, height).data.buffer) };
};

/** Let another function decode images. */
export function decodeImagesBy(decode: typeof decoder): void {
    decoder = decode;
}

function checkSize(width: number, height: number): void {
    if (width * height > MAX_PIXELS)
        throw new InputError(`it has ${width} x ${height} pixels; up to ${MAX_PIXELS.toLocaleString("en")} are read`);
}

/** Return width and height that an image of a kind that packs well declares; zeros for others. */
function sizeOf(bytes: Uint8Array): readonly [number, number] {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
    const start = new TextDecoder("latin1").decode(bytes.subarray(0, 512));
    const of = (at: number, bits: number): number => view.getUint32(at, true) & (2 ** bits - 1);
    const avif = start.indexOf("ispe");
    if (start.startsWith("PNG", 1)) return [view.getUint32(16), view.getUint32(20)];
    if (start.startsWith("GIF8")) return [of(6, 16), of(8, 16)];
    if (start.startsWith("WEBPVP8 ", 8)) return [of(26, 14), of(28, 14)];
    if (start.startsWith("WEBPVP8L", 8)) return [of(21, 14) + 1, (of(21, 28) >> 14) + 1];
    if (start.startsWith("WEBPVP8X", 8)) return [of(24, 24) + 1, of(27, 24) + 1];
    return avif > 0 ? [view.getUint32(avif + 8), view.getUint32(avif + 12)] : [0, 0];
}

/** The images of files that are opened together: each is decoded once, one after the other. */
export class Images {
    private readonly known = new Map<Uint8Array, Promise<Image>>();
    private last: Promise<unknown> = Promise.resolve();
    private total = 0;

    get(bytes: Uint8Array): Promise<Image> {
        const found = this.known.get(bytes) ?? this.last.then(() => this.decode(bytes));
        this.last = found.catch(() => undefined);
        this.known.set(bytes, found);
        return found;
    }

    private async decode(bytes: Uint8Array): Promise<Image> {
        const [width, height] = sizeOf(bytes);
        checkSize(width, height);
        if (this.total + width * height > MAX_ALL)
            throw new InputError(
                `all textures together may have up to ${MAX_ALL.toLocaleString("en")} pixels; reduce them`,
            );
        const most = Math.min(MAX_KEPT, MAX_ALL_KEPT - this.total);
        const image = await decoder(bytes, most);
        this.total += width * height || image.width * image.height;
        const { given = `${image.width} x ${image.height}` } = image;
        return image.width * image.height > most ? { ...reduced(image, KEPT_SIDE, false), given } : image;
    }
}

/** Return the image in bytes; undefined, with a note, if there is none that can be read. */
export async function imageOf(bytes: Uint8Array, name: string, { images, tell }: Source): Promise<Image | undefined> {
    try {
        return await images.get(bytes);
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
export function hides(image: Image): boolean {
    return (image.hides ??= isSomewhere(image, (pixels, at) => pixels[at + 3] < 255));
}

function isSomewhere({ pixels }: Image, is: (pixels: Uint8Array, at: number) => boolean): boolean {
    for (let at = 0; at < pixels.length; at += 4) if (is(pixels, at)) return true;
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
    const [red, green, blue] = pixels;
    const isOther = (_: unknown, at: number): boolean =>
        pixels[at] !== red || pixels[at + 1] !== green || pixels[at + 2] !== blue;
    image.isOne ??= !isSomewhere(image, isOther);
    if (image.isOne) return true;
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
        image.steps = (image.steps ?? 0) + (right - left + 1) * (bottom - top + 1);
        if (image.steps > MAX_STEPS) return false;
        const color = colorAt(left, top);
        for (let y = top; y <= bottom; y++)
            for (let x = left; x <= right; x++) if (colorAt(x, y) !== color) return false;
        return true;
    });
}

/** Multiply the colours of triangles, each of which shows one colour of a picture, by that colour. */
export function tint(colors: Uint8Array, { image }: Picture, uvs: Float64Array, triangles: readonly number[]): void {
    const texel = (place: number, size: number): number => clamped(Math.floor(place * size), 0, size - 1);
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
    const [known, key] = [(picture.image.smaller ??= new Map()), `${side} ${hasAlpha}`];
    let image = known.get(key) ?? reduced(picture.image, side, hasAlpha);
    known.set(key, image);
    const [{ width, height }, { width: wide, height: high }] = [image, picture.image];
    const { given: size = `${wide} x ${high}` } = picture.image;
    if (wide > width) tell(`the texture ${name} is reduced from ${size} to ${width} x ${height} texels`);
    if (hasAlpha) image = unhidden(image);
    const pixels = image.pixels.filter((_, at) => at % 4 < 3);
    const alpha = hasAlpha ? image.pixels.filter((_, at) => at % 4 === 3) : undefined;
    return { texture: { width, height, pixels, filter, wrap, alpha, cutoff }, uvs };
}

/** Return width and height of an image that has at most so many pixels a side. */
function sizeWithin({ width, height }: Pick<Image, "width" | "height">, side: number): [number, number] {
    const scale = Math.max(Math.max(width, height) / side, 1);
    return [Math.max(Math.round(width / scale), 1), Math.max(Math.round(height / scale), 1)];
}

/** Return an image of at most so many pixels a side, each the mean of those that it covers; of colours by alpha, if that counts. */
function reduced({ width, height, pixels }: Image, side: number, byAlpha: boolean): Image {
    const [wide, high] = sizeWithin({ width, height }, side);
    if (wide === width && high === height) return { width, height, pixels };
    const found = new Uint8Array(4 * wide * high);
    /** The old pixels that a new one covers, and their shares, along an axis. */
    const covered = (size: number, old: number): [number, number][][] =>
        Array.from({ length: size }, (_, at) => {
            const [begin, end] = [(at * old) / size, ((at + 1) * old) / size];
            const first = Math.floor(begin);
            const pixels = Array.from({ length: Math.ceil(end) - first }, (_, step) => first + step);
            return pixels.map((each) => [each, Math.min(each + 1, end) - Math.max(each, begin)]);
        });
    const [columns, rows] = [covered(wide, width), covered(high, height)];
    for (let pixel = 0; pixel < wide * high; pixel++) {
        let [red, green, blue, alpha, weights, area] = [0, 0, 0, 0, 0, 0];
        const across = columns[pixel % wide];
        for (const [row, up] of rows[Math.floor(pixel / wide)]) {
            // without an iterator: an image may have 67 million pixels
            for (let place = 0; place < across.length; place++) {
                const at = 4 * (row * width + across[place][0]);
                const share = up * across[place][1];
                const weight = share * (byAlpha ? pixels[at + 3] : 1);
                red += weight * pixels[at];
                green += weight * pixels[at + 1];
                blue += weight * pixels[at + 2];
                alpha += share * pixels[at + 3];
                weights += weight;
                area += share;
            }
        }
        const all = weights || 1;
        found.set([red / all, green / all, blue / all, alpha / area].map(Math.round), 4 * pixel);
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
