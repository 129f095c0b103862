// The fields of scenes. Written by tools/scene_fields.py from contracts/scene_fields.toml.

import type { Vector } from "./arithmetic.js";
import type { Rgb } from "./checks.js";
import type { Projection, Shading } from "./types.js";

export const SHADINGS = ["unlit", "flat", "smooth"] as const;
export const PROJECTIONS = ["perspective", "orthographic"] as const;
export const LIGHT_KINDS = ["directional", "point", "spot"] as const;
export const FILTERS = ["nearest", "bilinear"] as const;
export const WRAPS = ["repeat", "clamp"] as const;
export const AXES = ["x", "y", "z"] as const;
/** The classes of the kinds of lights. */
export const LIGHTS = { directional: "DirectionalLight", point: "PointLight", spot: "SpotLight" } as const;
/** The most pixels a side of a picture. */
export const MAX_SIDE = 2048;

// prettier-ignore
/** Of each class, the fields with a kind, checked. */
export interface Plain {
    Texture: {
        width: number;
        height: number;
        filter: "nearest" | "bilinear";
        wrap: "repeat" | "clamp";
        cutoff: number;
    },
    Material: {
        shading: Shading;
        ambient: number;
        diffuse: number;
        specular: number;
        shininess: number;
        emission: Rgb;
    },
    SceneObject: {
        position: Vector;
        scale: number;
        cull: boolean;
        wireframe: boolean;
        twoSided: boolean;
        opacity: number;
        fade: readonly [number, number] | undefined;
    },
    Camera: {
        eye: Vector;
        target: Vector;
        up: Vector;
        projection: Projection;
        halfHeight: number;
        near: number | undefined;
    },
    DirectionalLight: {
        kind: "directional";
        direction: Vector;
        color: Rgb;
        shadow: boolean;
    },
    PointLight: {
        kind: "point";
        position: Vector;
        color: Rgb;
        shadow: boolean;
    },
    SpotLight: {
        kind: "spot";
        position: Vector;
        direction: Vector;
        color: Rgb;
        innerAngle: number;
        outerAngle: number;
        shadow: boolean;
    },
    Background: {
        top: Rgb;
        bottom: Rgb | undefined;
    },
    Hemisphere: {
        sky: Rgb;
        ground: Rgb;
    },
    Rim: {
        color: Rgb;
        power: number;
    },
    Fog: {
        color: Rgb;
        near: number;
        far: number;
    },
    Tone: {
        exposure: number;
        filmic: boolean;
        gamma: boolean;
    },
    Ground: {
        color: Rgb;
        height: number | undefined;
        radius: number | undefined;
        center: readonly [number, number] | undefined;
        inner: number | undefined;
    },
    Scene: {
        ambientLight: Rgb;
        invert: boolean;
        antialias: boolean;
        width: number;
        height: number;
    },
}
// prettier-ignore
/** Of each class, the keys of files that are no fields. */
export interface InFile {
    SceneObject: {
        upAxis: "x" | "y" | "z";
        color: Rgb;
        crease: number;
    },
    Camera: {
        azimuth: number;
        elevation: number;
        margin: number;
        fov: number;
    },
}
// prettier-ignore
/** All fields, and keys of scene files. */
export const FIELDS = {
    Mesh: {
        positions: { needed: true },
        faces: { needed: true },
        colors: {},
        normals: {},
        uvs: {},
        opacities: {},
    },
    Texture: {
        image: { only: "file" },
        width: { kind: "whole", limits: [1, 256], needed: true },
        height: { kind: "whole", limits: [1, 256], needed: true },
        pixels: { needed: true },
        filter: { kind: "choice", choices: ["nearest", "bilinear"], default: "bilinear" },
        wrap: { kind: "choice", choices: ["repeat", "clamp"], default: "repeat" },
        alpha: {},
        cutoff: { kind: "whole", limits: [0, 255], default: 0 },
    },
    Material: {
        shading: { kind: "choice", choices: ["unlit", "flat", "smooth"], default: "flat" },
        ambient: { kind: "number", limits: [0, 4], default: 0.3 },
        diffuse: { kind: "number", limits: [0, 4], default: 0.75 },
        specular: { kind: "number", limits: [0, 4], default: 0.3 },
        shininess: { kind: "whole", limits: [1, 128], default: 24 },
        texture: {},
        emission: { kind: "color", default: [0, 0, 0] },
    },
    SceneObject: {
        mesh: { needed: true },
        position: { kind: "vector", default: [0, 0, 0] },
        rotation: { default: [0, 0, 0, 1] },
        upAxis: { kind: "choice", choices: ["x", "y", "z"], only: "file" },
        scale: { kind: "number", limits: [0], default: 1 },
        color: { kind: "color", only: "file" },
        crease: { kind: "number", limits: [0, 180], only: "file" },
        material: {},
        cull: { kind: "flag", default: true },
        wireframe: { kind: "flag", default: false },
        twoSided: { kind: "flag", default: false },
        opacity: { kind: "number", limits: [0, 1], default: 1 },
        fade: { kind: "pair" },
    },
    Camera: {
        eye: { kind: "vector", default: [0, 0, 0] },
        target: { kind: "vector", default: [0, 0, -1] },
        up: { kind: "vector", default: [0, 1, 0] },
        azimuth: { kind: "number", default: 30, only: "file" },
        elevation: { kind: "number", limits: [-90, 90], default: 20, only: "file" },
        margin: { kind: "number", limits: [0, 0.9], default: 0.08, only: "file" },
        projection: { kind: "choice", choices: ["perspective", "orthographic"], default: "perspective" },
        fov: { kind: "number", limits: [0.2, 179.8], only: "file" },
        halfHeight: { kind: "number", limits: [0], default: 0.4662004662004662 },
        near: { kind: "number" },
    },
    DirectionalLight: {
        kind: { kind: "choice", choices: ["directional"], needed: true },
        direction: { kind: "vector", needed: true },
        color: { kind: "color", default: [255, 255, 255] },
        shadow: { kind: "flag", default: false },
    },
    PointLight: {
        kind: { kind: "choice", choices: ["point"], needed: true },
        position: { kind: "vector", needed: true },
        color: { kind: "color", default: [255, 255, 255] },
        shadow: { kind: "flag", default: false },
    },
    SpotLight: {
        kind: { kind: "choice", choices: ["spot"], needed: true },
        position: { kind: "vector", needed: true },
        direction: { kind: "vector", needed: true },
        color: { kind: "color", default: [255, 255, 255] },
        innerAngle: { kind: "number", limits: [0, 180], default: 0 },
        outerAngle: { kind: "number", limits: [0, 180], default: 45 },
        shadow: { kind: "flag", default: false },
    },
    Background: {
        top: { kind: "color", default: [0, 0, 0] },
        bottom: { kind: "color" },
    },
    Hemisphere: {
        sky: { kind: "color", needed: true },
        ground: { kind: "color", default: [0, 0, 0] },
    },
    Rim: {
        color: { kind: "color", needed: true },
        power: { kind: "whole", limits: [1, 16], default: 3 },
    },
    Fog: {
        color: { kind: "color", needed: true },
        near: { kind: "number", limits: [0], needed: true },
        far: { kind: "number", limits: [0], needed: true },
    },
    Tone: {
        exposure: { kind: "number", limits: [0, 64], default: 1 },
        filmic: { kind: "flag", default: false },
        gamma: { kind: "flag", default: false },
    },
    Ground: {
        color: { kind: "color", needed: true },
        height: { kind: "number" },
        radius: { kind: "number", limits: [0] },
        center: { kind: "pair" },
        inner: { kind: "number", limits: [0] },
    },
    Scene: {
        size: { only: "file" },
        objects: { needed: true },
        camera: {},
        lights: {},
        background: {},
        ambientLight: { kind: "color", default: [255, 255, 255] },
        invert: { kind: "flag", default: false },
        antialias: { kind: "flag", default: false },
        hemisphere: {},
        rim: {},
        fog: {},
        tone: {},
        ground: {},
        width: { kind: "whole", limits: [1, 2048], default: 128, only: "class" },
        height: { kind: "whole", limits: [1, 2048], default: 128, only: "class" },
        creator: { only: "file" },
    },
} as const;
