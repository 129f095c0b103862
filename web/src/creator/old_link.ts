// Links of the Creator that was a server in Python: a state, which changes values of the scene of its source.

import { InputError } from "../errors.js";
import { fromEuler, type Vector } from "../scene/arithmetic.js";
import { MAX_LIGHTS } from "../scene/constants.js";
import { vector } from "../scene/checks.js";
import { Table } from "../scene/table.js";
import { controlOf, type Control, type Value } from "./controls.js";
import type { Document } from "./document.js";
import { LAMP, lightOf } from "./lamps.js";
import type { MeshStore } from "./library.js";
import { carried, changed, type Selection } from "./measure.js";

/** Frequent parts of the JSON of states. */
export const LINK_DICTIONARY = new TextEncoder().encode(
    '"max_triangles":"invert":true"wireframe":true"cull":false"ambient_light":"#ffffff""lights_follow":true' +
        '"background":{"top":"#000000","bottom":"#ffffff"}"size":{"width":256,"height":256}' +
        '"shading":"smooth""flat""unlit""ambient":0."diffuse":0."specular":0."shininess":"color":"#' +
        '"pose":{"position":[0.0,0.0,0.0],"rotation":[0.0,0.0,0.0],"scale":"surface":{' +
        '"lights":[{"kind":"point","azimuth":-"elevation":"distance":"color":"#ffffff"},{"azimuth":' +
        '"camera":{"target":[0.0,0.0,0.0],"distance":3."azimuth":"elevation":"roll":"projection":"orthographic","fov":' +
        '{"source":{"kind":"upload","name":"genesis/icons/' +
        '{"source":{"kind":"piece","name":"teapot"},',
);

/** What the parts of a state have where they do not say it. */
const DEFAULTS: Readonly<Record<string, object>> = {
    camera: { target: [0, 0, 0], distance: 3, azimuth: 30, elevation: 20, roll: 0, projection: "perspective", fov: 50 },
    fog: { color: "#8892a2", near: 2, far: 4 },
    background: { top: "#000000", bottom: "#000000" },
    tone: { exposure: 1, filmic: false, gamma: false },
    size: { width: 128, height: 128 },
};
/** The parts of a state, in the order in which they are written. */
const PARTS = (
    "surface cull wireframe max_triangles lights lights_follow ambient_light camera hemisphere rim fog tone " +
    "background invert antialias size"
).split(" ");

/** Return the path of a control by the place of its value in a state. */
function pathOf(place: string): string {
    return place
        .replace(/^surface\.(color|opacity)$|^(cull|wireframe|max_triangles)$/, "object.$1$2")
        .replace(/^(lights_follow|ambient_light|invert|antialias)$/, "scene.$1")
        .replace(/^surface\./, "material.")
        .replace(/^size\./, "scene.");
}

/** Return the document of a state. InputError if it is of a file that was opened on a server. */
export async function documentOfState(value: Record<string, unknown>, store: MeshStore): Promise<Document> {
    const state = new Table(value, "the link");
    const source = state.table("source");
    if (source.get("kind") !== "piece") {
        throw new InputError("The link is of a file that is not in it: open the file itself");
    }
    let doc: Document = { ...(await store.piece(String(source.get("name")))), antialias: false };
    const write = (place: string, value: unknown, selection: Selection = new Set()): void => {
        if (typeof value === "object" && value !== null) {
            const isPoint = Array.isArray(value) && place !== "lights";
            for (const [key, each] of Object.entries(value))
                write(`${place}.${isPoint ? "xyz"[Number(key)] : key}`, each);
            return;
        }
        const control = controlOf(pathOf(place));
        if (!control || !takes(control, value)) throw new InputError(`The link does not describe a picture: ${place}`);
        doc = control.write(doc, selection, value as Value, store);
    };
    for (const part of PARTS.filter((each) => state.has(each))) {
        const given = state.get(part);
        if (part === "lights") {
            const lamps = state.list(part).slice(0, MAX_LIGHTS);
            doc = { ...doc, lights: lamps.map(() => lightOf(LAMP, doc.frame)) };
            write(part, lamps);
        } else if (typeof given === "object") {
            const { on, ...values } = { ...DEFAULTS[part], ...given } as Record<string, unknown>;
            write(part, values);
            // what is off has values, too
            if (["hemisphere", "rim", "fog"].includes(part)) write(`${part}.on`, on === true);
        } else write(part, given);
    }
    state.list("opacities").forEach((opacity, index) => {
        const item = doc.objects[index];
        if (item && opacity !== null) write("surface.opacity", opacity, new Set([item.id]));
    });
    const pose = state.table("pose");
    const { middle, radius } = doc.frame;
    return changed(doc, new Set(), (item) =>
        carried(item, middle as Vector, {
            factor: pose.number("scale", 0.01, 100) ?? 1,
            by: (pose.read("position", vector) ?? [0, 0, 0]).map((x) => x * radius) as Vector,
            ...(pose.has("rotation") && { turn: fromEuler(pose.read("rotation", vector) as Vector) }),
        }),
    );
}

/** Return whether a value is one of a control. */
function takes({ kind, choices, none }: Control, value: unknown): boolean {
    if (value === null) return none !== "";
    if (kind === "number") return typeof value === "number";
    if (kind === "switch") return typeof value === "boolean";
    return (
        typeof value === "string" &&
        (kind === "color" ? /^#[0-9a-f]{6}$/.test(value) : choices.some(([each]) => each === value))
    );
}
