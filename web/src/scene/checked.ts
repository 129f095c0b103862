// Scenes whose values are checked, converted and complete, with the defaults of docs/scene-files.md.

import { InputError, show } from "../errors.js";
import { boundsOf, fromEuler, rint, times, unit, type Quaternion, type Vector } from "./arithmetic.js";
import * as check from "./checks.js";
import type { Rgb } from "./checks.js";
import { checkedOnce, remembered } from "./memory.js";
import { PROJECTIONS, VIEW, frame, keyLight } from "./staging.js";
import type * as given from "./types.js";

export const MAX_SIDE = 2048;
export const MAX_LIGHTS = 4;
/** Width and height of a picture where none are given. */
export const DEFAULT_SIDE = 128;
/** Objects of staged scenes lie within. */
const LARGEST = 1e305;

export const WHITE: Rgb = [255, 255, 255];
export const STAGED_BACKGROUND = { top: [46, 54, 72], bottom: [136, 146, 162] } as const;
const DEFAULT_COLOR: Rgb = [200, 200, 200];
export const SHADINGS = ["unlit", "flat", "smooth"] as const;
export const LIGHT_KINDS = ["directional", "point", "spot"] as const;

export const SCENE = [
    "objects",
    "camera",
    "lights",
    "background",
    "ambientLight",
    "invert",
    "antialias",
    "hemisphere",
    "rim",
    "fog",
    "tone",
    "ground",
    "width",
    "height",
] as const;
const CAMERA = ["eye", "target", "up", "projection", "halfHeight", "near"] as const;
const BACKGROUND = ["top", "bottom"] as const;
const HEMISPHERE = ["sky", "ground"] as const;
const RIM = ["color", "power"] as const;
const FOG = ["color", "near", "far"] as const;
const TONE = ["exposure", "filmic", "gamma"] as const;
const GROUND = ["color", "height", "radius", "center", "inner"] as const;
const LIGHTS = {
    directional: ["kind", "direction", "color", "shadow"],
    point: ["kind", "position", "color", "shadow"],
    spot: ["kind", "position", "direction", "color", "innerAngle", "outerAngle", "shadow"],
} as const;
export const OBJECT = [
    "mesh",
    "position",
    "rotation",
    "scale",
    "material",
    "cull",
    "wireframe",
    "twoSided",
    "opacity",
    "fade",
] as const;
export const MATERIAL = ["shading", "ambient", "diffuse", "specular", "shininess", "texture", "emission"] as const;
export const MESH = ["positions", "faces", "colors", "normals", "uvs", "opacities"] as const;
export const TEXTURE = ["width", "height", "pixels", "filter", "wrap", "alpha", "cutoff"] as const;
export const FILTERS = ["nearest", "bilinear"] as const;
export const WRAPS = ["repeat", "clamp"] as const;
const MAX_TEXTURE_SIDE = 256;

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
export interface Texture {
    width: number;
    height: number;
    pixels: Uint8Array;
    filter: (typeof FILTERS)[number];
    wrap: (typeof WRAPS)[number];
    alpha: Uint8Array | undefined;
    cutoff: number;
}

export interface Material {
    shading: given.Shading;
    ambient: number;
    diffuse: number;
    specular: number;
    shininess: number;
    texture: Texture | undefined;
    emission: Rgb;
}

export interface SceneObject {
    mesh: Mesh;
    position: Vector;
    rotation: Quaternion;
    scale: number;
    material: Material;
    cull: boolean;
    wireframe: boolean;
    twoSided: boolean;
    opacity: number;
    fade: readonly [number, number] | undefined;
}

export interface Camera {
    eye: Vector;
    target: Vector;
    up: Vector;
    projection: given.Projection;
    halfHeight: number;
    near: number | undefined;
}

/** `vector` is the direction toward a directional light, the position of any other; `cone` that of a spot light. */
export interface Light {
    kind: given.Light["kind"];
    vector: Vector;
    color: Rgb;
    cone: { direction: Vector; innerAngle: number; outerAngle: number } | undefined;
    shadow: boolean;
}

export interface Hemisphere {
    sky: Rgb;
    ground: Rgb;
}

