// Scene files: docs/scene-files.md documents the keys and their defaults.

import { InputError, about, show } from "../errors.js";
import { fromBase64 } from "../bytes.js";
import { fromAxisAngle, rint, type Vector } from "./arithmetic.js";
import * as checked from "./checked.js";
import * as check from "./checks.js";
import { PROJECTIONS, VIEW, frame, halfHeightOf, keyLight, type Viewpoint } from "./staging.js";
import { shadedMesh } from "./normals.js";
import { isOriginal, originalScene } from "./original.js";
import { Table, snake } from "./table.js";
import type * as given from "./types.js";

const SCENE = [...checked.SCENE.filter((key) => key !== "width" && key !== "height").map(snake), "size", "creator"];
const PLACES = ["eye", "target", "up"] as const;
const ANGLES = ["azimuth", "elevation", "margin"] as const;
const CAMERA = [...PLACES, ...ANGLES, "fov", "half_height", "near", "projection"];
const LIGHT = ["kind", "direction", "position", "color", "inner_angle", "outer_angle", "shadow"];
const OBJECT = [...checked.OBJECT.map(snake), "color", "crease"];
const TEXTURE = ["image", ...checked.TEXTURE];

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
    const table = new Table(document, "", SCENE);
    const [width, height] = sizeOf(table.get("size"));
    const objects = table.list("objects").map((each, index) => objectOf(each, `objects[${index}]`, find));
    const { view, camera } = cameraOf(table.table("camera", CAMERA), width / height, objects);
    const effects = Object.entries(checked.EFFECTS).map(([key, { known, check }]) => [
        key,
        table.has(key) ? check(table.table(key, known).values as never) : undefined,
    ]);
    return {
        objects,
        camera,
        lights: table.has("lights")
            ? table.list("lights").map((each, index) => lightOf(each, `lights[${index}]`))
            : [keyLight(view)],
        background: table.has("background") ? backgroundOf(table) : checked.STAGED_BACKGROUND,
        ambientLight: table.read("ambient_light", check.color),
        invert: table.read("invert", check.flag),
        antialias: table.read("antialias", check.flag),
        ...(Object.fromEntries(effects) as Pick<given.Scene, keyof typeof checked.EFFECTS>),
        width,
        height,
    };
}

