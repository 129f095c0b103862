// The document of the Creator: plain values, of which undo, autosave, links and saved scenes are made. Meshes are not in it.

import type { Vector } from "../scene/arithmetic.js";
import type { Mesh, Texture } from "../scene/checked.js";
import * as check from "../scene/checks.js";
import type { Rgb } from "../scene/checks.js";
import type { Plain } from "../scene/fields.js";
import { painted, shadedMesh } from "../scene/normals.js";
import { loadSimplifier, simplify } from "../scene/simplify.js";
import type { Light, Rotation, Scene, SceneObject, Vector3 } from "../scene/types.js";

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

/** The fields of a class as documents have them: colours are "#rrggbb", what is not there is null. */
type Stored<Name extends keyof Plain> = {
    readonly [Key in keyof Plain[Name]]: Plain[Name][Key] extends Vector
        ? Vector3
        : Plain[Name][Key] extends Rgb
          ? string
          : undefined extends Plain[Name][Key]
            ? Exclude<Plain[Name][Key], undefined> | null
            : Plain[Name][Key];
};
export type Surface = Stored<"Material">;
export type View = Stored<"Camera">;
export type Ground = Stored<"Ground">;

/** An object: a vertex v of its mesh is at position + rotation(scale * v). Colours are "#rrggbb". */
export interface Item extends Omit<Stored<"SceneObject">, "fade"> {
    /** Unique in the document. */
    readonly id: string;
    readonly name: string;
    readonly mesh: MeshRef;
    readonly rotation: Rotation;
    /** Of the whole mesh; null: its own colours. */
    readonly color: string | null;
    readonly material: Surface;
    /** Degrees for computed normals; null: those of the mesh, or by its shape. */
    readonly crease: number | null;
    /** To which the mesh is simplified; null: all. */
    readonly maxTriangles: number | null;
    /** Of a ground that is not that of the document: where it begins to fade, and ends. It is not among all objects. */
    readonly fade?: readonly [number, number] | null;
}

/** A sphere: lengths are shown in its radii, positions relative to its middle. */
export interface Frame {
    readonly middle: Vector3;
    readonly radius: number;
}

export interface Document extends Stored<"Scene"> {
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
    readonly background: { readonly top: string; readonly bottom: string };
    readonly hemisphere: Stored<"Hemisphere"> | null;
    readonly rim: Stored<"Rim"> | null;
    /** Distances in the world. */
    readonly fog: Stored<"Fog"> | null;
    readonly tone: Stored<"Tone"> | null;
    readonly ground: Ground | null;
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
