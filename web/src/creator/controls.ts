// The controls of the page, as a table: each reads one value of a document, and writes it. Those of settings of the Python
// package come from its table: a new setting that is a number, a switch, a colour or a choice has a control at once.

import { clamped } from "../scene/arithmetic.js";
import { MAX_LIGHTS } from "../scene/constants.js";
import { LIGHT_KINDS, MAX_SIDE, PROJECTIONS } from "../scene/fields.js";
import { resetCamera } from "../document/camera.js";
import type { Document, Meshes } from "../document/document.js";
import { around, changed, chosen, tidy, type Selection } from "../document/measure.js";
import { PARTS, camel, capital, settingsOf, type Part, type Scope, type Value } from "../document/fields.js";
import { SETTINGS, type Setting } from "../document/settings.js";

export { MIXED, type Value } from "../document/fields.js";

/** One value of a document. Lengths are in radii of its frame. */
export interface Control extends Readonly<Required<Traits>> {
    /** Its name, such as "camera.fov" or "lights.0.color". */
    readonly path: string;
    readonly label: string;
    /** Smallest and largest value of the slider; numbers can be typed from `low` to `high`. */
    readonly slider: readonly [number, number];
    /** Whether it has an effect at present. */
    shown(doc: Document, selection: Selection): boolean;
    read(doc: Document, selection: Selection, meshes: Meshes): Value;
    /** Return the document with the value, within low..high. */
    write(doc: Document, selection: Selection, value: Value, meshes: Meshes): Document;
    /** Return whether the value is another one than in the document that was opened. */
    changed(doc: Document, selection: Selection, own: Document, meshes: Meshes): boolean;
    /** Return the document with the value of that which was opened. */
    reset(doc: Document, selection: Selection, own: Document, meshes: Meshes): Document;
}

interface Traits {
    /** The panel that shows it. */
    group?: string;
    kind?: "number" | "switch" | "color" | "choice";
    low?: number;
    high?: number;
    step?: number;
    unit?: string;
    /** The range of the slider, where it is smaller than low..high. */
    reach?: readonly [number, number];
    /** Whether equal distances on the slider are equal ratios. */
    logarithmic?: boolean;
    /** Whether it is an angle that wraps around, so that 181 is -179. */
    turn?: boolean;
    whole?: boolean;
    /** Values and their labels. */
    choices?: readonly (readonly [string, string])[];
    /** The label of null; "" where a value is needed. */
    none?: string;
    /** One sentence, or "". */
    help?: string;
}

/** The panels, in their order. */
export const GROUPS = [
    { name: "object", title: "Place and size" },
    { name: "material", title: "Material" },
    { name: "lights", title: "Lights" },
    { name: "ground", title: "Ground" },
    { name: "atmosphere", title: "Sky, rim and fog" },
    { name: "tone", title: "Tone" },
    { name: "camera", title: "Camera" },
    { name: "picture", title: "Picture" },
] as const;

const KINDS: Readonly<Record<string, Traits>> = {
    number: {},
    whole: { whole: true },
    flag: { kind: "switch" },
    color: { kind: "color" },
    choice: { kind: "choice" },
};
/** What the table of settings does not say. Those that are here come first. */
const MORE: Readonly<Record<string, Traits & { label?: string }>> = {
    color: { label: "Colour", none: "its own colours" },
    shading: {},
    ambient: { reach: [0, 2] },
    diffuse: { reach: [0, 2] },
    specular: { reach: [0, 2] },
    ambient_light: { group: "lights" },
    exposure: { reach: [0, 4] },
    gamma: { label: "Linear light" },
    cull: { label: "Cull back faces", help: "Faster; correct for closed objects." },
    antialias: { label: "Anti-aliasing" },
};

function settingOf(name: string): Setting | undefined {
    return SETTINGS.find((each) => each.name === name);
}

/** Return what the table of settings says. */
function traitsOf({ name, kind, low, high, unit, choices, text }: Setting): Traits {
    const numbers = { ...(low !== null && { low }), ...(high !== null && { high }) };
    return {
        ...KINDS[kind],
        ...numbers,
        unit: unit === "degrees" ? "°" : unit,
        choices: labelled(choices),
        help: text,
        ...MORE[name],
    };
}

function labelled(words: readonly string[]): [string, string][] {
    return words.map((word) => [word, titled(word)]);
}

function titled(name: string): string {
    return capital(name.replaceAll("_", " "));
}

/** The largest number where there is no other. */
const MOST = 1e6;

type Row = readonly [path: string, label: string, traits?: Traits, help?: string];
const ANY: Traits = { low: -1000, high: 1000, unit: "radii", reach: [-2, 2] };
const TURN: Traits = { low: -180, high: 180, unit: "°", turn: true };
const LENGTH: Traits = { ...ANY, low: 0, reach: [0, 10] };
const SIZE: Traits = { unit: "radii", low: 0.01, high: 1000, reach: [0.5, 20], logarithmic: true };
const CONE: Traits = { low: 0, high: 180, unit: "°", reach: [0, 90] };
const PIXELS: Traits = { low: 1, high: MAX_SIDE, whole: true, unit: "pixels", reach: [16, 512] };
const COLOR: Traits = { kind: "color" };
const SWITCH: Traits = { kind: "switch" };

