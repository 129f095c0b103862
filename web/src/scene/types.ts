// What a scene is made of. docs/scene-files.md describes the fields; units and ranges are those of scene files.

/** Rows of three numbers, as arrays or one after the other. */
export type Rows = ArrayLike<number> | readonly ArrayLike<number>[];

/** x, y, z. */
export type Vector3 = readonly [number, number, number];

/**
 * Red, green and blue in whole numbers 0..255, or in fractions 0..1 of which one at least is not whole; "#rgb", "#rrggbb",
 * or the CSS name of a colour. `Mesh.colors` also takes an alpha, "#rgba" or "#rrggbbaa".
 */
export type Color = readonly [number, number, number] | string;

/** Three angles in degrees about the axes x, then y, then z; or a quaternion x, y, z, w of any length but zero. */
export type Rotation = Vector3 | readonly [number, number, number, number];

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
    /** Texels of a row, and rows: 1..256. */
    width: number;
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
     * The least alpha of what is drawn, 1..255, which is opaque then; 0, the default, if the surface is blended with what
     * is behind it.
     */
    cutoff?: number | undefined;
}

export type Shading = "unlit" | "flat" | "smooth";

/** Coefficients of Blinn-Phong shading, each 0..4; `shininess` is a whole number, 1..128. */
export interface Material {
    shading?: Shading | undefined;
    ambient?: number | undefined;
    diffuse?: number | undefined;
    specular?: number | undefined;
    shininess?: number | undefined;
    /** Needs a mesh with `uvs`. */
    texture?: Texture | undefined;
    /** The light that the surface emits, added to what it reflects; black, for none, by default. */
    emission?: Color | undefined;
}

/** A mesh in the world: a vertex v is at position + rotation(scale * v). */
export interface SceneObject {
    mesh: Mesh;
    position?: Vector3 | undefined;
    rotation?: Rotation | undefined;
    scale?: number | undefined;
    material?: Material | undefined;
    /** Whether faces that turn away from the viewer are left out; true by default. */
    cull?: boolean | undefined;
    /** Whether only the edges are drawn. */
    wireframe?: boolean | undefined;
    /**
     * Whether faces that turn away from the viewer, if they are not left out, are lit as from their front. Wires always
     * have the light of the front.
     */
    twoSided?: boolean | undefined;
    /** 0..1. Objects below 1, and those of which vertices are, are drawn after the others, in their order. */
    opacity?: number | undefined;
    /**
     * Of a ground, which casts no shadow: the distances from its position at which it begins to fade into what is behind
     * it, and at which nothing is left of it.
     */
    fade?: readonly [number, number] | undefined;
}

export type Projection = "perspective" | "orthographic";

/** A camera; by default at the origin, looking down -z. */
export interface Camera {
    eye?: Vector3 | undefined;
    target?: Vector3 | undefined;
    up?: Vector3 | undefined;
    projection?: Projection | undefined;
    /** Half the height of what the picture shows: at distance 1 in perspective (`halfHeightOf`), else in world units. */
    halfHeight?: number | undefined;
    /** Distance of the near plane. */
    near?: number | undefined;
}

/** A light at infinity; `direction` is that toward the light. */
export interface DirectionalLight {
    kind: "directional";
    direction: Vector3;
    color?: Color | undefined;
    /** Whether objects cast shadows in its light; of one light at most. */
    shadow?: boolean | undefined;
}

/** A light that shines in all directions, and does not fade. */
export interface PointLight {
    kind: "point";
    position: Vector3;
    color?: Color | undefined;
    shadow?: boolean | undefined;
}

/** A light that shines into a cone about `direction`; its angles are in degrees, 0..180. */
export interface SpotLight {
    kind: "spot";
    position: Vector3;
    direction: Vector3;
    color?: Color | undefined;
    /** Up to which its light is full; 0 by default. */
    innerAngle?: number | undefined;
    /** At which its light ends; 45 by default. */
    outerAngle?: number | undefined;
    shadow?: boolean | undefined;
}

export type Light = DirectionalLight | PointLight | SpotLight;

/** A vertical gradient; `bottom` is the colour of the top by default. */
export interface Background {
    top?: Color | undefined;
    bottom?: Color | undefined;
}

/** Light from above (+y) and below, in proportion to the ambient coefficients; `ground` is black by default. */
export interface Hemisphere {
    sky: Color;
    ground?: Color | undefined;
}

/** Light along the outlines of objects; `power` is a whole number from 1, wide, to 16, narrow, by default 3. */
export interface Rim {
    color: Color;
    power?: number | undefined;
}

/** Fog between two distances along the line of sight: where it begins, and where it hides everything. */
export interface Fog {
    color: Color;
    near: number;
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
    color: Color;
    /** Its y in the world; just below the lowest vertex by default. */
    height?: number | undefined;
    /** Where nothing is left of it, above 0; a multiple of the size of the objects by default. */
    radius?: number | undefined;
    /** Its x and z in the world; the middle of the objects by default. */
    center?: readonly [number, number] | undefined;
    /** Where it begins to fade, at least 0 and below the radius; 0.4 of the radius by default. */
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
    /** Whether edges are smoothed, by four samples per pixel. */
    antialias?: boolean | undefined;
    /** Scenes with one of the following are always antialiased. */
    hemisphere?: Hemisphere | undefined;
    rim?: Rim | undefined;
    fog?: Fog | undefined;
    tone?: Tone | undefined;
    ground?: Ground | undefined;
    /** In pixels, 1..2048; 128 by default. */
    width?: number | undefined;
    height?: number | undefined;
}

/** A part of the canvas, in pixels from the top left corner. */
export interface Rectangle {
    x: number;
    y: number;
    width: number;
    height: number;
}
