// Packed meshes, in the format of contracts/src/scene/Mesh.sol, and the normals of their vertices.

import { InputError } from "../errors.js";
import { rint } from "./arithmetic.js";
import type { Mesh } from "./checked.js";

/** Bits of the first byte. */
export const NORMALS = 1;
export const WIDE = 2;
/** Bytes before the vertices. */
export const HEADER = 5;
/** Bytes of a face. */
export const FACE = 6;

const MAX_COUNT = 65535;
/** The largest coordinates, of 16 and of 24 bits. */
export const MAX_SHORT = 2 ** 15 - 1;
export const MAX_WIDE = 2 ** 23 - 1;
/** A unit normal is sent as a vector of this length. */
const NORMAL_UNIT = 511;

/** Return the bytes of a mesh with whole coordinates; with its normals if `smooth`. */
export function pack(mesh: Mesh, smooth: boolean): Uint8Array {
    const { positions, faces, colors } = mesh;
    const [count, faceCount] = [positions.length / 3, faces.length / 3];
    if (count > MAX_COUNT || faceCount > MAX_COUNT) {
        throw new InputError(
            `a mesh has ${count} vertices and ${faceCount} triangles; a contract takes ${MAX_COUNT} of each: simplify it`,
        );
    }
    const wide = !fits(positions, MAX_SHORT);
    const size = vertexSize((wide ? WIDE : 0) | (smooth ? NORMALS : 0));
    const normals = smooth ? packedNormals(mesh) : undefined;
    const bytes = new Uint8Array(HEADER + count * size + faceCount * FACE);
    const view = new DataView(bytes.buffer);
    view.setUint8(0, (wide ? WIDE : 0) | (smooth ? NORMALS : 0));
    view.setUint16(1, count);
    view.setUint16(3, faceCount);
    let place = HEADER;
    for (let vertex = 0; vertex < count; vertex++) {
        for (let axis = 0; axis < 3; axis++) {
            const coordinate = positions[3 * vertex + axis] as number;
            if (wide) view.setInt8(place++, coordinate >> 16);
            view.setUint16(place, coordinate & 0xffff);
            place += 2;
        }
        for (let channel = 0; channel < 3; channel++) view.setUint8(place++, colors[3 * vertex + channel] as number);
        if (normals) {
            view.setUint32(place, normals[vertex] as number);
            place += 4;
        }
    }
    for (const vertex of faces) {
        view.setUint16(place, vertex);
        place += 2;
    }
    return bytes;
}

/** Return how many bytes a vertex of a packed mesh of a format takes. */
export function vertexSize(format: number): number {
    return (format & WIDE ? 9 : 6) + 3 + (format & NORMALS ? 4 : 0);
}

/** Return unit normals, three numbers each: the mean of the faces around a vertex by area; zero where none are. */
export function vertexNormals(positions: Float64Array, faces: Uint32Array): Float64Array {
    const ofFaces = new Float64Array(faces.length);
    for (let face = 0; face < faces.length; face += 3) {
        const [a, b, c] = [0, 1, 2].map((corner) => 3 * (faces[face + corner] as number)) as [number, number, number];
        const [ux, uy, uz] = edge(positions, a, b);
        const [vx, vy, vz] = edge(positions, a, c);
        ofFaces.set([uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx], face);
    }
    const normals = new Float64Array(positions.length);
    // all first corners before the second ones: the order of the sums
    for (let corner = 0; corner < 3; corner++) {
        for (let face = 0; face < faces.length; face += 3) {
            const vertex = 3 * (faces[face + corner] as number);
            for (let axis = 0; axis < 3; axis++) {
                normals[vertex + axis] = (normals[vertex + axis] as number) + (ofFaces[face + axis] as number);
            }
        }
    }
    return unitRows(normals);
}

/** Return whether all coordinates are whole numbers that a packed mesh can hold. */
export function isIntegral(positions: Float64Array): boolean {
    return fits(positions, MAX_WIDE) && positions.every(Number.isInteger);
}

/** Return whether all coordinates lie in -most-1..most. */
export function fits(positions: Float64Array, most: number): boolean {
    return positions.every((x) => x <= most && x >= -most - 1);
}

function edge(positions: Float64Array, from: number, to: number): [number, number, number] {
    const along = (axis: number): number => (positions[to + axis] as number) - (positions[from + axis] as number);
    return [along(0), along(1), along(2)];
}

/** Return rows of three numbers as vectors of length 1, or zero. */
function unitRows(rows: Float64Array): Float64Array {
    const units = new Float64Array(rows.length);
    for (let row = 0; row < rows.length; row += 3) {
        const [x, y, z] = rows.subarray(row, row + 3) as unknown as [number, number, number];
        const size = Math.sqrt(x * x + y * y + z * z);
        if (size > 0) units.set([x / size, y / size, z / size], row);
    }
    return units;
}

/** Return each normal as three numbers of 10 bits, then two zero bits. */
function packedNormals({ positions, faces, normals }: Mesh): Uint32Array {
    const units = normals ? unitRows(normals) : vertexNormals(positions, faces);
    const words = new Uint32Array(units.length / 3);
    units.forEach((x, index) => {
        const vertex = Math.floor(index / 3);
        words[vertex] = (words[vertex] as number) | ((rint(x * NORMAL_UNIT) & 1023) << (22 - 10 * (index % 3)));
    });
    return words;
}
