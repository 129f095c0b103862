// Calls of contracts/src/Renderer.sol that draw a scene: the ABI encoding of contracts/src/scene/Scene.sol.
//
// Every field of the structs is a word of 32 bytes; lengths and coefficients are Q32 fixed-point numbers, value * 2^32.

import { InputError, about } from "../errors.js";
import { joined } from "../bytes.js";
import { cosine, rint } from "./arithmetic.js";
import { checkedScene, type Light, type Scene as CheckedScene, type SceneObject } from "./checked.js";
import * as check from "./checks.js";
import type { Rgb } from "./checks.js";
import { fit, type FittedScene } from "./fit.js";
import { OPAQUE, isOpaque, shadowRule } from "./ground.js";
import { pack } from "./mesh.js";
import * as records from "./records.js";
import { packAlpha, packTexture } from "./texture.js";
import type { Rectangle, Scene } from "./types.js";

/** The functions of the Renderer that draw a scene, and their selectors. Those of a tile take a Rectangle too. */
export const FUNCTIONS = {
    render: 0xa6c4c26c,
    renderCounted: 0x7547c8c6,
    renderDataURI: 0x5ba61092,
    renderSVG: 0x6a94e1a6,
    renderTile: 0x11f4bd8c,
    renderTileCounted: 0xa7c8489b,
} as const;
export type FunctionName = keyof typeof FUNCTIONS;

export const WORD = 32;
/** The largest outer and inner radius of a ground, Q32; both are numbers without loss. */
const MAX_FADE = 2n ** 58n;
const MAX_INNER_FADE = MAX_FADE - 64n;
/** One, in exposures. */
export const EXPOSURE = 2 ** 16;

export const PROJECTION_NUMBERS = { perspective: 0, orthographic: 1 } as const;
export const LIGHT_NUMBERS = { directional: 0, point: 1, spot: 1 } as const;
export const SHADING_NUMBERS = { unlit: 0, flat: 1, smooth: 2 } as const;
export const CULL_BACKFACES = 1;
export const WIREFRAME = 2;
export const TWO_SIDED = 4;

/**
 * Return the bytes of the call that draws a scene: the calldata for `eth_call`.
 *
 * name: the function; `renderTile` and `renderTileCounted` draw the part `tile` of the canvas. InputError for a value
 * that is wrong.
 */
export function encode(scene: Scene, name: FunctionName = "render", tile?: Rectangle): Uint8Array {
    check.choice(name, "the function", Object.keys(FUNCTIONS) as FunctionName[]);
    const checked = checkedScene(scene);
    if (isTiled(name) !== (tile !== undefined)) {
        throw new InputError(isTiled(name) ? `${name} needs a tile` : `${name} takes no tile; renderTile does`);
    }
    const rectangle = tile ? checkedTile(tile, checked) : [];
    return joined([
        selectorOf(FUNCTIONS[name]),
        words([WORD * (1 + rectangle.length), ...rectangle]),
        ...encodeScene(fit(checked)),
    ]);
}

/** Return the four bytes of a selector. */
export function selectorOf(number: number): Uint8Array {
    return long(number);
}

/** Return the function that a call is of. */
export function functionOf(call: Uint8Array): FunctionName | undefined {
    const selector = call.length < 4 ? -1 : new DataView(call.buffer, call.byteOffset).getUint32(0);
    return (Object.keys(FUNCTIONS) as FunctionName[]).find((name) => FUNCTIONS[name] === selector);
}

/** Return whether a function takes a Rectangle. */
export function isTiled(name: FunctionName): boolean {
    return name.startsWith("renderTile");
}

function checkedTile({ x, y, width, height }: Rectangle, scene: CheckedScene): number[] {
    const inside = (start: number, size: number, all: number): boolean =>
        start >= 0 && size >= 1 && start + size <= all;
    const numbers = [x, y, width, height];
    if (!numbers.every(Number.isInteger) || !inside(x, width, scene.width) || !inside(y, height, scene.height)) {
        const canvas = `the canvas of ${scene.width} x ${scene.height} pixels`;
        throw new InputError(`the tile of ${width} x ${height} at (${x}, ${y}) does not lie on ${canvas}`);
    }
    return numbers;
}

/** Return the struct Scene, in parts. */
function encodeScene(scene: FittedScene): Uint8Array[] {
    const { camera } = scene;
    const head = words([
        scene.width,
        scene.height,
        ...[...camera.eye, ...camera.target, ...camera.up].map(q32),
        PROJECTION_NUMBERS[camera.projection],
        q32(camera.halfHeight),
        q32(camera.near),
        rgb(scene.background.top),
        rgb(scene.background.bottom),
        Number(scene.invert),
        rgb(scene.ambientLight),
    ]);
    const lights = [words([scene.lights.length]), ...scene.lights.map(encodeLight)];
    const objects = arrayOfDynamic(scene.objects.map(encodeObject));
    const first = head.length + 3 * WORD;
    const toObjects = first + sizeOf(lights);
    const offsets = words([first, toObjects, toObjects + sizeOf(objects)]);
    return [head, offsets, ...lights, ...objects, dynamicBytes(extensions(scene))];
}

