// Documents of scenes, and the scene files of documents: those of docs/scene-files.md, with pieces of datasets by reference.

import { InputError } from "../errors.js";
import { toBase64, toHex } from "../bytes.js";
import {
    checkedScene,
    worldPositions,
    type Light as CheckedLight,
    type Mesh,
    type SceneObject,
    type Texture,
} from "../scene/checked.js";
import * as check from "../scene/checks.js";
import type { Rgb } from "../scene/checks.js";
import { FIELDS } from "../scene/fields.js";
import { parseJson, parseScene } from "../scene/file.js";
import { groundUnder } from "../scene/ground.js";
import { vertexNormals } from "../scene/mesh.js";
import { shadedMesh } from "../scene/normals.js";
import { COLOR_KEYS } from "../scene/plain.js";
import { simplify } from "../scene/simplify.js";
import { Table, snake } from "../scene/table.js";
import type { Light, Scene } from "../scene/types.js";
import { isClosed } from "../scene/winding.js";
import {
    isSimplified,
    withoutNulls,
    type Document,
    type Item,
    type MeshRef,
    type Meshes,
    type StoredMesh,
} from "./document.js";
import { boundsOfPoints } from "./measure.js";
import { rows } from "./packed.js";

/** What is known of a scene. */
export interface About {
    title: string;
    notice?: string;
    licence?: string;
}

/** What a document has of an object beside what the scene has. */
export type Extra = Partial<Pick<Item, "name" | "mesh" | "color" | "crease" | "maxTriangles">>;

/** A document, and the meshes that it has brought along, by their keys. */
export interface Made {
    document: Document;
    meshes: Map<string, StoredMesh>;
}

/** Meshes that may have to be loaded. */
export interface Library extends Meshes {
    /** Load meshes, so that `get` returns them. InputError where there are none. */
    load(refs: readonly MeshRef[]): Promise<void>;
}

/** A document whose files are not here: it can be drawn once `Meshes` has them, when they were opened again. */
export class MissingFiles extends InputError {
    constructor(
        readonly document: Document,
        readonly names: readonly string[],
    ) {
        super(`${names.join(", ")} ${names.length > 1 ? "are" : "is"} not here: open the same file again`);
    }
}

// ---- of scenes ----

/** Return the document of a scene. extras: of its objects, in their order. An object that is a ground becomes the ground. */
export function documentOfScene(
    scene: Scene,
    { title, notice = "", licence = "" }: About,
    extras: readonly Extra[] = [],
): Made {
    const { objects: all, camera, lights, ...own } = checkedScene(scene);
    const ground = own.ground ? undefined : groundOf(all);
    const objects = ground ? all.slice(0, -1) : all;
    const meshes = new Map<string, StoredMesh>();
    const named = (index: number): string => (objects.length > 1 ? `${title || "Object"} ${index + 1}` : title);
    const about = { title, notice, licence };
    const items = objects.map((object, index): Item => {
        const { mesh, material, ...own } = object;
        const { texture, ...surface } = material;
        const extra = { name: named(index), color: null, crease: null, maxTriangles: null, ...extras[index] };
        const ref = extra.mesh ?? keep(object, extra.crease, about, meshes);
        return {
            id: String(index + 1),
            ...extra,
            mesh: ref,
            ...(plain({ ...own, material: surface }) as Omit<Item, keyof Extra | "id">),
        };
    });
    const document = {
        ...about,
        frame: boundsOfPoints(worldPositions(objects.filter(({ fade }) => !fade))),
        ...(plain(own) as Pick<Document, "ambientLight" | "background">),
        objects: items,
        camera: plain(camera) as Document["camera"],
        lights: lights.map(lightOf),
        lightsFollow: false,
        ...(ground && { ground }),
    } as unknown as Document;
    return { document, meshes };
}

/** Return a reference to the mesh of an object, which is kept. */
function keep(object: SceneObject, crease: number | null, about: Required<About>, meshes: Made["meshes"]): MeshRef {
    const { shading, texture } = object.material;
    let { mesh } = object;
    // smooth meshes of scenes are smooth all over
    if (shading === "smooth" && crease === null && !mesh.normals) {
        mesh = { ...mesh, normals: vertexNormals(mesh.positions, mesh.faces) };
    }
    const file = digestOf(mesh, mesh.normals, texture);
    if (!meshes.has(file)) meshes.set(file, storedMesh(mesh, texture, about));
    return { file };
}

/** Return a mesh with what is known of it. */
export function storedMesh(mesh: Mesh, texture: Texture | undefined, about: Required<About>): StoredMesh {
    const [triangles, vertices] = [mesh.faces.length / 3, mesh.positions.length / 3];
    const { radius } = boundsOfPoints(mesh.positions);
    return { ...about, mesh, texture, closed: isClosed(mesh), triangles, vertices, radius };
}

