// Scenes of mesh files: as a product is photographed. src/shackled/scene/_staging.py, _look.py and _canvas.py say why.

import { boundsOfPoints } from "../document/measure.js";
import { InputError } from "../errors.js";
import { boundsOf, cross, dot, fromEuler, length, rowOf, subtract, times } from "../scene/arithmetic.js";
import type { Quaternion, Vector } from "../scene/arithmetic.js";
import { worldPositions, type Mesh, type SceneObject } from "../scene/checked.js";
import { cornerNormals, creased, isFlat, withoutNormals } from "../scene/normals.js";
import { loadSimplifier, reduced, simplify } from "../scene/simplify.js";
import { frame, halfHeightOf, keyLight, type Viewpoint } from "../scene/staging.js";
import type { Scene } from "../scene/types.js";
import { rowsOf } from "../scene/topology.js";
import { rgbaOf, weld } from "../scene/weld.js";
import { wound } from "../scene/winding.js";
import type { Part } from "./parts.js";
import { plural } from "./source.js";

/** A mesh file: its parts, whether z is up in it, and where notes of it go. */
export interface Model {
    parts: readonly Part[];
    isZUp: boolean;
    tell: (note: string) => void;
}

const LENS = { margin: 0.15, projection: "perspective", halfHeight: halfHeightOf(30), aspect: 1 } as const;
/** Where the viewer stands, the higher the flatter the model is. */
const [AZIMUTH, ELEVATION, FLAT_ELEVATION] = [35, 20, 40];
/** Toward the light: right, up and toward the viewer. */
const KEY_LIGHT: Vector = [-0.6, 0.7, 0.9];
const MATERIAL = { ambient: 0.32, diffuse: 0.8, specular: 0.4, shininess: 28 };
/** Light, or dark where most of the surface is light, so that no outline is lost. */
const LIGHT_BACKGROUND = { top: [120, 130, 148], bottom: [196, 202, 212] } as const;
const DARK_BACKGROUND = { top: [16, 19, 25], bottom: [58, 64, 75] } as const;
/** The brightness from which a colour is light: in the light of a mesh file, and unlit. */
const [LIT, UNLIT] = [215, 115];
const LUMA: Vector = [0.2126, 0.7152, 0.0722];
/** The most vertices of what is not culled that has two sides unless the file says so. */
const MOST_TWO_SIDED = 16384;
/** Models of more triangles are simplified: one for so many pixels of the canvas, or this number if that is more. */
const [PIXELS, FEWEST] = [8, 4096];
/** Of so many times as many, normals and the like are computed of no more than this multiple. */
const ROUGH = 8;
/** Where more of the faces have corners of different colours, the colours are a picture, as fine as a pixel. */
const PAINTED = 0.01;
/** Between models that stand in a row: a part of the width of the widest. */
const GAP = 0.2;

/** Return the scene of models, each in a sphere of radius 1, and the numbers of those that its objects are of. */
export async function staged(
    models: readonly Model[],
    size: number,
    most?: number | "all",
): Promise<[Scene, number[]]> {
    const groups: SceneObject[][] = [];
    for (const model of models) groups.push(await objectsOf(model, size, most));
    const shown = placed(groups);
    const count = shown.reduce((sum, { cull, mesh }) => sum + (cull ? 0 : mesh.positions.length / 3), 0);
    const isSmall = count <= MOST_TWO_SIDED;
    const objects = shown.map((each) => ({ ...each, twoSided: !each.cull && (each.twoSided || isSmall) }));
    const points = worldPositions(objects);
    const [low, high] = boundsOf(points);
    const [x, y, z] = subtract(high, low);
    const flatness = Math.max(1 - (2 * y) / (Math.max(x, z) || 1), 0);
    const elevation = ELEVATION + flatness * (FLAT_ELEVATION - ELEVATION);
    const view: Viewpoint = { ...LENS, azimuth: AZIMUTH, elevation };
    const scene: Scene = {
        objects,
        camera: frame(points, view),
        lights: [{ ...keyLight(view, KEY_LIGHT), color: [255, 243, 226] }],
        background: isLight(objects) ? DARK_BACKGROUND : LIGHT_BACKGROUND,
        ambientLight: [232, 240, 255],
        antialias: true,
        width: size,
        height: size,
    };
    return [scene, groups.flatMap((group, model) => group.map(() => model))];
}

