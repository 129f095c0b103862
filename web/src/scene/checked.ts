// Scenes whose values are checked, converted and complete, with the defaults of docs/scene-files.md.

import { InputError, show } from "../errors.js";
import { boundsOf, fromEuler, rint, times, unit, type Quaternion, type Vector } from "./arithmetic.js";
import * as check from "./checks.js";
import type { Rgb } from "./checks.js";
import { LARGEST, MAX_LIGHTS } from "./constants.js";
import { FIELDS, LIGHT_KINDS, type Plain } from "./fields.js";
import { checkedOnce, remembered } from "./memory.js";
import { namesOf, plain } from "./plain.js";
import { VIEW, frame, keyLight } from "./staging.js";
import type * as given from "./types.js";

export const STAGED_BACKGROUND = { top: [46, 54, 72], bottom: [136, 146, 162] } as const;
const DEFAULT_COLOR: Rgb = [200, 200, 200];

/** The plain fields of a class. */
type Own<Name extends keyof Plain> = Plain[Name];

/**
 * Positions and normals have three numbers for each vertex, colours three bytes, uvs two numbers, opacities a multiple of
 * 1/255, of which one at least is below 1; faces three vertex numbers each. Nobody changes them.
 */
export interface Mesh {
    positions: Float64Array;
    faces: Uint32Array;
    colors: Uint8Array;
    normals: Float64Array | undefined;
    uvs: Float64Array | undefined;
    opacities: Float64Array | undefined;
}

/** `pixels` has three bytes for each texel, `alpha` one. */
export interface Texture extends Own<"Texture"> {
    pixels: Uint8Array;
    alpha: Uint8Array | undefined;
}

export interface Material extends Own<"Material"> {
    texture: Texture | undefined;
}

export interface SceneObject extends Own<"SceneObject"> {
    mesh: Mesh;
    rotation: Quaternion;
    material: Material;
}

/** `vector` is the direction toward a directional light, the position of any other; `cone` that of a spot light. */
export interface Light {
    kind: given.Light["kind"];
    vector: Vector;
    color: Rgb;
    cone: { direction: Vector; innerAngle: number; outerAngle: number } | undefined;
    shadow: boolean;
}

export type Camera = Own<"Camera">;
export type Fog = Own<"Fog">;
export type Ground = Own<"Ground">;

export interface Scene extends Own<"Scene"> {
    objects: SceneObject[];
    camera: Camera;
    lights: Light[];
    background: { top: Rgb; bottom: Rgb };
    hemisphere: Own<"Hemisphere"> | undefined;
    rim: Own<"Rim"> | undefined;
    fog: Fog | undefined;
    tone: Own<"Tone"> | undefined;
    ground: Ground | undefined;
}

/** Return the scene with all its values. InputError for one that is wrong, with its place. */
export function checkedScene(scene: given.Scene): Scene {
    const own = plain("Scene", scene, "");
    if (!Array.isArray(scene.objects)) throw new InputError(`objects must be a list, not ${show(scene.objects)}`);
    const objects = scene.objects.map((each: given.SceneObject, index) => checkedObject(each, `objects[${index}]`));
    let { camera, lights, background } = scene;
    if (objects.length && camera === undefined && lights === undefined && background === undefined) {
        camera = stagedCamera(worldPositions(objects), own.width / own.height);
        lights = [keyLight(VIEW)];
        background = STAGED_BACKGROUND;
    }
    return {
        objects,
        camera: checkedCamera(camera ?? {}),
        lights: checkedLights(lights ?? []),
        background: checkedBackground(background ?? {}),
        ...own,
        hemisphere: scene.hemisphere && EFFECTS.hemisphere.check(scene.hemisphere),
        rim: scene.rim && EFFECTS.rim.check(scene.rim),
        fog: scene.fog && EFFECTS.fog.check(scene.fog),
        tone: scene.tone && EFFECTS.tone.check(scene.tone),
        ground: scene.ground && EFFECTS.ground.check(scene.ground),
    };
}

export function checkedObject(object: given.SceneObject, where: string): SceneObject {
    const own = plain("SceneObject", object, where);
    const mesh = checkedMesh(object.mesh, `${where}.mesh`);
    const material = checkedMaterial(object.material ?? {}, `${where}.material`);
    if (material.texture && !mesh.uvs) {
        throw new InputError(`${where}.mesh needs uvs, as its material has a texture`);
    }
    const [inner, outer] = own.fade ?? [0, 1];
    if (!(0 <= inner && inner < outer)) {
        throw new InputError(`the distances of ${where}.fade must be 0 <= first < second, not ${inner} and ${outer}`);
    }
    const rotation = checkedRotation(object.rotation ?? FIELDS.SceneObject.rotation.default, `${where}.rotation`);
    return { mesh, rotation, material, ...own };
}

