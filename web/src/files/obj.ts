// Wavefront OBJ with its MTL materials, by three.js.

import { Matrix3, type Mesh } from "three";
import { MTLLoader } from "three/examples/jsm/loaders/MTLLoader.js";
import { OBJLoader } from "three/examples/jsm/loaders/OBJLoader.js";
import { InputError } from "../errors.js";
import { clamped, type Vector } from "../scene/arithmetic.js";
import { pictureBeside, type Picture } from "./images.js";
import { GREY, PLAIN, toByte, toLinear, type Triangles } from "./parts.js";
import { earsOf } from "./polygons.js";
import { baseOf, fileBeside, plural, textOf, withPoints, type Source } from "./source.js";
import { trianglesOf, type Shown } from "./three.js";

/** Lines that the loader does not read, or that make it take the faces of an object for lines; and those of no effect. */
const OTHERS = /^[ \t]*(?!(?:v|vt|vn|f|g|o|s|usemtl|mtllib)[ \t]|[#\s])(\S+)(.*)\n?/gm;
/** Lines that go on in the next one; of comments and names, a backslash at the end is a part. */
const JOINED = /^(?!\s*(?:#|(?:usemtl|mtllib|g|o)\s))(.*)\\\n/gm;
/** Lines that end with a name. */
const NAMED = /^[ \t]*(usemtl|mtllib|newmtl|map_\w+)[ \t]+(.*)/gm;
/** Statements of materials that are followed by numbers. */
const OF_NUMBERS = "K[ades]|N[is]|d|Tr|Tf";
const SILENT = /^(g|o|s|mg|bevel|[cd]_interp|lod|shadow_obj|trace_obj)$/;
const NAMES: Record<string, string> = { p: "point", l: "line", curv: "curve", surf: "curved surface" };

/** Return the triangles of an OBJ file, all its groups and objects. */
export async function readObj(source: Source): Promise<Triangles> {
    const { tell } = source;
    const leftOut = new Map<string, number>();
    const lines = `${withPoints(textOf(source.bytes), source, "v|vn|vt")}\n`
        .replace(JOINED, "$1 ")
        .replace(OTHERS, (_, key: string, rest: string) => {
            const count = key === "p" ? rest.trim().split(/\s+/).length : 1;
            if (!SILENT.test(key)) leftOut.set(key, (leftOut.get(key) ?? 0) + count);
            return "";
        });
    const text = withColors(cutPolygons(bareNames(lines)));
    const list = [...leftOut]
        .slice(0, 8)
        .map(([key, count]) => plural(count, NAMES[key] ?? `statement '${key.slice(0, 20)}'`));
    if (!/^[ \t]*f[ \t]/m.test(text))
        throw new InputError(`it has no faces${list.length ? `, only ${list.join(", ")}` : ""}; only faces are drawn`);
    const comma = /^[ \t]*f[ \t][^#\n]*,.*/m.exec(text)?.[0].trim().slice(0, 60);
    if (comma) throw new InputError(`its face '${comma}' has a comma; numbers are separated by spaces, and have none`);
    if (list.length) tell(`${list.join(", ")} left out; only faces are drawn`);
    if (/^#MRGB/m.test(text)) tell("colours of ZBrush (#MRGB) are left out");
    const root = new OBJLoader().parse(text) as ReturnType<OBJLoader["parse"]> & { materialLibraries: string[] };
    const materials: Record<string, Record<string, string | number[]>> = {};
    for (const name of root.materialLibraries.flatMap((each) => each.match(/\S.*?\.mtl(?!\S)|\S.*/gi) ?? [])) {
        const file = fileBeside(source, name);
        const text = file && bareNames(withPoints(textOf(file.bytes), source, OF_NUMBERS));
        if (text !== undefined) Object.assign(materials, new MTLLoader().parse(text, "").materialsInfo);
        else tell(`its materials are left out: ${baseOf(name)} is not among the files that were given`);
    }
    const looks = new Map<string, Shown>();
    const meshes = root.children.filter((each): each is Mesh => (each as Mesh).isMesh);
    const names = new Set(meshes.flatMap(({ material }) => [material].flat().map(({ name }) => name)));
    const pictures = new Map<string, Picture | undefined>();
    for (const name of names) looks.set(name, await lookOf(materials[name], source, pictures));
    const missing = [...names].filter((name) => name && !materials[name]);
    if (missing.length && Object.keys(materials).length)
        tell(`materials that no file has, drawn in light grey: ${missing.slice(0, 5).join(", ")}`);
    for (const { geometry } of meshes) {
        // normals of faces, by the loader
        if (!/^[ \t]*vn[ \t]/m.test(text)) geometry.deleteAttribute("normal");
    }
    return trianglesOf(root, source.bytes.length, ({ name }, { geometry }) => {
        const look = looks.get(name) as Shown;
        // a texture, or else colours of vertices, replace the colour of the material
        if (look.surface.picture) geometry.deleteAttribute("color");
        return geometry.attributes.color ? { ...look, factor: [1, 1, 1] } : look;
    });
}

/** Return the text with names without comments, quotes and several spaces. */
function bareNames(text: string): string {
    return text.replace(NAMED, (_, key: string, name: string) => {
        const plain = name.replace(/(^|\s)#(?=\s|$).*/, "").replaceAll(/["']/g, "");
        return `${key} ${plain.trim().replace(/\s+/g, " ")}`;
    });
}

/** Return the text with a colour in fractions for each vertex, if one has any: the loader mixes up those of some only. */
function withColors(text: string): string {
    const vertices = /^([ \t]*v(?:[ \t]+\S+){3})((?:[ \t]+\S+){3})?.*$/gm;
    const levels = [...text.matchAll(vertices)].flatMap(([, , color]) => color?.trim().split(/\s+/).map(Number) ?? []);
    if (!levels.length) return text;
    const largest = levels.some((level) => level > 1) ? 255 : 1;
    return text.replace(vertices, (_, place: string, color: string | undefined) => {
        const own = color
            ?.trim()
            .split(/\s+/)
            .map((level) => Number(level) / largest);
        return `${place} ${(own?.every(Number.isFinite) ? own : GREY.map((level) => level / 255)).join(" ")}`;
    });
}

/** Return the text with triangles in place of polygons that are not convex, which the loader would cut as if they were. */
function cutPolygons(text: string): string {
    const polygons = /^[ \t]*f((?:[ \t]+\d\S*){4,})[ \t]*$/gm;
    if (!polygons.test(text)) return text;
    const points = [...text.matchAll(/^[ \t]*v[ \t]+(\S+)[ \t]+(\S+)[ \t]+(\S+)/gm)].map(
        (words) => words.slice(1).map(Number) as Vector,
    );
    return text.replace(polygons, (line, list: string) => {
        const corners = list.trim().split(/\s+/);
        const outline = corners.map((corner) => points[parseInt(corner) - 1]);
        const ears = outline.every(Boolean) ? earsOf(outline, `the face ${line.trim().slice(0, 20)}...`) : undefined;
        return ears?.map((ear, at) => `${at % 3 ? "" : "\nf"} ${corners[ear]}`).join("") ?? line;
    });
}

/** Return how a material looks, undefined for none, which is light grey. pictures: those that were read, by their names. */
async function lookOf(
    own: Record<string, string | number[]> | undefined,
    source: Source,
    pictures: Map<string, Picture | undefined>,
): Promise<Shown> {
    const bytes = (key: string, or: number): number[] => {
        const levels = (own?.[key] as number[] | undefined) ?? [or, or, or];
        // one number is all of them
        return levels.map((level) => toByte(Number.isFinite(level) ? level : levels[0], 1));
    };
    const surface = { ...PLAIN, opacity: clamped(Number(own?.d ?? 1 - Number(own?.tr ?? 0)) || 0, 0, 1) };
    if (own && !own.map_ke) surface.emission = bytes("ke", 0) as unknown as typeof surface.emission;
    const unread = Object.keys(own ?? {}).filter((key) => /^(map_(?!k[ad]$)|bump|norm|disp|decal|refl)/.test(key));
    if (unread.length) source.tell(`of its materials are left out: ${unread.join(", ")}`);
    const factor = (own ? bytes("kd", 1) : GREY).map((level) => toLinear(level / 255));
    let map = String(own?.map_kd ?? own?.map_ka ?? "").replaceAll('"', "");
    let [scale, offset, wrap] = [[1, 1], [0, 0], "repeat" as "repeat" | "clamp"];
    for (
        let found;
        (found = /^-(\w+)((?:\s+(?:on|off|[-+.\d]+(?!\S)))*)\s+/.exec(map));
        map = map.slice(found[0].length)
    ) {
        const [, option, words] = found;
        const numbers = words.trim().split(/\s+/).map(Number);
        if (option === "s") scale = [numbers[0], numbers[1] ?? 1];
        else if (option === "o") offset = [numbers[0], numbers[1] ?? 0];
        else if (option === "clamp") wrap = words.includes("on") ? "clamp" : "repeat";
        else source.tell(`the option -${option} of a texture is left out`);
    }
    if (map && !pictures.has(map)) pictures.set(map, await pictureBeside(source, map));
    const picture = pictures.get(map);
    if (!picture) return { surface, factor };
    const matrix = new Matrix3(scale[0], 0, offset[0], 0, -scale[1], 1 - offset[1], 0, 0, 1);
    return { surface: { ...surface, picture: { ...picture, wraps: [wrap, wrap] } }, factor: [1, 1, 1], matrix };
}
