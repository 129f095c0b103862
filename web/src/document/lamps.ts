// Lights as people place them: by angles and distances from the middle of the objects.

import { add, dot, length, subtract, times, unit, type Vector } from "../scene/arithmetic.js";
import { MAX_LIGHTS } from "../scene/constants.js";
import { FIELDS, LIGHT_KINDS } from "../scene/fields.js";
import type { DirectionalLight, Light, PointLight, SpotLight } from "../scene/types.js";
import { aimed, anglesOf, axesAt, axesOf, inside, orbitOf, outside } from "./camera.js";
import type { Document, Frame } from "./document.js";
import { around, tidied, tidy } from "./measure.js";

/**
 * A light: angles in degrees, to the right of the front (+z) and above the horizon, lengths in radii. distance: of point
 * and spot lights. target: of spot lights, relative to the middle, as innerAngle and outerAngle.
 */
export interface Lamp {
    kind: Light["kind"];
    azimuth: number;
    elevation: number;
    distance: number;
    color: string;
    target: Vector;
    innerAngle: number;
    outerAngle: number;
    shadow: boolean;
}

export const LAMP: Lamp = {
    kind: LIGHT_KINDS[0],
    azimuth: 0,
    elevation: 30,
    distance: 3,
    color: "#ffffff",
    target: [0, 0, 0],
    innerAngle: FIELDS.SpotLight.innerAngle.default,
    outerAngle: FIELDS.SpotLight.outerAngle.default,
    shadow: false,
};
/** The most radii of a distance. */
const FARTHEST = 1000;
/** Places of new lights, in degrees to the right of the viewer and above the horizon; the first free one is taken. */
const PLACES = [
    [45, 30],
    [-45, 30],
    [0, 80],
    [180, 30],
    [90, -20],
] as const;
/** Cosine of 35 degrees, the least angle between a new light and the others. */
const APART = 0.82;

/** Return a light as it is placed. */
export function lampOf(light: Light, frame: Frame): Lamp {
    const lamp: Lamp = { ...LAMP, kind: light.kind, color: light.color as string, shadow: light.shadow ?? false };
    if (light.kind === "directional") return { ...lamp, ...anglesIn(light.direction as Vector) };
    const place = inside(frame, light.position as Vector);
    const distance = tidy(Math.min(length(place), FARTHEST));
    const at = { ...lamp, ...(distance ? anglesIn(place) : { azimuth: 0, elevation: 0 }), distance };
    if (light.kind === "point") return at;
    const { innerAngle = LAMP.innerAngle, outerAngle = LAMP.outerAngle } = light;
    const direction = light.direction as Vector;
    // a direction of length 1 says nothing of a target: the point of its axis nearest to the middle, or one before it
    const toward = unit(direction);
    const ahead = -dot(place, toward);
    const beam =
        Math.abs(length(direction) - 1) < 1e-9
            ? times(ahead > 0 ? ahead : 1, toward)
            : times(1 / frame.radius, direction);
    return { ...at, target: aimed(add(place, beam)), innerAngle, outerAngle };
}

function anglesIn(direction: Vector): { azimuth: number; elevation: number } {
    const [azimuth, elevation] = anglesOf(direction);
    return { azimuth: tidy(azimuth), elevation: tidy(elevation) };
}

/** Return the light in the world. */
export function lightOf(lamp: Lamp, frame: Frame): Light {
    const { color, shadow, outerAngle } = lamp;
    const toward = axesAt(lamp.azimuth, lamp.elevation).back;
    if (lamp.kind === "directional") {
        return { kind: lamp.kind, direction: tidied(toward), color, shadow } satisfies DirectionalLight;
    }
    const place = times(lamp.distance, toward);
    const position = tidied(outside(frame, place), frame.radius);
    if (lamp.kind === "point") return { kind: lamp.kind, position, color, shadow } satisfies PointLight;
    // as long as the way to the target; a light that stands there points at the middle
    const way = subtract(lamp.target, place);
    const beam = Math.max(...way.map(Math.abs)) > 1e-9 ? way : times(-1, toward);
    const direction = tidied(times(frame.radius, beam), frame.radius);
    const innerAngle = Math.min(lamp.innerAngle, outerAngle);
    return { kind: lamp.kind, position, direction, color, innerAngle, outerAngle, shadow } satisfies SpotLight;
}

