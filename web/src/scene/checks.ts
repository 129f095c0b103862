// Checks of values, each with a message that says what is wrong and what would be right.

import { InputError, show } from "../errors.js";
import { rint, type Quaternion, type Vector } from "./arithmetic.js";
import { COLOR_NAMES } from "./color_names.js";

/** Red, green, blue, 0..255. */
export type Rgb = readonly [number, number, number];
/** Red, green, blue and alpha, 0..255. */
export type Rgba = [number, number, number, number];

/** Return a finite number within low..high. */
export function number(value: unknown, name: string, low = -Infinity, high = Infinity): number {
    if (typeof value === "number" && Number.isFinite(value) && low <= value && value <= high) return value;
    const limits = high < Infinity ? ` from ${low} to ${high}` : low > -Infinity ? `, at least ${low}` : "";
    throw new InputError(`${name} must be a finite number${limits}, not ${show(value)}`);
}

/** Return a whole number within low..high. */
export function whole(value: unknown, name: string, low: number, high: number): number {
    if (Number.isInteger(value) && low <= (value as number) && (value as number) <= high) return value as number;
    throw new InputError(`${name} must be a whole number from ${low} to ${high}, not ${show(value)}`);
}

/** Return an object, whose keys must be among these. */
export function fields<T extends object>(value: T, name: string, known: readonly (keyof T & string)[]): T {
    if (typeof value !== "object" || value === null || isList(value)) {
        throw new InputError(`${name} must be an object with ${known.join(", ")}, not ${show(value)}`);
    }
    const unknown = Object.keys(value).find((key) => !(known as readonly string[]).includes(key));
    if (unknown === undefined) return value;
    throw new InputError(`${name} has the unknown key ${show(unknown)}; known are ${known.join(", ")}`);
}

export function flag(value: unknown, name: string): boolean {
    if (typeof value === "boolean") return value;
    throw new InputError(`${name} must be true or false, not ${show(value)}`);
}

export function choice<Word extends string>(value: unknown, name: string, choices: readonly Word[]): Word {
    const found = choices.find((word) => word === value);
    if (found !== undefined) return found;
    throw new InputError(`${name} must be one of ${choices.join(", ")}, not ${show(value)}`);
}

export function vector(value: unknown, name: string): Vector {
    return numbers(value, name, 3) as Vector;
}

export function quaternion(value: unknown, name: string): Quaternion {
    const found = numbers(value, name, 4) as Quaternion;
    if (found.some((x) => x)) return found;
    throw new InputError(`${name} must not be the zero quaternion; the identity is (0, 0, 0, 1)`);
}

/** Return whether a value is an array, or one of numbers such as Float32Array. */
export function isList(value: unknown): value is ArrayLike<unknown> {
    return Array.isArray(value) || (ArrayBuffer.isView(value) && "length" in value);
}

/** Return a colour as `rgba` takes it, which must be opaque. */
export function color(value: unknown, name: string): Rgb {
    const [red, green, blue, alpha] = rgba(value, name);
    if (alpha === 255) return [red, green, blue];
    throw new InputError(`${name} must be opaque, not ${show(value)}; an object has an opacity`);
}

/**
 * Return the colour of 3 or 4 whole numbers 0..255, of fractions one of which is not whole, "#rgb", "#rgba", "#rrggbb",
 * "#rrggbbaa", or a name of CSS. It is opaque where it does not say otherwise.
 */
export function rgba(value: unknown, name: string): Rgba {
    if (typeof value === "string") return rgbaOfText(value, name);
    let levels = isList(value) ? Array.from(value) : [];
    const areFractions =
        levels.every((x) => typeof x === "number" && x >= 0 && x <= 1) && !levels.every(Number.isInteger);
    if (areFractions) levels = levels.map((x) => rint(255 * (x as number)));
    if (levels.length < 3 || levels.length > 4 || !levels.every(isLevel)) {
        throw new InputError(`${name} must be red, green and blue from 0 to 255, not ${show(value)}`);
    }
    return [...levels, 255].slice(0, 4) as Rgba;
}

/** Return whether a value is a whole number 0..255. */
export function isLevel(value: unknown): value is number {
    return Number.isInteger(value) && (value as number) >= 0 && (value as number) <= 255;
}

function rgbaOfText(text: string, name: string): Rgba {
    const key = text.trim().toLowerCase();
    const known = Object.hasOwn(COLOR_NAMES, key) ? COLOR_NAMES[key] : undefined;
    if (known !== undefined) return [known >> 16, (known >> 8) & 255, known & 255, 255];
    const word = key === "transparent" ? "#0000" : key;
    if (!/^(#[0-9a-f]{3,4}|#?[0-9a-f]{6}|#[0-9a-f]{8})$/.test(word)) {
        const known = "red, green and blue from 0 to 255, #rgb, #rrggbb, or the name of a colour";
        throw new InputError(`${name} must be ${known}, not ${show(text)}`);
    }
    const digits = word.replace("#", "");
    const level = parseInt((digits.length > 4 ? digits : digits.replace(/./g, "$&$&")).padEnd(8, "f"), 16);
    return [24, 16, 8, 0].map((at) => (level >>> at) & 255) as Rgba;
}

/** Return so many finite numbers. */
export function numbers(value: unknown, name: string, size: number): number[] {
    if (isList(value) && value.length === size) {
        const found = Array.from(value);
        if (found.every((x): x is number => typeof x === "number" && Number.isFinite(x))) return found;
    }
    throw new InputError(`${name} must be ${size} finite numbers, not ${show(value)}`);
}
