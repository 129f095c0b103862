/** A ground under the objects of a scene, and what casts shadows on it. */

import {
    add,
    boundsOf,
    cross,
    dot,
    exponentOf,
    length,
    powerOfTwo,
    rint,
    rotation,
    rowOf,
    subtract,
    times,
    type Vector,
} from "./arithmetic.js";
import {
    checkInner,
    checkedObject,
    worldBounds,
    worldPositions,
    type Ground,
    type Scene,
    type SceneObject,
} from "./checked.js";
import { SHADOWS_ALL, SHADOWS_BACK_FACES } from "./records.js";
import { facesOfAll, isBalanced, numbered } from "./topology.js";
import { solidOf } from "./winding.js";

/**
 * The radius of a ground, as a multiple of half the diagonal of the box around the objects; the part of the radius at
 * which it begins to fade; how far it is below the lowest vertex, as a part of that half diagonal.
 */
const [REACH, INNER, GAP] = [2.25, 0.4, 2 ** -10];
/** Its coordinates are multiples of the half diagonal, rounded up to a power of two, times 2^-20. */
const STEP_BITS = 20;
/** Casters are closed if they are with vertices at multiples of their size, rounded up to a power of two, times 2^-16. */
const PLACE_BITS = 16;
/** One, in opacities. */
export const OPAQUE = 2 ** 24;
const CORNERS = [-1, 0, -1, -1, 0, 1, 1, 0, 1, 1, 0, -1];

/** Return the objects of a scene, with its ground as the last. */
export function withGround({ objects, ground }: Scene): SceneObject[] {
    return ground ? [...objects, groundUnder(ground, worldBounds(objects))] : objects;
}

/** Return the object that is a ground under what has these bounds. */
export function groundUnder({ color, height, radius, center, inner }: Ground, bounds: [Vector, Vector]): SceneObject {
    const [low, high] = bounds.map((each) => times(0.5, each));
    const half = length(subtract(high, low)) || 1;
    const step = powerOfTwo(exponentOf(half) - STEP_BITS);
    const onGrid = (value: number): number => Math.floor(value / step) * step;
    const [x, , z] = add(low, high).map(onGrid);
    const scale = radius ?? onGrid(REACH * half);
    const start = inner ?? INNER * scale;
    checkInner(start, scale);
    const object = {
        mesh: { positions: CORNERS, faces: [0, 1, 2, 0, 2, 3], colors: color },
        position: [center?.[0] ?? x, height ?? onGrid(2 * low[1] - GAP * half), center?.[1] ?? z],
        scale,
        // matte
        material: { ambient: 0.4, diffuse: 0.7, specular: 0 },
        fade: [start, scale],
    } as const;
    return checkedObject(object, "ground");
}

/**
 * Return which faces of culled objects cast shadows: all, or those turned away from the light, if all of them together
 * are closed.
 */
export function shadowRule({ objects }: Scene): number {
    const casters = objects.filter(
        (each) => each.cull && !each.wireframe && isOpaque(each) && !isBlended(each) && !each.fade,
    );
    return areClosed(casters.map(asSent)) ? SHADOWS_BACK_FACES : SHADOWS_ALL;
}

/** Return the object with the place that its Q32 numbers give it. */
function asSent({ position, rotation, scale, ...rest }: SceneObject): SceneObject {
    const sent = <V extends readonly number[]>(v: V): V => v.map((x) => rint(x * 2 ** 32) / 2 ** 32) as unknown as V;
    return { ...rest, position: sent(position), rotation: sent(rotation), scale: sent([scale] as const)[0] };
}

/** Return whether vertices or texels may be translucent. */
function isBlended({ mesh, material: { texture } }: SceneObject): boolean {
    return mesh.opacities !== undefined || (texture?.alpha !== undefined && texture.cutoff === 0);
}

/** Return whether the opacity of an object is 1 for the contracts, which have it in steps of 2^-24. */
export function isOpaque({ opacity }: SceneObject): boolean {
    return rint(opacity * OPAQUE) === OPAQUE;
}

/** Return whether each edge has as many faces on one side as on the other, and they bound a volume from outside. */
function areClosed(objects: SceneObject[]): boolean {
    const known = objects.length ? volumeOf(objects) : 1;
    if (known !== undefined) return known > 0;
    const positions = worldPositions(objects);
    const [low, high] = boundsOf(positions);
    const step = powerOfTwo(exponentOf(Math.max(...subtract(high, low))) - PLACE_BITS);
    const places = positions.map((x, index) => rint((x - low[index % 3]) / step));
    const { numbers } = numbered(places, 3);
    const faces = facesOfAll(objects.map(({ mesh }) => mesh));
    if (!isBalanced(faces.map((vertex) => numbers[vertex]))) return false;
    let volume = 0;
    for (let face = 0; face < faces.length; face += 3) {
        const [a, b, c] = [0, 1, 2].map((corner) => rowOf(places, faces[face + corner]));
        volume += dot(a, cross(b, c));
    }
    return volume > 0;
}

/**
 * Return the volume within objects, if each of them is closed by itself, and the volume far enough from zero to have
 * this sign wherever `areClosed` moves their vertices: then it need not look at all of them.
 */
function volumeOf(objects: SceneObject[]): number | undefined {
    const solids = objects.map(({ mesh }) => solidOf(mesh));
    if (!solids.every(({ isClosed }) => isClosed)) return undefined;
    const balls = objects.map((each, index) => {
        const { center, radius } = solids[index];
        const middle = add(each.position, rotation(each.rotation)(times(each.scale, center)));
        return [-1, 1].flatMap((side) => middle.map((x) => x + side * 2 * each.scale * radius));
    });
    const [low, high] = boundsOf(Float64Array.from(balls.flat()));
    const step = 2 ** -PLACE_BITS * 2 * Math.max(...subtract(high, low));
    let [volume, error, faces] = [0, 0, 0];
    objects.forEach(({ scale, mesh }, index) => {
        const solid = solids[index];
        faces += mesh.faces.length / 3;
        volume += scale ** 3 * solid.volume;
        // each vertex moves by less than a step, and so the volume by less than what the surface then sweeps
        error += step * (scale ** 2 * solid.area + scale * step * solid.sides + 2 * step ** 2 * mesh.faces.length);
    });
    // that of the sum: of products below 2^50 cubic steps
    error += step ** 3 * faces ** 2;
    return Math.abs(volume) > error ? volume : undefined;
}
