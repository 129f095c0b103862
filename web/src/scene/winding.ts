// Which side of faces is the front: src/shackled/scene/_winding.py, of which this is a translation.

import { add, boundsOf, cross, dot, largest, rowOf, subtract, times, type Vector } from "./arithmetic.js";
import { checkedMesh, type Mesh } from "./checked.js";
import * as constant from "./constants.js";
import { remembered } from "./memory.js";
import { areaNormals } from "./mesh.js";
import { Parts, balances, edgesOf, facesOfAll, isBalanced, pointsOf } from "./topology.js";
import { partOf } from "./weld.js";

/** A part of a model, as far as its winding goes; only opaque ones are split. */
export interface Part {
    mesh: Mesh;
    isOpaque: boolean;
}

/**
 * Return the parts of a model with closed pieces wound outward, and with `cull` for those of closed pieces only; and how
 * many pieces were turned.
 *
 * A connected piece is closed if each edge is as often in one direction as in the other.
 * split: whether parts that are partly closed may become two.
 */
export function wound<P extends Part>(
    parts: readonly P[],
    split: boolean,
): { parts: (P & { cull: boolean })[]; turned: number } {
    const meshes = parts.map(({ mesh }) => mesh);
    const positions = new Float64Array(meshes.reduce((sum, mesh) => sum + mesh.positions.length, 0));
    meshes.reduce((begin, mesh) => (positions.set(mesh.positions, begin), begin + mesh.positions.length), 0);
    const pieces = piecesOf(positions, facesOfAll(meshes));
    let begin = 0;
    const made = parts.flatMap((part) => {
        const own = pieces.slice(begin, (begin += part.mesh.faces.length / 3));
        const mesh = turned(part.mesh, own);
        const closed = own.filter((piece) => piece.isClosed).length;
        if (!split || !part.isOpaque || closed < constant.SPLIT_FACES || closed === own.length) {
            return [{ ...part, mesh, cull: closed === own.length }];
        }
        return [true, false].map((cull) => {
            const half = mesh.faces.filter(
                (_: number, corner: number) => own[Math.floor(corner / 3)].isClosed === cull,
            );
            return { ...part, mesh: partOf(mesh, half), cull };
        });
    });
    return { parts: made, turned: new Set(pieces.filter((piece) => piece.isInverted)).size };
}

/** Faces that are connected by edges. */
interface Piece {
    isClosed: boolean;
    isInverted: boolean;
    /** A point of it, six times the volume that it bounds, and what the pyramids of its faces have together. */
    origin: Vector;
    volume: number;
    most: number;
    low: Vector;
    high: Vector;
}

/** Return the piece of each face. */
function piecesOf(positions: Float64Array, faces: Uint32Array): Piece[] {
    const { numbers } = pointsOf(positions);
    const corners = faces.map((vertex) => numbers[vertex]);
    const sides = edgesOf(corners);
    const balance = balances(corners, sides);
    const [joined, firsts] = [new Parts(faces.length / 3), new Map<number, number>()];
    sides.edges.forEach((edge, side) => {
        const face = Math.floor(side / 3);
        if (edge >= 0 && firsts.has(edge)) joined.join(firsts.get(edge) as number, face);
        else if (edge >= 0) firsts.set(edge, face);
    });
    const start = rowOf(positions, 0);
    // of any size: products of lengths stay within floats
    const size = largest(boundsOf(positions).flatMap((each) => subtract(each, start))) || 1;
    const pieces = new Map<number, Piece>();
    const found = Array.from({ length: faces.length / 3 }, (_, face) => {
        const points = [0, 1, 2].map((corner) => {
            const [x, y, z] = subtract(rowOf(positions, faces[3 * face + corner]), start);
            return [x / size, y / size, z / size] as Vector;
        });
        const label = joined.of(face);
        const piece = pieces.get(label) ?? {
            isClosed: true,
            isInverted: false,
            origin: points[0],
            volume: 0,
            most: 0,
            low: points[0],
            high: points[0],
        };
        pieces.set(label, piece);
        const [a, b, c] = points.map((point) => subtract(point, piece.origin));
        const pyramid = dot(a, cross(b, c));
        piece.volume += pyramid;
        piece.most += Math.abs(pyramid);
        for (const point of points) {
            piece.low = piece.low.map((x, axis) => Math.min(x, point[axis])) as Vector;
            piece.high = piece.high.map((x, axis) => Math.max(x, point[axis])) as Vector;
        }
        for (const edge of sides.edges.subarray(3 * face, 3 * face + 3)) if (balance[edge]) piece.isClosed = false;
        return piece;
    });
    markInverted([...pieces.values()]);
    return found;
}

