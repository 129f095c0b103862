// Numbers as documents have them, and where objects are.

import {
    add,
    boundsOf,
    fromEuler,
    length,
    multiply,
    rotation,
    rowOf,
    subtract,
    times,
    type Quaternion,
    type Vector,
} from "../scene/arithmetic.js";
import { worldPositions, type Mesh, type SceneObject } from "../scene/checked.js";
import { remembered } from "../scene/memory.js";
import type { Rotation } from "../scene/types.js";
import type { Document, Frame, Item, Meshes } from "./document.js";

/** The objects that are selected, by their ids: all where there are none. */
export type Selection = ReadonlySet<string>;

/** Significant digits of numbers that people set. */
const DIGITS = 6;
/** Digits of what is computed of them: as many fewer than those of the size of the objects. */
const FINE = 9;

/** Return a number with 6 significant digits, and 0 for rounding errors about 0. */
export function tidy(value: number): number {
    return Math.abs(value) < 1e-9 ? 0 : Number(value.toPrecision(DIGITS));
}

/** Return a point with 9 digits, the first of which is that of `size`. */
export function tidied(point: Vector, size = 1): Vector {
    const digits = FINE - 1 - Math.floor(Math.log10(size));
    return point.map((x) => (digits < 0 || digits > 100 ? x : Number(x.toFixed(digits)) + 0)) as Vector;
}

/** Return an angle from -180 to 180. */
export function around(degrees: number): number {
    return Math.abs(degrees) <= 180 ? degrees : degrees - 360 * Math.round(degrees / 360);
}

export const degrees = (radians: number): number => (radians * 180) / Math.PI;
export const radians = (degrees: number): number => (degrees * Math.PI) / 180;

export const quaternionOf = remembered((value: Rotation): Quaternion => {
    return value.length === 3 ? fromEuler([...value]) : [...value];
});

/** Return the angles about x, then y, then z of a rotation, in degrees. */
export function eulerOf(value: Rotation): Vector {
    if (value.length === 3) return [...value];
    const turn = rotation([...value]);
    const [x, y] = [turn([1, 0, 0]), turn([0, 1, 0])];
    const z = turn([0, 0, 1]);
    const level = Math.hypot(x[0], x[1]);
    const about = level > 1e-6 ? [Math.atan2(y[2], z[2]), Math.atan2(x[1], x[0])] : [Math.atan2(-z[1], y[1]), 0];
    return [about[0], Math.atan2(-x[2], level), about[1]].map((angle) => tidy(degrees(angle))) as Vector;
}

const inMesh = remembered((mesh: Mesh): Frame => sphereAbout(mesh.positions));

function sphereAbout(points: Float64Array): Frame {
    const [low, high] = boundsOf(points);
    const middle = low.map((x, axis) => x / 2 + high[axis] / 2) as Vector;
    let radius = 0;
    for (let row = 0; 3 * row < points.length; row++) {
        radius = Math.max(radius, length(subtract(rowOf(points, row), middle)));
    }
    return { middle, radius };
}

/** Return the vertices of objects in the world, three numbers each. */
export function pointsOf(items: readonly Item[], meshes: Meshes): Float64Array {
    const placed = items.map(({ mesh, position, rotation, scale }) => ({
        mesh: meshes.get(mesh).mesh,
        position,
        rotation: quaternionOf(rotation),
        scale,
    }));
    return worldPositions(placed as unknown as SceneObject[]);
}

/** Return the sphere about the box of points; the unit sphere where they have no size. */
export function boundsOfPoints(points: Float64Array): Frame {
    const { middle, radius } = sphereAbout(points);
    return { middle, radius: radius || 1 };
}

/** Return the sphere about an object, which turns, moves and grows with it. */
export function sphereOf(item: Item, meshes: Meshes): Frame {
    const { middle, radius } = inMesh(meshes.get(item.mesh).mesh);
    const turned = rotation(quaternionOf(item.rotation))(times(item.scale, middle as Vector));
    return { middle: add(item.position as Vector, turned), radius: item.scale * radius };
}

/** Return the sphere about objects, which turns, moves and grows with them. */
export function sphereOfAll(items: readonly Item[], meshes: Meshes): Frame {
    const spheres = items.map((item) => sphereOf(item, meshes));
    const all = spheres.reduce((sum, { radius }) => sum + radius, 0) || 1;
    let middle: Vector = [0, 0, 0];
    for (const each of spheres) middle = add(middle, times(each.radius / all, each.middle as Vector));
    const reach = spheres.map((each) => length(subtract(each.middle as Vector, middle)) + each.radius);
    return { middle, radius: Math.max(0, ...reach) || 1 };
}

/** Return the objects of a selection; all but grounds where it is empty. */
export function chosen(doc: Document, selection: Selection): readonly Item[] {
    const found = doc.objects.filter(({ id }) => selection.has(id));
    return found.length ? found : doc.objects.filter(({ fade }) => !fade);
}

/** Return the document with changed objects of a selection. */
export function changed(doc: Document, selection: Selection, change: (item: Item) => Item): Document {
    const items = new Set(chosen(doc, selection));
    return { ...doc, objects: doc.objects.map((item) => (items.has(item) ? change(item) : item)) };
}

/** Return an object scaled about a point, turned about it, and moved. */
export function carried(
    item: Item,
    about: Vector,
    { factor = 1, by = [0, 0, 0], turn }: { factor?: number; by?: Vector; turn?: Quaternion },
): Item {
    const from = times(factor, subtract(item.position as Vector, about));
    return {
        ...item,
        position: add(add(about, by), turn ? rotation(turn)(from) : from),
        rotation: turn ? multiply(turn, quaternionOf(item.rotation)) : item.rotation,
        scale: factor * item.scale,
    };
}
