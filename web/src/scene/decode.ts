// Scenes from calls, which may come from anybody: the inverse of encode.ts.

import { InputError, about } from "../errors.js";
import type { Quaternion, Vector } from "./arithmetic.js";
import type { Mesh, Texture } from "./checked.js";
import type { Rgb } from "./checks.js";
import { MAX_COORDINATE } from "./constants.js";
import {
    CULL_BACKFACES,
    EXPOSURE,
    LIGHT_NUMBERS,
    PROJECTION_NUMBERS,
    SHADING_NUMBERS,
    TWO_SIDED,
    WIREFRAME,
    WORD,
    encode,
} from "./encode.js";
import { OPAQUE } from "./ground.js";
import { unpack } from "./mesh.js";
import { OBJECT_WORDS, Reader, type ObjectPlaces } from "./reader.js";
import * as records from "./records.js";
import { unpackAlpha, unpackTexture } from "./texture.js";
import type { Camera, Ground, Light, Scene, SceneObject } from "./types.js";

/** The contents of the extensions, by kind and index. */
type Records = (kind: number, index: number) => DataView | undefined;

/**
 * Return the scene of a call of `render`, such that `encode` makes the same call of it again. A ground is one, not an
 * object with a fade.
 *
 * InputError for everything that the contracts refuse, and for calls that `encode` would make otherwise: of another
 * encoding, with numbers that a float does not hold, or of a scene that it would move and scale.
 */
export function decodeCall(call: Uint8Array): Scene {
    const reader = new Reader(call);
    if (reader.name !== "render") throw new InputError(`it must be a call of render, not of ${reader.name}`);
    const scene = sceneOf(reader);
    const isCall = (each: Scene): boolean => differenceOf(encode(each), call) === undefined;
    const found = [...withGround(scene), scene].find(isCall);
    if (found) return found;
    const where = `from byte ${differenceOf(encode(scene), call)} on they differ, and the picture could change`;
    throw new InputError(`the call is not the one that is made of its scene: ${where}`);
}

/** Return the first place at which bytes differ, undefined if they do not. */
function differenceOf(one: Uint8Array, other: Uint8Array): number | undefined {
    const place = one.findIndex((byte, at) => byte !== other[at]);
    return place >= 0 ? place : one.length < other.length ? one.length : undefined;
}

/** Return the scene with its last object as a ground, with and without an inner radius; none if that is no ground. */
function withGround(scene: Scene): Scene[] {
    const last = scene.objects.at(-1);
    if (!last?.fade || !last.position) return [];
    const [x, height, z] = last.position;
    const [inner, radius] = last.fade;
    const [red, green, blue] = last.mesh.colors as Uint8Array;
    const color: Rgb = [red, green, blue];
    const ground: Ground = { color, height, radius, center: [x, z] };
    const objects = scene.objects.slice(0, -1);
    return [ground, { ...ground, inner }].map((each) => ({ ...scene, objects, ground: each }));
}

function sceneOf(reader: Reader): Scene {
    const found = new Map(reader.extensions().map((each) => [each.kind * 2 ** 16 + each.index, each]));
    const recordOf: Records = (kind, index) => {
        const record = found.get(kind * 2 ** 16 + index);
        if (!record) return undefined;
        const size = (records.SIZES as Record<number, number>)[kind] ?? record.size;
        if (size !== record.size) reader.refuseExtension(record.place);
        return new DataView(reader.bytes.buffer, reader.bytes.byteOffset + record.place, size);
    };
    const places = reader.objects();
    // not shared: what is made of them is no larger than the call
    if (places.reduce((sum, { size }) => sum + WORD * OBJECT_WORDS + size, 0) > reader.bytes.length) {
        throw new InputError("the objects of the call overlap");
    }
    const field = (index: number): number => reader.field(index);
    return {
        width: reader.side(field(0), "width"),
        height: reader.side(field(1), "height"),
        camera: cameraOf(reader),
        background: {
            top: colorOf(reader, field(14), "the top of the background"),
            bottom: colorOf(reader, field(15), "the bottom of the background"),
        },
        invert: reader.count(field(16), 1, "invert") === 1,
        ambientLight: colorOf(reader, field(17), "the ambient light"),
        lights: reader.lights().map((place, index) => lightOf(reader, place, index, recordOf)),
        objects: places.map((each, index) => objectOf(reader, each, index, recordOf)),
        antialias: recordOf(records.ANTIALIAS, 0) !== undefined,
        ...effectsOf(recordOf),
    };
}

function colorOf(reader: Reader, place: number, name: string): Rgb {
    return rgb(reader.count(place, 0xffffff, name));
}

function rgb(value: number): Rgb {
    return [value >> 16, (value >> 8) & 255, value & 255];
}

function cameraOf(reader: Reader): Camera {
    const { perspective, halfHeights } = reader.projection();
    const near = reader.number(reader.field(13), "the near distance");
    return {
        eye: reader.vector(reader.field(2), "the camera's eye").value,
        target: reader.vector(reader.field(5), "the camera's target").value,
        up: reader.vector(reader.field(8), "the camera's up").value,
        projection: nameOf(PROJECTION_NUMBERS, Number(!perspective)),
        halfHeight: reader.number(reader.field(12), "the half height", ...halfHeights),
        near: !perspective && near === -MAX_COORDINATE ? undefined : near,
    };
}

