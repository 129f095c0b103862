// Polygons as files have them, cut into triangles.

import earcut from "three/src/extras/lib/earcut.js";
import { InputError } from "../errors.js";
import { add, cross, dot, type Vector } from "../scene/arithmetic.js";

/** How many corners a polygon may have that no fan fills: the time that its cutting takes grows with their square. */
const MAX_CORNERS = 1 << 13;
/** A fan may leave its polygon by this part of the polygon's area, as it does by rounding. */
const ROUNDING = 1e-9;

/** Triangles: the vertices of their corners, the number of each corner in the file, and the polygon of each triangle. */
export interface Cut {
    faces: Uint32Array;
    corners: Uint32Array;
    polygon: Uint32Array;
}

/**
 * Cut polygons, given by the number of their corners and the vertices of these, into triangles: as fans where these fill
 * them, as they do convex ones, otherwise by ear clipping. One with a vertex that does not exist, or is not at finite numbers,
 * becomes a triangle at that vertex only, which `partsOf` leaves out with a note.
 */
export function cut(positions: Float64Array, sizes: ArrayLike<number>, vertices: ArrayLike<number>): Cut {
    const [corners, polygon]: number[][] = [[], []];
    const pointOf = (corner: number): Vector => {
        const at = 3 * vertices[corner];
        return [positions[at], positions[at + 1], positions[at + 2]];
    };
    for (let number = 0, start = 0; number < sizes.length; start += sizes[number++]) {
        const size = sizes[number];
        const outline = Array.from({ length: size }, (_, each) => pointOf(start + each));
        const bad = outline.findIndex((point) => !point.every(Number.isFinite));
        const ears = bad >= 0 ? [bad, bad, bad] : size > 3 ? earsOf(outline, `face ${number}`) : undefined;
        for (let each = 0; each < (ears ? ears.length / 3 : size - 2); each++) {
            for (const corner of ears ? ears.slice(3 * each, 3 * each + 3) : [0, each + 1, each + 2])
                corners.push(start + corner);
            polygon.push(number);
        }
    }
    const faces = Uint32Array.from(corners, (corner) => vertices[corner]);
    return { faces, corners: Uint32Array.from(corners), polygon: Uint32Array.from(polygon) };
}

/** Return the triangles of a polygon that no fan fills, as numbers of its corners; undefined for any other. */
export function earsOf(outline: Vector[], name: string): number[] | undefined {
    const away = outline.map((point) => point.map((x, axis) => x - outline[0][axis]));
    const extent = Math.max(...away.flat().map(Math.abs)) || 1;
    const points = away.map((point) => point.map((x) => x / extent) as Vector);
    const areas = points.slice(1, -1).map((point, at) => cross(point, points[at + 2]));
    const normal = areas.reduce(add);
    if (areas.every((area) => dot(area, normal) >= -ROUNDING * dot(normal, normal))) return undefined;
    if (points.length > MAX_CORNERS) {
        throw new InputError(`${name} is not convex and has ${points.length} corners; up to ${MAX_CORNERS} are cut`);
    }
    // seen along the axis that is nearest to the normal, such that the outline runs counter-clockwise
    const sizes = normal.map(Math.abs);
    const axis = sizes.indexOf(Math.max(...sizes));
    const steps = normal[axis] > 0 ? [1, 2] : [2, 1];
    const flat = points.map((point) => steps.map((step) => point[(axis + step) % 3]));
    const ears = earcut(flat.flat());
    for (let at = 0; at < ears.length; at += 3) {
        const [[ax, ay], [bx, by], [cx, cy]] = ears.slice(at, at + 3).map((corner) => flat[corner]);
        if ((bx - ax) * (cy - ay) < (by - ay) * (cx - ax)) [ears[at], ears[at + 2]] = [ears[at + 2], ears[at]];
    }
    return ears;
}
