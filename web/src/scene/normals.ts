// Normals for meshes that have none: smooth, except across creases. src/shackled/scene/_crease.py, of which this is a
// translation with the same results, says how and why.

import { boundsOf, cosine, cross, dot, largest, length, rint, rowOf, subtract } from "./arithmetic.js";
import { checkedMesh, type Mesh } from "./checked.js";
import * as constant from "./constants.js";
import type { Rgb } from "./checks.js";
import { remembered } from "./memory.js";
import { areaNormals } from "./mesh.js";
import { Parts, edgesOf, next, pointsOf, rowsOf } from "./topology.js";
import { rgbaOf, weld } from "./weld.js";
import { against } from "./winding.js";

/** Where edges are smooth, by shape. */
const ANGLES = [constant.SOLID, constant.FIGURE, constant.FACETS];
const DIGITS = 10 ** constant.DIGITS;

/**
 * Return the mesh with smooth normals, except across edges at which faces differ by more than `degrees`, or, if null, by
 * more than suits the shape; without normals, for flat shading, where that looks the same.
 */
export const creased = remembered((mesh: Mesh, degrees: number | null): Mesh => {
    const { positions, faces } = mesh;
    const normals = cornerNormals(positions, faces, degrees);
    if (areFlat(positions, faces, normals)) return withoutNormals(mesh);
    return weld(positions, faces, { rgba: rowsOf(rgbaOf(mesh), faces, 4), normals, uvs: cornerUvs(mesh) });
});

/** Return a mesh for smooth shading, or for flat one without curves: with its own normals unless degrees are given. */
export function shadedMesh(mesh: Mesh, degrees: number | null): { mesh: Mesh; shading: "flat" | "smooth" } {
    const found = mesh.normals && degrees === null ? mesh : creased(mesh, degrees);
    return { mesh: found, shading: found.normals ? "smooth" : "flat" };
}

/** Return the mesh without normals, nor vertices that differ in these only. */
export const withoutNormals = remembered((mesh: Mesh): Mesh => {
    if (!mesh.normals) return mesh;
    const { positions, faces } = mesh;
    return weld(positions, faces, { rgba: rowsOf(rgbaOf(mesh), faces, 4), uvs: cornerUvs(mesh) });
});

/** Return the mesh in one colour. */
export function painted(mesh: Mesh, color: Rgb): Mesh {
    return inColor(mesh, (color[0] << 16) | (color[1] << 8) | color[2]);
}

const inColor = remembered((mesh: Mesh, color: number): Mesh => {
    const channel = (_: unknown, at: number): number => (color >> (16 - 8 * (at % 3))) & 255;
    return checkedMesh({ ...mesh, colors: Uint8Array.from(mesh.colors, channel) }, "a mesh");
}, 16);

function cornerUvs({ uvs, faces }: Mesh): Float64Array | undefined {
    return uvs && rowsOf(uvs, faces, 2);
}

/** Return whether a mesh has normals, which are those of its faces. */
export function isFlat({ positions, faces, normals }: Mesh): boolean {
    return normals !== undefined && areFlat(positions, faces, rowsOf(normals, faces));
}

/**
 * Return a unit normal for each corner of each face: the mean of the faces around the corner, up to the next creases,
 * weighted by area and angle. It points to the front of its face, also where its neighbours are wound the other way.
 */