/** Return the objects of a model, with as many triangles as the canvas shows, or as are asked for. */
async function objectsOf({ parts, isZUp, tell }: Model, size: number, asked?: number | "all"): Promise<SceneObject[]> {
    if (isZUp) tell("it is read as z up, and turned upright");
    const countOf = (some: readonly { mesh: Mesh }[]): number =>
        some.reduce((sum, { mesh }) => sum + mesh.faces.length / 3, 0);
    const [total, pixels] = [countOf(parts), size * size];
    const most = asked ?? Math.max(parts.some(({ mesh }) => isPainted(mesh)) ? pixels : pixels / PIXELS, FEWEST);
    const isLarge = most !== "all" && total > most;
    if (isLarge) await loadSimplifier();
    const share = (most as number) / total;
    const isHuge = isLarge && asked === undefined && 2 * ROUGH * share < 1;
    const given = isHuge ? parts.map((part) => ({ ...part, mesh: less(part.mesh, ROUGH * share) })) : parts;
    const solid = given.map((part) => ({ ...part, isOpaque: isOpaque(part) }));
    const { parts: found, turned } = wound(solid, asked === undefined);
    if (turned) tell(`${plural(turned, "closed part")} wound inside out, now turned`);
    const rotation: Quaternion = isZUp ? fromEuler([-90, 0, 0]) : [0, 0, 0, 1];
    const objects = found.map((part): SceneObject => {
        const object = objectOf(part, rotation);
        if (!isLarge) return object;
        if (asked !== undefined)
            return smoothed({ ...object, mesh: simplify(object.mesh, asked as number) }, object.mesh);
        const mesh = less(rounded(object), (share * total) / countOf(found));
        const shown = mesh.normals && isFlat(mesh) ? withoutNormals(mesh) : mesh;
        const shading = part.unlit ? "unlit" : shadingOf(shown);
        return { ...object, mesh: shown, material: { ...object.material, shading } };
    });
    const why = asked === undefined ? `, as ${size} x ${size} pixels show no more` : "";
    const [before, after] = [total, countOf(objects)].map((count) => count.toLocaleString("en"));
    if (before !== after) tell(`it is simplified from ${before} to ${after} triangles${why}`);
    return objects;
}

/** Return a mesh with a share of its triangles, or itself if that cannot be. */
function less(mesh: Mesh, share: number): Mesh {
    try {
        return reduced(mesh, Math.ceil((mesh.faces.length / 3) * share));
    } catch (error) {
        if (error instanceof InputError) return mesh;
        throw error;
    }
}

function isOpaque({ opacity, mesh, texture }: Part): boolean {
    return opacity === 1 && !mesh.opacities && !(texture?.alpha && !texture.cutoff);
}

/** Return a part in the shading that suits its normals, unless the file says which. */
function objectOf(part: Part & { cull: boolean }, rotation: Quaternion): SceneObject {
    const { unlit, highlights, emission, texture, opacity, twoSided, cull } = part;
    let mesh = part.mesh;
    if (!unlit) mesh = mesh.normals ? (isFlat(mesh) ? withoutNormals(mesh) : mesh) : creased(mesh, null);
    const [specular, shininess] = highlights ?? [MATERIAL.specular, MATERIAL.shininess];
    const shading = unlit ? "unlit" : shadingOf(mesh);
    const material = { ...MATERIAL, shading, specular, shininess, emission, texture } as const;
    const place = { position: [0, 0, 0] as Vector, rotation, scale: 1, fade: undefined };
    return { ...place, mesh, material, cull, twoSided, opacity, wireframe: false };
}

