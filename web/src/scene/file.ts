// Scene files: docs/scene-files.md documents the keys and their defaults.

import { InputError, about, show } from "../errors.js";
import { fromBase64 } from "../bytes.js";
import { fromAxisAngle, rint } from "./arithmetic.js";
import * as checked from "./checked.js";
import * as check from "./checks.js";
import { FIELDS, LIGHTS, LIGHT_KINDS, type Plain } from "./fields.js";
import { shadedMesh } from "./normals.js";
import { isOriginal, originalScene } from "./original.js";
import { COLOR_KEYS, keysOf, read, type Field } from "./plain.js";
import { VIEW, frame, halfHeightOf, keyLight, type Viewpoint } from "./staging.js";
import { Table, snake } from "./table.js";
import type * as given from "./types.js";

const PLACES = ["eye", "target", "up"] as const;
const ANGLES = ["azimuth", "elevation", "margin"] as const;
/** Meshes are not turned upright here. */
const OBJECT = keysOf("SceneObject").filter((key) => key !== "up_axis");

/** Returns the mesh that the key `mesh` of an object refers to. */
export type FindMesh = (mesh: unknown, where: string) => Pick<given.Material, "texture"> & { mesh: given.Mesh };

/**
 * Return the scene of a scene file: its JSON as text, or as `JSON.parse` returns it.
 *
 * Meshes must be inside, as `Scene.save` of Python writes them, or `find` returns them: there are no files to read.
 * `JSON.parse` does not tell 1.0 from 1: a colour such as [1.0, 0.0, 0.0] is red in a text, and nearly black in a value.
 * InputError, with the key, if anything is wrong.
 */
export function parseScene(json: string | object, find: FindMesh = findNone): given.Scene {
    const document: unknown = typeof json === "string" ? parseJson(json) : json;
    if (isOriginal(document)) return originalScene(document);
    const table = new Table(document, "", keysOf("Scene"));
    const [width, height] = sizeOf(table.get("size"));
    const objects = table.list("objects").map((each, index) => objectOf(each, `objects[${index}]`, find));
    const { view, camera } = cameraOf(table.table("camera", keysOf("Camera")), width / height, objects);
    const effects = Object.entries(checked.EFFECTS).map(([key, { of, check }]) => [
        key,
        table.read(key, () => check(table.table(key, keysOf(of)).values as never)),
    ]);
    return {
        objects,
        camera,
        lights: table.has("lights")
            ? table.list("lights").map((each, index) => lightOf(each, `lights[${index}]`))
            : [keyLight(view)],
        background: table.has("background") ? backgroundOf(table) : checked.STAGED_BACKGROUND,
        ...read("Scene", table),
        ...(Object.fromEntries(effects) as Pick<given.Scene, keyof typeof checked.EFFECTS>),
        width,
        height,
    };
}

/** The arrays of colours in a text; a quote inside of a string has a backslash before it. */
const COLORS = new RegExp(`"(?:${[...COLOR_KEYS].join("|")})"\\s*:\\s*\\[([^\\]"{}[]*)\\]`, "g");

/** Return the value of the JSON of a scene file. */
export function parseJson(text: string): unknown {
    const whole = text.replace(COLORS, (found, content: string) => {
        const levels = content.split(",").map(Number);
        const areFractions = /[.eE]/.test(content) && levels.every((level) => level >= 0 && level <= 1);
        return areFractions ? found.replace(content, levels.map((level) => rint(255 * level)).join(", ")) : found;
    });
    try {
        return JSON.parse(whole) as unknown;
    } catch (error) {
        throw new InputError(`the scene is not valid JSON: ${(error as Error).message.replace(/\s+/g, " ")}`);
    }
}

function sizeOf(size: unknown): [number, number] {
    const { limits, default: usual } = FIELDS.Scene.width;
    const sides: unknown[] = Array.isArray(size) ? size : [size ?? usual, size ?? usual];
    if (sides.length !== 2) {
        throw new InputError(`size must be a number of pixels, or width and height, not ${show(size)}`);
    }
    return [check.whole(sides[0], "size", ...limits), check.whole(sides[1], "size", ...limits)];
}

function backgroundOf(table: Table): given.Background | given.Color {
    const value = table.get("background");
    if (typeof value !== "object" || Array.isArray(value)) return check.color(value, "background");
    return read("Background", table.table("background", keysOf("Background")));
}

function cameraOf(
    keys: Table,
    aspect: number,
    objects: given.SceneObject[],
): { view: Viewpoint; camera: given.Camera } {
    const { azimuth, elevation, margin, fov, eye, target, up, ...own } = read("Camera", keys);
    const projection = own.projection ?? "perspective";
    const orthographic = projection === "orthographic";
    exclude(keys, ["fov"], ["half_height"]);
    exclude(keys, ANGLES, PLACES);
    if (keys.has("eye") !== keys.has("target") || (keys.has("up") && !keys.has("eye"))) {
        throw new InputError("camera must have an eye and a target, or neither; with neither it has no up");
    }
    if (orthographic && keys.has("fov")) {
        throw new InputError("camera.fov is for the perspective projection; the orthographic one has half_height");
    }
    const halfHeight = fov === undefined ? own.halfHeight : halfHeightOf(fov);
    const view = {
        azimuth: azimuth ?? VIEW.azimuth,
        elevation: elevation ?? VIEW.elevation,
        margin: margin ?? VIEW.margin,
        projection,
        halfHeight: orthographic || halfHeight === undefined ? VIEW.halfHeight : halfHeight,
        aspect,
    };
    let camera: given.Camera;
    if (keys.has("eye")) {
        if (orthographic && halfHeight === undefined) {
            throw new InputError("camera needs a half_height, in world units: it is orthographic and has an eye");
        }
        camera = { eye, target, up, projection };
    } else {
        const points = checked.worldPositions(
            objects.map((each, index) => checked.checkedObject(each, `objects[${index}]`)),
        );
        camera = about("camera", () => frame(objects.length ? points : new Float64Array(3), view));
    }
    const whole = { ...camera, halfHeight: halfHeight ?? camera.halfHeight, near: own.near };
    checked.checkedCamera(whole);
    return { view, camera: whole };
}

