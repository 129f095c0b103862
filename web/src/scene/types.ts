// What a scene is made of, in the units and ranges of scene files: docs/scene-files.md.
// Written by tools/scene_fields.py from contracts/scene_fields.toml.

import type { Color, Rotation, Rows, Vector3 } from "./values.js";

export type * from "./values.js";

export type Shading = "unlit" | "flat" | "smooth";

export type Projection = "perspective" | "orthographic";

/** A triangle mesh; counter-clockwise faces are seen from the front. It must not change after it was encoded. */
export interface Mesh {
    /** The vertices. */
    positions: Rows;
    /** Three vertex numbers, from 0, for each triangle. */
    faces: Rows;
    /**
     * Red, green and blue of each vertex, 0..255, in rows of four also with an alpha, which becomes the opacity; or one
     * colour for all. Light grey by default.
     */
    colors?: Rows | Color | undefined;
    /** The normal of each vertex; computed for smooth shading where there are none. */
    normals?: Rows | undefined;
    /**
     * Where each vertex is on the texture of the material, two numbers each: from its upper left corner (0, 0) to its
     * lower right one (1, 1), as in glTF.
     */
    uvs?: ArrayLike<number> | readonly ArrayLike<number>[] | undefined;
    /** What each vertex hides of what is behind it, 0..1; multiplied with the opacity of the object. */
    opacities?: ArrayLike<number> | undefined;
}

/** An image that is multiplied with the colours of a mesh, at the places of `Mesh.uvs`. It must not change, either. */
export interface Texture {
    /** Texels of a row, 1..256. */
    width: number;
    /** Rows, 1..256. */
    height: number;
    /** Red, green and blue of each texel, 0..255, rows from the top; also with an alpha, as `ImageData` has them. */
    pixels: ArrayLike<number>;
    /** Whether colours are those of texels, or interpolated between four; "bilinear" by default. */
    filter?: "nearest" | "bilinear" | undefined;
    /** Whether the image repeats outside of 0..1, or its border goes on; "repeat" by default. */
    wrap?: "repeat" | "clamp" | undefined;
    /** What each texel hides of what is behind it, 0..255; all are opaque by default, whatever alpha pixels have. */
    alpha?: ArrayLike<number> | undefined;
    /**
     * The least alpha of what is drawn, which is opaque then, 0..255; 0 if the surface is blended with what is behind
     * it; 0 by default.
     */
    cutoff?: number | undefined;
}

/** Coefficients of Blinn-Phong shading. */
export interface Material {
    shading?: Shading | undefined;
    /** Coefficient of the ambient light, 0..4; 0.3 by default. */
    ambient?: number | undefined;
    /** Coefficient of diffuse light, 0..4; 0.75 by default. */
    diffuse?: number | undefined;
    /** Coefficient of the highlights, 0..4; 0.3 by default. */
    specular?: number | undefined;
    /** Exponent of the highlights, 1..128; larger values make smaller highlights; 24 by default. */
    shininess?: number | undefined;
    /** Needs a mesh with `uvs`. */
    texture?: Texture | undefined;
    /** The colour of the light that the surface emits, added to what it reflects; black by default. */
    emission?: Color | undefined;
}

/** A mesh in the world: a vertex v is at position + rotation(scale * v). */
export interface SceneObject {
    mesh: Mesh;
    /** The position of the mesh's origin; [0, 0, 0] by default. */
    position?: Vector3 | undefined;
    rotation?: Rotation | undefined;
    /** A factor of its size, at least 0; 1 by default. */
    scale?: number | undefined;
    material?: Material | undefined;
    /** Whether to leave out faces that point away from the viewer; true by default. */
    cull?: boolean | undefined;
    /** Whether to draw only the edges, one pixel wide. */
    wireframe?: boolean | undefined;
    /** Whether the backs of faces are lit like their fronts; does not apply to wires. */
    twoSided?: boolean | undefined;
    /**
     * Opacity, 0..1; 1 by default. Objects below 1, and those whose vertices have opacities, are drawn after the
     * others, in their order: list the farthest first.
     */
    opacity?: number | undefined;
    /**
     * `[inner, outer]`: makes the object a ground, which casts no shadow. The numbers are the distances from its
     * position at which it begins to fade and at which it is invisible.
     */
    fade?: readonly [number, number] | undefined;
}