/** Return the document with a changed light. number: from 0. */
export function withLamp(doc: Document, number: number, change: Partial<Lamp>): Document {
    const light = doc.lights[number];
    if (!light) return doc;
    const moves = Object.keys(change).some((key) => key !== "color" && key !== "shadow");
    const made = moves
        ? lightOf({ ...lampOf(light, doc.frame), ...change }, doc.frame)
        : { ...light, ...(change as Pick<Lamp, "color" | "shadow">) };
    return withLights(doc, doc.lights.with(number, made), change.shadow ? number : undefined);
}

/** Return the document in which one light casts shadows, or none. */
export function setShadow(doc: Document, number: number | null): Document {
    return { ...doc, lights: doc.lights.map((light, index) => ({ ...light, shadow: index === number })) };
}

function withLights(doc: Document, lights: readonly Light[], shadow: number | undefined): Document {
    const made = { ...doc, lights };
    return shadow === undefined ? made : setShadow(made, shadow);
}

/** Return the document with one more light, in a direction without one; as it is where it has four. */
export function addLight(doc: Document): Document {
    if (doc.lights.length >= MAX_LIGHTS) return doc;
    const { azimuth } = orbitOf(doc.camera, doc.frame);
    const there = doc.lights.map((light) => towardOf(light, doc.frame));
    const places = PLACES.map(([side, elevation]) => ({
        ...LAMP,
        azimuth: Math.round(around(azimuth + side)),
        elevation,
    }));
    const closeness = (lamp: Lamp): number =>
        Math.max(-1, ...there.map((each) => dot(each, axesAt(lamp.azimuth, lamp.elevation).back)));
    const free = places.find((lamp) => closeness(lamp) < APART);
    const nearest = places.reduce((best, lamp) => (closeness(lamp) < closeness(best) ? lamp : best));
    return { ...doc, lights: [...doc.lights, lightOf(free ?? nearest, doc.frame)] };
}

/** Return the document without one of its lights. */
export function removeLight(doc: Document, number: number): Document {
    return { ...doc, lights: doc.lights.filter((_, index) => index !== number) };
}

/** Return the unit vector from the middle toward a light. */
function towardOf(light: Light, frame: Frame): Vector {
    const { azimuth, elevation } = lampOf(light, frame);
    return axesAt(azimuth, elevation).back;
}

/**
 * Return the place of a light on a sphere that the viewer sees as a disc of radius 1: x to the right, y down, and whether
 * it is on the near side.
 */
export function onDisc(doc: Document, light: Light): { x: number; y: number; near: boolean } {
    const { right, up, back } = axesOf(doc.camera);
    const toward = towardOf(light, doc.frame);
    return { x: dot(right, toward), y: -dot(up, toward), near: dot(back, toward) >= 0 };
}

/**
 * Return the document with a light at a place of that disc.
 *
 * A place beyond the rim is on the far side of the sphere; at two radii and more the light is right behind it.
 */
export function fromDisc(doc: Document, number: number, x: number, y: number): Document {
    const far = Math.hypot(x, y);
    const radius = far <= 1 ? far : Math.max(2 - far, 0);
    const [a, b] = far ? [(x * radius) / far, (y * radius) / far] : [0, 0];
    const depth = Math.sqrt(Math.max(0, 1 - radius * radius));
    const { right, up, back } = axesOf(doc.camera);
    return withLamp(
        doc,
        number,
        anglesIn(add(add(times(a, right), times(-b, up)), times(far <= 1 ? depth : -depth, back))),
    );
}