function checkedRotation(value: given.Rotation, where: string): Quaternion {
    return value.length === 3 ? fromEuler(check.vector(value, where)) : check.quaternion(value, where);
}

function checkedMaterial(material: given.Material, where: string): Material {
    const own = plain("Material", material, where);
    return { ...own, texture: material.texture && checkedTexture(material.texture, `${where}.texture`) };
}

const checkedTexture = checkedOnce((texture: given.Texture, where: string): Texture => {
    const own = plain("Texture", texture, where);
    const { pixels } = texture;
    const count = own.width * own.height;
    const channels = check.isList(pixels) ? pixels.length / count : 0;
    if (channels !== 3 && channels !== 4) {
        throw new InputError(`${where}.pixels must be three or four bytes for each of ${count} texels`);
    }
    checkLevels(pixels, `${where}.pixels`);
    const { alpha } = texture;
    if (alpha !== undefined) {
        if (!check.isList(alpha) || alpha.length !== count) {
            throw new InputError(`${where}.alpha must be a byte for each of ${count} texels`);
        }
        checkLevels(alpha, `${where}.alpha`);
    }
    const level = (_: unknown, at: number): number => pixels[channels * Math.floor(at / 3) + (at % 3)];
    return {
        ...own,
        pixels: Uint8Array.from({ length: 3 * count }, level),
        alpha: alpha && Uint8Array.from(alpha),
    };
});

function checkLevels(levels: ArrayLike<number>, where: string): void {
    const bad = Array.prototype.findIndex.call(levels, (level: unknown) => !check.isLevel(level as number));
    if (bad >= 0)
        throw new InputError(`${where}[${bad}] must be a whole number from 0 to 255, not ${show(levels[bad])}`);
}

/** Return the mesh with all its tables, each of one type. It is the same one each time, and may share tables. */
export const checkedMesh = checkedOnce((mesh: given.Mesh, where: string): Mesh => {
    check.fields(mesh, where, namesOf("Mesh") as (keyof given.Mesh)[]);
    const positions = rows(mesh.positions, `${where}.positions`);
    const faces = rows(mesh.faces, `${where}.faces`);
    const [count, faceCount] = [positions.length / 3, faces.length / 3];
    if (!count || !faceCount) {
        throw new InputError(`${where} needs vertices and faces; this one has ${count} and ${faceCount}`);
    }
    const bad = faces.findIndex((vertex) => !(Number.isInteger(vertex) && vertex >= 0 && vertex < count));
    if (bad >= 0) {
        const face = Math.floor(bad / 3);
        throw new InputError(
            `${where}.faces[${face}] names the vertex ${faces[bad]}, but vertices are numbered 0 to ${count - 1}`,
        );
    }
    const normals = mesh.normals === undefined ? undefined : rows(mesh.normals, `${where}.normals`);
    if (normals && normals.length !== positions.length) {
        throw new InputError(`${where}.normals must be one for each of ${count} vertices, not ${normals.length / 3}`);
    }
    const { colors, alpha } = colorsOf(mesh.colors, count, `${where}.colors`);
    const opacities = mesh.opacities && opacitiesOf(mesh.opacities, count, `${where}.opacities`);
    if (alpha && opacities) {
        throw new InputError(`${where} must have opacities, or colors with an alpha below 255, not both`);
    }
    return {
        positions,
        faces: mesh.faces instanceof Uint32Array ? mesh.faces : Uint32Array.from(faces),
        colors,
        normals,
        uvs: mesh.uvs && uvsOf(mesh.uvs, count, `${where}.uvs`),
        opacities: opacities ?? alpha,
    };
});

/** Return a multiple of 1/255 for each vertex, or undefined where all are opaque. */
function opacitiesOf(value: ArrayLike<number>, count: number, where: string): Float64Array | undefined {
    if (!check.isList(value)) throw new InputError(`${where} must be a list of numbers, not ${show(value)}`);
    const levels = Array.from(value, (each, index) => rint(255 * check.number(each, `${where}[${index}]`, 0, 1)));
    if (levels.length !== count) {
        throw new InputError(`${where} must be one for each of ${count} vertices, not ${levels.length}`);
    }
    return unlessOpaque(levels);
}

function unlessOpaque(levels: number[]): Float64Array | undefined {
    return levels.every((level) => level === 255) ? undefined : Float64Array.from(levels, (level) => level / 255);
}

