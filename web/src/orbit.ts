// Cameras that orbit about a target, as the page `shackled creator` has them: src/shackled/creator/_orbit.py.

import { readCall } from "./call.js";
import { add, cross, dot, subtract, times, type Vector } from "./scene/arithmetic.js";
import { q32, setWord } from "./scene/encode.js";
import { putPoint, setNumbers, turnLights } from "./turn.js";

/** A camera: angles in degrees, lengths in radii of the object, `target` relative to its middle. */
export interface Orbit {
    azimuth: number;
    elevation: number;
    roll: number;
    distance: number;
    target: Vector;
    fov: number;
    projection: "perspective" | "orthographic";
}

/** The camera that a call has, the length of a radius in the call, and whether the lights move with the camera. */
export interface Base {
    camera: Orbit;
    radius: number;
    follow: boolean;
}

/** Degrees of a drag over the whole height, and the factor of the distance for one notch of the wheel. */
const TURN = 180;
const NOTCH = 1.1;
/** The ranges of the controls. */
const DISTANCES = [0.01, 1000] as const;
const MAX_TARGET = 1000;
/** The distance of the target in a call, which only tells the direction. */
const AHEAD = 2 ** 12;

/** Turn the camera about its target, so that the object follows the pointer: parts of the picture's height. */
export function drag(camera: Orbit, dx: number, dy: number): Orbit {
    const [c, s] = [Math.cos(radians(camera.roll)), Math.sin(radians(camera.roll))];
    const azimuth = camera.azimuth - TURN * (dx * c + dy * s);
    const elevation = clamped(camera.elevation + TURN * (dy * c - dx * s), -90, 90);
    return { ...camera, azimuth: azimuth - 360 * Math.round(azimuth / 360), elevation };
}

/** Move the camera nearer by a number of notches of the wheel, or away where it is negative. */
export function zoom(camera: Orbit, notches: number): Orbit {
    const distance = camera.distance * NOTCH ** -clamped(notches, -200, 200);
    return { ...camera, distance: clamped(distance, ...DISTANCES) };
}

/** Move the target of the camera, so that the object follows the pointer: parts of the picture's height. */
export function pan(camera: Orbit, dx: number, dy: number): Orbit {
    const { right, up } = axesOf(camera);
    const height = 2 * camera.distance * Math.tan(radians(camera.fov) / 2);
    const moved = add(camera.target, times(height, subtract(times(dy, up), times(dx, right))));
    return { ...camera, target: moved.map((x) => clamped(x, -MAX_TARGET, MAX_TARGET)) as Vector };
}

/** Return the call of the same scene, seen by another camera. InputError where it would lie beyond the contracts' range. */
export function orbitCall(bytes: Uint8Array, { camera, radius, follow }: Base, to: Orbit): Uint8Array {
    const call = readCall(bytes);
    const result = new Uint8Array(bytes);
    const [before, after] = [axesOf(camera), axesOf(to)];
    const middle = subtract(call.eye.value, times(radius, add(camera.target, times(camera.distance, before.back))));
    const eye = add(middle, times(radius, add(to.target, times(to.distance, after.back))));
    putPoint(result, "the eye", call.eye, eye);
    putPoint(result, "the target", call.target, subtract(eye, times(AHEAD, after.back)));
    setNumbers(result, call.up.place, after.up);
    if (to.projection === "orthographic") {
        const halfHeight = clamped((call.halfHeight.value * to.distance) / camera.distance, ...call.halfHeights);
        setWord(result, call.halfHeight.place, q32(halfHeight));
    }
    if (!follow) return result;
    const turn = (v: Vector): Vector =>
        add(
            add(times(dot(before.right, v), after.right), times(dot(before.up, v), after.up)),
            times(dot(before.back, v), after.back),
        );
    turnLights(call, result, turn, middle);
    return result;
}

/** Return unit vectors to the right, upward and toward the viewer. */
function axesOf({ azimuth, elevation, roll }: Orbit): { right: Vector; up: Vector; back: Vector } {
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

function radians(degrees: number): number {
    return (degrees * Math.PI) / 180;
}

function clamped(x: number, low: number, high: number): number {
    return Math.min(Math.max(x, low), high);
}