export function cornerNormals(positions: Float64Array, faces: Uint32Array, degrees: number | null): Float64Array {
    const surface = surfaceOf(positions, faces);
    const { corners, areas, angles, sizes, units, pairs, count } = surface;
    const isHard = creasesOf(surface, degrees);
    const patches = new Parts(corners.length);
    pairs.one.forEach((side, pair) => {
        if (isHard[pair]) return;
        patches.join(side, next(pairs.other[pair]));
        patches.join(next(side), pairs.other[pair]);
    });
    const patch = Uint32Array.from(corners, (_, corner) => patches.of(corner));
    // triangles without an area go with any other at the same place
    const owner = new Int32Array(count).fill(-1);
    for (const isProper of [true, false]) {
        corners.forEach((point, corner) => {
            if (sizes[faceOf(corner)] > 0 !== isProper) return;
            if (isProper) owner[point] = patch[corner];
            else if (owner[point] >= 0) patch[corner] = owner[point];
        });
    }
    const sums = new Float64Array(3 * corners.length);
    for (let corner = 0; corner < corners.length; corner++) {
        const [from, to] = [corner - (corner % 3), 3 * patch[corner]];
        for (let axis = 0; axis < 3; axis++) sums[to + axis] += areas[from + axis] * angles[corner];
    }
    const normals = new Float64Array(sums.length);
    for (let corner = 0; corner < corners.length; corner++) {
        const at = 3 * patch[corner];
        const size = lengthAt(sums, at);
        const isReversed = surface.isAgainst[faceOf(corner)];
        // the corners of reversed faces are in reverse order, too
        const to = 3 * (isReversed ? corner + 2 - 2 * (corner % 3) : corner);
        for (let axis = 0; axis < 3; axis++) {
            const x = size > 0 ? sums[at + axis] / size : units[corner - (corner % 3) + axis];
            normals[to + axis] = rint((isReversed ? -x : x) * DIGITS) / DIGITS + 0;
        }
    }
    return normals;
}

function faceOf(corner: number): number {
    return Math.floor(corner / 3);
}

type Surface = ReturnType<typeof surfaceOf>;

/**
 * Return points, in a box whose largest side is about 1, and faces between them, wound alike: the normals of faces, of
 * their sizes and of length 1, their angles, and the pairs of proper faces that share an edge.
 */
function surfaceOf(positions: Float64Array, faces: Uint32Array) {
    const { numbers, firsts } = pointsOf(positions);
    const given = rowsOf(positions, firsts);
    let corners = faces.map((vertex) => numbers[vertex]);
    const isAgainst = against(corners);
    corners = corners.map((point, at) => (isAgainst[faceOf(at)] ? corners[at + 2 - 2 * (at % 3)] : point));
    let least = 0;
    for (let point = 1; point < firsts.length; point++) if (isBefore(given, point, least)) least = point;
    const points = scaled(given, least);
    const { areas, angles, sizes } = areasAndAngles(points, corners);
    const units = areas.map((x, at) => (sizes[faceOf(at)] > 0 ? x / sizes[faceOf(at)] : 0));
    const pairs = pairsOf(given, corners, sizes);
    return { points, count: firsts.length, corners, isAgainst, areas, angles, sizes, units, pairs };
}

/** Return whether a point comes before another in the order of their coordinates. */
function isBefore(points: Float64Array, one: number, other: number): boolean {
    const [a, b] = [3 * one, 3 * other];
    const axis = points[a] !== points[b] ? 0 : points[a + 1] !== points[b + 1] ? 1 : 2;
    return points[a + axis] < points[b + axis];
}

/** Return points less one of them, so that the largest coordinate is 1: products of lengths stay within floats. */
function scaled(points: Float64Array, origin: number): Float64Array {
    const from = rowOf(points, origin);
    const most = largest(boundsOf(points).flatMap((each) => subtract(each, from))) || 1;
    return points.map((x, at) => (x - from[at % 3]) / most);
}

function areasAndAngles(points: Float64Array, corners: Uint32Array) {
    const areas = areaNormals(points, corners);
    const sizes = Float64Array.from({ length: corners.length / 3 }, (_, face) => lengthAt(areas, 3 * face));
    const angles = Float64Array.from(corners, (point, corner) => {
        const other = corners[next(next(corner))];
        let along = 0;
        for (let axis = 0; axis < 3; axis++) {
            const from = points[3 * point + axis];
            along += (points[3 * corners[next(corner)] + axis] - from) * (points[3 * other + axis] - from);
        }
        return Math.atan2(sizes[faceOf(corner)], along);
    });
    return { areas, angles, sizes };
}

