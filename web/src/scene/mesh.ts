// Packed meshes, in the format of contracts/src/scene/Mesh.sol, and the normals of their vertices.

import { InputError } from "../errors.js";
import { rint } from "./arithmetic.js";
import { checkedMesh, type Mesh } from "./checked.js";
import { remembered } from "./memory.js";

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
export const pack = remembered((mesh: Mesh, smooth: boolean): Uint8Array => {
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
            const coordinate = positions[3 * vertex + axis];
            if (wide) view.setInt8(place++, coordinate >> 16);
            view.setUint16(place, coordinate & 0xffff);
            place += 2;
        }
        for (let channel = 0; channel < 3; channel++) view.setUint8(place++, colors[3 * vertex + channel]);
        if (normals) {
            view.setUint32(place, normals[vertex]);
            place += 4;
        }
    }
    for (const vertex of faces) {
        view.setUint16(place, vertex);
        place += 2;
    }
    return bytes;
});

/** Return the coordinates of a packed mesh, and how many triangles it has. InputError where its size is not what it says. */
export function unpackedPositions(packed: Uint8Array): { positions: Float64Array; triangles: number } {
    const view = new DataView(packed.buffer, packed.byteOffset, packed.length);
    const format = packed.length < HEADER ? 0xff : packed[0];
    if (format > NORMALS + WIDE) throw new InputError("a packed mesh must begin with a format and two counts");
    const [vertices, triangles, size] = [view.getUint16(1), view.getUint16(3), vertexSize(format)];
    const expected = HEADER + vertices * size + triangles * FACE;
    if (packed.length !== expected) {
        throw new InputError(`a packed mesh of this header must have ${expected} bytes, not ${packed.length}`);
    }
    const positions = new Float64Array(3 * vertices);
    for (let vertex = 0, at = 0; vertex < vertices; vertex++) {
        let place = HEADER + vertex * size;
        for (let axis = 0; axis < 3; axis++) {
            positions[at++] = format & WIDE ? view.getInt16(place) * 256 + packed[place + 2] : view.getInt16(place);
            place += format & WIDE ? 3 : 2;
        }
    }
    return { positions, triangles };
}

/** Return the mesh of packed bytes, such that `pack` makes the same bytes of it again. InputError for any others. */
export function unpack(packed: Uint8Array): Mesh {
    const { positions, triangles } = unpackedPositions(packed);
    const view = new DataView(packed.buffer, packed.byteOffset, packed.length);
    const [size, end] = [vertexSize(packed[0]), packed.length - FACE * triangles];
    const colorsAt = packed[0] & WIDE ? 9 : 6;
    const [colors, normals] = [new Uint8Array(positions.length), new Float64Array(positions.length)];
    for (let place = HEADER, at = 0; place < end; place += size, at += 3) {
        colors.set(packed.subarray(place + colorsAt, place + colorsAt + 3), at);
        if (packed[0] & NORMALS) normals.set(unpackedNormal(view.getUint32(place + size - 4)), at);
    }
    const faces = Uint32Array.from({ length: 3 * triangles }, (_, at) => view.getUint16(end + 2 * at));
    const mesh = { positions, faces, colors, normals: packed[0] & NORMALS ? normals : undefined };
    return checkedMesh(mesh, "the packed mesh");
}

/**
 * Return a vector that `packedNormals` rounds to the same word, although it makes it a unit vector; _packed.py says
 * how.
 */
function unpackedNormal(word: number): number[] {
    const numbers = [22, 12, 2].map((at) => (((word >>> at) & 1023) ^ 512) - 512);
    const excess = numbers.reduce((sum, x) => sum + x * x, 0) - NORMAL_UNIT ** 2;
    const way = numbers.map((x) => (excess <= 0 ? (x < 0 ? -0.5 : 0.5) : Math.sign(x) * -0.5));
    const a = way.reduce((sum, x) => sum + x * x, 0);
    const b = Math.abs(numbers.reduce((sum, x, axis) => sum + x * way[axis], 0));
    // |numbers + t way| = NORMAL_UNIT
    const t = Math.abs(excess) / (b + Math.sqrt(b * b - a * excess));
    return numbers.map((x, axis) => x + (t < 1 ? t : 0) * way[axis]);
}

/** Return how many bytes a vertex of a packed mesh of a format takes. */
function vertexSize(format: number): number {
    return (format & WIDE ? 9 : 6) + 3 + (format & NORMALS ? 4 : 0);
}

/** Return unit normals, three numbers each: the mean of the faces around a vertex by area; zero where none are. */
export function vertexNormals(positions: Float64Array, faces: Uint32Array): Float64Array {
    const ofFaces = areaNormals(positions, faces);
    const normals = new Float64Array(positions.length);
    // all first corners before the second ones: the order of the sums
    for (let corner = 0; corner < 3; corner++) {
        for (let face = 0; face < faces.length; face += 3) {
            const vertex = 3 * faces[face + corner];
            for (let axis = 0; axis < 3; axis++) normals[vertex + axis] += ofFaces[face + axis];
        }
    }
    return unitRows(normals);
}

/** Return the normals of faces, three numbers each, twice as long as their areas. */
export function areaNormals(positions: Float64Array, faces: Uint32Array): Float64Array {
    const normals = new Float64Array(faces.length);
    for (let face = 0; face < faces.length; face += 3) {
        const a = 3 * faces[face];
        const b = 3 * faces[face + 1];
        const c = 3 * faces[face + 2];
        const ux = positions[b] - positions[a];
        const uy = positions[b + 1] - positions[a + 1];
        const uz = positions[b + 2] - positions[a + 2];
        const vx = positions[c] - positions[a];
        const vy = positions[c + 1] - positions[a + 1];
        const vz = positions[c + 2] - positions[a + 2];
        normals[face] = uy * vz - uz * vy;
        normals[face + 1] = uz * vx - ux * vz;
        normals[face + 2] = ux * vy - uy * vx;
    }
    return normals;
}

/** Return whether all coordinates are whole numbers that a packed mesh can hold. */
export function isIntegral(positions: Float64Array): boolean {
    return fits(positions, MAX_WIDE) && positions.every(Number.isInteger);
}

/** Return whether all coordinates lie in -most-1..most. */
export function fits(positions: Float64Array, most: number): boolean {
    return positions.every((x) => x <= most && x >= -most - 1);
}

/** Return rows of three numbers as vectors of length 1, or zero. */
export function unitRows(rows: Float64Array): Float64Array {
    const units = new Float64Array(rows.length);
    for (let row = 0; row < rows.length; row += 3) {
        const size = Math.sqrt(rows[row] * rows[row] + rows[row + 1] * rows[row + 1] + rows[row + 2] * rows[row + 2]);
        for (let at = row; size > 0 && at < row + 3; at++) units[at] = rows[at] / size;
    }
    return units;
}

/** Return each normal as three numbers of 10 bits, then two zero bits. */
function packedNormals({ positions, faces, normals }: Mesh): Uint32Array {
    const units = normals ? unitRows(normals) : vertexNormals(positions, faces);
    const words = new Uint32Array(units.length / 3);
    units.forEach((x, index) => {
        const vertex = Math.floor(index / 3);
        words[vertex] = words[vertex] | ((rint(x * NORMAL_UNIT) & 1023) << (22 - 10 * (index % 3)));
    });
    return words;
}