export interface Rim {
    color: Rgb;
    power: number;
}

export interface Fog {
    color: Rgb;
    near: number;
    far: number;
}

export interface Tone {
    exposure: number;
    filmic: boolean;
    gamma: boolean;
}

export interface Ground {
    color: Rgb;
    height: number | undefined;
    radius: number | undefined;
    center: readonly [number, number] | undefined;
    inner: number | undefined;
}

export interface Scene {
    objects: SceneObject[];
    camera: Camera;
    lights: Light[];
    background: { top: Rgb; bottom: Rgb };
    ambientLight: Rgb;
    invert: boolean;
    antialias: boolean;
    hemisphere: Hemisphere | undefined;
    rim: Rim | undefined;
    fog: Fog | undefined;
    tone: Tone | undefined;
    ground: Ground | undefined;
    width: number;
    height: number;
}

/** Return the scene with all its values. InputError for one that is wrong, with its place. */
export function checkedScene(scene: given.Scene): Scene {
    check.fields(scene, "the scene", SCENE);
    const width = check.whole(scene.width ?? DEFAULT_SIDE, "width", 1, MAX_SIDE);
    const height = check.whole(scene.height ?? DEFAULT_SIDE, "height", 1, MAX_SIDE);
    if (!Array.isArray(scene.objects)) throw new InputError(`objects must be a list, not ${show(scene.objects)}`);
    const objects = scene.objects.map((each: given.SceneObject, index) => checkedObject(each, `objects[${index}]`));
    let { camera, lights, background } = scene;
    if (objects.length && camera === undefined && lights === undefined && background === undefined) {
        camera = stagedCamera(worldPositions(objects), width / height);
        lights = [keyLight(VIEW)];
        background = STAGED_BACKGROUND;
    }
    return {
        objects,
        camera: checkedCamera(camera ?? {}),
        lights: checkedLights(lights ?? []),
        background: checkedBackground(background ?? {}),
        ambientLight: check.color(scene.ambientLight ?? WHITE, "ambientLight"),
        invert: check.flag(scene.invert ?? false, "invert"),
        antialias: check.flag(scene.antialias ?? false, "antialias"),
        hemisphere: scene.hemisphere && checkedHemisphere(scene.hemisphere),
        rim: scene.rim && checkedRim(scene.rim),
        fog: scene.fog && checkedFog(scene.fog),
        tone: scene.tone && checkedTone(scene.tone),
        ground: scene.ground && checkedGround(scene.ground),
        width,
        height,
    };
}

export function checkedObject(object: given.SceneObject, where: string): SceneObject {
    check.fields(object, where, OBJECT);
    const mesh = checkedMesh(object.mesh, `${where}.mesh`);
    const material = checkedMaterial(object.material ?? {}, `${where}.material`);
    if (material.texture && !mesh.uvs) {
        throw new InputError(`${where}.mesh needs uvs, as its material has a texture`);
    }
    return {
        mesh,
        position: check.vector(object.position ?? [0, 0, 0], `${where}.position`),
        rotation: checkedRotation(object.rotation ?? [0, 0, 0, 1], `${where}.rotation`),
        scale: check.number(object.scale ?? 1, `${where}.scale`, 0),
        material,
        cull: check.flag(object.cull ?? true, `${where}.cull`),
        wireframe: check.flag(object.wireframe ?? false, `${where}.wireframe`),
        twoSided: check.flag(object.twoSided ?? false, `${where}.twoSided`),
        opacity: check.number(object.opacity ?? 1, `${where}.opacity`, 0, 1),
        fade: object.fade && checkedFade(object.fade, `${where}.fade`),
    };
}

function checkedFade(value: readonly [number, number], where: string): readonly [number, number] {
    if (!check.isList(value) || value.length !== 2) throw new InputError(`${where} must be two distances`);
    const [inner, outer] = [check.number(value[0], where, 0), check.number(value[1], where, 0)];
    if (inner < outer) return [inner, outer];
    throw new InputError(`the first distance of ${where}, ${inner}, must be below the second, ${outer}`);
}