function uvsOf(value: NonNullable<given.Mesh["uvs"]>, count: number, where: string): Float64Array {
    if (!check.isList(value)) throw new InputError(`${where} must be rows of two numbers, not ${show(value)}`);
    const flat = Array.from<unknown>(value).flatMap((row) => (check.isList(row) ? Array.from(row) : [row]));
    const bad = flat.findIndex((x) => !Number.isFinite(x));
    if (bad >= 0) {
        throw new InputError(`${where}[${Math.floor(bad / 2)}] must be two finite numbers, not ${show(flat[bad])}`);
    }
    if (flat.length !== 2 * count) {
        throw new InputError(`${where} must be two numbers for each of ${count} vertices, not ${flat.length} in all`);
    }
    return Float64Array.from(flat as number[]);
}

interface Painted {
    colors: Uint8Array;
    /** As the opacities of a mesh. */
    alpha: Float64Array | undefined;
}

function colorsOf(value: given.Rows | given.Color | undefined, count: number, where: string): Painted {
    const isOne =
        typeof value === "string" || (check.isList(value) && value.length === 3 && typeof value[0] === "number");
    if (value === undefined || (isOne && count !== 1)) {
        const one = value === undefined ? [...DEFAULT_COLOR, 255] : check.rgba(value, where);
        const colors = Uint8Array.from({ length: 3 * count }, (_, at) => one[at % 3]);
        return { colors, alpha: unlessOpaque(Array.from({ length: count }, () => one[3])) };
    }
    const width = check.isList(value) && check.isList(value[0]) && value[0].length === 4 ? 4 : 3;
    const levels = rows(value as given.Rows, where, width);
    if (levels.length !== width * count) {
        throw new InputError(`${where} must be one for each of ${count} vertices, not ${levels.length / width}`);
    }
    const bad = levels.findIndex((level) => !check.isLevel(level));
    if (bad >= 0) {
        throw new InputError(
            `${where}[${Math.floor(bad / width)}] must be whole numbers from 0 to 255, not ${levels[bad]}`,
        );
    }
    if (width === 3) {
        return { colors: value instanceof Uint8Array ? value : Uint8Array.from(levels), alpha: undefined };
    }
    const [colors, alpha] = [levels.filter((_, at) => at % 4 < 3), levels.filter((_, at) => at % 4 === 3)];
    return { colors: Uint8Array.from(colors), alpha: unlessOpaque(Array.from(alpha)) };
}

/** Return rows of three finite numbers, or of `width`, one after the other. */
function rows(value: given.Rows, where: string, width: 3 | 4 = 3): Float64Array {
    if (!check.isList(value)) throw new InputError(`${where} must be rows of three numbers, not ${show(value)}`);
    let flat: Float64Array;
    if (value.length && typeof value[0] !== "number") {
        flat = new Float64Array(width * value.length);
        for (let index = 0; index < value.length; index++) {
            flat.set(check.numbers(value[index], `${where}[${index}]`, width), width * index);
        }
        return flat;
    }
    flat = value instanceof Float64Array ? value : Float64Array.from(value as ArrayLike<number>);
    if (flat.length % 3) throw new InputError(`${where} must be rows of three numbers, not ${flat.length} in all`);
    const bad = flat.findIndex((x) => !Number.isFinite(x));
    if (bad < 0) return flat;
    throw new InputError(`${where}[${Math.floor(bad / 3)}] must be three finite numbers, not ${show(value[bad])}`);
}

export function checkedCamera(camera: given.Camera): Camera {
    const own = plain("Camera", camera, "camera");
    const perspective = own.projection === "perspective";
    const [low, high] = perspective ? [2 ** -10, 2 ** 10] : [1e-30, 1e30];
    check.number(own.halfHeight, "camera.halfHeight", low, high);
    if (perspective && own.near !== undefined && own.near <= 0) {
        throw new InputError(`camera.near must be above 0 for a perspective camera, not ${own.near}`);
    }
    return own;
}

function checkedLights(lights: readonly given.Light[]): Light[] {
    if (!Array.isArray(lights)) throw new InputError(`lights must be a list, not ${show(lights)}`);
    if (lights.length > MAX_LIGHTS) throw new InputError(`lights must be up to ${MAX_LIGHTS}, not ${lights.length}`);
    const found = lights.map((light: given.Light, index) => checkedLight(light, `lights[${index}]`));
    if (found.filter((light) => light.shadow).length < 2) return found;
    throw new InputError("one of the lights may cast shadows, not several");
}

