/** A ground under the objects of a scene, and what casts shadows on it. */

import { cross, dot, exponentOf, length, powerOfTwo, rint, type Vector } from "./arithmetic.js";
import { checkInner, worldPositions, type Ground, type Scene, type SceneObject } from "./checked.js";
import { SHADOWS_ALL, SHADOWS_BACK_FACES } from "./records.js";

/**
 * The radius of a ground, as a multiple of half the diagonal of the box around the objects; the part of the radius at
 * which it begins to fade; how far it is below the lowest vertex, as a part of that half diagonal.
 */
const [REACH, INNER, GAP] = [2.25, 0.4, 2 ** -10];
/** Its coordinates are multiples of the half diagonal, rounded up to a power of two, times 2^-20. */
const STEP_BITS = 20;
/** One, in opacities. */
export const OPAQUE = 2 ** 24;
const CORNERS = [-1, 0, -1, -1, 0, 1, 1, 0, 1, 1, 0, -1];

/** Return the objects of a scene, with its ground as the last. */
export function withGround({ objects, ground }: Scene): SceneObject[] {
    return ground ? [...objects, groundUnder(ground, objects.flatMap(worldPositions))] : objects;
}

function groundUnder({ color, height, radius, center, inner }: Ground, points: Vector[]): SceneObject {
    const bounds = [0, 1, 2].map((axis) => {
        const values = points.length ? points.map((point) => point[axis] as number) : [0];
        const low = values.reduce((least, value) => Math.min(least, value));
        return [low / 2, values.reduce((most, value) => Math.max(most, value)) / 2] as const;
    });
    const half = length(bounds.map(([low, high]) => high - low)) || 1;
    const step = powerOfTwo(exponentOf(half) - STEP_BITS);
    const onGrid = (value: number): number => Math.floor(value / step) * step;
    const [x, , z] = bounds.map(([low, high]) => onGrid(low + high)) as [number, number, number];
    const lowest = (bounds[1] as readonly [number, number])[0];
    const scale = radius ?? onGrid(REACH * half);
    const start = inner ?? INNER * scale;
    checkInner(start, scale);
    return {
        mesh: {
            positions: Float64Array.from(CORNERS),
            faces: Uint32Array.from([0, 1, 2, 0, 2, 3]),
            colors: Uint8Array.from({ length: 12 }, (_, index) => color[index % 3] as number),
            normals: undefined,
            uvs: undefined,
            opacities: undefined,
        },
        position: [center?.[0] ?? x, height ?? onGrid(2 * lowest - GAP * half), center?.[1] ?? z],
        rotation: [0, 0, 0, 1],
        scale,
        // matte
        material: {
            shading: "flat",
            ambient: 0.4,
            diffuse: 0.7,
            specular: 0,
            shininess: 24,
            texture: undefined,
            emission: [0, 0, 0],
        },
        cull: true,
        wireframe: false,
        twoSided: false,
        opacity: 1,
        fade: [start, scale],
    };
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
    const positions = objects.flatMap(worldPositions);
    if (!positions.length) return true;
    const low = [0, 1, 2].map((axis) => positions.reduce((least, p) => Math.min(least, p[axis] as number), Infinity));
    const sides = low.map((least, axis) =>
        positions.reduce((most, p) => Math.max(most, (p[axis] as number) - least), 0),
    );
    const step = powerOfTwo(exponentOf(Math.max(...sides)) - 16);
    const places = positions.map((p) => p.map((x, axis) => rint((x - (low[axis] as number)) / step)) as Vector);
    const names = new Map<string, number>();
    const numbers = places.map((place) => {
        const key = place.join();
        const number = names.get(key) ?? names.size;
        names.set(key, number);
        return number;
    });
    const edges = new Map<number, number>();
    let [volume, begin] = [0, 0];
    for (const { mesh } of objects) {
        for (let face = 0; face < mesh.faces.length; face += 3) {
            const corners = [0, 1, 2].map((corner) => begin + (mesh.faces[face + corner] as number));
            const [a, b, c] = corners.map((vertex) => places[vertex] as Vector) as [Vector, Vector, Vector];
            volume += dot(a, cross(b, c));
            for (let corner = 0; corner < 3; corner++) {
                const one = numbers[corners[corner] as number] as number;
                const other = numbers[corners[(corner + 1) % 3] as number] as number;
                if (one === other) continue;
                const key = Math.min(one, other) * names.size + Math.max(one, other);
                edges.set(key, (edges.get(key) ?? 0) + (one < other ? 1 : -1));
            }
        }
        begin += mesh.positions.length / 3;
    }
    return volume > 0 && [...edges.values()].every((balance) => balance === 0);
}
