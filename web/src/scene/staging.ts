// The camera and the light of scenes that have none: all objects in the picture, seen from a little above.

import { InputError } from "../errors.js";
import { add, boundsOf, cosine, cross, dot, rowOf, sine, subtract, tangent, times, type Vector } from "./arithmetic.js";
import { number } from "./checks.js";
import { FIELDS } from "./fields.js";
import type { DirectionalLight, Projection } from "./types.js";

/** Toward the light, in the directions right, up and toward the viewer. */
const KEY_LIGHT: Vector = [-0.4, 0.7, 0.8];

/** The side from which a camera sees all objects; angles in degrees, to the right of the front (+z) and above the horizon. */
export interface Viewpoint {
    azimuth: number;
    elevation: number;
    /** The part of the picture's half width and half height that stays free. */
    margin: number;
    projection: Projection;
    /** Of a perspective camera; an orthographic one takes what the objects need. */
    halfHeight: number;
    /** Width of the picture / its height. */
    aspect: number;
}

const { azimuth, elevation, margin, projection, halfHeight, fov: FOV } = FIELDS.Camera;
export const VIEW: Viewpoint = {
    azimuth: azimuth.default,
    elevation: elevation.default,
    margin: margin.default,
    projection: projection.default,
    halfHeight: halfHeight.default,
    aspect: 1,
};

/** Return the `halfHeight` of a perspective camera with a vertical field of view in degrees, 0.2..179.8. */
export function halfHeightOf(fov: number): number {
    return tangent(number(fov, "the field of view in degrees", ...FOV.limits) / 2);
}

/** Return unit vectors to the right, upward, and toward a viewer. */
export function viewAxes(azimuth: number, elevation: number): [Vector, Vector, Vector] {
    const right: Vector = [cosine(azimuth), 0, -sine(azimuth)];
    const level = cosine(elevation);
    const back: Vector = [sine(azimuth) * level, sine(elevation), cosine(azimuth) * level];
    return [right, cross(back, right), back];
}

/** Return a light that stays where it is for the viewer, wherever the viewer stands. */
export function keyLight({ azimuth, elevation }: Viewpoint, toward = KEY_LIGHT): DirectionalLight {
    const parts = viewAxes(azimuth, elevation).map((axis, at) => times(toward[at], axis));
    return { kind: "directional", direction: parts.reduce(add) };
}

/** Return the camera of a view, as near as all points, three numbers each, fit the picture. */
export function frame(
    points: Float64Array,
    view: Viewpoint,
): { eye: Vector; target: Vector; up: Vector; projection: Projection; halfHeight: number } {
    const [right, up, back] = viewAxes(view.azimuth, view.elevation);
    const [x, y, z] = [right, up, back].map((axis) =>
        Float64Array.from({ length: points.length / 3 }, (_, at) => dot(rowOf(points, at), axis)),
    );
    const free = 1 - view.margin;
    let halfHeight = view.halfHeight;
    let middle: Vector;
    let distance: number;
    if (view.projection === "orthographic") {
        middle = [(max(x) + min(x)) / 2, (max(y) + min(y)) / 2, (max(z) + min(z)) / 2];
        halfHeight = Math.max((max(x) - min(x)) / 2 / view.aspect, (max(y) - min(y)) / 2) / free || 1;
        distance = max(z) - middle[2] + halfHeight;
    } else {
        // a point is in the picture if |x - x0| <= slope * (z0 - z): both sides are tight for the nearest z0, and likewise
        // for y
        const slope = number(halfHeight, "the half height", 2 ** -10, 2 ** 10) * free;
        const side = (a: Float64Array, s: number): { high: number; low: number; slope: number } => ({
            high: max(a.map((each, index) => each / s + z[index])),
            low: max(a.map((each, index) => z[index] - each / s)),
            slope: s,
        });
        const sides = [side(x, slope * view.aspect), side(y, slope)];
        const z0 = Math.max(...sides.map(({ high, low }) => (high + low) / 2));
        const [x0, y0] = sides.map(({ high, low, slope: s }) => (s * (high - low)) / 2) as [number, number];
        const [low, high] = boundsOf(points);
        const extent = Math.max(...subtract(high, low));
        // a mesh that is only a line toward the eye fits at any distance
        middle = [x0, y0, (max(z) + min(z)) / 2];
        distance = Math.max(z0, max(z) + 1e-3 * (extent || 1)) - middle[2];
    }
    const target = add(add(times(middle[0], right), times(middle[1], up)), times(middle[2], back));
    const eye = add(target, times(distance, back));
    if (!eye.every(Number.isFinite)) {
        throw new InputError("the coordinates of the objects are too large for a camera to be placed");
    }
    return { eye, target, up: Math.abs(back[1]) < 0.999 ? [0, 1, 0] : up, projection: view.projection, halfHeight };
}

function max(values: Float64Array): number {
    return values.reduce((most, value) => Math.max(most, value));
}

function min(values: Float64Array): number {
    return values.reduce((least, value) => Math.min(least, value));
}
