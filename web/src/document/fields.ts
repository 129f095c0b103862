// The parts of a document that controls read and write, by keys. Lengths are in radii of its frame.

import { add, dot, multiply, subtract, type Quaternion, type Vector } from "../scene/arithmetic.js";
import { MAX_LIGHTS } from "../scene/constants.js";
import type { Light } from "../scene/types.js";
import { axesOf, inside, orbitOf, outside, resetCamera, withCamera } from "./camera.js";
import type { Document, Item, Meshes } from "./document.js";
import { LAMP, lampOf, setShadow, withLamp } from "./lamps.js";
import * as measure from "./measure.js";
import { chosen, tidy, type Selection } from "./measure.js";
import { SETTINGS, type Setting } from "./settings.js";

export type Value = number | string | boolean | null;
/** What is read where the selected objects differ. */
export const MIXED = "mixed";

/** The settings of parts that are a number, a switch, a colour or a choice. */
export function settingsOf(...parts: string[]): readonly Setting[] {
    return SETTINGS.filter(({ part, kind }) => parts.includes(part ?? "") && KINDS.includes(kind));
}
const KINDS = ["number", "whole", "flag", "color", "choice"];

function defaultOf({ kind, part, default: words, low, choices }: Setting): Value {
    if (kind === "flag") return false;
    if (kind === "color") return part === "object" ? null : "#000000";
    return kind === "choice" ? choices[0] : Number.parseFloat(words) || (low ?? 0);
}

/** Return the value of a setting that an object does not have. */
function missing(key: string): Value {
    const setting = settingsOf("object", "material").find(({ name }) => camel(name) === key);
    return setting ? defaultOf(setting) : null;
}

/** Return a name of Python as one of JavaScript. */
export function camel(name: string): string {
    return name.replace(/_(.)/g, (_, letter: string) => letter.toUpperCase());
}

/** Return a text that begins with a capital letter. */
export function capital(text: string): string {
    return text.slice(0, 1).toUpperCase() + text.slice(1);
}

/** What is read or written. */
export interface Scope {
    doc: Document;
    selection: Selection;
    meshes: Meshes;
}
export type Field = Value | readonly Value[];
/** A part of a document, by whose keys values are read and written. */
export interface Part {
    group: string;
    get(scope: Scope, key: string): Field;
    /** axis: of a vector, the one that changes. */
    set(scope: Scope, key: string, value: Field, axis: number): Document;
    shown?(doc: Document, key: string, selection: Selection): boolean;
    /** Return the document whose values are those that a reset takes. */
    opened?(doc: Document, own: Document): Document;
    /** Whether each object has a value of its own. */
    each?: boolean;
    /** Return the document after a reset of what one value does not bring back; undefined for other keys. */
    reset?(scope: Scope, own: Document, key: string, axis: number): Document | undefined;
    /** Return the document with what was opened, to the last digit, where it is that but for rounding. */
    exact?(doc: Document, own: Document): Document;
}

/** Return the fields of a thing, or of a table in it. */
function fieldsOf(whole: object, inner?: string): Record<string, Field | undefined> {
    return (inner ? (whole as Record<string, object>)[inner] : whole) as Record<string, Field | undefined>;
}

function withField<T extends object>(whole: T, inner: string | undefined, key: string, value: Field): T {
    const fields = { ...fieldsOf(whole, inner), [key]: value };
    return inner ? { ...whole, [inner]: fields } : ({ ...whole, ...fields } as T);
}

/** Return the part that is all of the document, or a table in it. */
const ofDocument = (group: string, inner?: string): Part => ({
    group,
    get: ({ doc }, key) => fieldsOf(doc, inner)[key] ?? null,
    set: ({ doc }, key, value) => withField(doc, inner, key, value),
});

const camera: Part = {
    group: "camera",
    get: ({ doc }, key) => orbitOf(doc.camera, doc.frame)[key as "azimuth"],
    set: ({ doc }, key, value) => withCamera(doc, { [key]: value }),
    exact: (doc, own) => {
        const [here, there] = [doc, own].map(({ camera, frame }) => JSON.stringify(orbitOf(camera, frame)));
        return here === there ? resetCamera(doc, own) : doc;
    },
};

/** The values that effects have at first. */
const EFFECTS = {
    hemisphere: () => ({ sky: "#b4c8e6", ground: "#3c342c" }),
    rim: () => ({ color: "#ffffff", power: 3 }),
    /** As deep as the objects. */
    fog: ({ camera, frame, background }: Document) => {
        const depth = Math.max(1, dot(inside(frame, camera.eye as Vector), axesOf(camera).back));
        return { color: background.bottom, near: (depth - 1) * frame.radius, far: (depth + 1) * frame.radius };
    },
    ground: ({ background: { bottom: color } }: Document) => ({
        color,
        height: null,
        radius: null,
        center: null,
        inner: null,
    }),
    tone: () => Object.fromEntries(settingsOf("tone").map((each) => [camel(each.name), defaultOf(each)])),
} satisfies Partial<Record<keyof Document, (doc: Document) => object>>;
type Effect = keyof typeof EFFECTS;

