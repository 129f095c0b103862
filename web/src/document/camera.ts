// Cameras that orbit about a target, and the lights that follow them.
//
// Distances on the picture are parts of its height, x to the right and y down.

import { add, clamped, cross, dot, length, subtract, times, unit, type Vector } from "../scene/arithmetic.js";
import { FIELDS } from "../scene/fields.js";
import { halfHeightOf } from "../scene/staging.js";
import type { Light } from "../scene/types.js";
import type { Document, Frame, Meshes, View } from "./document.js";
import { around, boundsOfPoints, chosen, degrees, pointsOf, radians, tidied, tidy, type Selection } from "./measure.js";

/**
 * A camera: angles in degrees, to the right of the front (+z) and above the horizon, lengths in radii, `target` relative
 * to the middle. fov: vertical; an orthographic camera shows what a perspective one would show at the target.
 */
export interface Orbit {
    azimuth: number;
    elevation: number;
    roll: number;
    distance: number;
    target: Vector;
    projection: View["projection"];
    fov: number;
}

export interface Axes {
    right: Vector;
    up: Vector;
    /** Toward the viewer. */
    back: Vector;
}

/** Degrees of a drag over the whole height. */
const TURN = 180;
/** Free border around what is fitted, as a fraction of half the picture. */
const MARGIN = 0.06;
/** How deep, in radii from the middle, the target of a camera may lie. */
const NEAR = 1.5;
const RANGES = {
    elevation: FIELDS.Camera.elevation.limits,
    distance: [0.01, 1000],
    target: [-1000, 1000],
    fov: FIELDS.Camera.fov.limits,
} as const;

/** Return unit vectors of a viewer at some angles. */
export function axesAt(azimuth: number, elevation: number, roll = 0): Axes {
    const [a, e, r] = [radians(azimuth), radians(elevation), radians(roll)];
    const right: Vector = [Math.cos(a), 0, -Math.sin(a)];
    const back: Vector = [Math.sin(a) * Math.cos(e), Math.sin(e), Math.cos(a) * Math.cos(e)];
    const up = cross(back, right);
    return {
        right: subtract(times(Math.cos(r), right), times(Math.sin(r), up)),
        up: add(times(Math.cos(r), up), times(Math.sin(r), right)),
        back,
    };
}

/** Return unit vectors of a camera. */
export function axesOf({ eye, target, up }: Pick<View, "eye" | "target" | "up">): Axes {
    const back = unit(subtract(eye as Vector, target as Vector));
    const right = unit(cross(unit([...up]), back));
    return { right, up: cross(back, right), back };
}

/** Return azimuth and elevation of a vector that is not zero; the azimuth of a vertical vector is 0. */
export function anglesOf(vector: Vector): [number, number] {
    const [x, y, z] = unit(vector);
    const level = Math.hypot(x, z);
    return [level > 1e-9 ? degrees(Math.atan2(x, z)) : 0, degrees(Math.atan2(y, level))];
}

/** Return a point of the world in radii from the middle. */
export function inside({ middle, radius }: Frame, point: Vector): Vector {
    return times(1 / radius, subtract(point, middle as Vector));
}

/** Return the point of the world that is so many radii from the middle. */
export function outside({ middle, radius }: Frame, point: Vector): Vector {
    return add(middle as Vector, times(radius, point));
}

/** Return a target, in radii from the middle, as people set it. */
export function aimed(target: Vector): Vector {
    return target.map((x) => tidy(clamped(x, ...RANGES.target))) as Vector;
}

/**
 * Return a camera as an orbit about its target or, where that is far from the objects and so only a direction, about the
 * point of its line of sight that is as deep as the middle.
 */
export function orbitOf(camera: View, frame: Frame): Orbit {
    const own = axesOf(camera);
    const eye = camera.eye as Vector;
    const ahead = length(subtract(eye, camera.target as Vector));
    const middle = dot(subtract(eye, frame.middle as Vector), own.back);
    const isDirection = Math.abs(middle - ahead) > NEAR * frame.radius && middle > 0.01 * frame.radius;
    const depth = isDirection ? middle : ahead;
    let [azimuth, elevation] = anglesOf(own.back);
    // seen from right above or below, what is up tells the azimuth
    if (Math.abs(elevation) > 90 - 1e-4)
        azimuth = degrees(Math.atan2(-own.up[0] * own.back[1], -own.up[2] * own.back[1]));
    const level = axesAt(azimuth, elevation);
    const slope = camera.projection === "perspective" ? camera.halfHeight : camera.halfHeight / depth;
    return {
        azimuth: tidy(azimuth),
        elevation: tidy(elevation),
        roll: tidy(degrees(Math.atan2(dot(own.up, level.right), dot(own.up, level.up)))),
        distance: tidy(clamped(depth / frame.radius, ...RANGES.distance)),
        target: aimed(inside(frame, subtract(eye, times(depth, own.back)))),
        projection: camera.projection,
        fov: tidy(clamped(degrees(2 * Math.atan(slope)), ...RANGES.fov)),
    };
}

