// Files that people open: mesh files, scene files, pictures with their scene, calls, and ZIP files of them.

import { InputError } from "../errors.js";
import { documentOfScene, type Library, type Made } from "../document/save.js";
import { decodeCall } from "../scene/decode.js";
import type { Scene } from "../scene/types.js";
import { readFile } from "../scene/call_file.js";
import { Images } from "./images.js";
import { contentOf, formatOf, gunzipped, namedFormat } from "./kinds.js";
import { readOff } from "./off.js";
import { partsOf, type Part, type Triangles } from "./parts.js";
import { readPly } from "./ply.js";
import { readScene } from "./scenes.js";
import { baseOf, extensionOf, titleOf, type Given, type Source } from "./source.js";
import { staged, type Model } from "./staging.js";
import { unzipped } from "./zip.js";

export type { Given } from "./source.js";

export interface Options {
    /** The canvas, in pixels, for mesh files. */
    size: number;
    /** To how many triangles meshes are simplified; by default to what the canvas shows. */
    maxTriangles?: number | "all" | undefined;
    /** Of the pieces that scene files name. */
    library?: Library | undefined;
    /** Returns the decoder of Draco's meshes. */
    draco?: (() => Promise<Uint8Array>) | undefined;
    /** Returns a file that was not given, by the name that one of those that were gives it. */
    beside?: ((name: string) => Given | undefined) | undefined;
}

/** What was opened: its document, the meshes of it by their keys, and a line for each thing that is not as in the file. */
export interface Opened extends Made {
    notes: string[];
}

/** The most bytes of all files, as they are and unpacked, and files of a ZIP file. */
const [MOST_BYTES, MOST_FILES] = [100 * 2 ** 20, 1000];
/** The readers of mesh files; those that need three.js are loaded with it. */
const READERS: Record<string, (source: Source) => Triangles | Promise<Triangles>> = {
    ".glb": async (source) => (await import("./gltf.js")).readGltf(source),
    ".gltf": async (source) => (await import("./gltf.js")).readGltf(source),
    ".obj": async (source) => (await import("./obj.js")).readObj(source),
    ".stl": async (source) => (await import("./stl.js")).readStl(source),
    ".ply": readPly,
    ".off": readOff,
};
const MESHES = Object.keys(READERS);
/** Of one scene each; the last ones are of calls, as bytes or hexadecimal digits. */
const SCENES = [[".toml", ".json"], [".png"], [".bin", ".hex", ".txt", ".calldata"]];
/** What may lie beside others without a word. */
const SILENT = /\.(mtl|bin|txt|md|pdf|url)$/i;

/** Return the document of files. InputError, a sentence, if nothing of them can be shown. */
export async function readFiles(files: readonly Given[], options: Options): Promise<Opened> {
    const { draco = noDraco, beside } = options;
    let total = 0;
    const add = (bytes: number): void => {
        total += bytes;
        if (total > MOST_BYTES)
            throw new InputError("All files together may have up to 100 MB, also when they are unpacked.");
    };
    const folder = (await Promise.all(files.map((file) => said(file, () => unpacked(file, add))))).flat();
    // by content also those of other names, where no name tells of a format
    const known = folder.filter(({ name }) => [...MESHES, ...SCENES[0]].includes(namedFormat(name)));
    const of = (extensions: readonly string[]): Given[] =>
        (known.length ? known : folder).filter((file) => extensions.includes(formatOf(file)));
    const meshes = of(MESHES);
    // beside a mesh file, pictures are textures
    const scenes =
        SCENES.slice(0, meshes.length ? 1 : 3)
            .map(of)
            .find(({ length }) => length) ?? [];
    if (scenes.length > 1) throw new InputError(`Open one scene at a time: ${namesOf(scenes)} are ${scenes.length}.`);
    const shown = scenes.length ? scenes : meshes;
    if (!shown.length) {
        for (const file of folder) await said(file, async () => contentOf({ ...file, tell: () => undefined }));
        throw unknown(folder);
    }
    const notes: string[] = [];
    const images = new Images();
    const sources = shown.map((file): Source => {
        const tell = (note: string): void => void notes.push(`${baseOf(file.name)}: ${note}`);
        return { ...file, folder, draco, beside, tell, images };
    });
    const made = scenes.length ? await openScene(sources[0], options) : await openMeshes(sources, options);
    const unused = folder.filter((file) => !file.used && !shown.includes(file) && !SILENT.test(file.name));
    if (unused.length) notes.push(`Not used: ${namesOf(unused)}`);
    return { ...made, notes: [...new Set(notes)] };
}