/** A camera; by default at the origin, looking down -z. */
export interface Camera {
    eye?: Vector3 | undefined;
    target?: Vector3 | undefined;
    up?: Vector3 | undefined;
    projection?: Projection | undefined;
    /**
     * Half the height of what the picture shows: at distance 1 in perspective (`halfHeightOf`), else in world units.
     */
    halfHeight?: number | undefined;
    /**
     * Distance of the near plane; by default 1/1024 of the farthest distance of an object, and an orthographic camera
     * clips nothing.
     */
    near?: number | undefined;
}

/** A light at infinity; `direction` is that toward the light. */
export interface DirectionalLight {
    kind: "directional";
    direction: Vector3;
    /** The colour of the light; white by default. */
    color?: Color | undefined;
    /** Whether objects cast shadows from this light; for one light at most. */
    shadow?: boolean | undefined;
}

/** A light that shines in all directions, and does not fade. */
export interface PointLight {
    kind: "point";
    position: Vector3;
    /** The colour of the light; white by default. */
    color?: Color | undefined;
    /** Whether objects cast shadows from this light; for one light at most. */
    shadow?: boolean | undefined;
}

/** A light that shines into a cone about `direction`; its angles are in degrees. */
export interface SpotLight {
    kind: "spot";
    position: Vector3;
    direction: Vector3;
    /** The colour of the light; white by default. */
    color?: Color | undefined;
    /** Degrees from the axis of a spot light, within which its light is full, as in glTF, 0..180; 0 by default. */
    innerAngle?: number | undefined;
    /** Degrees from the axis of a spot light, outside of which there is none of its light, 0..180; 45 by default. */
    outerAngle?: number | undefined;
    /** Whether objects cast shadows from this light; for one light at most. */
    shadow?: boolean | undefined;
}

/** A vertical gradient. */
export interface Background {
    /** The colour of the top row; black by default. */
    top?: Color | undefined;
    /** The colour of the bottom row; as top by default. */
    bottom?: Color | undefined;
}

/** Light from above (+y) and below, in proportion to the ambient coefficients. */
export interface Hemisphere {
    /** The colour of the light from above. */
    sky: Color;
    /** The colour of the light from below; black by default. */
    ground?: Color | undefined;
}

/** Light along the outlines of objects. */
export interface Rim {
    /** The colour of the light. */
    color: Color;
    /** How narrow the rim is, 1..16; 3 by default. */
    power?: number | undefined;
}

/** Fog between two distances along the line of sight. */
export interface Fog {
    /** The colour of the fog. */
    color: Color;
    /** The distance at which it begins, at least 0. */
    near: number;
    /** The distance at which it hides everything, at least 0. */
    far: number;
}

/** How the light of surfaces becomes colours. */
export interface Tone {
    /** A factor of all light, 0..64; 1 by default. */
    exposure?: number | undefined;
    /** Whether bright light is compressed as on film. */
    filmic?: boolean | undefined;
    /** Whether light is added in linear space. */
    gamma?: boolean | undefined;
}

/** A level, matte disc under the objects, which receives shadows and fades into the background. */
export interface Ground {
    /** The colour of the ground. */
    color: Color;
    /** Its y in the world; just below the lowest vertex by default. */
    height?: number | undefined;
    /** The radius at which it has faded away, above 0; 2.25 times half the diagonal of the objects by default. */
    radius?: number | undefined;
    /** Its x and z in the world; the middle of the objects by default. */
    center?: readonly [number, number] | undefined;
    /** The radius at which it begins to fade, below the radius; 0.4 of the radius by default. */
    inner?: number | undefined;
}

/**
 * Objects, drawn in their order with one depth buffer, seen by a camera.
 *
 * Without camera, lights and background, objects are staged: the camera sees all of them from a little above and to the
 * side, and a white light shines from the upper left.
 */
export interface Scene {
    objects: readonly SceneObject[];
    camera?: Camera | undefined;
    /** Up to four. */
    lights?: readonly Light[] | undefined;
    background?: Background | Color | undefined;
    /** The colour of the light that comes from everywhere; white by default. */
    ambientLight?: Color | undefined;
    /** Whether each byte v of the picture becomes 255 - v. */
    invert?: boolean | undefined;
    /** Whether to smooth the edges with four samples per pixel. */
    antialias?: boolean | undefined;
    /** Scenes with one of the following are always antialiased. */
    hemisphere?: Hemisphere | undefined;
    rim?: Rim | undefined;
    fog?: Fog | undefined;
    tone?: Tone | undefined;
    ground?: Ground | undefined;
    /** In pixels, 1..2048; 128 by default. */
    width?: number | undefined;
    /** In pixels, 1..2048; 128 by default. */
    height?: number | undefined;
}

export type Light = DirectionalLight | PointLight | SpotLight;