function checkedRotation(value: given.Rotation, where: string): Quaternion {
    return value.length === 3 ? fromEuler(check.vector(value, where)) : check.quaternion(value, where);
}

function checkedMaterial(material: given.Material, where: string): Material {
    check.fields(material, where, MATERIAL);
    return {
        shading: check.choice(material.shading ?? "flat", `${where}.shading`, SHADINGS),
        ambient: check.number(material.ambient ?? 0.3, `${where}.ambient`, 0, 4),
        diffuse: check.number(material.diffuse ?? 0.75, `${where}.diffuse`, 0, 4),
        specular: check.number(material.specular ?? 0.3, `${where}.specular`, 0, 4),
        shininess: check.whole(material.shininess ?? 24, `${where}.shininess`, 1, 128),
        texture: material.texture && checkedTexture(material.texture, `${where}.texture`),
        emission: check.color(material.emission ?? [0, 0, 0], `${where}.emission`),
    };
}

const checkedTexture = checkedOnce((texture: given.Texture, where: string): Texture => {
    check.fields(texture, where, TEXTURE);
    const width = check.whole(texture.width, `${where}.width`, 1, MAX_TEXTURE_SIDE);
    const height = check.whole(texture.height, `${where}.height`, 1, MAX_TEXTURE_SIDE);
    const { pixels } = texture;
    const count = width * height;
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
    return {
        width,
        height,
        pixels: Uint8Array.from(
            { length: 3 * count },
            (_, at) => pixels[channels * Math.floor(at / 3) + (at % 3)] as number,
        ),
        filter: check.choice(texture.filter ?? "bilinear", `${where}.filter`, FILTERS),
        wrap: check.choice(texture.wrap ?? "repeat", `${where}.wrap`, WRAPS),
        alpha: alpha && Uint8Array.from(alpha),
        cutoff: check.whole(texture.cutoff ?? 0, `${where}.cutoff`, 0, 255),
    };
});

function checkLevels(levels: ArrayLike<number>, where: string): void {
    const bad = Array.prototype.findIndex.call(levels, (level: unknown) => !check.isLevel(level as number));
    if (bad >= 0)
        throw new InputError(`${where}[${bad}] must be a whole number from 0 to 255, not ${show(levels[bad])}`);
}

