// The fields of scenes. Written by tools/scene_fields.py from contracts/scene_fields.toml.

import type { Vector } from "./arithmetic.js";
import type { Rgb } from "./checks.js";
import type { Projection, Shading } from "./types.js";

/** A field of a class; one without a kind is checked by hand. */
export interface Field {
    readonly kind?: "number" | "whole" | "flag" | "color" | "vector" | "pair" | "choice";
    readonly low?: number;
    readonly high?: number;
    readonly choices?: readonly string[];
    readonly needed?: boolean;
    readonly usual?: unknown;
    /** Of a key of scene files that is no field, or of a field that is no key. */
    readonly only?: "file" | "class";
}

export const SHADINGS = ["unlit", "flat", "smooth"] as const;
export const PROJECTIONS = ["perspective", "orthographic"] as const;
export const LIGHT_KINDS = ["directional", "point", "spot"] as const;
export const FILTERS = ["nearest", "bilinear"] as const;
export const WRAPS = ["repeat", "clamp"] as const;
export const AXES = ["x", "y", "z"] as const;
/** The classes of the kinds of lights. */
export const LIGHTS = { directional: "DirectionalLight", point: "PointLight", spot: "SpotLight" } as const;

/** Of each class, the fields with a kind, checked. */
export interface Plain {
    Texture: {
        width: number;
        height: number;
        filter: "nearest" | "bilinear";
        wrap: "repeat" | "clamp";
        cutoff: number;
    };
    Material: {
        shading: Shading;
        ambient: number;
        diffuse: number;
        specular: number;
        shininess: number;
        emission: Rgb;
    };
    SceneObject: {
        position: Vector;
        scale: number;
        cull: boolean;
        wireframe: boolean;
        twoSided: boolean;
        opacity: number;
        fade: readonly [number, number] | undefined;
    };
    Camera: {
        eye: Vector;
        target: Vector;
        up: Vector;
        projection: Projection;
        halfHeight: number;
        near: number | undefined;
    };
    DirectionalLight: {
        kind: "directional";
        direction: Vector;
        color: Rgb;
        shadow: boolean;
    };
    PointLight: {
        kind: "point";
        position: Vector;
        color: Rgb;
        shadow: boolean;
    };
    SpotLight: {
        kind: "spot";
        position: Vector;
        direction: Vector;
        color: Rgb;
        innerAngle: number;
        outerAngle: number;
        shadow: boolean;
    };
    Background: {
        top: Rgb;
        bottom: Rgb | undefined;
    };
    Hemisphere: {
        sky: Rgb;
        ground: Rgb;
    };
    Rim: {
        color: Rgb;
        power: number;
    };
    Fog: {
        color: Rgb;
        near: number;
        far: number;
    };
    Tone: {
        exposure: number;
        filmic: boolean;
        gamma: boolean;
    };
    Ground: {
        color: Rgb;
        height: number | undefined;
        radius: number | undefined;
        center: readonly [number, number] | undefined;
        inner: number | undefined;
    };
    Scene: {
        ambientLight: Rgb;
        invert: boolean;
        antialias: boolean;
        width: number;
        height: number;
    };
}

/** Of each class, the keys of scene files that are no fields. */
export interface InFile {
    SceneObject: { upAxis: "x" | "y" | "z"; color: Rgb; crease: number };
    Camera: { azimuth: number; elevation: number; margin: number; fov: number };
}