/** Return an effect of a document, with the key `on` and lengths in radii. */
function effectOf(doc: Document, name: Effect): Record<string, Field> {
    const { middle, radius } = doc.frame;
    const effect: Record<string, Field> = { ...(doc[name] ?? EFFECTS[name](doc)), on: doc[name] !== null };
    if (typeof effect["height"] === "number") effect["height"] = tidy((effect["height"] - middle[1]) / radius);
    for (const key of LENGTHS) if (typeof effect[key] === "number") effect[key] = tidy(effect[key] / radius);
    return effect;
}
const LENGTHS = ["near", "far", "radius", "inner"] as const;
const fine = (x: number, size: number): number => measure.tidied([x, 0, 0], size)[0];
/** The least depth of fog. */
const GAP = 0.01;

/** Return the radius of a ground whose inner radius is given, but no other. */
function wide({ objects, frame }: Document, meshes: Meshes): number {
    return fine(2 * measure.boundsOfPoints(measure.pointsOf(objects, meshes)).radius, frame.radius);
}

function withEffect({ doc, meshes }: Scope, name: Effect, changes: Record<string, Field>): Document {
    const { middle, radius } = doc.frame;
    const { on, ...fields }: Record<string, Field> = { ...effectOf(doc, name), on: true, ...changes };
    if (!on) return { ...doc, [name]: null };
    const effect = fields as Partial<Record<"near" | "far" | "inner" | "radius" | "height", number | null | undefined>>;
    // fog that ends before it begins is a wall, and a ground must fade before it ends
    if (name === "fog" && (effect.far as number) < (effect.near as number) + GAP) {
        effect.near = "near" in changes ? effect.near : Math.max(0, (effect.far as number) - GAP);
        effect.far = (effect.near as number) + GAP;
    }
    if (typeof effect.inner === "number") {
        effect.radius ??= wide(doc, meshes) / radius;
        effect.inner = Math.min(effect.inner, 0.99 * effect.radius);
    }
    if (typeof effect.height === "number") effect.height = fine(middle[1] + effect.height * radius, radius);
    for (const key of LENGTHS) if (typeof effect[key] === "number") effect[key] = fine(effect[key] * radius, radius);
    const isPlain = name === "tone" && JSON.stringify(effect) === JSON.stringify(EFFECTS.tone());
    return { ...doc, [name]: isPlain ? null : effect };
}

function effect(group: string, name: Effect): Part {
    return {
        group,
        get: ({ doc }, key) => effectOf(doc, name)[key] ?? null,
        set: (scope, key, value) => withEffect(scope, name, { [key]: value }),
        shown: (doc, key) => key === "on" || name === "tone" || doc[name] !== null,
        opened: (doc, own) => ({ ...doc, [name]: own[name] }),
        reset: (scope, own, key) => {
            if (key === "on") return { ...scope.doc, [name]: own[name] };
            const { ground } = scope.doc;
            const isWide =
                key === "inner" && own.ground?.radius === null && ground?.radius === wide(scope.doc, scope.meshes);
            return isWide ? { ...scope.doc, ground: { ...ground, radius: null, inner: own.ground.inner } } : undefined;
        },
    };
}

/** Return the value that all have; MIXED where they differ. */
function common(values: readonly Value[]): Value {
    return values.every((value) => value === values[0]) ? (values[0] ?? null) : MIXED;
}

/** Return the part that is each selected object, or a table in it. */
const ofItems = (inner?: string): Part => ({
    group: "material",
    each: true,
    get: ({ doc, selection }, key) =>
        common(chosen(doc, selection).map((item) => (fieldsOf(item, inner)[key] ?? missing(key)) as Value)),
    set: ({ doc, selection }, key, value) =>
        measure.changed(doc, selection, (item) => withField(item, inner, key, value)),
    shown: (doc, key, selection) =>
        key !== "crease" || chosen(doc, selection).some(({ material }) => material.shading === "smooth"),
});

/** Return the document with objects that turn and grow: about their common middle where all do alike, others about their own. */
function carried(
    { doc, selection, meshes }: Scope,
    change: (item: Item) => { rotation?: Vector; factor?: number },
): Document {
    const items = chosen(doc, selection);
    const about = measure.sphereOfAll(items, meshes).middle as Vector;
    const changes = new Map(
        items.map((item) => {
            const { rotation, factor = 1 } = change(item);
            const [x, y, z, w] = measure.quaternionOf(item.rotation);
            const turn = rotation && multiply(measure.quaternionOf(rotation), [-x, -y, -z, w] as Quaternion);
            return [item, { rotation, factor, turn, text: JSON.stringify([turn?.map(tidy), tidy(factor)]) }];
        }),
    );
    const isOne = common(Array.from(changes.values(), ({ text }) => text)) !== MIXED;
    return measure.changed(doc, selection, (item) => {
        const { rotation = item.rotation, turn, factor } = changes.get(item)!;
        const own = isOne ? about : (measure.sphereOf(item, meshes).middle as Vector);
        const { position, scale } = measure.carried(item, own, { factor, ...(turn && { turn }) });
        return { ...item, rotation, ...fineOf(position as Vector, scale, doc.frame.radius) };
    });
}

