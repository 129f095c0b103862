// Meshes of fewer triangles, by meshoptimizer.

import type { MeshoptSimplifier, SimplifierFlags } from "meshoptimizer/simplifier";
import { InputError, show } from "../errors.js";
import { boundsOf, clamped, largest, subtract } from "./arithmetic.js";
import type { Mesh } from "./checked.js";
import { remembered } from "./memory.js";
import { unitRows } from "./mesh.js";
import { withoutNormals } from "./normals.js";
import { beside } from "./topology.js";
import { meshOf, partOf, rgbaOf } from "./weld.js";

/** How much a difference of a whole colour, or of a whole image, counts beside one of the size of the mesh. */
const WEIGHT = 0.5;
/** What is tried until it suffices: borders of colours and of images stay; they may move; only the shape is sampled. */
const TRIES: readonly (SimplifierFlags[] | undefined)[] = [[], ["Permissive", "Prune"], undefined];
/** However large: the number of triangles decides. */
const MOST_ERROR = 1e9;

let simplifier: typeof MeshoptSimplifier | undefined;

/** Load what `simplify` needs. */
export async function loadSimplifier(): Promise<void> {
    const { MeshoptSimplifier: loaded } = await import("meshoptimizer/simplifier");
    await loaded.ready;
    simplifier = loaded;
}

/** Return a mesh as `reduced` does, without normals; the mesh itself where it is small enough. */
export const simplify = remembered((mesh: Mesh, count: number): Mesh => {
    return reduced(mesh.faces.length > 3 * count ? withoutNormals(mesh) : mesh, count);
});

/**
 * Return a mesh of at most `count` triangles; the mesh itself where it is small enough. InputError, with a number that can
 * be reached, for one that cannot. `loadSimplifier` must have been awaited.
 */
export function reduced(mesh: Mesh, count: number): Mesh {
    if (!(Number.isInteger(count) && count >= 1)) {
        const wanted = "the number of triangles to simplify to must be a whole number, at least 1";
        throw new InputError(`${wanted}, not ${show(count)}`);
    }
    const total = mesh.faces.length / 3;
    if (total <= count) return mesh;
    let least = total;
    for (const flags of TRIES) {
        const found = simplified(mesh, count, flags);
        if (found && found.faces.length <= 3 * count) return found;
        if (found) least = Math.min(least, found.faces.length / 3);
    }
    throw new InputError(`a mesh of ${total} triangles cannot be simplified to ${count}; ${least} would do`);
}

/** Return the mesh with about so many triangles; undefined if none remain. flags: undefined if only the shape counts. */
function simplified(mesh: Mesh, count: number, flags: SimplifierFlags[] | undefined): Mesh | undefined {
    if (!simplifier) throw new Error("loadSimplifier() must have been awaited");
    const [low, high] = boundsOf(mesh.positions);
    const size = largest(subtract(high, low)) || 1;
    // in 32 bits, from the corner of the box
    const before = Float32Array.from(mesh.positions, (x, at) => (x - low[at % 3]) / size);
    if (!flags) {
        const [faces] = simplifier.simplifySloppy(mesh.faces, before, 3, null, 3 * count, MOST_ERROR);
        return faces.length ? partOf(mesh, faces) : undefined;
    }
    const { rows, width } = beside([rgbaOf(mesh), mesh.normals && unitRows(mesh.normals), mesh.uvs], before.length / 3);
    const more = Float32Array.from(rows, (x, at) => (at % width < 4 ? x / 255 : x));
    const [faces, after] = [mesh.faces.slice(), before.slice()];
    const weights = Array<number>(width).fill(WEIGHT);
    const [left] = simplifier.simplifyWithUpdate(
        ...([faces, after, 3, more, width, weights, null, 3 * count, MOST_ERROR, flags] as const),
    );
    if (!left) return undefined;
    const columns = (from: number, to: number): Float64Array =>
        Float64Array.from(more.filter((_, at) => at % width >= from && at % width < to));
    const kept = faces.subarray(0, left);
    const positions = mesh.positions.map((x, at) => (after[at] === before[at] ? x : low[at % 3] + size * after[at]));
    const whole = meshOf(positions, kept, {
        rgba: Uint8Array.from(columns(0, 4), (x) => 255 * clamped(x, 0, 1) + 0.5),
        normals: mesh.normals && unitRows(columns(4, 7)),
        uvs: mesh.uvs && columns(width - 2, width),
    });
    return partOf(whole, kept);
}