const OBJECT: readonly Row[] = [
    ["pose.position.x", "Move right", ANY],
    ["pose.position.y", "Move up", ANY],
    ["pose.position.z", "Move forward", ANY],
    ["pose.rotation.x", "Tilt", TURN, "Rotation about the x axis, which points right."],
    ["pose.rotation.y", "Turn", TURN, "Rotation about the y axis, which points up."],
    ["pose.rotation.z", "Roll", TURN, "Rotation about the z axis, which points forward."],
    ["pose.size", "Size", { ...SIZE, high: 100, reach: [0.1, 10] }, "Radius of the sphere about the object."],
    [
        "object.max_triangles",
        "Triangles",
        { group: "object", low: 4, high: 65535, whole: true, logarithmic: true, none: "all" },
    ],
];
const AUTOMATIC: readonly Row[] = settingsOf("material", "object", "tone", "scene")
    .toSorted((a, b) => rank(a.name) - rank(b.name))
    .map(({ name, part }) => [`${part}.${name}`, MORE[name]?.label ?? titled(name)]);
const CREASE: Row = ["object.crease", "Crease", { none: "by shape" }];
const OTHERS: readonly Row[] = [
    [
        "scene.lights_follow",
        "Lights move with the camera",
        { ...SWITCH, group: "lights" },
        "They stay where they are for the viewer.",
    ],
    ["ground.on", "Ground", SWITCH],
    ["ground.color", "Colour", COLOR],
    ["ground.height", "Height", { ...ANY, none: "under the objects" }],
    ["ground.radius", "Radius", { ...SIZE, none: "by the objects" }, "Where nothing is left of the ground."],
    ["ground.inner", "Fades from", { ...LENGTH, none: "0.4 of the radius" }, "Where the ground begins to fade."],
    ["hemisphere.on", "Sky light", SWITCH],
    ["hemisphere.sky", "Sky", COLOR, "Colour of the light from above."],
    ["hemisphere.ground", "Ground", COLOR, "Colour of the light from below."],
    ["rim.on", "Rim light", SWITCH],
    ["rim.color", "Rim colour", COLOR, "Colour of the light along outlines."],
    ["rim.power", "Rim exponent", { low: 1, high: 16, whole: true }, "From a wide rim to a narrow one."],
    ["fog.on", "Fog", SWITCH],
    ["fog.color", "Fog colour", COLOR],
    ["fog.near", "Fog from", LENGTH, "Distance at which the fog begins."],
    ["fog.far", "Fog to", LENGTH, "Distance at which it hides everything."],
    ["camera.azimuth", "Azimuth", TURN],
    ["camera.elevation", "Elevation"],
    ["camera.roll", "Roll", TURN, "Rotation of the camera about its line of sight."],
    ["camera.distance", "Distance", SIZE],
    ["camera.projection", "Projection", { kind: "choice", choices: labelled(PROJECTIONS) }],
    ["camera.fov", "Field of view", { reach: [5, 120] }],
    ["camera.target.x", "Look at, right", ANY],
    ["camera.target.y", "Look at, up", ANY],
    ["camera.target.z", "Look at, forward", ANY],
    ["background.top", "Background, top", COLOR],
    ["background.bottom", "Background, bottom", COLOR],
    ["scene.width", "Width", PIXELS],
    ["scene.height", "Height", PIXELS],
];
const LIGHT: readonly Row[] = [
    ["kind", "Kind", { kind: "choice", choices: labelled(LIGHT_KINDS) }],
    ["azimuth", "Azimuth", TURN, "Angle at which the light stands to the right of the front."],
    ["elevation", "Elevation", { low: -90, high: 90, unit: "°" }, "Angle at which the light stands above the horizon."],
    ["distance", "Distance", { ...LENGTH, reach: [0.2, 20] }, "Distance of the light from the middle of the object."],
    ["color", "Colour", COLOR],
    ["shadow", "Shadow", SWITCH, "Let objects cast shadows in this light; one light can."],
    ["target.x", "Points at, right", ANY],
    ["target.y", "Points at, up", ANY],
    ["target.z", "Points at, forward", ANY],
    ["inner_angle", "Full light", CONE, "Angle from the direction of the light up to which it is at full strength."],
    ["outer_angle", "No light", CONE, "Angle from the direction of the light at which it has faded to nothing."],
];

function rank(name: string): number {
    const at = Object.keys(MORE).indexOf(name);
    return at < 0 ? Infinity : at;
}