function fineOf(position: Vector, scale: number, size: number): Pick<Item, "position" | "scale"> {
    return { position: measure.tidied(position, size), scale: Number(scale.toPrecision(9)) };
}

/** Where the selected objects are, all together. */
const pose: Part = {
    group: "object",
    each: true,
    get: ({ doc, selection, meshes }, key) => {
        const items = chosen(doc, selection);
        if (key === "rotation") {
            const angles = items.map(({ rotation }) => measure.eulerOf(rotation));
            return [0, 1, 2].map((axis) => common(angles.map((each) => each[axis])));
        }
        const { middle, radius } = measure.sphereOfAll(items, meshes);
        return key === "size" ? tidy(radius / doc.frame.radius) : inside(doc.frame, middle as Vector).map(tidy);
    },
    set: (scope, key, value, axis) => {
        const { doc, selection, meshes } = scope;
        const number = (axis < 0 ? value : (value as number[])[axis]) as number;
        if (key === "rotation")
            return carried(scope, ({ rotation }) => ({
                rotation: measure.eulerOf(rotation).with(axis, number) as Vector,
            }));
        const all = measure.sphereOfAll(chosen(doc, selection), meshes);
        if (key === "size") return carried(scope, () => ({ factor: (number * doc.frame.radius) / all.radius }));
        const to = outside(doc.frame, inside(doc.frame, all.middle as Vector).with(axis, number) as Vector);
        const by = subtract(to, all.middle as Vector);
        return measure.changed(doc, selection, (item) => ({
            ...item,
            ...fineOf(add(item.position as Vector, by), item.scale, doc.frame.radius),
        }));
    },
    reset: (scope, own, key, axis) => {
        if (key === "position") return undefined;
        const before = new Map(own.objects.map((item) => [item.id, item]));
        return carried(scope, (item) => {
            const opened = before.get(item.id) ?? item;
            if (key === "size") return { factor: opened.scale / item.scale };
            const angle = measure.eulerOf(opened.rotation)[axis];
            return { rotation: measure.eulerOf(item.rotation).with(axis, angle) as Vector };
        });
    },
    exact: (doc, own) => {
        const before = new Map(own.objects.map((item) => [item.id, item]));
        const place = ({ position, rotation, scale }: Item): number[] =>
            [inside(doc.frame, position as Vector), measure.eulerOf(rotation), scale / doc.frame.radius].flat();
        return measure.changed(doc, new Set(), (item) => {
            const opened = before.get(item.id);
            const there = opened && place(opened);
            if (!there || place(item).some((x, at) => Math.abs(x - there[at]) > 2e-6 * Math.max(1, Math.abs(x))))
                return item;
            const { position, rotation, scale } = opened;
            return { ...item, position, rotation, scale };
        });
    },
};

function lampPart(number: number): Part {
    return {
        group: "lights",
        get: ({ doc }, key) =>
            (doc.lights[number] ? lampOf(doc.lights[number], doc.frame) : LAMP)[key as keyof typeof LAMP],
        set: ({ doc }, key, value) => withLamp(doc, number, { [key]: value }),
        shown: (doc, key) => {
            const kind = doc.lights[number]?.kind;
            if (key === "distance") return kind === "point" || kind === "spot";
            return kind === "spot" || !["target", "innerAngle", "outerAngle"].includes(key);
        },
        // what another kind of light does not have, and the shadow that another light has, come back
        reset: ({ doc }, own, key) => {
            const shadowed = own.lights.findIndex(({ shadow }) => shadow);
            if (key === "shadow") return setShadow(doc, shadowed);
            const [here, there] = [doc, own].map(({ lights }) => lights[number]);
            if (key !== "kind" || !here || !there) return undefined;
            const { kind, distance, target, innerAngle, outerAngle } = lampOf(there, doc.frame);
            const away = here.kind === "directional" ? { distance } : {};
            return withLamp(doc, number, { kind, target, innerAngle, outerAngle, ...away });
        },
        exact: (doc, own) => {
            const [here, there] = [doc, own].map(({ lights }) => lights[number] as Light);
            const isSame =
                there && JSON.stringify(lampOf(here, doc.frame)) === JSON.stringify(lampOf(there, doc.frame));
            return isSame ? { ...doc, lights: doc.lights.with(number, there) } : doc;
        },
    };
}

/** The parts, by their names. */
export const PARTS: Readonly<Record<string, Part>> = {
    pose,
    object: ofItems(),
    material: ofItems("material"),
    scene: ofDocument("picture"),
    background: ofDocument("picture", "background"),
    camera,
    hemisphere: effect("atmosphere", "hemisphere"),
    rim: effect("atmosphere", "rim"),
    fog: effect("atmosphere", "fog"),
    ground: effect("ground", "ground"),
    tone: effect("tone", "tone"),
    ...Object.fromEntries(Array.from({ length: MAX_LIGHTS }, (_, number) => [`lights.${number}`, lampPart(number)])),
};