/** Return the camera in the world. near: distance of its near plane, null for the default. */
export function viewOf(orbit: Orbit, frame: Frame, near: number | null): View {
    const { up, back } = axesAt(orbit.azimuth, orbit.elevation, orbit.roll);
    const target = outside(frame, orbit.target);
    const distance = orbit.distance * frame.radius;
    const isUpright = orbit.roll === 0 && Math.abs(orbit.elevation) < 89;
    const slope = halfHeightOf(orbit.fov);
    return {
        eye: tidied(add(target, times(distance, back)), frame.radius),
        target: tidied(target, frame.radius),
        up: isUpright ? [0, 1, 0] : tidied(up),
        projection: orbit.projection,
        halfHeight: orbit.projection === "perspective" ? slope : slope * distance,
        near,
    };
}

/** Return the document seen by another camera; lights follow it if they do. */
export function withCamera(doc: Document, change: Partial<Orbit>): Document {
    const orbit = { ...orbitOf(doc.camera, doc.frame), ...change };
    const near = orbit.projection === doc.camera.projection ? doc.camera.near : null;
    return withView(doc, viewOf(orbit, doc.frame, near));
}

function withView(doc: Document, camera: View): Document {
    const lights = doc.lightsFollow
        ? doc.lights.map((light) => followed(light, doc.camera, camera, doc.frame))
        : doc.lights;
    return { ...doc, camera, lights };
}

/** Turn the camera about its target, so that the object follows the pointer. */
export function turned(doc: Document, dx: number, dy: number): Document {
    const { azimuth, elevation, roll } = orbitOf(doc.camera, doc.frame);
    const [c, s] = [Math.cos(radians(roll)), Math.sin(radians(roll))];
    return withCamera(doc, {
        azimuth: tidy(around(azimuth - TURN * (dx * c + dy * s))),
        elevation: tidy(clamped(elevation + TURN * (dy * c - dx * s), ...RANGES.elevation)),
    });
}

/** Move the camera so many times nearer. */
export function zoomed(doc: Document, factor: number): Document {
    const { distance } = orbitOf(doc.camera, doc.frame);
    return withCamera(doc, { distance: tidy(clamped(distance / factor, ...RANGES.distance)) });
}

/** Move the target of the camera, so that the object follows the pointer. */
export function panned(doc: Document, dx: number, dy: number): Document {
    const orbit = orbitOf(doc.camera, doc.frame);
    const { right, up } = axesOf(doc.camera);
    const height = 2 * orbit.distance * Math.tan(radians(orbit.fov) / 2);
    const target = add(orbit.target, times(height, subtract(times(dy, up), times(dx, right))));
    return withCamera(doc, { target: aimed(target) });
}

/** Move the camera so that the sphere about objects just fills the picture; it keeps its direction. */
export function fitted(doc: Document, meshes: Meshes, selection: Selection = new Set()): Document {
    if (!doc.objects.length) return doc;
    const { middle, radius } = boundsOfPoints(pointsOf(chosen(doc, selection), meshes));
    const { fov, projection } = orbitOf(doc.camera, doc.frame);
    const half = Math.atan(Math.tan(radians(fov) / 2) * Math.min(1, doc.width / doc.height));
    const needed = projection === "perspective" ? 1 / Math.sin(half) : 1 / Math.tan(half);
    const distance = (radius / doc.frame.radius) * needed * (1 + MARGIN);
    return withCamera(doc, {
        target: aimed(inside(doc.frame, middle as Vector)),
        distance: tidy(clamped(distance, ...RANGES.distance)),
    });
}

/** Return the document seen by the camera of another one, such as that which was opened. */
export function resetCamera(doc: Document, own: Document): Document {
    return withView(doc, own.camera);
}

/** Return a light that is carried with the viewer about the middle, from one camera to another. */
export function followed(light: Light, before: View, after: View, frame: Frame): Light {
    const [from, to] = [axesOf(before), axesOf(after)];
    const turn = (v: Vector): Vector =>
        add(add(times(dot(from.right, v), to.right), times(dot(from.up, v), to.up)), times(dot(from.back, v), to.back));
    const place = (point: Vector): Vector => tidied(outside(frame, turn(inside(frame, point))), frame.radius);
    const way = (v: Vector): Vector => tidied(turn(v), length(v));
    if (light.kind === "directional") return { ...light, direction: way(light.direction as Vector) };
    const position = place(light.position as Vector);
    return light.kind === "point"
        ? { ...light, position }
        : { ...light, position, direction: way(light.direction as Vector) };
}
