#!/usr/bin/env node
// The command `shackled poster`: pictures of models and scenes, in Node.

import { mkdirSync, readFileSync, readdirSync, realpathSync, statSync, writeFileSync } from "node:fs";
import { basename, dirname, join, relative, resolve, sep } from "node:path";
import { parseArgs } from "node:util";
import { encode as encodePng } from "fast-png";
import { fitted, withCamera } from "./document/camera.js";
import { sceneOf, type Document, type MeshRef, type Meshes, type StoredMesh } from "./document/document.js";
import { applyLook, LOOKS } from "./document/looks.js";
import { InputError } from "./errors.js";
import { toHex } from "./bytes.js";
import { decodeImagesBy } from "./files/images.js";
import { decodeInNode } from "./files/node.js";
import { readFiles, type Given, type Opened } from "./files/read.js";
import { render } from "./render.js";
import { boundsOf } from "./scene/arithmetic.js";
import { checkedScene, worldPositions } from "./scene/checked.js";
import * as check from "./scene/checks.js";
import { withCall } from "./scene/call_file.js";
import { encode } from "./scene/encode.js";
import { FIELDS } from "./scene/fields.js";

const PRESETS = LOOKS.map(({ name }) => name);
const HELP = `Draw posters of models and scenes, every pixel by the contracts of Shackled.

  shackled poster INPUT... -o OUTPUT [options]

INPUT is a mesh file (.glb, .gltf, .obj, .ply, .stl, .off), a scene file (.toml, .json), a PNG file by Shackled, or a
ZIP file of them. OUTPUT is a PNG file, or a folder for several inputs.

  --size N            pixels of a side, 1 to 2048; 256 for mesh files
  --preset NAME       a look: ${PRESETS.join(", ")}
  --azimuth=DEGREES   where the camera stands, to the right of the front
  --elevation=DEGREES and above the horizon
  --background COLOR  one colour, or those of top and bottom with a comma between them
  --no-antialias      without smooth edges: cheaper
  --max-triangles N   simplify larger meshes to so many triangles; "all" keeps all
  --json              print what was read as JSON, a line for each input
  --help
`;
const TEXT = { type: "string" } as const;
const FLAG = { type: "boolean" } as const;
const OPTIONS = {
    ...{ output: { ...TEXT, short: "o" }, size: TEXT, preset: TEXT, azimuth: TEXT, elevation: TEXT, background: TEXT },
    ...{ "max-triangles": TEXT, "no-antialias": FLAG, json: FLAG, help: { ...FLAG, short: "h" } },
};

type Values = Partial<Record<keyof typeof OPTIONS, string | boolean>>;

decodeImagesBy(decodeInNode);

try {
    await main(process.argv.slice(2));
} catch (error) {
    const { code, name, message } = error as Error & { code?: unknown };
    const isOfOptions = String(code).startsWith("ERR_PARSE_ARGS");
    if (!isOfOptions && !(error instanceof InputError) && name !== "CallError") throw error;
    console.error(message);
    process.exitCode = 2;
}

async function main(given: string[]): Promise<void> {
    const { values, positionals } = parseArgs({ args: given, options: OPTIONS, allowPositionals: true });
    const [command, ...inputs] = positionals;
    if (values.help || !command) return console.log(HELP);
    if (command !== "poster") throw new InputError(`The command is poster, not ${command}; --help tells more.`);
    if (!inputs.length) throw new InputError("An input is missing: shackled poster model.glb -o poster.png");
    const { output, json } = values as { output?: string; json?: boolean };
    if (!output && !json) throw new InputError("An output is missing: -o poster.png");
    const isFolder =
        inputs.length > 1 || output?.endsWith("/") || statSync(output ?? "", { throwIfNoEntry: false })?.isDirectory();
    const paths = inputs.map((input) =>
        output && isFolder ? join(output, `${basename(input).replace(/\.[^.]*$/, "")}.png`) : output,
    );
    const twice = output && paths.find((path, at) => paths.indexOf(path) < at);
    if (twice) throw new InputError(`Two inputs would be written to ${twice}: give them other names, or one by one.`);
    for (const [at, input] of inputs.entries()) {
        const path = paths[at];
        try {
            const opened = await open(input, values);
            if (!json) for (const note of opened.notes) console.error(note);
            const facts = await draw(opened, values, path);
            const line = `${path}: ${facts.width} x ${facts.height} pixels, ${facts.gas?.toLocaleString("en")} gas`;
            console.log(json ? JSON.stringify({ input, ...facts, notes: opened.notes }) : line);
        } catch (error) {
            if (inputs.length === 1) throw error;
            // the others are drawn all the same
            process.exitCode = 2;
            const { message } = error as Error;
            if (json) console.log(JSON.stringify({ input, error: message }));
            else console.error(message);
        }
    }
}