const PLAIN: Traits = {
    ...{ kind: "number", unit: "", turn: false, whole: false, logarithmic: false, choices: [], none: "", help: "" },
};

function control([path, label, own = {}, help]: Row): Control {
    const found = /^(lights\.\d|\w+)\.(\w+)(?:\.([xyz]))?$/.exec(path);
    const [, owner, name, letter] = found as unknown as [string, string, string, string?];
    const part = PARTS[owner] as Part;
    const setting = settingOf(name === "on" ? owner : name);
    const [key, axis] = [camel(name), letter ? "xyz".indexOf(letter) : -1];
    const isOwn = setting?.part === owner || name === "on" || (owner === "object" && setting?.part === null);
    const known = setting && isOwn ? traitsOf(setting) : {};
    const traits: Traits = { ...known, ...own, ...(help && { help }) };
    // without bounds, the slider goes from 0 to 1
    const { low = -MOST, high = MOST } = traits;
    const { reach = [low > -MOST ? low : 0, high < MOST ? high : 1], whole = false, turn = false, unit = "" } = traits;
    const scope = (doc: Document, selection: Selection, meshes: Meshes): Scope => ({ doc, selection, meshes });
    const read = (from: Scope): Value => {
        const field = part.get(from, key);
        return Array.isArray(field) ? (field[axis] as Value) : (field as Value);
    };
    const put = (into: Scope, value: Value): Document =>
        part.set(into, key, axis < 0 ? value : (part.get(into, key) as Value[]).with(axis, value), axis);
    /** Return the objects, each by itself where it has a value of its own, that are in the document that was opened, too. */
    const pairs = (doc: Document, selection: Selection, own: Document, meshes: Meshes): [Selection, Value][] => {
        const opened = part.opened?.(doc, own) ?? own;
        if (!part.each) return [[selection, read(scope(opened, selection, meshes))]];
        const ids = chosen(doc, selection).filter(({ id }) => own.objects.some((each) => each.id === id));
        return ids.map(({ id }) => [new Set([id]), read(scope(own, new Set([id]), meshes))]);
    };
    return {
        ...PLAIN,
        ...{ step: whole || unit === "°" ? 1 : 0.01, group: part.group, ...traits },
        ...{ path, label, low, high, reach, slider: [Math.max(low, reach[0]), Math.min(high, reach[1])] },
        shown: (doc, selection) => part.shown?.(doc, key, selection) ?? true,
        read: (doc, selection, meshes) => read(scope(doc, selection, meshes)),
        write: (doc, selection, value, meshes) => {
            if (typeof value !== "number") return put(scope(doc, selection, meshes), value);
            const number = clamped(turn ? around(value) : value, low, high);
            return put(scope(doc, selection, meshes), whole ? Math.round(number) : tidy(number));
        },
        changed: (doc, selection, own, meshes) =>
            pairs(doc, selection, own, meshes).some(([ids, value]) => read(scope(doc, ids, meshes)) !== value),
        reset: (doc, selection, own, meshes) => {
            const known = part.reset?.(scope(doc, selection, meshes), own, key, axis);
            const back = (before: Document, [ids, value]: [Selection, Value]) => put(scope(before, ids, meshes), value);
            const made = known ?? pairs(doc, selection, own, meshes).reduce(back, doc);
            return part.exact?.(made, own) ?? made;
        },
    } as Control;
}

/** The crease is a trait of smooth shading. */
const withCrease = AUTOMATIC.flatMap((row) => (row[0] === "material.shading" ? [row, CREASE] : [row]));

/** All controls but those of lights, in the order of their panels. */
export const CONTROLS: readonly Control[] = [...OBJECT, ...withCrease, ...OTHERS].map(control);

const LIGHTS = Array.from({ length: MAX_LIGHTS }, (_, number) =>
    LIGHT.map(([key, ...row]) => control([`lights.${number}.${key}`, ...row])),
);

/** Return the controls of a light. number: from 0. */
export function lightControls(number: number): readonly Control[] {
    return LIGHTS[number] as readonly Control[];
}

const BY_PATH = new Map([...CONTROLS, ...LIGHTS.flat()].map((each) => [each.path, each]));

/** Return the control of a path. */
export function controlOf(path: string): Control | undefined {
    return BY_PATH.get(path);
}

/** Return the document with the values of that which was opened, for all controls of a panel. */
export function resetGroup(
    doc: Document,
    group: string,
    selection: Selection,
    own: Document,
    meshes: Meshes,
): Document {
    if (group === "camera") return resetCamera(doc, own);
    let first = group === "lights" ? { ...doc, lights: own.lights } : doc;
    if (group === "object")
        first = changed(doc, selection, (item) => {
            const { position, rotation, scale } = own.objects.find(({ id }) => id === item.id) ?? item;
            return { ...item, position, rotation, scale };
        });
    const rows = CONTROLS.filter((each) => each.group === group);
    return rows.reduce((made, each) => each.reset(made, selection, own, meshes), first);
}