// prettier-ignore
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
        width: { kind: "whole", low: 1, high: 256, needed: true },
        height: { kind: "whole", low: 1, high: 256, needed: true },
        pixels: { needed: true },
        filter: { kind: "choice", choices: FILTERS, usual: "bilinear" },
        wrap: { kind: "choice", choices: WRAPS, usual: "repeat" },
        alpha: {},
        cutoff: { kind: "whole", low: 0, high: 255, usual: 0 },
    },
    Material: {
        shading: { kind: "choice", choices: SHADINGS, usual: "flat" },
        ambient: { kind: "number", low: 0, high: 4, usual: 0.3 },
        diffuse: { kind: "number", low: 0, high: 4, usual: 0.75 },
        specular: { kind: "number", low: 0, high: 4, usual: 0.3 },
        shininess: { kind: "whole", low: 1, high: 128, usual: 24 },
        texture: {},
        emission: { kind: "color", usual: [0, 0, 0] },
    },
    SceneObject: {
        mesh: { needed: true },
        position: { kind: "vector", usual: [0, 0, 0] },
        rotation: { usual: [0, 0, 0, 1] },
        upAxis: { kind: "choice", choices: AXES, only: "file" },
        scale: { kind: "number", low: 0, usual: 1 },
        color: { kind: "color", only: "file" },
        crease: { kind: "number", low: 0, high: 180, only: "file" },
        material: {},
        cull: { kind: "flag", usual: true },
        wireframe: { kind: "flag", usual: false },
        twoSided: { kind: "flag", usual: false },
        opacity: { kind: "number", low: 0, high: 1, usual: 1 },
        fade: { kind: "pair" },
    },
    Camera: {
        eye: { kind: "vector", usual: [0, 0, 0] },
        target: { kind: "vector", usual: [0, 0, -1] },
        up: { kind: "vector", usual: [0, 1, 0] },
        azimuth: { kind: "number", usual: 30, only: "file" },
        elevation: { kind: "number", low: -90, high: 90, usual: 20, only: "file" },
        margin: { kind: "number", low: 0, high: 0.9, usual: 0.08, only: "file" },
        projection: { kind: "choice", choices: PROJECTIONS, usual: "perspective" },
        fov: { kind: "number", low: 0.2, high: 179.8, only: "file" },
        halfHeight: { kind: "number", low: 0, usual: 1 / 2.145 },
        near: { kind: "number" },
    },
    DirectionalLight: {
        kind: { kind: "choice", choices: ["directional"], needed: true },
        direction: { kind: "vector", needed: true },
        color: { kind: "color", usual: [255, 255, 255] },
        shadow: { kind: "flag", usual: false },
    },
    PointLight: {
        kind: { kind: "choice", choices: ["point"], needed: true },
        position: { kind: "vector", needed: true },
        color: { kind: "color", usual: [255, 255, 255] },
        shadow: { kind: "flag", usual: false },
    },
    SpotLight: {
        kind: { kind: "choice", choices: ["spot"], needed: true },
        position: { kind: "vector", needed: true },
        direction: { kind: "vector", needed: true },
        color: { kind: "color", usual: [255, 255, 255] },
        innerAngle: { kind: "number", low: 0, high: 180, usual: 0 },
        outerAngle: { kind: "number", low: 0, high: 180, usual: 45 },
        shadow: { kind: "flag", usual: false },
    },
    Background: {
        top: { kind: "color", usual: [0, 0, 0] },
        bottom: { kind: "color" },
    },
    Hemisphere: {
        sky: { kind: "color", needed: true },
        ground: { kind: "color", usual: [0, 0, 0] },
    },
    Rim: {
        color: { kind: "color", needed: true },
        power: { kind: "whole", low: 1, high: 16, usual: 3 },
    },
    Fog: {
        color: { kind: "color", needed: true },
        near: { kind: "number", low: 0, needed: true },
        far: { kind: "number", low: 0, needed: true },
    },
    Tone: {
        exposure: { kind: "number", low: 0, high: 64, usual: 1 },
        filmic: { kind: "flag", usual: false },
        gamma: { kind: "flag", usual: false },
    },
    Ground: {
        color: { kind: "color", needed: true },
        height: { kind: "number" },
        radius: { kind: "number", low: 0 },
        center: { kind: "pair" },
        inner: { kind: "number", low: 0 },
    },
    Scene: {
        size: { only: "file" },
        objects: { needed: true },
        camera: {},
        lights: {},
        background: {},
        ambientLight: { kind: "color", usual: [255, 255, 255] },
        invert: { kind: "flag", usual: false },
        antialias: { kind: "flag", usual: false },
        hemisphere: {},
        rim: {},
        fog: {},
        tone: {},
        ground: {},
        width: { kind: "whole", low: 1, high: 2048, usual: 128, only: "class" },
        height: { kind: "whole", low: 1, high: 2048, usual: 128, only: "class" },
        creator: { only: "file" },
    },
} as const satisfies Record<string, Record<string, Field>>;
