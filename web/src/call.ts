// Calls of the Renderer, read from bytes that may come from anybody: contracts/src/scene/Scene.sol says where what is.

import { InputError } from "./errors.js";
import { add, largest, rotation, times, type Quaternion, type Vector } from "./scene/arithmetic.js";
import { MAX_LIGHTS, MAX_SIDE } from "./scene/checked.js";
import { FUNCTIONS, WORD, type FunctionName } from "./scene/encode.js";
import { MAX_COORDINATE, MIN_HALF_HEIGHT } from "./scene/fit.js";
import { FACE, HEADER, NORMALS, WIDE, vertexSize } from "./scene/mesh.js";
import { LONG_KINDS, RECORD_HEADER, SIZES, SPOT } from "./scene/records.js";

const SELECTOR = 4;
/** Words of the structs, up to their arrays. */
const SCENE_WORDS = 21;
const LIGHT_WORDS = 5;
const OBJECT_WORDS = 15;

/** A number and the place of its word. */
export interface Field<T> {
    place: number;
    value: T;
}

export interface CallLight {
    directional: boolean;
    /** The direction of a directional light, the position of any other. */
    vector: Field<Vector>;
}

/** What of a call can be changed, each with its place in the bytes. */
export interface Call {
    bytes: Uint8Array;
    name: FunctionName;
    width: Field<number>;
    height: Field<number>;
    eye: Field<Vector>;
    target: Field<Vector>;
    up: Field<Vector>;
    halfHeight: Field<number>;
    /** The range of `halfHeight`. */
    halfHeights: readonly [number, number];
    lights: CallLight[];
    /** Where spot lights point: three numbers of 8 bytes each. */
    spots: Field<Vector>[];
    /** The middle of the box around the boxes of all objects, in the world; zero without objects. */
    middle: Vector;
    triangles: number;
}

/** Return what is in the bytes of a call. InputError, with the place, where they are not those of a call. */
export function readCall(bytes: Uint8Array): Call {
    const reader = new Reader(bytes);
    const name = reader.functionName();
    const scene = reader.offset(SELECTOR, SELECTOR, SCENE_WORDS * WORD);
    const field = (index: number): number => scene + WORD * index;
    const perspective = reader.count(field(11), 1, "the projection") === 0;
    const halfHeights = perspective ? ([2 ** -10, 2 ** 10] as const) : ([MIN_HALF_HEIGHT, MAX_COORDINATE] as const);
    const halfHeight = { place: field(12), value: reader.number(field(12), "the half height", ...halfHeights) };
    return {
        bytes,
        name,
        width: { place: field(0), value: reader.side(field(0), "width") },
        height: { place: field(1), value: reader.side(field(1), "height") },
        eye: reader.vector(field(2), "the camera's eye"),
        target: reader.vector(field(5), "the camera's target"),
        up: reader.vector(field(8), "the camera's up"),
        halfHeight,
        halfHeights,
        lights: reader.lights(scene, field(18)),
        spots: reader.spots(scene, field(20)),
        ...reader.objects(scene, field(19)),
    };
}

/** Checked access to the bytes of a call. */
class Reader {
    readonly #bytes: Uint8Array;
    readonly #view: DataView;

