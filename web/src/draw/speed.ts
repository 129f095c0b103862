// How long pictures of a size take, and the size at which they are drawn while the viewer moves.

import { clamped } from "../scene/arithmetic.js";

/** Milliseconds that a picture may take while the viewer moves: 60 a second at the call's own size or above it, or 25. */
const FRAME = 16;
export const SLOW_FRAME = 40;
/** Sizes while the viewer moves, as fractions of that at rest, and below the call's own as fractions of that. */
const LARGER = [1, 0.75, 0.5];
const SMALLER = [1, 0.75, 0.5, 0.25, 0.125];
/** Which share of the time does not depend on the number of pixels, beyond the sizes that are known. */
const FIXED = 0.25;
/** By how many times a picture counts as slower than the one before it, at most. */
const OUTLIER = 1.5;
const MIN_SIDE = 16;

/** Width and height in pixels. */
export type Size = readonly [number, number];

export class Speed {
    /** Milliseconds by the number of pixels. */
    readonly #seen = new Map<number, number>();

    /** Note how long a picture took. One that took much longer than before says more about the machine than about itself. */
    add(pixels: number, milliseconds: number): void {
        const before = this.#seen.get(pixels) ?? Infinity;
        this.#seen.set(pixels, Math.min(milliseconds, OUTLIER * before));
        // more pixels take no longer than each of these does, and fewer no longer than all: what was slower then, is not now
        for (const [size, known] of this.#seen)
            this.#seen.set(size, Math.min(known, milliseconds * Math.max(1, size / pixels)));
    }

    /** Return how long a picture will take, in milliseconds; 0 if none was drawn yet. */
    predict(pixels: number): number {
        const known = [...this.#seen].sort(([a], [b]) => a - b);
        const high = known.find(([size]) => size >= pixels);
        const low = known.findLast(([size]) => size <= pixels);
        if (low && high && low !== high) {
            return low[1] + ((high[1] - low[1]) * (pixels - low[0])) / (high[0] - low[0]);
        }
        const near = low ?? high;
        return near ? near[1] * (FIXED + ((1 - FIXED) * pixels) / near[0]) : 0;
    }

    /** Return the largest size that is fast enough to move. own: that of the call. shown: that at rest, no smaller. */
    movingSize(own: Size, shown: Size): Size {
        const sizes = [...LARGER.map((part) => scaled(shown, part)), ...SMALLER.map((part) => scaled(own, part))];
        const allowed = sizes.filter(([width], index) => index >= LARGER.length || width > own[0]);
        const within = (time: number, sizes: readonly Size[]): Size | undefined =>
            sizes.find((size) => this.predict(areaOf(size)) <= time);
        const large = allowed.filter(([width]) => width >= own[0]);
        return within(FRAME, large) ?? within(SLOW_FRAME, allowed) ?? (allowed.at(-1) as Size);
    }
}

export function areaOf([width, height]: Size): number {
    return width * height;
}

/** Return a part of a size, in its proportions. */
export function scaled([width, height]: Size, part: number): Size {
    const factor = clamped(part, MIN_SIDE / Math.min(width, height), 1);
    return [Math.round(width * factor), Math.round(height * factor)];
}