/** Return a text that differs for meshes that do, but for accidents. */
export function digestOf(mesh: Mesh, normals: Mesh["normals"], texture: Texture | undefined): string {
    const { positions, faces, colors, uvs, opacities } = mesh;
    const tables = [positions, faces, colors, normals, uvs, opacities, texture?.pixels, texture?.alpha];
    const more = [tables.map((each) => each?.length), texture?.width, texture?.filter, texture?.wrap, texture?.cutoff];
    const lanes = Uint32Array.of(0x811c9dc5, 0x9e3779b9, 0xb7e15163, 0x243f6a89);
    for (const each of [new TextEncoder().encode(JSON.stringify(more)), ...tables]) {
        if (!each) continue;
        for (const byte of new Uint8Array(each.buffer, each.byteOffset, each.byteLength)) {
            for (let lane = 0; lane < 4; lane++) lanes[lane] = Math.imul(lanes[lane] ^ byte, FACTORS[lane]);
        }
    }
    return Array.from(lanes, (each) => each.toString(16).padStart(8, "0")).join("");
}
const FACTORS = [0x01000193, 0x85ebca6b, 0xc2b2ae35, 0x27d4eb2f];

/** Return a checked value as documents have it: with "#rrggbb", and null for what is not there. */
function plain(value: unknown, key = ""): unknown {
    if (value === undefined) return null;
    if (Array.isArray(value)) return COLOR_KEYS.has(snake(key)) ? hex(value as number[]) : value;
    if (typeof value !== "object" || value === null) return value;
    return Object.fromEntries(Object.entries(value).map(([name, each]) => [name, plain(each, name)]));
}

function hex(color: ArrayLike<number>): string {
    return toHex(color, "#");
}

function lightOf({ kind, vector, color, cone, shadow }: CheckedLight): Light {
    const common = { color: hex(color), shadow };
    if (kind === "directional") return { kind, direction: vector, ...common };
    return kind === "point"
        ? { kind, position: vector, ...common }
        : { kind: "spot", position: vector, ...(cone as NonNullable<typeof cone>), ...common };
}

/** Return the ground that the last of some objects is; undefined where it is another object. */
function groundOf(objects: readonly SceneObject[]): Document["ground"] | undefined {
    const last = objects.at(-1);
    if (!last?.fade) return undefined;
    const { mesh, position, scale, fade } = last;
    const center = [position[0], position[2]] as const;
    const color: Rgb = [mesh.colors[0], mesh.colors[1], mesh.colors[2]];
    const made = { height: position[1], radius: scale, center, inner: fade[0] };
    const other = groundUnder({ color, ...made }, [position, position]);
    const parts = ({ mesh, material, ...own }: SceneObject): string =>
        JSON.stringify([own, material, mesh].map((part) => Object.entries(part).sort()));
    return parts(other) === parts(last) ? { color: hex(color), ...made } : undefined;
}

// ---- as scene files ----

/** Return the JSON of the scene file of a document: pieces by reference, opened meshes inside. `prepare` must have been called. */
export function sceneFile(doc: Document, meshes: Meshes): string {
    return JSON.stringify(sceneTable(doc, meshes, true));
}

/** Return the scene file of a document, as a value. inline: whether opened and simplified meshes are inside. */
export function sceneTable(doc: Document, meshes: Meshes, inline: boolean): object {
    const { title, notice, licence, frame, lightsFollow, objects, width, height, ...own } = doc;
    const made = objects.map((item) => {
        const isFile = "file" in item.mesh;
        const stored = isFile && !inline ? undefined : meshes.get(item.mesh);
        const isInside = inline && stored !== undefined && (isFile || isSimplified(item, stored));
        return {
            table: objectTable(item, stored, isInside),
            note: { name: item.name, max_triangles: item.maxTriangles, mesh: isInside && !isFile ? item.mesh : null },
        };
    });
    return {
        ...(snakes(withoutNulls(own)) as object),
        size: [width, height],
        objects: made.map(({ table }) => table),
        creator: {
            title,
            notice,
            licence,
            frame,
            lights_follow: lightsFollow,
            objects: made.map(({ note }) => withoutNulls(note)),
        },
    };
}

function objectTable(
    { id, name, mesh: ref, maxTriangles, rotation, material, ...own }: Item,
    stored: StoredMesh | undefined,
    isInside: boolean,
): object {
    let mesh: object = ref;
    let { shading } = material;
    if (isInside && stored) {
        let inside = simplify(stored.mesh, maxTriangles ?? stored.triangles);
        // meshes in files are as they are: without a crease, there are no normals by shape
        if (shading === "smooth" && own.crease === null) ({ mesh: inside, shading } = shadedMesh(inside, null));
        mesh = meshTable(inside);
    }
    const texture = stored?.texture && textureTable(stored.texture);
    return {
        ...(snakes(withoutNulls(own)) as object),
        mesh,
        rotation: rotation.length === 4 ? { quaternion: rotation } : rotation,
        material: { ...(snakes(material) as object), shading, ...(texture && { texture }) },
    };
}

