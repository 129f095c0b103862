/** A ground under the objects of a scene, and what casts shadows on it. */

import { exponentOf, length, powerOfTwo, type Vector } from "./arithmetic.js";
import { worldPositions, type Ground, type Mesh, type Scene, type SceneObject } from "./checked.js";

/**
 * The radius of a ground, as a multiple of half the diagonal of the box around the objects; the part of the radius at
 * which it begins to fade; how far it is below the lowest vertex, as a part of that half diagonal.
 */
const [REACH, INNER, GAP] = [2.25, 0.4, 2 ** -10];
/** Its coordinates are multiples of the half diagonal, rounded up to a power of two, times 2^-20. */
const STEP_BITS = 20;
const CORNERS = [-1, 0, -1, -1, 0, 1, 1, 0, 1, 1, 0, -1];

/** Return the objects of a scene, with its ground as the last. */
export function withGround({ objects, ground }: Scene): SceneObject[] {
    return ground ? [...objects, groundUnder(ground, objects.flatMap(worldPositions))] : objects;
}

function groundUnder({ color, height, radius }: Ground, points: Vector[]): SceneObject {
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
    return {
        mesh: {
            positions: Float64Array.from(CORNERS),
            faces: Uint32Array.from([0, 1, 2, 0, 2, 3]),
            colors: Uint8Array.from({ length: 12 }, (_, index) => color[index % 3] as number),
            normals: undefined,
            uvs: undefined,
        },
        position: [x, height ?? onGrid(2 * lowest - GAP * half), z],
        rotation: [0, 0, 0, 1],
        scale,
        // matte
        material: { shading: "flat", ambient: 0.4, diffuse: 0.7, specular: 0, shininess: 24, texture: undefined },
        cull: true,
        wireframe: false,
        opacity: 1,
        fade: [INNER * scale, scale],
    };
}

/** Return which faces of culled objects cast shadows: 1 for all, 2, for closed objects, for those turned away. */
export function shadowRule({ objects }: Scene): number {
    const casters = objects.filter((each) => each.cull && !each.wireframe && each.opacity === 1 && !each.fade);
    return casters.every(({ mesh }) => isClosed(mesh)) ? 2 : 1;
}

/** Return whether each edge has a face on either side, wound alike, and the mesh bounds a volume from outside. */
function isClosed({ positions, faces }: Mesh): boolean {
    const numbers = new Map<string, number>();
    const places = Array.from({ length: positions.length / 3 }, (_, vertex) => {
        const key = positions.slice(3 * vertex, 3 * vertex + 3).join();
        const number = numbers.get(key) ?? numbers.size;
        numbers.set(key, number);
        return number;
    });
    // how many more faces an edge has on one side than on the other
    const edges = new Map<number, number>();
    let volume = 0;
    for (let face = 0; face < faces.length; face += 3) {
        const corners = [0, 1, 2].map((corner) => faces[face + corner] as number);
        const [a, b, c] = corners.map((vertex) => positions.subarray(3 * vertex, 3 * vertex + 3)) as [
            Float64Array,
            Float64Array,
            Float64Array,
        ];
        volume += determinant(a, b, c);
        for (let corner = 0; corner < 3; corner++) {
            const one = places[corners[corner] as number] as number;
            const other = places[corners[(corner + 1) % 3] as number] as number;
            if (one === other) continue;
            const key = Math.min(one, other) * numbers.size + Math.max(one, other);
            edges.set(key, (edges.get(key) ?? 0) + (one < other ? 1 : -1));
        }
    }
    return volume > 0 && [...edges.values()].every((balance) => balance === 0);
}

function determinant(a: Float64Array, b: Float64Array, c: Float64Array): number {
    const [ax, ay, az, bx, by, bz, cx, cy, cz] = [...a, ...b, ...c] as [
        number,
        number,
        number,
        number,
        number,
        number,
        number,
        number,
        number,
    ];
    return ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
}