/** Return a number of an option, undefined if it is not given. */
function numberOf(values: Values, name: keyof Values, low?: number, high?: number): number | undefined {
    const value = values[name];
    return value === undefined ? undefined : check.number(value === "" ? NaN : Number(value), `--${name}`, low, high);
}

function open(input: string, values: Values): Promise<Opened> {
    const folder = dirname(resolve(input));
    const read = new Map<string, Given>();
    return readFiles([{ name: basename(input), bytes: bytesOf(input) }], {
        size: numberOf(values, "size", ...FIELDS.Scene.width.limits) ?? 256,
        maxTriangles: values["max-triangles"] === "all" ? "all" : numberOf(values, "max-triangles", 1),
        draco: () => Promise.resolve(bytesOf(new URL("./draco.wasm", import.meta.url))),
        beside: (name) => {
            const path = fileIn(folder, name) ?? fileIn(folder, basename(name));
            if (path && !read.has(path)) read.set(path, { name: relative(folder, path), bytes: bytesOf(path) });
            return read.get(path ?? "");
        },
    });
}

/** Return the path of a file in a folder, or below, in any letter case; undefined if there is none, or a link leads out. */
function fileIn(folder: string, name: string): string | undefined {
    let paths = [folder];
    for (const part of name.split("/")) {
        const isSame = (each: string): boolean => each.toLowerCase() === part.toLowerCase();
        paths = paths.flatMap((path) => {
            try {
                const names = readdirSync(path).filter(isSame);
                return names.sort((each) => (each === part ? -1 : 0)).map((each) => join(path, each));
            } catch {
                return [];
            }
        });
    }
    const isInside = (path: string): boolean => realpathSync(path).startsWith(join(realpathSync(folder), sep));
    return paths.find((path) => statSync(path, { throwIfNoEntry: false })?.isFile() && isInside(path));
}

function bytesOf(path: string | URL): Uint8Array<ArrayBuffer> {
    try {
        return new Uint8Array(readFileSync(path));
    } catch (error) {
        const { code, message } = error as NodeJS.ErrnoException;
        throw new InputError(`Cannot read ${String(path)}: ${code === "ENOENT" ? "it does not exist" : message}.`);
    }
}

/** Draw a document, if there is a path, and return what is known of it. */
async function draw({ document, meshes }: Opened, values: Values, path: string | undefined) {
    const store = { get: (ref: MeshRef) => meshes.get("file" in ref ? ref.file : "") as StoredMesh };
    const scene = sceneOf(changed(document, store, values), store);
    const { objects, width, height } = checkedScene(scene);
    const corners = objects.reduce((sum, { mesh }) => sum + mesh.faces.length, 0);
    const color = [0, 0, 0];
    for (const { mesh } of objects)
        mesh.faces.forEach((vertex) => color.forEach((_, at) => (color[at] += mesh.colors[3 * vertex + at] / corners)));
    const bounds = boundsOf(worldPositions(objects));
    const facts = {
        title: document.title,
        width,
        height,
        objects: objects.length,
        triangles: corners / 3,
        bounds,
        color,
    };
    if (!path) return { ...facts, gas: undefined };
    const call = encode(scene);
    const { pixels, gas } = await render(call);
    const png = encodePng({ width, height, channels: 3, data: pixels.filter((_, at) => at % 4 < 3) });
    mkdirSync(dirname(path), { recursive: true });
    writeFileSync(path, await withCall(new Uint8Array(png), call));
    return { ...facts, output: path, gas };
}

/** Return the document with what the options change. */
function changed(given: Document, meshes: Meshes, values: Values): Document {
    const size = numberOf(values, "size", ...FIELDS.Scene.width.limits);
    let doc = size ? { ...given, width: size, height: size } : given;
    if (values["no-antialias"]) doc = { ...doc, antialias: false };
    if (values.preset !== undefined) doc = applyLook(doc, check.choice(values.preset, "--preset", PRESETS));
    if (values.background !== undefined) {
        const colors = String(values.background)
            .split(",")
            .map((each) => check.color(each.trim(), "--background"));
        const [top, bottom = top] = colors.map((color) => toHex(color, "#"));
        doc = { ...doc, background: { top, bottom } };
    }
    const azimuth = numberOf(values, "azimuth");
    const elevation = numberOf(values, "elevation", ...FIELDS.Camera.elevation.limits);
    if (azimuth === undefined && elevation === undefined) return doc;
    const angles = { ...(azimuth !== undefined && { azimuth }), ...(elevation !== undefined && { elevation }) };
    return fitted(withCamera(doc, angles), meshes);
}