/** Return the mesh with all its tables, each of one type. It is the same one each time, and may share tables. */
export const checkedMesh = checkedOnce((mesh: given.Mesh, where: string): Mesh => {
    check.fields(mesh, where, MESH);
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
        const colors = Uint8Array.from({ length: 3 * count }, (_, at) => one[at % 3] as number);
        return { colors, alpha: unlessOpaque(Array.from({ length: count }, () => one[3] as number)) };
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
    check.fields(camera, "camera", CAMERA);
    const projection = check.choice(camera.projection ?? "perspective", "camera.projection", PROJECTIONS);
    const perspective = projection === "perspective";
    const [low, high] = perspective ? [2 ** -10, 2 ** 10] : [1e-30, 1e30];
    const near = camera.near === undefined ? undefined : check.number(camera.near, "camera.near");
    if (perspective && near !== undefined && near <= 0) {
        throw new InputError(`camera.near must be above 0 for a perspective camera, not ${near}`);
    }
    return {
        eye: check.vector(camera.eye ?? [0, 0, 0], "camera.eye"),
        target: check.vector(camera.target ?? [0, 0, -1], "camera.target"),
        up: check.vector(camera.up ?? [0, 1, 0], "camera.up"),
        projection,
        halfHeight: check.number(camera.halfHeight ?? VIEW.halfHeight, "camera.halfHeight", low, high),
        near,
    };
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
    check.fields(light as given.SpotLight, where, LIGHTS[kind]);
    const color = check.color(light.color ?? WHITE, `${where}.color`);
    const shadow = check.flag(light.shadow ?? false, `${where}.shadow`);
    if (light.kind === "directional") {
        return { kind, vector: nonzero(light.direction, `${where}.direction`), color, cone: undefined, shadow };
    }
    const place = check.vector(light.position, `${where}.position`);
    if (light.kind === "point") return { kind, vector: place, color, cone: undefined, shadow };
    const direction = nonzero(light.direction, `${where}.direction`);
    const innerAngle = check.number(light.innerAngle ?? 0, `${where}.innerAngle`, 0, 180);
    const outerAngle = check.number(light.outerAngle ?? 45, `${where}.outerAngle`, 0, 180);
    if (innerAngle > outerAngle) {
        throw new InputError(`${where}.innerAngle, ${innerAngle}, must not be above its outerAngle, ${outerAngle}`);
    }
    return { kind, vector: place, color, cone: { direction, innerAngle, outerAngle }, shadow };
}

function nonzero(value: unknown, where: string): Vector {
    const found = check.vector(value, where);
    if (found.some((x) => x)) return found;
    throw new InputError(`${where} must not be zero`);
}

function checkedBackground(value: given.Background | given.Color): { top: Rgb; bottom: Rgb } {
    const { top, bottom }: given.Background =
        typeof value === "string" || check.isList(value)
            ? { top: value }
            : check.fields(value as given.Background, "background", BACKGROUND);
    const found = check.color(top ?? [0, 0, 0], "background.top");
    return { top: found, bottom: bottom === undefined ? found : check.color(bottom, "background.bottom") };
}

function checkedHemisphere(value: given.Hemisphere): Hemisphere {
    const { sky, ground } = check.fields(value, "hemisphere", HEMISPHERE);
    return {
        sky: check.color(sky, "hemisphere.sky"),
        ground: check.color(ground ?? [0, 0, 0], "hemisphere.ground"),
    };
}

function checkedRim(value: given.Rim): Rim {
    const { color, power } = check.fields(value, "rim", RIM);
    return { color: check.color(color, "rim.color"), power: check.whole(power ?? 3, "rim.power", 1, 16) };
}

function checkedFog(value: given.Fog): Fog {
    const { color, near, far } = check.fields(value, "fog", FOG);
    const fog = {
        color: check.color(color, "fog.color"),
        near: check.number(near, "fog.near", 0),
        far: check.number(far, "fog.far", 0),
    };
    if (fog.near < fog.far) return fog;
    throw new InputError(`fog.near, ${fog.near}, must be below fog.far, ${fog.far}`);
}

function checkedGround(value: given.Ground): Ground {
    const { color, height, radius, center, inner } = check.fields(value, "ground", GROUND);
    const ground = {
        color: check.color(color, "ground.color"),
        height: height === undefined ? undefined : check.number(height, "ground.height"),
        radius: radius === undefined ? undefined : check.number(radius, "ground.radius", 0),
        center: center && (check.numbers(center, "ground.center", 2) as [number, number]),
        inner: inner === undefined ? undefined : check.number(inner, "ground.inner", 0),
    };
    if (ground.radius === 0) throw new InputError("ground.radius must be above 0");
    if (ground.radius !== undefined && ground.inner !== undefined) checkInner(ground.inner, ground.radius);
    return ground;
}

/** Check the inner radius of a ground against its radius. */
export function checkInner(inner: number, radius: number): void {
    if (inner < radius) return;
    throw new InputError(`ground.inner, ${inner}, must be below the radius of the ground, ${radius}`);
}

function checkedTone(value: given.Tone): Tone {
    const { exposure, filmic, gamma } = check.fields(value, "tone", TONE);
    return {
        exposure: check.number(exposure ?? 1, "tone.exposure", 0, 64),
        filmic: check.flag(filmic ?? false, "tone.filmic"),
        gamma: check.flag(gamma ?? false, "tone.gamma"),
    };
}

/** What a scene may have besides, by its keys: the keys of each, and what checks it. */
export const EFFECTS = {
    hemisphere: { known: HEMISPHERE, check: checkedHemisphere },
    rim: { known: RIM, check: checkedRim },
    fog: { known: FOG, check: checkedFog },
    tone: { known: TONE, check: checkedTone },
    ground: { known: GROUND, check: checkedGround },
};

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
    const camera = frame(
        points.map((x) => x / size),
        { ...VIEW, aspect },
    );
    return { ...camera, eye: times(size, camera.eye), target: times(size, camera.target) };
}