function lightOf(reader: Reader, place: number, index: number, recordOf: Records): Light {
    const name = `light ${index}`;
    const isPoint = reader.count(place, 1, `the kind of ${name}`) === LIGHT_NUMBERS.point;
    const vector = reader.vector(place + WORD, `the vector of ${name}`).value;
    const color = colorOf(reader, place + 4 * WORD, `the colour of ${name}`);
    const [spot, shadow] = [recordOf(records.SPOT, index), recordOf(records.SHADOW, index) !== undefined];
    if (!isPoint) return { kind: "directional", direction: vector, color, shadow };
    if (!spot) return { kind: "point", position: vector, color, shadow };
    const [x, y, z, inner, outer] = [0, 8, 16, 24, 32].map((at) => q32At(spot, at));
    // the arc cosine errs by far less than half a step of Q32; that of what is beyond 1 is no number
    const [innerAngle, outerAngle] = [inner, outer].map((each) => (Math.acos(each) * 180) / Math.PI);
    return { kind: "spot", position: vector, direction: [x, y, z], color, innerAngle, outerAngle, shadow };
}

function objectOf(
    reader: Reader,
    { place, mesh: start, size }: ObjectPlaces,
    index: number,
    recordOf: Records,
): SceneObject {
    const name = `object ${index}`;
    const word = (at: number): number => place + at * WORD;
    const numbers = (at: number, count: number, what: string): number[] =>
        reader.numbers(word(at), count, `the ${what} of ${name}`);
    const [ambient, diffuse, specular] = numbers(10, 3, "coefficients");
    const [scale] = numbers(8, 1, "scale");
    const flags = reader.count(word(14), CULL_BACKFACES | WIREFRAME | TWO_SIDED, `the flags of ${name}`);
    const [faded, opacity, emission] = [records.GROUND, records.OPACITY_OF, records.EMISSION_OF].map((kind) =>
        recordOf(kind, index),
    );
    const shading = nameOf(SHADING_NUMBERS, reader.count(word(9), 2, `the shading of ${name}`));
    return about(name, () => {
        const { texture, ...mesh } = meshOf(reader.bytes.subarray(start, start + size), index, recordOf);
        return {
            mesh,
            position: numbers(1, 3, "position") as Vector,
            rotation: numbers(4, 4, "rotation") as Quaternion,
            scale,
            material: {
                shading,
                ambient,
                diffuse,
                specular,
                shininess: reader.count(word(13), 128, `the shininess of ${name}`),
                texture,
                emission: emission && rgb(emission.getUint32(WORD - 4)),
            },
            cull: (flags & CULL_BACKFACES) > 0,
            wireframe: (flags & WIREFRAME) > 0,
            twoSided: (flags & TWO_SIDED) > 0,
            opacity: opacity && opacity.getUint32(0) / OPAQUE,
            fade: faded && [q32At(faded, 0), q32At(faded, 8)],
        };
    });
}

/** Return the mesh of packed bytes, with what records say of its vertices, and its texture. */
function meshOf(packed: Uint8Array, index: number, recordOf: Records): Mesh & { texture: Texture | undefined } {
    const mesh = unpack(packed);
    const count = mesh.positions.length / 3;
    const [levels, image, alpha] = [records.OPACITIES_OF, records.TEXTURE_OF, records.ALPHA_OF].map((kind) => {
        const record = recordOf(kind, index);
        return record && new Uint8Array(record.buffer, record.byteOffset, record.byteLength);
    });
    if (levels && levels.length < count) throw new InputError(`it needs ${count} opacities, not ${levels.length}`);
    const opacities = levels && Float64Array.from(levels.subarray(0, count), (level) => level / 255);
    const { texture, uvs } = image ? unpackTexture(image, count) : { texture: undefined, uvs: undefined };
    return { ...mesh, opacities, uvs, texture: texture && alpha ? unpackAlpha(alpha, texture) : texture };
}

function effectsOf(recordOf: Records): Partial<Scene> {
    const [hemisphere, rim, fog, tone] = [records.HEMISPHERE, records.RIM, records.FOG, records.TONE].map((kind) =>
        recordOf(kind, 0),
    );
    const color = (view: DataView, at = 0): Rgb => [view.getUint8(at), view.getUint8(at + 1), view.getUint8(at + 2)];
    return {
        hemisphere: hemisphere && { sky: color(hemisphere), ground: color(hemisphere, 3) },
        rim: rim && { color: color(rim), power: rim.getUint8(3) },
        fog: fog && { color: color(fog), near: q32At(fog, 3), far: q32At(fog, 11) },
        tone: tone && {
            exposure: tone.getUint32(0) / EXPOSURE,
            ...Object.fromEntries(records.TONE_FLAGS.map(([name, bit]) => [name, (tone.getUint8(4) & bit) > 0])),
        },
    };
}

function q32At(view: DataView, at: number): number {
    return Number(view.getBigInt64(at)) / 2 ** 32;
}

function nameOf<Name extends string>(numbers: Record<Name, number>, number: number): Name {
    return (Object.keys(numbers) as Name[]).find((name) => numbers[name] === number) as Name;
}