function meshTable({ positions, faces, colors, normals, uvs, opacities }: Mesh): object {
    return {
        positions: rows(positions, 3),
        faces: rows(faces, 3),
        colors: rows(colors, 3),
        ...(normals && { normals: rows(normals, 3) }),
        ...(uvs && { uvs: rows(uvs, 2) }),
        ...(opacities && { opacities: [...opacities] }),
    };
}

export function textureTable({ pixels, alpha, cutoff, ...own }: Texture): object {
    return { ...own, pixels: toBase64(pixels), ...(alpha && { alpha: toBase64(alpha), ...(cutoff && { cutoff }) }) };
}

/** Return a plain value with the keys of Python. */
function snakes(value: unknown): unknown {
    if (Array.isArray(value)) return value.map(snakes);
    if (typeof value !== "object" || value === null) return value;
    return Object.fromEntries(Object.entries(value).map(([key, each]) => [snake(key), snakes(each)]));
}

/**
 * Return the document of a scene file: its JSON, or the value of it.
 *
 * library: of the meshes that it refers to. about: what it does not say itself.
 */
export async function openSceneFile(json: string | object, library: Library, about: About): Promise<Made> {
    const value = typeof json === "string" ? parseJson(json) : json;
    const table = new Table(value, "");
    const creator = table.table("creator");
    const notes = creator.list("objects").map((note) => new Table(note, creator.place("objects")));
    const objects = table.list("objects").map((each, index) => new Table(each, `objects[${index}]`));
    const refs = objects.map((each, index) => refOf(notes[index]?.get("mesh")) ?? refOf(each.get("mesh")));
    await library.load(refs.filter((ref) => ref !== undefined));
    const extras = objects.map((each, index): Extra => ({
        ...(refs[index] && { mesh: refs[index] }),
        color: each.read("color", (color, where) => hex(check.color(color, where))) ?? null,
        crease: each.number("crease", ...FIELDS.SceneObject.crease.limits) ?? null,
        maxTriangles: notes[index]?.number("max_triangles", 1) ?? null,
        ...text(notes[index], "name"),
    }));
    // what a document has of its own is left out
    const bare = objects.map(({ values: { color, crease, ...own } }, index) =>
        refs[index] ? { ...own, mesh: refs[index] } : own,
    );
    const whole = table.has("objects") ? { ...(value as object), objects: bare } : (value as object);
    const missing = new Set<number>();
    const names: Pick<Extra, "name">[] = [];
    const scene = parseScene(whole, (mesh, where) => {
        const [ref, index] = [refOf(mesh), Number(/\d+/.exec(where))];
        if (!ref) throw new InputError(`${where} is not here: give all files together`);
        try {
            const found = library.get(ref);
            names[index] = { name: "piece" in ref && ref.object ? `${found.title} ${ref.object + 1}` : found.title };
            return found;
        } catch (error) {
            if ("piece" in ref) throw error;
            missing.add(index);
            return { mesh: NO_MESH };
        }
    });
    const known = Object.assign({}, about, ...["title", "notice", "licence"].map((key) => text(creator, key))) as About;
    const called = extras.map((each, index) => ({ ...names[index], ...each }));
    const { document, meshes } = documentOfScene(scene, known, called);
    const frame = creator.table("frame");
    const [middle, radius] = [frame.read("middle", check.vector), frame.number("radius", 1e-30)];
    const lightsFollow = creator.read("lights_follow", check.flag) ?? false;
    const made = { ...document, lightsFollow, ...(middle && radius && { frame: { middle, radius } }) };
    if (missing.size)
        throw new MissingFiles(made, [...new Set(Array.from(missing, (at) => extras[at]?.name ?? "a file"))]);
    return { document: made, meshes };
}

const NO_MESH = { positions: [0, 0, 0, 1, 0, 0, 0, 1, 0], faces: [0, 1, 2] };

function text(table: Table | undefined, key: string): Record<string, string> {
    const value = table?.get(key);
    return typeof value === "string" ? { [key]: value.slice(0, 1000) } : {};
}

function refOf(value: unknown): MeshRef | undefined {
    if (typeof value !== "object" || value === null) return undefined;
    const { piece, object = 0, file } = value as { piece?: unknown; object?: unknown; file?: unknown };
    if (typeof piece === "string" && Number.isInteger(object)) return { piece, object: object as number };
    return typeof file === "string" ? { file } : undefined;
}