/** Mark the closed pieces that are inside out, but for those that may be the walls of hollows in others. */
function markInverted(pieces: Piece[]): void {
    const inverted = pieces.filter(({ isClosed, volume, most }) => isClosed && volume < -constant.NO_VOLUME * most);
    if (!inverted.length) return;
    const key = ({ isClosed, volume }: Piece): number => (isClosed ? -volume : 0);
    const outer = [...pieces]
        .sort((one, other) => key(one) - key(other))
        .slice(0, constant.MOST_OUTER)
        .filter(({ volume }) => volume > 0);
    for (const piece of inverted) {
        const isIn = ({ low, high }: Piece): boolean =>
            piece.low.every((x, axis) => x >= low[axis]) && piece.high.every((x, axis) => x <= high[axis]);
        piece.isInverted = !outer.some(isIn);
    }
}

/** Return the mesh with some faces wound the other way, and normals that point to their front. */
function turned(mesh: Mesh, pieces: Piece[]): Mesh {
    const isTurned = (corner: number): boolean => pieces[Math.floor(corner / 3)].isInverted;
    if (!pieces.some(({ isInverted }) => isInverted)) return mesh;
    const faces = mesh.faces.map((vertex, at) => (isTurned(at) ? mesh.faces[at + 2 - 2 * (at % 3)] : vertex));
    if (!mesh.normals) return checkedMesh({ ...mesh, faces }, "a mesh");
    let along = 0;
    const isFlipped = new Uint8Array(mesh.positions.length / 3);
    for (let face = 0; face < faces.length; face += 3) {
        if (!isTurned(face)) continue;
        const corners = faces.subarray(face, face + 3);
        const [a, b, c] = Array.from(corners, (vertex) => rowOf(mesh.positions, vertex));
        const front = cross(subtract(b, a), subtract(c, a));
        for (const vertex of corners) {
            along += dot(rowOf(mesh.normals, vertex), front);
            isFlipped[vertex] = 1;
        }
    }
    const normals = mesh.normals.map((x, at) => (along < 0 && isFlipped[Math.floor(at / 3)] ? -x : x));
    return checkedMesh({ ...mesh, faces, normals }, "a mesh");
}

/**
 * Return which faces are wound against the first of their piece; none where that has no answer, as in a Moebius strip.
 * corners: three points of each face.
 */
export function against(corners: Uint32Array): Uint8Array {
    const { edges, count } = edgesOf(corners);
    const [first, second, around] = [new Uint32Array(count), new Uint32Array(count), new Uint32Array(count)];
    edges.forEach((edge, side) => {
        if (edge >= 0) (around[edge]++ ? second : first)[edge] = side;
    });
    // both sides of a face are two things: those that belong together are one part
    const joined = new Parts((2 * corners.length) / 3);
    for (let edge = 0; edge < count; edge++) {
        if (around[edge] !== 2) continue;
        const [one, other] = [first[edge], second[edge]];
        const isOdd = Number(corners[one] === corners[other]);
        for (const side of [0, 1]) {
            joined.join(2 * Math.floor(one / 3) + side, 2 * Math.floor(other / 3) + (isOdd ^ side));
        }
    }
    return Uint8Array.from({ length: corners.length / 3 }, (_, face) =>
        Number(joined.of(2 * face) > joined.of(2 * face + 1)),
    );
}

/** A mesh by itself, in its own units: the area of all faces, and the length of two sides of each. */
export interface Solid {
    isClosed: boolean;
    volume: number;
    area: number;
    sides: number;
    center: Vector;
    radius: number;
}

export const solidOf = remembered(({ positions, faces }: Mesh): Solid => {
    const { numbers } = pointsOf(positions);
    const [low, high] = boundsOf(positions);
    const [center, radius] = [times(0.5, add(low, high)), largest(subtract(high, low)) / 2];
    const isClosed = isBalanced(faces.map((vertex) => numbers[vertex]));
    const normals = areaNormals(positions, faces);
    let [volume, area, sides] = [0, 0, 0];
    for (let face = 0; isClosed && face < faces.length; face += 3) {
        let [pyramid, size, one, other] = [0, 0, 0, 0];
        for (let axis = 0; axis < 3; axis++) {
            const [a, normal] = [positions[3 * faces[face] + axis], normals[face + axis]];
            pyramid += (a - center[axis]) * normal;
            size += normal ** 2;
            one += (positions[3 * faces[face + 1] + axis] - a) ** 2;
            other += (positions[3 * faces[face + 2] + axis] - a) ** 2;
        }
        volume += pyramid / 6;
        area += Math.sqrt(size) / 2;
        sides += Math.sqrt(one) + Math.sqrt(other);
    }
    return { isClosed, volume, area, sides, center, radius };
});

/** Return whether each edge has a face on either side, wound alike, and the mesh bounds a volume from outside. */
export function isClosed(mesh: Mesh): boolean {
    const { isClosed, volume, area, radius } = solidOf(mesh);
    // doubled sheets have a volume of rounding only
    return isClosed && volume > constant.NO_VOLUME * area * radius;
}
