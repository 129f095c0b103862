// Between points of the canvas and points of the world.

import { add, dot, subtract, times, unit, type Vector } from "../../scene/arithmetic.js";
import { axesOf } from "../../document/camera.js";
import type { Document } from "../../document/document.js";

/** A point of the picture: fractions of its width and height from the upper left corner. */
export type Spot = readonly [number, number];

/** Return the viewer of a document, and whether its rays are parallel. */
function seenBy({ camera, width, height }: Document) {
    const eye = camera.eye as Vector;
    const flat = camera.projection === "orthographic";
    return { ...axesOf(camera), eye, halfHeight: camera.halfHeight, aspect: width / height, flat };
}

/** Return where a point of the world is seen; null behind the viewer. */
export function project(doc: Document, point: Vector): Spot | null {
    const { eye, halfHeight, right, up, back, aspect, flat } = seenBy(doc);
    const from = subtract(point, eye);
    const depth = flat ? 1 : -dot(from, back);
    if (depth <= 0) return null;
    const half = halfHeight * depth;
    return [0.5 + dot(from, right) / half / aspect / 2, 0.5 - dot(from, up) / half / 2];
}

/**
 * Return by how much what is at `anchor` moves if it is dragged from one point of the picture to another: on the level of the
 * anchor, or, where that is seen from too low, or if `upright`, in a plane that faces the viewer.
 */
export function dragged(doc: Document, anchor: Vector, from: Spot, to: Spot, upright: boolean): Vector {
    const { eye, halfHeight, right, up, back, aspect, flat } = seenBy(doc);
    const level = !upright && Math.abs(back[1]) > 0.2;
    const normal: Vector = level ? [0, 1, 0] : upright ? unit([back[0], 0, back[2]]) : back;
    const hit = ([x, y]: Spot): Vector | null => {
        const across = add(times((2 * x - 1) * aspect * halfHeight, right), times((1 - 2 * y) * halfHeight, up));
        const [start, way] = flat ? [add(eye, across), times(-1, back)] : [eye, subtract(across, back)];
        const slope = dot(way, normal);
        const distance = Math.abs(slope) < 1e-6 ? -1 : dot(subtract(anchor, start), normal) / slope;
        return distance > 0 ? add(start, times(distance, way)) : null;
    };
    const [first, last] = [hit(from), hit(to)];
    if (!first || !last) return [0, 0, 0];
    const moved = subtract(last, first);
    return upright ? [0, moved[1], 0] : moved;
}