/** Return the fields that the structs do not have: records in ascending order of kind and index. */
function extensions(scene: CheckedScene): Uint8Array {
    const made: [kind: number, index: number, content: Uint8Array][] = [];
    const add = (kind: number, index: number, ...content: (Uint8Array | readonly number[])[]): void => {
        const parts = content.map((part) => (part instanceof Uint8Array ? part : Uint8Array.from(part)));
        made.push([kind, index, joined(parts)]);
    };
    scene.lights.forEach(({ cone, shadow }, index) => {
        if (shadow) add(records.SHADOW, index, words([shadowRule(scene)]));
        if (!cone) return;
        const numbers = [...cone.direction, cosine(cone.innerAngle), cosine(cone.outerAngle)];
        add(records.SPOT, index, longs(numbers.map(q32)));
    });
    scene.objects.forEach((object, index) => {
        const { mesh, material, opacity, fade } = object;
        const { texture, emission } = material;
        if (!isOpaque(object)) add(records.OPACITY_OF, index, long(rint(opacity * OPAQUE)));
        if (texture && mesh.uvs) {
            const { uvs } = mesh;
            const packed = about(`objects[${index}]`, () => packTexture(texture, uvs));
            add(records.TEXTURE_OF, index, packed);
        }
        if (texture?.alpha) add(records.ALPHA_OF, index, packAlpha(texture, texture.alpha));
        if (mesh.opacities) {
            const levels = Array.from(mesh.opacities, (each) => rint(255 * each));
            add(records.OPACITIES_OF, index, levels, new Uint8Array(-levels.length & (WORD - 1)));
        }
        if (fade) {
            const within = (each: number, most: bigint): bigint => (q32(each) < most ? q32(each) : most);
            const radii = range(within(fade[0], MAX_INNER_FADE), within(fade[1], MAX_FADE));
            add(records.GROUND, index, radii, longs([0, 0]));
        }
        if (emission.some(Boolean)) add(records.EMISSION_OF, index, words([rgb(emission)]));
    });
    const { antialias, hemisphere, rim, fog, tone } = scene;
    if (antialias) add(records.ANTIALIAS, 0);
    if (hemisphere) add(records.HEMISPHERE, 0, hemisphere.sky, hemisphere.ground);
    if (rim) add(records.RIM, 0, rim.color, [rim.power]);
    if (fog) add(records.FOG, 0, fog.color, range(q32(fog.near), q32(fog.far)));
    if (tone) {
        const flags = records.TONE_FLAGS.reduce((sum, [name, bit]) => sum + (tone[name] ? bit : 0), 0);
        add(records.TONE, 0, long(Math.max(rint(tone.exposure * EXPOSURE), 1)), [flags]);
    }
    return joined(made.sort(([a, first], [b, second]) => a - b || first - second).map((each) => record(...each)));
}

/** Return two distances, the second of which is the greater. */
function range(near: bigint, far: bigint): Uint8Array {
    return longs([near, far > near ? far : near + 1n]);
}

function record(kind: number, index: number, content: Uint8Array): Uint8Array {
    if (index > 0xffff) {
        throw new InputError(
            `objects with an opacity, a texture, a fade or an emission must be among the first 65,536 of a scene, not number ${index}`,
        );
    }
    const head = new DataView(new ArrayBuffer(records.RECORD_HEADER));
    head.setUint8(0, kind);
    head.setUint16(1, index);
    head.setUint16(3, kind < records.LONG_KINDS ? content.length : content.length / WORD);
    return joined([new Uint8Array(head.buffer), content]);
}

/** Return a whole number in 4 bytes. */
function long(value: number): Uint8Array {
    return longs([value]).subarray(4);
}

/** Return whole numbers in 8 bytes each. */
function longs(values: readonly (number | bigint)[]): Uint8Array {
    const view = new DataView(new ArrayBuffer(8 * values.length));
    values.forEach((value, place) => view.setBigInt64(8 * place, BigInt(value)));
    return new Uint8Array(view.buffer);
}

function encodeLight(light: Light): Uint8Array {
    return words([LIGHT_NUMBERS[light.kind], ...light.vector.map(q32), rgb(light.color)]);
}

function encodeObject(object: SceneObject): Uint8Array[] {
    const { material } = object;
    const fields = [
        ...[...object.position, ...object.rotation, object.scale].map(q32),
        SHADING_NUMBERS[material.shading],
        ...[material.ambient, material.diffuse, material.specular].map(q32),
        material.shininess,
        (object.cull ? CULL_BACKFACES : 0) | (object.wireframe ? WIREFRAME : 0) | (object.twoSided ? TWO_SIDED : 0),
    ];
    const mesh = pack(object.mesh, material.shading === "smooth");
    return [words([WORD * (1 + fields.length), ...fields]), dynamicBytes(mesh)];
}

function arrayOfDynamic(items: Uint8Array[][]): Uint8Array[] {
    let end = WORD * items.length;
    const offsets = items.map((item) => {
        const begin = end;
        end += sizeOf(item);
        return begin;
    });
    return [words([items.length, ...offsets]), ...items.flat()];
}

export function dynamicBytes(content: Uint8Array): Uint8Array<ArrayBuffer> {
    return joined([words([content.length]), content, new Uint8Array(-content.length & (WORD - 1))]);
}

function rgb([red, green, blue]: Rgb): number {
    return (red << 16) | (green << 8) | blue;
}

/** Return a number as a multiple of 2^-32, rounded to nearest, ties to even. */
export function q32(value: number): bigint {
    return BigInt(rint(value * 2 ** 32));
}

/** Return whole numbers of up to 63 bits as words. */
function words(values: readonly (number | bigint)[]): Uint8Array {
    const bytes = new Uint8Array(WORD * values.length);
    values.forEach((value, index) => setWord(bytes, WORD * index, BigInt(value)));
    return bytes;
}

/** Write a word. */
export function setWord(bytes: Uint8Array, place: number, value: bigint): void {
    if (BigInt.asIntN(64, value) !== value) throw new InputError(`a number of the scene is too large for a contract`);
    bytes.fill(value < 0n ? 0xff : 0, place, place + WORD - 8);
    new DataView(bytes.buffer, bytes.byteOffset).setBigInt64(place + WORD - 8, value);
}

function sizeOf(parts: readonly Uint8Array[]): number {
    return parts.reduce((size, part) => size + part.length, 0);
}
