// Checked access to the bytes of calls, which may come from anybody: contracts/src/scene/Scene.sol says where what is.

import { InputError } from "../errors.js";
import type { Vector } from "./arithmetic.js";
import { MAX_COORDINATE, MAX_LIGHTS, MIN_HALF_HEIGHT } from "./constants.js";
import { FUNCTIONS, WORD, functionOf, type FunctionName } from "./encode.js";
import { MAX_SIDE } from "./fields.js";
import { LONG_KINDS, RECORD_HEADER } from "./records.js";

const SELECTOR = 4;
/** Words of the structs, up to their arrays. */
const SCENE_WORDS = 21;
const LIGHT_WORDS = 5;
export const OBJECT_WORDS = 15;

/** A number and the place of its word. */
export interface Field<T> {
    place: number;
    value: T;
}

/** A record of the extensions, and the place and the size of its content. */
export interface Extension {
    kind: number;
    index: number;
    place: number;
    size: number;
}

/** Places within a call: of an object's first word and of its packed mesh, whose size is in bytes. */
export interface ObjectPlaces {
    place: number;
    mesh: number;
    size: number;
}

/** Checked access to the bytes of a call. */
export class Reader {
    readonly view: DataView;
    readonly name: FunctionName;
    readonly #scene: number;

    constructor(readonly bytes: Uint8Array) {
        if (!(bytes instanceof Uint8Array)) throw new InputError("a call must be a Uint8Array");
        this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
        const name = functionOf(bytes);
        if (!name)
            throw new InputError(`the call must begin with the selector of ${Object.keys(FUNCTIONS).join(", ")}`);
        this.name = name;
        this.#scene = this.offset(SELECTOR, SELECTOR, SCENE_WORDS * WORD);
    }

    /** Return the place of a word of the scene. */
    field(index: number): number {
        return this.#scene + WORD * index;
    }

    /** Return the camera's projection, and the range of its half height. */
    projection(): { perspective: boolean; halfHeights: readonly [number, number] } {
        const perspective = this.count(this.field(11), 1, "the projection") === 0;
        return { perspective, halfHeights: perspective ? [2 ** -10, 2 ** 10] : [MIN_HALF_HEIGHT, MAX_COORDINATE] };
    }

    /** Return the places of the lights. */
    lights(): number[] {
        const [start, count] = this.array(this.field(18), this.#scene, LIGHT_WORDS * WORD);
        if (count > MAX_LIGHTS) throw new InputError(`a call has up to ${MAX_LIGHTS} lights, not ${count}`);
        return Array.from({ length: count }, (_, index) => start + index * LIGHT_WORDS * WORD);
    }

    objects(): ObjectPlaces[] {
        const [start, count] = this.array(this.field(19), this.#scene, WORD);
        return Array.from({ length: count }, (_, index) => {
            const place = this.offset(start + WORD * index, start, OBJECT_WORDS * WORD);
            const [mesh, size] = this.array(place, place, 1);
            return { place, mesh, size };
        });
    }

    extensions(): Extension[] {
        const [start, size] = this.array(this.field(20), this.#scene, 1);
        const found: Extension[] = [];
        for (let record = start; record < start + size;) {
            const left = start + size - record - RECORD_HEADER;
            const kind = this.bytes[record];
            const content = left < 0 ? 0 : (kind < LONG_KINDS ? 1 : WORD) * this.view.getUint16(record + 3);
            const place = record + RECORD_HEADER;
            if (left < content || left < 0) this.refuseExtension(place);
            found.push({ kind, index: this.view.getUint16(record + 1), place, size: content });
            record = place + content;
        }
        return found;
    }

    /** Throw the InputError for a record whose content is at a place. */
    refuseExtension(place: number): never {
        const record = place - RECORD_HEADER;
        throw new InputError(`the extension at byte ${record} of the call has the wrong size, or is cut off`);
    }

    /** Return where an offset leads, which is `size` bytes within the call. from: the place that it counts from. */
    offset(place: number, from: number, size: number): number {
        const end = this.bytes.length;
        const target = from + this.count(place, end, "the offset");
        if (target + size <= end) return target;
        throw new InputError(`the offset at byte ${place} of the call leads beyond its end: ${size} bytes must follow`);
    }

    /** Return the place after a length, and the length: so many elements of `size` bytes lie within the call. */
    array(place: number, from: number, size: number): [number, number] {
        const start = this.offset(place, from, WORD);
        const count = this.count(start, this.bytes.length, "the length");
        if (start + WORD + count * size <= this.bytes.length) return [start + WORD, count];
        throw new InputError(
            `the length at byte ${start} of the call leads beyond its end: ${count} times ${size} bytes`,
        );
    }

    /** Return a whole number of a word, 0..most. */
    count(place: number, most: number, name: string): number {
        const value = this.#word(place, name);
        if (value >= 0n && value <= BigInt(most)) return Number(value);
        throw new InputError(`${name} at byte ${place} of the call must be from 0 to ${most}`);
    }

    side(place: number, name: string): number {
        const side = this.count(place, MAX_SIDE, `the ${name} of the canvas`);
        if (side) return side;
        throw new InputError(`the ${name} of the canvas, at byte ${place} of the call, must be from 1 to ${MAX_SIDE}`);
    }

    /** Return a Q32 number of a word, low..high. */
    number(place: number, name: string, low = -MAX_COORDINATE, high = MAX_COORDINATE): number {
        const value = Number(this.#word(place, name)) / 2 ** 32;
        if (low <= value && value <= high) return value;
        throw new InputError(`${name} at byte ${place} of the call must be from ${low} to ${high}`);
    }

    /** Return Q32 numbers of words that follow each other. */
    numbers(place: number, count: number, name: string): number[] {
        return Array.from({ length: count }, (_, index) => this.number(place + WORD * index, name));
    }

    vector(place: number, name: string): Field<Vector> {
        return { place, value: this.numbers(place, 3, name) as Vector };
    }

    /** Return a word as a signed number; one that does not fit 64 bits as the largest of its sign. */
    #word(place: number, name: string): bigint {
        if (place + WORD > this.bytes.length) {
            throw new InputError(`the call ends at byte ${this.bytes.length}, before ${name} at byte ${place}`);
        }
        const value = this.view.getBigInt64(place + WORD - 8);
        const negative = this.bytes[place] >= 0x80;
        const fits = this.bytes.subarray(place, place + WORD - 8).every((byte) => byte === (negative ? 0xff : 0));
        if (fits && value < 0n === negative) return value;
        return negative ? -(2n ** 63n) : 2n ** 63n - 1n;
    }
}
