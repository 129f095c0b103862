// The document of the Creator: plain values, of which undo, autosave, links and saved scenes are made. Meshes are not in it.

import type { Mesh, Texture } from "../scene/checked.js";
import * as check from "../scene/checks.js";
import { painted, shadedMesh } from "../scene/normals.js";
import { loadSimplifier, simplify } from "../scene/simplify.js";
import type { Light, Projection, Rotation, Scene, SceneObject, Shading, Vector3 } from "../scene/types.js";

/** The `object`-th object of a piece of a dataset, or an opened mesh by the digest of its contents. */
export type MeshRef = { readonly piece: string; readonly object: number } | { readonly file: string };

/** Return a text for a mesh, and the mesh of such a text. */
export function keyOf(ref: MeshRef): string {
    return "file" in ref ? ref.file : `${ref.piece}#${ref.object}`;
}
export function refOf(key: string): MeshRef {
    const [piece, object] = key.split("#") as [string, string?];
    return object === undefined ? { file: piece } : { piece, object: Number(object) };
}

export interface Surface {
    readonly shading: Shading;
    readonly ambient: number;
    readonly diffuse: number;
    readonly specular: number;
    readonly shininess: number;
    readonly emission: string;
}

/** An object: a vertex v of its mesh is at position + rotation(scale * v). Colours are "#rrggbb". */
export interface Item {
    /** Unique in the document. */
    readonly id: string;
    readonly name: string;
    readonly mesh: MeshRef;
    readonly position: Vector3;
    readonly rotation: Rotation;
    readonly scale: number;
    /** Of the whole mesh; null: its own colours. */
    readonly color: string | null;
    readonly material: Surface;
    /** Degrees for computed normals; null: those of the mesh, or by its shape. */
    readonly crease: number | null;
    /** To which the mesh is simplified; null: all. */
    readonly maxTriangles: number | null;
    readonly opacity: number;
    readonly cull: boolean;
    readonly wireframe: boolean;
    readonly twoSided: boolean;
    /** Of a ground that is not that of the document: where it begins to fade, and ends. It is not among all objects. */
    readonly fade?: readonly [number, number] | null;
}

/** A sphere: lengths are shown in its radii, positions relative to its middle. */
export interface Frame {
    readonly middle: Vector3;
    readonly radius: number;
}

export interface View {
    readonly eye: Vector3;
    readonly target: Vector3;
    readonly up: Vector3;
    readonly projection: Projection;
    readonly halfHeight: number;
    readonly near: number | null;
}

export interface Ground {
    readonly color: string;
    readonly height: number | null;
    readonly radius: number | null;
    readonly center: readonly [number, number] | null;
    readonly inner: number | null;
}

export interface Document {
    /** Of what was opened; "" where it is not known. */
    readonly title: string;
    readonly notice: string;
    readonly licence: string;
    /** Set at opening. */
    readonly frame: Frame;
    readonly objects: readonly Item[];
    readonly camera: View;
    /** With all their fields, colours "#rrggbb"; up to four, at most one with shadow. */
    readonly lights: readonly Light[];
    /** Whether lights move with the camera. */
    readonly lightsFollow: boolean;
    readonly ambientLight: string;
    readonly background: { readonly top: string; readonly bottom: string };
    readonly invert: boolean;
    readonly antialias: boolean;
    readonly hemisphere: { readonly sky: string; readonly ground: string } | null;
    readonly rim: { readonly color: string; readonly power: number } | null;
    /** Distances in the world. */
    readonly fog: { readonly color: string; readonly near: number; readonly far: number } | null;
    readonly tone: { readonly exposure: number; readonly filmic: boolean; readonly gamma: boolean } | null;
    readonly ground: Ground | null;
    readonly width: number;
    readonly height: number;
}

export interface StoredMesh {
    readonly mesh: Mesh;
    readonly texture?: Texture | undefined;
    /** Whether it bounds a volume, so that back faces can be left out. */
    readonly closed: boolean;
    readonly triangles: number;
    readonly vertices: number;
    /** Of the sphere about the middle of its box. */
    readonly radius: number;
    readonly title: string;
    readonly notice: string;
    readonly licence: string;
}

/** The meshes that documents refer to. */
export interface Meshes {
    /** InputError where it is not there. */
    get(ref: MeshRef): StoredMesh;
}

export interface SceneOptions {
    width?: number | undefined;
    height?: number | undefined;
    antialias?: boolean | undefined;
}

/**
 * Return the scene of a document, for `encode`.
 *
 * Its meshes are the same objects each time, so that what is remembered of them stays. `prepare` must have been called.
 */
export function sceneOf(doc: Document, meshes: Meshes, options: SceneOptions = {}): Scene {
    const { title, notice, licence, frame, lightsFollow, objects, ...own } = doc;
    const { width = doc.width, height = doc.height, antialias = doc.antialias } = options;
    const made = objects.map((item) => objectOf(item, meshes.get(item.mesh)));
    return { ...(withoutNulls(own) as Omit<Scene, "objects">), width, height, antialias, objects: made };
}

function objectOf(item: Item, stored: StoredMesh): SceneObject {
    const { id, name, mesh: ref, color, crease, maxTriangles, material, fade, ...own } = item;
    let { mesh, texture } = { texture: undefined, ...stored };
    let { shading } = material;
    if (isSimplified(item, stored)) mesh = simplify(mesh, maxTriangles as number);
    if (shading === "smooth") ({ mesh, shading } = shadedMesh(mesh, crease));
    if (color !== null) [mesh, texture] = [painted(mesh, check.color(color, "color")), undefined];
    return { ...own, mesh, material: { ...material, shading, texture }, fade: fade ?? undefined };
}

/** Return whether an object has less triangles than its mesh. */
export function isSimplified({ maxTriangles }: Item, { triangles }: StoredMesh): boolean {
    return maxTriangles !== null && maxTriangles < triangles;
}

/** Load what `sceneOf` needs for a document: the library that simplifies, where an object is simplified. */
export async function prepare(doc: Document, meshes: Meshes): Promise<void> {
    if (doc.objects.some((item) => isSimplified(item, meshes.get(item.mesh)))) await loadSimplifier();
}

/** Return a plain value without the keys, of itself and of the objects in it, whose values are null. */
export function withoutNulls(value: unknown): unknown {
    if (typeof value !== "object" || value === null || Array.isArray(value)) return value;
    const kept = Object.entries(value).filter(([, each]) => each !== null);
    return Object.fromEntries(kept.map(([key, each]) => [key, withoutNulls(each)]));
}