/** Return pairs of proper faces that are wound alike: their sides along a common edge, which begin at corners. */
function pairsOf(points: Float64Array, corners: Uint32Array, sizes: Float64Array) {
    const { edges, count } = edgesOf(corners);
    // the downward sides of each edge follow each other
    const following = new Int32Array(corners.length).fill(-1);
    const [first, last, around] = [0, 1, 2].map((each) => new Int32Array(count).fill(each < 2 ? -1 : 0));
    const isUpward = (side: number): boolean => isBefore(points, corners[side], corners[next(side)]);
    const [upward, downward]: number[][] = [[], []];
    edges.forEach((_, side) => sizes[faceOf(side)] > 0 && (isUpward(side) ? upward : downward).push(side));
    for (const side of downward) {
        const edge = edges[side];
        if (around[edge]++) following[last[edge]] = side;
        else first[edge] = side;
        last[edge] = side;
    }
    const [one, other]: number[][] = [[], []];
    for (const side of upward) {
        if (around[edges[side]] > constant.MOST_PAIRS) continue;
        for (let back = first[edges[side]]; back >= 0; back = following[back]) {
            one.push(side);
            other.push(back);
        }
    }
    const [here, there] = [one, other].map((sides) => Uint32Array.from(sides, faceOf));
    return { one, other, here, there };
}

/** Return which pairs of faces have a crease between them. */
function creasesOf(surface: Surface, degrees: number | null): Uint8Array {
    const { pairs, units } = surface;
    const { shape, directions } = degrees === null ? byShape(surface) : { shape: undefined, directions: units };
    const angles = degrees === null ? ANGLES : [[degrees, constant.SOLID[1]]];
    const limits = angles.map((row) => row.map(cosine));
    const cosines = Float64Array.from(pairs.here, (face, pair) => dotAt(directions, 3 * face, 3 * pairs.there[pair]));
    const limitsOf = (pair: number): number[] => limits[shape ? shape[pair] : 0];
    const isHard = Uint8Array.from(cosines, (each, pair) => Number(each < limitsOf(pair)[0] - constant.ROUNDING));
    removeDeadEnds(isHard, (pair) => cosines[pair] > limitsOf(pair)[1], surface);
    return isHard;
}

/** Return which of `ANGLES` decide at each pair of faces, and the directions of faces. */
function byShape(surface: Surface): { shape: Uint8Array; directions: Float64Array } {
    const { points, corners, units, sizes, count } = surface;
    const { one, here, there } = surface.pairs;
    const joined = new Parts(count);
    for (let corner = 0; corner < corners.length; corner++)
        joined.join(corners[corner], corners[corner - (corner % 3)]);
    const partOf = (face: number): number => joined.of(corners[3 * face]);
    const faces = new Uint32Array(count);
    const sides = new Float64Array(corners.length);
    corners.forEach((point, side) => {
        sides[side] = length(subtract(rowOf(points, corners[next(side)]), rowOf(points, point)));
    });
    for (let face = 0; face < sizes.length; face++) faces[partOf(face)]++;
    const part = Uint32Array.from(here, partOf);
    const turns = Float64Array.from(here, (face, pair) => turnAt(units, 3 * face, 3 * there[pair]));

    /** Return the mean of values of some pairs, weighted by the lengths of edges, in each part. */
    const mean = (isIn: (turn: number) => boolean, value: (turn: number, part: number) => number): Float64Array => {
        const [totals, sums] = [new Float64Array(count), new Float64Array(count)];
        turns.forEach((turn, pair) => {
            if (!isIn(turn)) return;
            totals[part[pair]] += sides[one[pair]];
            sums[part[pair]] += sides[one[pair]] * value(turn, part[pair]);
        });
        return sums.map((sum, each) => (totals[each] > 0 ? sum / totals[each] : 0));
    };
    const among = (low: number, high: number) => (turn: number) => turn > low && turn <= high;
    const [isAny, isSeen, isBlunt] = [
        among(-1, 181),
        among(constant.FACETS[0], 181),
        among(constant.FACETS[0], constant.GAP[1]),
    ];
    const [flat, middling, sharp] = [among(-1, constant.FLAT), among(...constant.GAP), among(constant.GAP[1], 181)].map(
        (isIn) => mean(isAny, (turn) => Number(isIn(turn))),
    );
    const [average, middle] = [isSeen, isBlunt].map((isIn) => mean(isIn, (turn) => turn));
    const spread = mean(isBlunt, (turn, each) => (turn - middle[each]) * (turn - middle[each]));
    const isSolid = flat.map((each, at) =>
        Number(
            each >= constant.FLAT_SHARE ||
                (sharp[at] >= constant.GAP_TIMES * middling[at] && sharp[at] >= constant.GAP_SHARE),
        ),
    );
    const isAllCorners = flat.map((each, at) => {
        const isUneven = Math.sqrt(spread[at]) >= constant.UNEVEN * middle[at];
        return Number(
            each < constant.FLAT_SHARE &&
                faces[at] <= constant.FEW_FACES &&
                average[at] > constant.COARSE[isUneven ? 0 : 1],
        );
    });
    const hasFigure = faces.some((each, at) => each && !isSolid[at] && !isAllCorners[at]);
    const shapes = isSolid.map((each, at) => (isAllCorners[at] && !hasFigure ? 2 : each ? 0 : 1));
    const longest = sizes.map((_, face) => Math.max(sides[3 * face], sides[3 * face + 1], sides[3 * face + 2]));
    const directions = units.slice();
    // faces that simplification left, much lower than long, have the direction of the larger one beside them
    const straighten = (face: number, larger: number, pair: number): void => {
        const most = longest[face];
        const isNeedle = shapes[part[pair]] === 1 && sizes[face] < constant.NEEDLE * (most * most);
        if (!isNeedle || sides[one[pair]] < (1 - 1e-9) * most || 2 * sizes[face] >= sizes[larger]) return;
        directions.set(units.subarray(3 * larger, 3 * larger + 3), 3 * face);
    };
    here.forEach((face, pair) => straighten(face, there[pair], pair));
    there.forEach((face, pair) => straighten(face, here[pair], pair));
    return { shape: Uint8Array.from(part, (each) => shapes[each]), directions };
}

