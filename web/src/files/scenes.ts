// Scene files with the mesh files and images that they name.

import { parse } from "smol-toml";
import { keyOf, type StoredMesh } from "../document/document.js";
import { digestOf, openSceneFile, storedMesh, textureTable, type Library, type Made } from "../document/save.js";
import { InputError, show } from "../errors.js";
import { checkedMesh, type Mesh, type Texture } from "../scene/checked.js";
import { parseJson } from "../scene/file.js";
import { shadedMesh } from "../scene/normals.js";
import { COLOR_KEYS } from "../scene/plain.js";
import { hides, imageOf, textureOf } from "./images.js";
import { formatOf } from "./kinds.js";
import type { Part } from "./parts.js";
import { baseOf, fileBeside, plural, textOf, titleOf, type Given, type Source } from "./source.js";

type Keys = Record<string, unknown>;

/** What turns an axis up to y: signs and numbers, from 1, of the old columns. */
const TURNS: Record<string, number[]> = { x: [-2, 1, 3], y: [1, 2, 3], z: [1, 3, -2] };

/** Return the document of a scene file. library: of pieces. read: returns the parts of a mesh file. */
export async function readScene(
    source: Source,
    library: Library | undefined,
    read: (source: Source) => Promise<Part[]>,
): Promise<Made> {
    const about = { title: titleOf(source), notice: "", licence: "" };
    const text = textOf(source.bytes);
    const table = (formatOf(source) === ".toml" ? plain(tomlOf(text)) : parseJson(text)) as Keys;
    const own = new Map<string, StoredMesh>();
    const given = Array.isArray(table.objects) ? (table.objects as Keys[]) : [];
    const objects: Keys[] = [];
    for (const [number, object] of given.entries()) {
        const where = `objects[${number}]`;
        const { texture: image, ...material } = (object?.material ?? {}) as Keys;
        const texture = isNamed(image) ? await textureFile(image, `${where}.material.texture`, source) : undefined;
        if (typeof object?.mesh !== "string") {
            objects.push(texture ? { ...object, material: { ...material, texture: textureTable(texture) } } : object);
            continue;
        }
        const file = needed(object.mesh, `${where}.mesh`, source);
        const parts = await read({ ...source, ...file, tell: (note) => source.tell(`${where}.mesh: ${note}`) });
        for (const part of parts) {
            const { up_axis: up = formatOf(file) === ".stl" && !object.rotation ? "z" : "y", ...rest } = object;
            const turn = TURNS[String(up)];
            if (!turn) throw new InputError(`${where}.up_axis must be "x", "y" or "z", not ${show(up)}`);
            const turned = (_: number, at: number, table: Float64Array): number =>
                Math.sign(turn[at % 3]) * table[at - (at % 3) + Math.abs(turn[at % 3]) - 1] + 0;
            const { positions, normals } = part.mesh;
            let mesh: Mesh = { ...part.mesh, positions: positions.map(turned), normals: normals?.map(turned) };
            let { shading } = material;
            if (shading === "smooth" && object.crease === undefined) ({ mesh, shading } = shadedMesh(mesh, null));
            const key = digestOf(mesh, mesh.normals, texture ?? part.texture);
            own.set(key, storedMesh(checkedMesh(mesh, file.name), texture ?? part.texture, about));
            const { opacity, twoSided: two_sided } = part;
            const surface = { ...material, ...(shading !== undefined && { shading }) };
            objects.push({ opacity, two_sided, ...rest, mesh: { file: key }, material: surface });
        }
    }
    const all: Library = {
        load: async (refs) => {
            const others = refs.filter((ref) => !own.has(keyOf(ref)));
            if (others.length && !library)
                throw new InputError(`it names ${plural(others.length, "piece")} of datasets, which are not here`);
            if (others.length) await library?.load(others);
        },
        get: (ref) => own.get(keyOf(ref)) ?? (library as Library).get(ref),
    };
    const made = await openSceneFile(given.length ? { ...table, objects } : table, all, about);
    return { document: made.document, meshes: new Map([...own, ...made.meshes]) };
}

/** Return a file that a scene file names. */
function needed(name: string, where: string, source: Source): Given {
    const file = fileBeside(source, name);
    if (file) return file;
    const both = "which was not given: choose or drop both files, or a ZIP file of them";
    throw new InputError(`${where} names ${baseOf(name)}, ${both}`);
}

function tomlOf(text: string): Keys {
    try {
        return parse(text, { integersAsBigInt: true });
    } catch (error) {
        throw new InputError(`it is not valid TOML: ${(error as Error).message.split("\n")[0]}`);
    }
}

/** Return a value of TOML as JSON has it: with numbers, and bytes for colours in fractions. */
function plain(value: unknown, key = ""): unknown {
    if (typeof value === "bigint") return Number(value);
    if (Array.isArray(value)) {
        const isFraction = (level: unknown): boolean => typeof level === "number" && level >= 0 && level <= 1;
        const areFractions = COLOR_KEYS.has(key) && value.every(isFraction);
        return value.map((each: unknown) => (areFractions ? Math.round(255 * (each as number)) : plain(each)));
    }
    if (typeof value !== "object" || value === null || value instanceof Date) return value;
    return Object.fromEntries(Object.entries(value).map(([name, each]) => [name, plain(each, name)]));
}

/** Return whether a texture is named, not inside of the scene file. */
function isNamed(texture: unknown): texture is string | Keys {
    return typeof texture === "string" || (texture as Keys | undefined)?.image !== undefined;
}

/** Return the texture that a scene file names; undefined, with a note, if it cannot be read. */
async function textureFile(value: string | Keys, where: string, source: Source): Promise<Texture | undefined> {
    const keys: Keys = typeof value === "string" ? { image: value } : value;
    const name = baseOf(String(keys.image));
    const image = await imageOf(needed(String(keys.image), where, source).bytes, name, source);
    if (!image) return undefined;
    const { filter = "bilinear", wrap = "repeat", cutoff = 0 } = keys as Partial<Texture>;
    const hasAlpha = keys.alpha === true && hides(image);
    const picture = { image, name, hasAlpha, filter, wraps: [wrap, wrap] as const, cutoff };
    return textureOf(picture, new Float64Array(0), 1, source).texture;
}
