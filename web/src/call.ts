// Calls of the Renderer, read from bytes that may come from anybody, to be changed.

import { InputError, about } from "./errors.js";
import { add, boundsOf, largest, rotation, times, type Quaternion, type Vector } from "./scene/arithmetic.js";
import { WORD, type FunctionName } from "./scene/encode.js";
import { MAX_COORDINATE } from "./scene/constants.js";
import { unpackedPositions } from "./scene/mesh.js";
import { Reader, type Field } from "./scene/reader.js";
import { SIZES, SPOT } from "./scene/records.js";

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
    const field = (index: number): number => reader.field(index);
    const { halfHeights } = reader.projection();
    return {
        bytes,
        name: reader.name,
        width: { place: field(0), value: reader.side(field(0), "width") },
        height: { place: field(1), value: reader.side(field(1), "height") },
        eye: reader.vector(field(2), "the camera's eye"),
        target: reader.vector(field(5), "the camera's target"),
        up: reader.vector(field(8), "the camera's up"),
        halfHeight: { place: field(12), value: reader.number(field(12), "the half height", ...halfHeights) },
        halfHeights,
        lights: reader.lights().map((place, index) => ({
            directional: reader.count(place, 1, `the kind of light ${index}`) === 0,
            vector: reader.vector(place + WORD, `the vector of light ${index}`),
        })),
        spots: spotsOf(reader),
        ...objectsOf(reader),
    };
}

/** Return where spot lights point, from the extensions. */
function spotsOf(reader: Reader): Field<Vector>[] {
    return reader.extensions().flatMap(({ kind, place, size }) => {
        if (kind !== SPOT) return [];
        if (size !== SIZES[SPOT]) reader.refuseExtension(place);
        const value = [0, 8, 16].map((at) => Number(reader.view.getBigInt64(place + at)) / 2 ** 32) as Vector;
        if (largest(value) > 0 && largest(value) <= MAX_COORDINATE) return [{ place, value }];
        throw new InputError(`the direction of the spot light at byte ${place} of the call is zero, or too long`);
    });
}

/** Return the middle of the box around the boxes of all objects, and the number of triangles. */
function objectsOf(reader: Reader): { middle: Vector; triangles: number } {
    const meshes = new Map<number, { corners: Vector[]; triangles: number }>();
    const corners: number[] = [];
    let [bytesOfMeshes, triangles] = [0, 0];
    reader.objects().forEach(({ place, mesh: start, size }, index) => {
        let mesh = meshes.get(start);
        if (!mesh) {
            // meshes may be shared, but not overlap: reading them takes no longer than the call
            bytesOfMeshes += size;
            if (bytesOfMeshes > reader.bytes.length) throw new InputError("the meshes of the call overlap");
            mesh = about(`object ${index} of the call`, () => cornersOf(reader.bytes.subarray(start, start + size)));
            meshes.set(start, mesh);
        }
        triangles += mesh.triangles;
        const name = `object ${index}`;
        const position = reader.vector(place + WORD, `the position of ${name}`).value;
        const numbers = reader.numbers(place + 4 * WORD, 4, `the rotation of ${name}`) as Quaternion;
        if (!numbers.some((x) => x)) throw new InputError(`the rotation of ${name} of the call is the zero quaternion`);
        const scale = reader.number(place + 8 * WORD, `the scale of ${name}`, 0);
        const turn = rotation(numbers);
        for (const corner of mesh.corners) corners.push(...add(position, turn(times(scale, corner))));
    });
    return { middle: times(0.5, add(...boundsOf(Float64Array.from(corners)))), triangles };
}

/** Return the corners of the box around the vertices of a packed mesh, none without vertices. */
function cornersOf(packed: Uint8Array): { corners: Vector[]; triangles: number } {
    const { positions, triangles } = unpackedPositions(packed);
    const [low, high] = boundsOf(positions);
    const [xs, ys, zs] = low.map((x, axis) => [x, high[axis]]);
    const corners = xs.flatMap((x) => ys.flatMap((y) => zs.map((z): Vector => [x, y, z])));
    return { corners: positions.length ? corners : [], triangles };
}