/** Make weak creases smooth that end within a surface, which look like scars. */
function removeDeadEnds(isHard: Uint8Array, isWeak: (pair: number) => boolean, surface: Surface): void {
    const { corners, sizes, count, pairs } = surface;
    const endsOf = (pair: number): number[] => [corners[pairs.one[pair]], corners[next(pairs.one[pair])]];
    // at each point: how many pairs there are less how many corners, how many creases, and the sum of their numbers
    const [open, degree, sum] = [new Int32Array(count), new Int32Array(count), new Float64Array(count)];
    corners.forEach((point, corner) => (open[point] -= Number(sizes[faceOf(corner)] > 0)));
    isHard.forEach((hard, pair) => {
        for (const end of endsOf(pair)) {
            open[end]++;
            degree[end] += hard;
            sum[end] += hard * pair;
        }
    });
    // each point of a border is an end of no crease
    const waiting = Array.from(degree.keys()).filter((end) => degree[end] === 1 && open[end] === 0);
    for (let end = waiting.pop(); end !== undefined; end = waiting.pop()) {
        const pair = sum[end];
        if (degree[end] !== 1 || !isWeak(pair)) continue;
        isHard[pair] = 0;
        for (const each of endsOf(pair)) {
            degree[each]--;
            sum[each] -= pair;
            if (degree[each] === 1 && open[each] === 0) waiting.push(each);
        }
    }
}

/** Return whether normals of corners are those of the faces. */
function areFlat(positions: Float64Array, faces: Uint32Array, normals: Float64Array): boolean {
    const { areas, sizes } = areasAndAngles(scaled(positions, 0), faces);
    return faces.every((_, corner) => {
        const along = dotAt(normals, 3 * corner, corner - (corner % 3), areas);
        return along >= constant.STRAIGHT * lengthAt(normals, 3 * corner) * sizes[faceOf(corner)];
    });
}

/** Return the scalar product of two rows, of one table or of two. */
function dotAt(table: Float64Array, one: number, other: number, second = table): number {
    return table[one] * second[other] + table[one + 1] * second[other + 1] + table[one + 2] * second[other + 2];
}

function lengthAt(table: Float64Array, row: number): number {
    return Math.sqrt(dotAt(table, row, row));
}

/** Return the degrees between two rows. */
function turnAt(units: Float64Array, one: number, other: number): number {
    const [a, b] = [rowOf(units, one / 3), rowOf(units, other / 3)];
    return Math.atan2(length(cross(a, b)), dot(a, b)) * (180 / Math.PI);
}
