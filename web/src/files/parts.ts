// From the triangles of a file to meshes: one for each texture, opacity and kind of surface.

import { InputError } from "../errors.js";
import { clamped, cross, length, subtract, type Vector } from "../scene/arithmetic.js";
import type { Mesh, Texture } from "../scene/checked.js";
import type { Rgb } from "../scene/checks.js";
import { cornerNormals } from "../scene/normals.js";
import { rowsOf } from "../scene/topology.js";
import { weld } from "../scene/weld.js";
import { isPlain, textureOf, tint, type Picture } from "./images.js";
import { plural, type Source } from "./source.js";

export const GREY: Rgb = [200, 200, 200];
/** A triangle that is thinner than this part of its length has no area but by rounding. */
const THIN = 1e-6;

/** What a file says of a surface. gloss: roughness and metalness. */
export interface Surface {
    picture?: Picture | undefined;
    opacity: number;
    emission: Rgb;
    unlit: boolean;
    twoSided: boolean;
    gloss?: readonly [number, number] | undefined;
}

export const PLAIN: Surface = { opacity: 1, emission: [0, 0, 0], unlit: false, twoSided: false };

/**
 * Triangles, by their corners. faces: vertices of corners. colors: four bytes a corner. normals: three numbers a corner,
 * zeros where there are none. uvs: two a corner. surface: the number of that of each triangle, by default the first one.
 */
export interface Triangles {
    positions: Float64Array;
    faces: Uint32Array;
    colors: Uint8Array;
    normals?: Float64Array | undefined;
    uvs?: Float64Array | undefined;
    surface?: ArrayLike<number> | undefined;
    surfaces: readonly Surface[];
}

/** A mesh of a file. highlights: strength and exponent, where the file tells of them. */
export interface Part extends Omit<Surface, "picture" | "gloss"> {
    mesh: Mesh;
    texture: Texture | undefined;
    highlights: readonly [number, number] | undefined;
}

/** Triangles of one mesh. gloss: sums of roughness, metalness and 1, by area. */
interface Group {
    own: number[];
    surface: Surface;
    gloss: number[];
}

/** Return the triangles as meshes. Those at no finite numbers are left out. InputError if none has an area. */
export function partsOf(
    { positions, faces, colors, normals, uvs, surface, surfaces }: Triangles,
    source: Source,
): Part[] {
    const images = [...new Set(surfaces.map(({ picture }) => picture?.image))];
    const groups = new Map<string, Group>();
    const lists = surfaces.map((): number[] => []);
    const area = (_: unknown, triangle: number): number => areaOf(positions, faces.subarray(3 * triangle));
    const areas = Float64Array.from({ length: faces.length / 3 }, area);
    areas.forEach((area, triangle) => Number.isNaN(area) || lists[surface?.[triangle] ?? 0].push(triangle));
    const lost = areas.filter(Number.isNaN).length;
    if (lost === areas.length)
        throw new InputError(lost ? "none of its triangles has vertices at finite numbers" : "it has no triangles");
    if (lost)
        source.tell(
            `${plural(lost, "triangle")} left out, with vertices that do not exist or are not at finite numbers`,
        );
    if (!areas.some((area) => area > 0))
        throw new InputError(`there is nothing to see: none of its ${plural(areas.length, "triangle")} has an area`);
    lists.forEach((list, number) => {
        if (!list.length) return;
        const { gloss, ...kind } = surfaces[number];
        if (kind.picture && uvs && isPlain(kind.picture, uvs, list)) {
            tint(colors, kind.picture, uvs, list);
            kind.picture = undefined;
        }
        const isClear = list.some((triangle) => [3, 7, 11].some((at) => colors[12 * triangle + at] < 255));
        const { picture, ...plain } = kind;
        const shown = picture && { ...picture, image: images.indexOf(picture.image) };
        const key = JSON.stringify([shown, plain, isClear]);
        const group: Group = groups.get(key) ?? { own: [], surface: kind, gloss: [0, 0, 0] };
        groups.set(key, group);
        const area = list.reduce((sum, triangle) => sum + areas[triangle], 0);
        if (gloss) group.gloss = group.gloss.map((sum, at) => sum + area * [...gloss, 1][at]);
        for (const triangle of list) group.own.push(triangle);
    });
    const pictures = new Set([...groups.values()].flatMap(({ surface: { picture } }) => picture?.image ?? [])).size;
    const parts = [...groups.values()].map(({ own, surface: { picture, ...kind }, gloss: [rough, metal, known] }) => {
        const triangles = Uint32Array.from(own);
        const of = <T extends Float64Array | Uint8Array | Uint32Array>(table: T, width: number): T =>
            rowsOf(table, triangles, 3 * width);
        const corners = of(faces, 1);
        const shown = picture && uvs && textureOf(picture, of(uvs, 2), pictures, source);
        const table = {
            rgba: of(colors, 4),
            normals: normals && filled(positions, corners, of(normals, 3)),
            uvs: shown?.uvs,
        };
        const highlights = known > 0 && !kind.unlit ? highlightsOf(rough / known, metal / known) : undefined;
        return { ...kind, mesh: weld(positions, corners, table), texture: shown?.texture, highlights };
    });
    if (parts.some(isVisible)) return parts;
    // of writers without transparency, and where Tr of OBJ files means the opposite
    source.tell("its opacity is 0 everywhere, which cannot be meant; it is drawn opaque");
    return parts.map((part) => ({
        ...part,
        mesh: { ...part.mesh, opacities: undefined },
        texture: part.texture && { ...part.texture, alpha: undefined, cutoff: 0 },
        opacity: 1,
    }));
}