/** The arrays of colours in a text; a quote inside of a string has a backslash before it. */
const COLORS = /"(?:color|background|top|bottom|ambient_light|sky|ground)"\s*:\s*\[([^\]"{}[]*)\]/g;

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
    if (size === undefined) return [checked.DEFAULT_SIDE, checked.DEFAULT_SIDE];
    const sides: unknown[] = Array.isArray(size) ? size : [size, size];
    if (sides.length !== 2) {
        throw new InputError(`size must be a number of pixels, or width and height, not ${show(size)}`);
    }
    return [check.whole(sides[0], "size", 1, checked.MAX_SIDE), check.whole(sides[1], "size", 1, checked.MAX_SIDE)];
}

function backgroundOf(table: Table): given.Background | given.Color {
    const value = table.get("background");
    if (typeof value !== "object" || Array.isArray(value)) return check.color(value, "background");
    const inside = table.table("background", ["top", "bottom"]);
    return { top: inside.read("top", check.color), bottom: inside.read("bottom", check.color) };
}

function cameraOf(
    keys: Table,
    aspect: number,
    objects: given.SceneObject[],
): { view: Viewpoint; camera: given.Camera } {
    const projection =
        keys.read("projection", (value, where) => check.choice(value, where, PROJECTIONS)) ?? "perspective";
    const orthographic = projection === "orthographic";
    exclude(keys, ["fov"], ["half_height"]);
    exclude(keys, ANGLES, PLACES);
    if (keys.has("eye") !== keys.has("target") || (keys.has("up") && !keys.has("eye"))) {
        throw new InputError("camera must have an eye and a target, or neither; with neither it has no up");
    }
    if (orthographic && keys.has("fov")) {
        throw new InputError("camera.fov is for the perspective projection; the orthographic one has half_height");
    }
    const fov = keys.number("fov", 0.2, 179.8);
    const halfHeight = fov === undefined ? keys.number("half_height", 0) : halfHeightOf(fov);
    const view = {
        azimuth: keys.number("azimuth") ?? VIEW.azimuth,
        elevation: keys.number("elevation", -90, 90) ?? VIEW.elevation,
        margin: keys.number("margin", 0, 0.9) ?? VIEW.margin,
        projection,
        halfHeight: orthographic || halfHeight === undefined ? VIEW.halfHeight : halfHeight,
        aspect,
    };
    let camera: given.Camera;
    if (keys.has("eye")) {
        if (orthographic && halfHeight === undefined) {
            throw new InputError("camera needs a half_height, in world units: it is orthographic and has an eye");
        }
        const [eye, target, up] = PLACES.map((key) => keys.read(key, check.vector));
        camera = { eye, target, up, projection };
    } else {
        const points = checked.worldPositions(
            objects.map((each, index) => checked.checkedObject(each, `objects[${index}]`)),
        );
        camera = about("camera", () => frame(objects.length ? points : new Float64Array(3), view));
    }
    const whole = { ...camera, halfHeight: halfHeight ?? camera.halfHeight, near: keys.number("near") };
    checked.checkedCamera(whole);
    return { view, camera: whole };
}

/** Refuse keys of which one is of the first and one of the second list. */
function exclude(keys: Table, ...lists: [readonly string[], readonly string[]]): void {
    const [one, other] = lists.map((list) => list.find((key) => keys.has(key)));
    if (one === undefined || other === undefined) return;
    throw new InputError(`${keys.place(one)} and ${keys.place(other)} exclude each other: give one of them`);
}

/** The keys of a light that it must have, and those that it may. */
const LIGHT_KEYS = {
    directional: [["direction"], []],
    point: [["position"], []],
    spot: [
        ["position", "direction"],
        ["inner_angle", "outer_angle"],
    ],
} as const satisfies Record<given.Light["kind"], readonly [readonly string[], readonly string[]]>;

function lightOf(value: unknown, where: string): given.Light {
    const keys = new Table(value, where, LIGHT);
    const kind = check.choice(keys.get("kind"), keys.place("kind"), checked.LIGHT_KINDS);
    const [needed, optional]: readonly [readonly string[], readonly string[]] = LIGHT_KEYS[kind];
    for (const key of ["position", "direction", "inner_angle", "outer_angle"]) {
        if (needed.includes(key) && !keys.has(key))
            throw new InputError(`${where} must have a ${key}, as its kind is ${kind}`);
        if (keys.has(key) && ![...needed, ...optional].includes(key)) {
            throw new InputError(`${where} must have no ${key}, as its kind is ${kind}`);
        }
    }
    const color = keys.read("color", check.color);
    const [position, direction] = ["position", "direction"].map((key) => keys.read(key, check.vector)) as [
        Vector,
        Vector,
    ];
    const shadow = keys.read("shadow", check.flag);
    if (kind === "directional") return { kind, direction, color, shadow };
    if (kind === "point") return { kind, position, color, shadow };
    const [innerAngle, outerAngle] = ["inner_angle", "outer_angle"].map((key) => keys.number(key, 0, 180));
    return { kind, position, direction, color, innerAngle, outerAngle, shadow };
}

function objectOf(value: unknown, where: string, find: FindMesh): given.SceneObject {
    const keys = new Table(value, where, OBJECT);
    const color = keys.read("color", check.color);
    const own = keys.table("material", checked.MATERIAL);
    const material = materialOf(own);
    const found = isInside(keys) ? { mesh: meshOf(keys) } : find(keys.get("mesh"), keys.place("mesh"));
    if (found.texture && !own.has("texture")) material.texture = found.texture;
    let { mesh } = found;
    const crease = keys.number("crease", 0, 180);
    if (crease !== undefined && material.shading === "smooth") {
        const shaded = shadedMesh(checked.checkedMesh(mesh, keys.place("mesh")), crease);
        [mesh, material.shading] = [shaded.mesh, shaded.shading];
    }
    if (color) [mesh, material.texture] = [{ ...mesh, colors: color }, undefined];
    return {
        mesh,
        position: keys.read("position", check.vector),
        rotation: rotationOf(keys),
        scale: keys.number("scale", 0),
        material,
        cull: keys.read("cull", check.flag),
        wireframe: keys.read("wireframe", check.flag),
        twoSided: keys.read("two_sided", check.flag),
        opacity: keys.number("opacity", 0, 1),
        fade: keys.get("fade") as [number, number] | undefined,
    };
}

/** Return whether the mesh of an object is in the file. */
function isInside(keys: Table): boolean {
    const mesh = keys.get("mesh");
    return typeof mesh === "object" && mesh !== null && !("piece" in mesh) && !("file" in mesh);
}

function findNone(_: unknown, where: string): never {
    throw new InputError(`${where} must be a table with positions and faces: no files are read here`);
}

function materialOf(keys: Table): given.Material {
    return {
        shading: keys.read("shading", (value, where) => check.choice(value, where, checked.SHADINGS)),
        ambient: keys.number("ambient", 0, 4),
        diffuse: keys.number("diffuse", 0, 4),
        specular: keys.number("specular", 0, 4),
        shininess: keys.number("shininess", 1, 128),
        texture: keys.has("texture") ? textureOf(keys) : undefined,
        emission: keys.read("emission", check.color),
    };
}

function textureOf(material: Table): given.Texture {
    const place = material.place("texture");
    const keys = typeof material.get("texture") === "string" ? undefined : material.table("texture", TEXTURE);
    const pixels = keys?.get("pixels");
    if (keys === undefined || typeof pixels !== "string") {
        throw new InputError(`${place} must have width, height and pixels, in base64: no files are read here`);
    }
    return {
        width: check.whole(keys.get("width"), keys.place("width"), 1, 256),
        height: check.whole(keys.get("height"), keys.place("height"), 1, 256),
        pixels: levelsOf(pixels, `${place}.pixels must be red, green and blue bytes in base64`),
        filter: keys.read("filter", (value, where) => check.choice(value, where, checked.FILTERS)),
        wrap: keys.read("wrap", (value, where) => check.choice(value, where, checked.WRAPS)),
        alpha: keys.read("alpha", (value, where) => levelsOf(String(value), `${where} must be bytes in base64`)),
        cutoff: keys.read("cutoff", (value, where) => check.whole(value, where, 0, 255)),
    };
}

function levelsOf(base64: string, error: string): Uint8Array {
    const bytes = fromBase64(base64);
    if (bytes) return bytes;
    throw new InputError(error);
}

function meshOf(keys: Table): given.Mesh {
    const inside = keys.table("mesh", checked.MESH);
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