function noDraco(): Promise<never> {
    throw new InputError("it is compressed with Draco, whose decoder is not here");
}

/** Return the error for files of which none is of a known kind. */
function unknown(files: readonly Given[]): InputError {
    const kind = files.length > 1 ? "These are no 3D files" : "This is no 3D file";
    const what = files.length ? `${kind}: ${namesOf(files)}` : "There is no file to open";
    const known = [...MESHES, ...SCENES.slice(0, 2).flat()].join(", ");
    return new InputError(`${what}. Known are ${known} and .zip files of them.`);
}

async function openScene(source: Source, { library }: Options): Promise<Made> {
    const title = titleOf(source);
    return said(source, async () => {
        const bytes = contentOf(source);
        if (SCENES[0].includes(formatOf(source))) return readScene({ ...source, bytes }, library, readMesh);
        const read = async (): Promise<Scene> => decodeCall(await readFile(source.bytes));
        const scene = await read().catch((error: Error) => {
            if (/must begin with the selector/.test(error.message)) throw unknown([source]);
            if (!/carries no scene/.test(error.message)) throw error;
            throw new InputError("This PNG was not made by Shackled: it holds no scene.");
        });
        return documentOfScene(scene, { title });
    });
}

async function openMeshes(sources: Source[], { size, maxTriangles }: Options): Promise<Made> {
    const models: Model[] = [];
    const titles: string[] = [];
    let failed: unknown;
    for (const source of sources) {
        try {
            const parts = await said(source, () => readMesh(source));
            models.push({ parts, isZUp: formatOf(source) === ".stl", tell: source.tell });
            titles.push(titleOf(source));
        } catch (error) {
            if (sources.length > 1) source.tell(`left out: ${(error as Error).message}`);
            failed = error;
        }
    }
    if (!models.length) throw failed;
    const [scene, owners] = await said(sources[0], () => staged(models, size, maxTriangles));
    const names = owners.map((owner, at) => {
        const own = owners.flatMap((each, place) => (each === owner ? [place] : []));
        return { name: own.length > 1 ? `${titles[owner]} ${own.indexOf(at) + 1}` : titles[owner] };
    });
    return documentOfScene(scene, { title: listOf(titles) }, names);
}

/** Return the parts of a mesh file. */
async function readMesh(source: Source): Promise<Part[]> {
    if (!source.bytes.length) throw new InputError("it is empty");
    const bytes = contentOf(source);
    const read = READERS[formatOf(source)];
    if (!read) throw new InputError(`it is none of the mesh files that are read: ${MESHES.join(", ")}`);
    return partsOf(await read({ ...source, bytes }), source);
}

/** Return what `read` does, with errors in one sentence that names the file. */
async function said<T>(file: Given, read: () => Promise<T>): Promise<T> {
    try {
        return await read();
    } catch (error) {
        const text = (error as Error).message
            .replace(/^THREE\.\w+: /, "")
            .split("\n")[0]
            .slice(0, 300);
        if (/^[A-Z].*\.$/.test(text)) throw error;
        const kind = formatOf(file).slice(1).toUpperCase();
        const why = error instanceof InputError ? text : `it is no ${kind} file that can be read (${text})`;
        throw new InputError(`Cannot open ${baseOf(file.name)}: ${why}.`);
    }
}

/** Return a file, or those that are in it if it is a ZIP file. add: is told of bytes, and throws where they are too many. */
async function unpacked(given: Given, add: (bytes: number) => void): Promise<Given[]> {
    const file = await gunzipped(given);
    add(file.bytes.length);
    if (extensionOf(file.name) !== ".zip") return [{ ...file, name: file.name.replaceAll("\\", "/") }];
    let count = 0;
    return unzipped(file.bytes, (name, size) => {
        if (/\/$|(^|\/)(__MACOSX|\.[^/]*)/.test(name)) return false;
        if (++count > MOST_FILES) throw new InputError(`A ZIP file may hold up to ${MOST_FILES} files.`);
        add(size);
        return true;
    });
}

function namesOf(files: readonly Given[]): string {
    return listOf(files.map(({ name }) => baseOf(name)));
}

function listOf(names: readonly string[]): string {
    const shown = names.length > 3 ? [...names.slice(0, 2), `${names.length - 2} others`] : names;
    return [shown.slice(0, -1).join(", "), shown.at(-1)].filter(Boolean).join(" and ");
}