function isVisible({ opacity, mesh, texture }: Part): boolean {
    const cutoff = Math.max(texture?.cutoff ?? 0, 1);
    const isSomewhere = texture?.alpha?.some((level) => level >= cutoff) ?? true;
    return opacity > 0 && (mesh.opacities?.some(Boolean) ?? true) && isSomewhere;
}

/** Return strength and exponent, with Beckmann's roughness of Blinn-Phong; the strength is a matter of taste. */
function highlightsOf(roughness: number, metalness: number): [number, number] {
    const exponent = clamped(2 / Math.max(roughness, 0.1) ** 4 - 2, 10, 128);
    return [Math.round(1000 * (0.8 + 0.3 * metalness) * (1 - roughness)) / 1000, Math.round(exponent)];
}

/** Return the normals of corners, computed where there are none; undefined if there are none at all. */
function filled(positions: Float64Array, faces: Uint32Array, normals: Float64Array): Float64Array | undefined {
    const isAbsent = (at: number): boolean => !normals[at] && !normals[at + 1] && !normals[at + 2];
    const absent = Array.from(faces, (_, corner) => 3 * corner).filter(isAbsent);
    if (absent.length === faces.length) return undefined;
    const computed = absent.length ? cornerNormals(positions, faces, null) : normals;
    for (const at of absent) normals.set(computed.subarray(at, at + 3), at);
    return normals;
}

/** Return the area of a triangle, twice; 0 if it has none but by rounding, NaN if it is not at finite numbers. */
function areaOf(positions: Float64Array, [a, b, c]: Uint32Array): number {
    // halved, for the difference of two numbers may be beyond the largest
    const [p, q, r] = [a, b, c].map((vertex) => [0, 1, 2].map((axis) => positions[3 * vertex + axis] / 2) as Vector);
    const [u, v] = [subtract(q, p), subtract(r, p)];
    const most = Math.max(...[...u, ...v, ...subtract(u, v)].map(Math.abs));
    if (!(most > 0 && most < Infinity)) return most;
    const [unitU, unitV] = [u, v].map((edge) => edge.map((x) => x / most) as Vector);
    const area = length(cross(unitU, unitV));
    return area > THIN ? 4 * area * most * most : 0;
}

/** Return what corners have of a table of vertices, in rows of so many numbers; a note tells of what is not finite. */
export function ofCorners(
    rows: ArrayLike<number>,
    width: number,
    vertices: Uint32Array,
    what: string,
    { tell }: Source,
): Float64Array {
    const value = (_: unknown, at: number): number => rows[width * vertices[Math.floor(at / width)] + (at % width)];
    const found = Float64Array.from({ length: width * vertices.length }, value);
    const bad = found.filter((x) => !Number.isFinite(x)).length;
    if (bad) tell(`${what} that are not finite numbers are not used: ${bad.toLocaleString("en")}`);
    return bad ? found.map((x) => (Number.isFinite(x) ? x : 0)) : found;
}

/** Return a channel of a colour, 0..`largest`, as a byte. */
export function toByte(level: number, largest: number): number {
    if (!Number.isFinite(level)) throw new InputError("it has a colour that is not finite numbers");
    return Math.round((clamped(level, 0, largest) * 255) / largest);
}

/** Return a level of sRGB, 0..1, as a linear one. */
export function toLinear(level: number): number {
    return level <= 0.04045 ? level / 12.92 : ((level + 0.055) / 1.055) ** 2.4;
}

/** Return a linear level, 0..1, as a byte of sRGB. */
export function toSrgb(linear: number): number {
    const value = clamped(linear, 0, 1);
    return Math.round(255 * (value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055));
}