/** Refuse keys of which one is of the first and one of the second list. */
function exclude(keys: Table, ...lists: [readonly string[], readonly string[]]): void {
    const [one, other] = lists.map((list) => list.find((key) => keys.has(key)));
    if (one === undefined || other === undefined) return;
    throw new InputError(`${keys.place(one)} and ${keys.place(other)} exclude each other: give one of them`);
}

function lightOf(value: unknown, where: string): given.Light {
    const keys = new Table(value, where, keysOf("SpotLight"));
    const kind = check.choice(keys.get("kind"), keys.place("kind"), LIGHT_KINDS);
    const name = LIGHTS[kind];
    for (const [key, { needed }] of Object.entries<Field>(FIELDS.SpotLight)) {
        const isKnown = key in FIELDS[name];
        if (needed && isKnown && !keys.has(key))
            throw new InputError(`${where} must have a ${key}, as its kind is ${kind}`);
        if (!isKnown && keys.has(snake(key)))
            throw new InputError(`${where} must have no ${snake(key)}, as its kind is ${kind}`);
    }
    return read(name, keys) as given.Light;
}

function objectOf(value: unknown, where: string, find: FindMesh): given.SceneObject {
    const keys = new Table(value, where, OBJECT);
    const { color, crease, ...fields } = read("SceneObject", keys);
    const own = keys.table("material", keysOf("Material"));
    const material: given.Material = read("Material", own);
    if (own.has("texture")) material.texture = textureOf(own);
    const found = isInside(keys) ? { mesh: meshOf(keys) } : find(keys.get("mesh"), keys.place("mesh"));
    if (found.texture && !own.has("texture")) material.texture = found.texture;
    let { mesh } = found;
    if (crease !== undefined && material.shading === "smooth") {
        const shaded = shadedMesh(checked.checkedMesh(mesh, keys.place("mesh")), crease);
        [mesh, material.shading] = [shaded.mesh, shaded.shading];
    }
    if (color) [mesh, material.texture] = [{ ...mesh, colors: color }, undefined];
    return { ...fields, mesh, rotation: rotationOf(keys), material };
}

/** Return whether the mesh of an object is in the file. */
function isInside(keys: Table): boolean {
    const mesh = keys.get("mesh");
    return typeof mesh === "object" && mesh !== null && !("piece" in mesh) && !("file" in mesh);
}

function findNone(_: unknown, where: string): never {
    throw new InputError(`${where} must be a table with positions and faces: no files are read here`);
}

function textureOf(material: Table): given.Texture {
    const place = material.place("texture");
    const keys = typeof material.get("texture") === "string" ? undefined : material.table("texture", keysOf("Texture"));
    const pixels = keys?.get("pixels");
    if (keys === undefined || typeof pixels !== "string") {
        throw new InputError(`${place} must have width, height and pixels, in base64: no files are read here`);
    }
    return {
        ...(read("Texture", keys) as Plain["Texture"]),
        pixels: levelsOf(pixels, `${place}.pixels must be red, green and blue bytes in base64`),
        alpha: keys.read("alpha", (value, where) => levelsOf(String(value), `${where} must be bytes in base64`)),
    };
}

function levelsOf(base64: string, error: string): Uint8Array {
    const bytes = fromBase64(base64);
    if (bytes) return bytes;
    throw new InputError(error);
}

function meshOf(keys: Table): given.Mesh {
    const inside = keys.table("mesh", keysOf("Mesh"));
    return {
        positions: inside.rows("positions"),
        faces: inside.rows("faces"),
        colors: inside.has("colors") ? colorsOf(inside) : undefined,
        normals: inside.has("normals") ? inside.rows("normals") : undefined,
        uvs: inside.has("uvs") ? (inside.list("uvs") as number[][]) : undefined,
        opacities: inside.has("opacities") ? (inside.list("opacities") as number[]) : undefined,
    };
}

function colorsOf(mesh: Table): number[][] {
    const rows = mesh.list("colors");
    const width = Array.isArray(rows[0]) && rows[0].length === 4 ? 4 : 3;
    return rows.map((row, index) => check.numbers(row, `${mesh.place("colors")}[${index}]`, width));
}

function rotationOf(keys: Table): given.Rotation | undefined {
    const value = keys.get("rotation");
    if (typeof value !== "object" || value === null || Array.isArray(value)) return keys.read("rotation", check.vector);
    const inside = keys.table("rotation", ["quaternion", "axis", "angle"]);
    exclude(inside, ["quaternion"], ["axis", "angle"]);
    const [axis, angle] = [inside.read("axis", check.vector), inside.number("angle")];
    if (axis && angle !== undefined) {
        if (!axis.some((x) => x)) throw new InputError(`${inside.place("axis")} must not be zero`);
        return fromAxisAngle(axis, angle);
    }
    const quaternion = inside.read("quaternion", check.quaternion);
    if (quaternion) return quaternion;
    throw new InputError(`${inside.where} must have a quaternion, or an axis and an angle in degrees`);
}