    constructor(bytes: Uint8Array) {
        if (!(bytes instanceof Uint8Array)) throw new InputError("a call must be a Uint8Array");
        this.#bytes = bytes;
        this.#view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    }

    functionName(): FunctionName {
        const selector = this.#bytes.length < SELECTOR ? -1 : this.#view.getUint32(0);
        const name = (Object.keys(FUNCTIONS) as FunctionName[]).find((each) => FUNCTIONS[each] === selector);
        if (name) return name;
        throw new InputError(`the call must begin with the selector of ${Object.keys(FUNCTIONS).join(", ")}`);
    }

    /** Return where an offset leads, which is `size` bytes within the call. from: the place that it counts from. */
    offset(place: number, from: number, size: number): number {
        const end = this.#bytes.length;
        const target = from + this.count(place, end, "the offset");
        if (target + size <= end) return target;
        throw new InputError(`the offset at byte ${place} of the call leads beyond its end: ${size} bytes must follow`);
    }

    /** Return the place after a length, and the length: so many elements of `size` bytes lie within the call. */
    array(place: number, from: number, size: number): [number, number] {
        const start = this.offset(place, from, WORD);
        const count = this.count(start, this.#bytes.length, "the length");
        if (start + WORD + count * size <= this.#bytes.length) return [start + WORD, count];
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

    vector(place: number, name: string): Field<Vector> {
        return { place, value: [0, 1, 2].map((axis) => this.number(place + WORD * axis, name)) as Vector };
    }

    lights(scene: number, place: number): CallLight[] {
        const [start, count] = this.array(place, scene, LIGHT_WORDS * WORD);
        if (count > MAX_LIGHTS) throw new InputError(`a call has up to ${MAX_LIGHTS} lights, not ${count}`);
        return Array.from({ length: count }, (_, index) => {
            const light = start + index * LIGHT_WORDS * WORD;
            const directional = this.count(light, 1, `the kind of light ${index}`) === 0;
            return { directional, vector: this.vector(light + WORD, `the vector of light ${index}`) };
        });
    }

    /** Return where spot lights point, from the extensions. */
    spots(scene: number, place: number): Field<Vector>[] {
        const [start, size] = this.array(place, scene, 1);
        const spots: Field<Vector>[] = [];
        for (let record = start; record < start + size;) {
            const left = start + size - record - RECORD_HEADER;
            const unit = (this.#bytes[record] as number) < LONG_KINDS ? 1 : WORD;
            const content = left < 0 ? 0 : unit * this.#view.getUint16(record + 3);
            const isSpot = this.#bytes[record] === SPOT;
            if (left < content || left < 0 || (isSpot && content !== SIZES[SPOT])) {
                throw new InputError(`the extension at byte ${record} of the call has the wrong size, or is cut off`);
            }
            const numbers = record + RECORD_HEADER;
            if (isSpot) {
                const value = [0, 8, 16].map((at) => Number(this.#view.getBigInt64(numbers + at)) / 2 ** 32) as Vector;
                if (!(largest(value) > 0 && largest(value) <= MAX_COORDINATE)) {
                    throw new InputError(
                        `the direction of the spot light at byte ${record} of the call is zero, or too long`,
                    );
                }
                spots.push({ place: numbers, value });
            }
            record = numbers + content;
        }
        return spots;
    }

    /** Return the middle of the box around the boxes of all objects, and the number of triangles. */
    objects(scene: number, place: number): { middle: Vector; triangles: number } {
        const [start, count] = this.array(place, scene, WORD);
        const low: Vector = [Infinity, Infinity, Infinity];
        const high: Vector = [-Infinity, -Infinity, -Infinity];
        const meshes = new Map<number, { corners: Vector[]; triangles: number }>();
        let bytesOfMeshes = 0;
        let triangles = 0;
        for (let index = 0; index < count; index++) {
            const object = this.offset(start + WORD * index, start, OBJECT_WORDS * WORD);
            const [meshStart, size] = this.array(object, object, 1);
            let mesh = meshes.get(meshStart);
            if (!mesh) {
                // meshes may be shared, but not overlap: reading them takes no longer than the call
                bytesOfMeshes += size;
                if (bytesOfMeshes > this.#bytes.length) throw new InputError("the meshes of the call overlap");
                mesh = this.#mesh(meshStart, size, index);
                meshes.set(meshStart, mesh);
            }
            triangles += mesh.triangles;
            const name = `object ${index}`;
            const position = this.vector(object + WORD, `the position of ${name}`).value;
            const numbers = [4, 5, 6, 7].map((at) => this.number(object + WORD * at, `the rotation of ${name}`));
            if (!numbers.some((x) => x))
                throw new InputError(`the rotation of ${name} of the call is the zero quaternion`);
            const scale = this.number(object + WORD * 8, `the scale of ${name}`, 0);
            const turn = rotation(numbers as Quaternion);
            for (const corner of mesh.corners) {
                add(position, turn(times(scale, corner))).forEach((x, axis) => {
                    low[axis as 0 | 1 | 2] = Math.min(low[axis as 0 | 1 | 2], x);
                    high[axis as 0 | 1 | 2] = Math.max(high[axis as 0 | 1 | 2], x);
                });
            }
        }
        const middle = times(0.5, add(low, high));
        return { middle: middle.every(Number.isFinite) ? middle : [0, 0, 0], triangles };
    }

    /** Return the corners of the box around the vertices of a mesh, none without vertices. */
    #mesh(start: number, size: number, object: number): { corners: Vector[]; triangles: number } {
        const format = size < HEADER ? 0xff : this.#view.getUint8(start);
        if (format > NORMALS + WIDE) throw new InputError(`the mesh of object ${object} of the call has no header`);
        const [vertices, triangles] = [this.#view.getUint16(start + 1), this.#view.getUint16(start + 3)];
        const stride = vertexSize(format);
        const expected = HEADER + vertices * stride + triangles * FACE;
        if (size !== expected) {
            throw new InputError(`the mesh of object ${object} of the call must have ${expected} bytes, not ${size}`);
        }
        if (!vertices) return { corners: [], triangles };
        const range = (axis: number): readonly number[] => {
            let [low, high] = [Infinity, -Infinity];
            for (let vertex = 0, at = start + HEADER; vertex < vertices; vertex++, at += stride) {
                const place = at + (format & WIDE ? 3 : 2) * axis;
                const short = this.#view.getInt16(place);
                const x = format & WIDE ? short * 256 + this.#view.getUint8(place + 2) : short;
                if (x < low) low = x;
                if (x > high) high = x;
            }
            return [low, high];
        };
        const [xs, ys, zs] = [range(0), range(1), range(2)];
        return { corners: xs.flatMap((x) => ys.flatMap((y) => zs.map((z): Vector => [x, y, z]))), triangles };
    }

    /** Return a word as a signed number; one that does not fit 64 bits as the largest of its sign. */
    #word(place: number, name: string): bigint {
        if (place + WORD > this.#bytes.length) {
            throw new InputError(`the call ends at byte ${this.#bytes.length}, before ${name} at byte ${place}`);
        }
        const value = this.#view.getBigInt64(place + WORD - 8);
        const negative = (this.#bytes[place] as number) >= 0x80;
        const fits = this.#bytes.subarray(place, place + WORD - 8).every((byte) => byte === (negative ? 0xff : 0));
        if (fits && value < 0n === negative) return value;
        return negative ? -(2n ** 63n) : 2n ** 63n - 1n;
    }
}