function checkedLight(light: given.Light, where: string): Light {
    const kind = check.choice((light as given.Light | null)?.kind, `${where}.kind`, LIGHT_KINDS);
    if (kind === "point") {
        const { position, color, shadow } = plain("PointLight", light, where);
        return { kind, vector: position, color, cone: undefined, shadow };
    }
    if (kind === "directional") {
        const { direction, color, shadow } = plain("DirectionalLight", light, where);
        return { kind, vector: nonzero(direction, `${where}.direction`), color, cone: undefined, shadow };
    }
    const { position, direction, color, innerAngle, outerAngle, shadow } = plain("SpotLight", light, where);
    nonzero(direction, `${where}.direction`);
    if (innerAngle > outerAngle) {
        throw new InputError(`${where}.innerAngle, ${innerAngle}, must not be above its outerAngle, ${outerAngle}`);
    }
    return { kind, vector: position, color, cone: { direction, innerAngle, outerAngle }, shadow };
}

function nonzero(value: Vector, where: string): Vector {
    if (value.some((x) => x)) return value;
    throw new InputError(`${where} must not be zero`);
}

function checkedBackground(value: given.Background | given.Color): { top: Rgb; bottom: Rgb } {
    const own = typeof value === "string" || check.isList(value) ? { top: value as given.Color } : value;
    const { top, bottom } = plain("Background", own as given.Background, "background");
    return { top, bottom: bottom ?? top };
}

function checkedFog(value: given.Fog): Fog {
    const fog = plain("Fog", value, "fog");
    if (fog.near < fog.far) return fog;
    throw new InputError(`fog.near, ${fog.near}, must be below fog.far, ${fog.far}`);
}

function checkedGround(value: given.Ground): Ground {
    const ground = plain("Ground", value, "ground");
    if (ground.radius === 0) throw new InputError("ground.radius must be above 0");
    if (ground.radius !== undefined && ground.inner !== undefined) checkInner(ground.inner, ground.radius);
    return ground;
}

/** Check the inner radius of a ground against its radius. */
export function checkInner(inner: number, radius: number): void {
    if (inner < radius) return;
    throw new InputError(`ground.inner, ${inner}, must be below the radius of the ground, ${radius}`);
}

/** What a scene may have besides, by its keys: the class of each, and what checks it. */
export const EFFECTS = {
    hemisphere: { of: "Hemisphere", check: (value: given.Hemisphere) => plain("Hemisphere", value, "hemisphere") },
    rim: { of: "Rim", check: (value: given.Rim) => plain("Rim", value, "rim") },
    fog: { of: "Fog", check: checkedFog },
    tone: { of: "Tone", check: (value: given.Tone) => plain("Tone", value, "tone") },
    ground: { of: "Ground", check: checkedGround },
} as const;

/** A mesh in the world. */
type Placed = Pick<SceneObject, "mesh" | "position" | "rotation" | "scale">;

/** Return the least and the largest of each coordinate of the vertices of objects in the world. */
export function worldBounds(objects: readonly Placed[]): [Vector, Vector] {
    const all = objects.map(({ mesh, position, rotation, scale }) =>
        placedBounds(mesh, JSON.stringify({ position, rotation, scale })),
    );
    return boundsOf(Float64Array.from(all.flat(2)));
}

const placedBounds = remembered((mesh: Mesh, place: string) =>
    boundsOf(worldPositions([{ mesh, ...(JSON.parse(place) as Omit<Placed, "mesh">) }])),
);

/** Return the vertices of objects in the world, three numbers each. */
export function worldPositions(objects: readonly Placed[]): Float64Array {
    const found = new Float64Array(objects.reduce((sum, { mesh }) => sum + mesh.positions.length, 0));
    let at = 0;
    for (const { mesh, position, scale, rotation } of objects) {
        // `rotation` of arithmetic.ts without its vectors
        const [a, b, c, w] = unit(rotation);
        for (let vertex = 0; vertex < mesh.positions.length; vertex += 3) {
            const x = scale * mesh.positions[vertex];
            const y = scale * mesh.positions[vertex + 1];
            const z = scale * mesh.positions[vertex + 2];
            const t = 2 * (b * z - c * y);
            const u = 2 * (c * x - a * z);
            const v = 2 * (a * y - b * x);
            found[at++] = position[0] + (x + w * t + (b * v - c * u));
            found[at++] = position[1] + (y + w * u + (c * t - a * v));
            found[at++] = position[2] + (z + w * v + (a * u - b * t));
        }
    }
    return found;
}

function stagedCamera(points: Float64Array, aspect: number): given.Camera {
    // of any size: squares of its lengths stay within floats
    let size = points.reduce((most, x) => Math.max(most, Math.abs(x)), 0);
    if (!(size < LARGEST))
        throw new InputError("the coordinates of the objects are too large for a camera to be placed");
    size ||= 1;
    const shape = points.map((x) => x / size);
    const camera = frame(shape, { ...VIEW, aspect });
    return { ...camera, eye: times(size, camera.eye), target: times(size, camera.target) };
}