function shadingOf({ normals }: Mesh): "smooth" | "flat" {
    return normals ? "smooth" : "flat";
}

/** Return the mesh of an object with normals, which a fine one also has where its faces are nearly in one plane. */
function rounded({ mesh, material }: SceneObject): Mesh {
    if (mesh.normals || material.shading === "unlit") return mesh;
    const { positions, faces, uvs } = mesh;
    const normals = cornerNormals(positions, faces, null);
    return weld(positions, faces, { rgba: rowsOf(rgbaOf(mesh), faces, 4), normals, uvs: uvs && rowsOf(uvs, faces, 2) });
}

/** Return an object with new normals, if its mesh had some. */
function smoothed(object: SceneObject, before: Mesh): SceneObject {
    if (object.material.shading !== "smooth" || object.mesh === before) return object;
    const mesh = creased(object.mesh, null);
    return { ...object, mesh, material: { ...object.material, shading: shadingOf(mesh) } };
}

function isPainted({ faces, colors }: Mesh): boolean {
    let count = 0;
    for (let face = 0; face < faces.length; face += 3) {
        const [a, b, c] = [3 * faces[face], 3 * faces[face + 1], 3 * faces[face + 2]];
        for (let channel = 0; channel < 3; channel++) {
            const level = colors[a + channel];
            if (level === colors[b + channel] && level === colors[c + channel]) continue;
            count++;
            break;
        }
    }
    return count > (PAINTED * faces.length) / 3;
}

/** Return objects with their places: models in spheres of radius 1; several side by side, on one level. */
function placed(groups: readonly SceneObject[][]): SceneObject[] {
    const spheres = groups.map((group) => {
        const points = worldPositions(group);
        const [low, high] = boundsOf(points);
        const { middle, radius } = boundsOfPoints(points);
        if (!(radius < Infinity && 1 / radius < Infinity))
            throw new InputError("its coordinates are too large or too small to be scaled");
        return { middle: middle as Vector, scale: 1 / radius, half: times(0.5 / radius, subtract(high, low)) };
    });
    const gap = GAP * Math.max(...spheres.map(({ half }) => 2 * half[0]));
    let right = -spheres.reduce((sum, { half }) => sum + half[0], (gap * (groups.length - 1)) / 2);
    return groups.flatMap((group, model) => {
        const { middle, scale, half } = spheres[model];
        const own: Vector = [right + half[0], half[1] - spheres[0].half[1], 0];
        right += 2 * half[0] + gap;
        const position = subtract(groups.length > 1 ? own : [0, 0, 0], times(scale, middle));
        return group.map((each) => ({ ...each, position, scale }));
    });
}

/** Return whether most of the surface of objects is light. */
function isLight(objects: readonly SceneObject[]): boolean {
    let [light, total] = [0, 0];
    for (const { mesh, material, scale } of objects) {
        const pixels = material.texture?.pixels ?? Uint8Array.of(255, 255, 255);
        const mean = [0, 0, 0];
        pixels.forEach((level, at) => (mean[at % 3] += level / 255 / (pixels.length / 3)));
        const limit = material.shading === "unlit" ? UNLIT : LIT;
        for (let face = 0; face < mesh.faces.length; face += 3) {
            const corners = [...mesh.faces.subarray(face, face + 3)];
            const [a, b, c] = corners.map((vertex) => times(scale, rowOf(mesh.positions, vertex)));
            const area = length(cross(subtract(b, a), subtract(c, a)));
            const [p, q, r] = corners.map((vertex) => mesh.colors.subarray(3 * vertex, 3 * vertex + 3));
            const color = mean.map((level, at) => (level * (p[at] + q[at] + r[at])) / 3) as Vector;
            if (dot(color, LUMA) >= limit) light += area;
            total += area;
        }
    }
    return 2 * light > total;
}
