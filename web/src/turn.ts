// Calls that show the same scene from elsewhere, or in another size. The bytes of the meshes stay as they are.

import { readCall, type Call } from "./call.js";
import { InputError, show } from "./errors.js";
import {
    add,
    clamped,
    cross,
    fromAxisAngle,
    multiply,
    rotation,
    subtract,
    unit,
    type Vector,
} from "./scene/arithmetic.js";
import { number, whole } from "./scene/checks.js";
import { WORD, isTiled, q32, setWord } from "./scene/encode.js";
import { MAX_COORDINATE } from "./scene/constants.js";
import { MAX_SIDE } from "./scene/fields.js";
import { direction } from "./scene/fit.js";
import type { Field } from "./scene/reader.js";

/** How far the viewer has gone around a scene. */
export interface Turn {
    /** Degrees about the vertical axis of the world, to the right. */
    azimuth?: number;
    /** Degrees upward, about the axis to the right of the camera; the viewer is at most right above or below. */
    elevation?: number;
    /** How many times larger the picture shows the objects. */
    zoom?: number;
}

/** What a call draws, for a viewer. */
export interface CallFacts {
    width: number;
    height: number;
    triangles: number;
    /** The range of `Turn.elevation`, in degrees: beyond it the viewer stays right above or below. */
    elevations: [number, number];
}

/** Return what a call draws. InputError where the bytes are not those of a call. */
export function describeCall(call: Uint8Array): CallFacts {
    const found = readCall(call);
    const { width, height, triangles } = found;
    return { width: width.value, height: height.value, triangles, elevations: elevationsOf(found) };
}

/**
 * Return the call in which the viewer has gone around the middle of the objects; with no turn, the same bytes.
 *
 * Camera and lights turn together, so that the light stays for the viewer. InputError where the bytes are not those of a
 * call, or where something would lie beyond what the contracts take.
 */
export function turnCall(call: Uint8Array, turn: Turn): Uint8Array {
    const azimuth = number(turn.azimuth ?? 0, "azimuth");
    const zoom = number(turn.zoom ?? 1, "zoom", 2 ** -20, 2 ** 20);
    const found = readCall(call);
    const [low, high] = elevationsOf(found);
    const elevation = clamped(number(turn.elevation ?? 0, "elevation"), low, high);
    const bytes = new Uint8Array(call);
    if (azimuth || elevation) turnCamera(found, bytes, azimuth, elevation);
    if (zoom !== 1) {
        const [least, most] = found.halfHeights;
        const halfHeight = clamped(found.halfHeight.value / zoom, least, most);
        setWord(bytes, found.halfHeight.place, q32(halfHeight));
    }
    return bytes;
}

/** Return the call that draws a picture of another size; the camera keeps its vertical field of view. */
export function resizeCall(call: Uint8Array, width: number, height: number): Uint8Array {
    const found = readCall(call);
    if (isTiled(found.name)) throw new InputError(`a call of ${found.name} has a size of its own: give one of render`);
    const bytes = new Uint8Array(call);
    setWord(bytes, found.width.place, BigInt(whole(width, "width", 1, MAX_SIDE)));
    setWord(bytes, found.height.place, BigInt(whole(height, "height", 1, MAX_SIDE)));
    return bytes;
}

function turnCamera(call: Call, bytes: Uint8Array, azimuth: number, elevation: number): void {
    const { right } = axesOf(call);
    const turn = rotation(multiply(fromAxisAngle([0, 1, 0], azimuth), fromAxisAngle(right, -elevation)));
    const { eye, target, up, middle } = call;
    putPoint(bytes, "the eye", eye, add(middle, turn(subtract(eye.value, middle))));
    putPoint(bytes, "the target", target, add(middle, turn(subtract(target.value, middle))));
    setNumbers(bytes, up.place, direction(turn(up.value)));
    turnLights(call, bytes, turn, middle);
}

/** Turn the lights of a call about a point. */
export function turnLights(call: Call, bytes: Uint8Array, turn: (v: Vector) => Vector, about: Vector): void {
    call.lights.forEach(({ directional, vector }, index) => {
        if (directional) setNumbers(bytes, vector.place, direction(turn(vector.value)));
        else putPoint(bytes, `light ${index}`, vector, add(about, turn(subtract(vector.value, about))));
    });
    const view = new DataView(bytes.buffer, bytes.byteOffset);
    for (const { place, value } of call.spots) {
        direction(turn(value)).forEach((x, axis) => view.setBigInt64(place + 8 * axis, q32(x)));
    }
}

/** Write a point into a call. InputError, which has the name of the point, where it lies beyond what the contracts take. */
export function putPoint(bytes: Uint8Array, name: string, { place }: Field<Vector>, point: Vector): void {
    if (!point.every((x) => Math.abs(x) <= MAX_COORDINATE)) {
        throw new InputError(`${name} would be at (${show(point).slice(1, -1)}), beyond ${MAX_COORDINATE} units`);
    }
    setNumbers(bytes, place, point);
}

/** Return by how many degrees the viewer can go down and up, until right below or above the scene. */
function elevationsOf(call: Call): [number, number] {
    const { up, back } = axesOf(call);
    // the height of the viewer is a sine of the elevation; upside down, the other way
    const now = (Math.atan2(back[1], Math.abs(up[1])) * 180) / Math.PI;
    const [low, high] = up[1] < 0 ? [now - 90, now + 90] : [-90 - now, 90 - now];
    return [Math.min(low, 0), Math.max(high, 0)];
}

/** Return unit vectors to the right, upward and toward the viewer. */
function axesOf(call: Call): { right: Vector; up: Vector; back: Vector } {
    const back = subtract(call.eye.value, call.target.value);
    const side =
        back.some((x) => x) && call.up.value.some((x) => x) ? cross(unit(call.up.value), unit(back)) : [0, 0, 0];
    if (!side.some((x) => x)) {
        throw new InputError(
            "the camera of the call has no direction: its eye is its target, or it looks along its up",
        );
    }
    const [right, toward] = [unit(side as Vector), unit(back)];
    return { right, up: cross(toward, right), back: toward };
}

export function setNumbers(bytes: Uint8Array, place: number, numbers: Vector): void {
    numbers.forEach((x, axis) => setWord(bytes, place + WORD * axis, q32(x)));
}
