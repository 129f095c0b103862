// The keys of the page, and what they do.

import { toHex } from "../../bytes.js";
import type { App } from "../app.js";
import { fitted, panned, resetCamera, turned, zoomed } from "../../document/camera.js";
import { MIXED, controlOf, type Control, type Value } from "../controls.js";
import type { Document, Item } from "../../document/document.js";
import { LOOKS, applyLook, lookOf, surprise } from "../../document/looks.js";
import { chosen, type Selection } from "../../document/measure.js";
import { duplicated, removed } from "../../document/objects.js";
import { open, show } from "../state.js";

interface Key {
    /** As in KeyboardEvent.key, after "Ctrl+" and "Shift+". */
    names: readonly string[];
    shown: string;
    text: string;
    does(app: App, name: string): void;
}

/** For a press of a key: part of the picture's height, factor of sizes, and degrees. */
const STEP = 1 / 24;
const ZOOM = 1.1;
const ANGLE = 15;

export function fit(app: App): void {
    app.change(fitted(app.doc.value, app.meshes), "Fit");
}

export function surpriseMe(app: App): void {
    app.change(surprise(app.doc.value, app.meshes), "Surprise");
}

/** Open a random piece of Genesis. */
export function anyGenesis(app: App, add = false): Promise<void> {
    const seed = toHex(crypto.getRandomValues(new Uint8Array(32)), "");
    return app.openPiece(`genesis/${seed}`, add);
}

export function remove(app: App): void {
    if (!app.selected.value.size) return app.tell("Select an object first: click it");
    if (app.selected.value.size >= app.doc.value.objects.length) return app.tell("A picture needs an object");
    app.change(removed(app.doc.value, app.selected.value), "Remove");
}

export function duplicate(app: App): void {
    const { doc, selected, meshes } = app;
    app.addObjects(duplicated(doc.value, idsOf(chosen(doc.value, selected.value)), meshes), "Duplicate");
}

function idsOf(items: readonly Item[]): ReadonlySet<string> {
    return new Set(items.map(({ id }) => id));
}

function look(app: App, number: number): void {
    const { name } = LOOKS[number % LOOKS.length];
    app.change(applyLook(app.doc.value, name, app.selected.value), "Look");
}

function move(app: App, label: string, change: (doc: Document) => Document): void {
    app.change(change(app.doc.value), label, label);
}

/** Return what gives a switch its other value, and a choice its next one. */
function cycle(path: string): (app: App) => void {
    return (app) => {
        const { doc, selected, meshes } = app;
        const of = controlOf(path) as Control;
        const value = of.read(doc.value, selected.value, meshes);
        const names = of.choices.map(([name]) => name);
        const next =
            of.kind === "switch" ? value !== true : (names[(names.indexOf(String(value)) + 1) % names.length] ?? null);
        app.change(of.write(doc.value, selected.value, next, meshes), of.label);
    };
}

/** Return what changes a number of the selected objects, of each by itself where they differ. */
function nudge(path: string, change: (value: number) => number): (app: App) => void {
    return (app) => {
        const { doc, selected, meshes } = app;
        const of = controlOf(path) as Control;
        const read = (made: Document, ids: Selection): Value => of.read(made, ids, meshes);
        const isMixed = read(doc.value, selected.value) === MIXED;
        const each = isMixed ? chosen(doc.value, selected.value).map(({ id }) => new Set([id])) : [selected.value];
        const put = (made: Document, ids: Selection): Document =>
            of.write(made, ids, change(Number(read(made, ids))), meshes);
        app.change(each.reduce(put, doc.value), of.label, path);
    };
}

const WAYS = { ArrowLeft: [-STEP, 0], ArrowRight: [STEP, 0], ArrowUp: [0, -STEP], ArrowDown: [0, STEP] } as const;
const way = (name: string): readonly [number, number] => WAYS[name.replace("Shift+", "") as keyof typeof WAYS];

/** names: with spaces between them. */
function key(names: string, shown: string, text: string, does: Key["does"]): Key {
    return { names: names.split(" "), shown, text, does };
}

const ARROWS = Object.keys(WAYS);
const orbit = (app: App, name: string): void => move(app, "Turn", (doc) => turned(doc, ...way(name)));
const pan = (app: App, name: string): void => move(app, "Pan", (doc) => panned(doc, ...way(name)));
const zoom =
    (factor: number) =>
    (app: App): void =>
        move(app, "Zoom", (doc) => zoomed(doc, factor));
const turnLeft = nudge("pose.rotation.y", (angle) => angle - ANGLE);
const turnRight = nudge("pose.rotation.y", (angle) => angle + ANGLE);
const shrink = nudge("pose.size", (size) => size / ZOOM);
const grow = nudge("pose.size", (size) => size * ZOOM);

export const KEYS: readonly Key[] = [
    key(ARROWS.join(" "), "← → ↑ ↓", "Turn", orbit),
    key(ARROWS.map((name) => `Shift+${name}`).join(" "), "Shift ← → ↑ ↓", "Move the view", pan),
    key("+ =", "+", "Zoom in", zoom(ZOOM)),
    key("- _", "-", "Zoom out", zoom(1 / ZOOM)),
    key("f", "F", "Fit into the picture", fit),
    key("0 Home", "0", "Reset the camera", (app) => app.change(resetCamera(app.doc.value, app.own.value), "Reset")),
    key("1 2 3 4 5 6 7 8 9", "1 … 9", "Choose a look", (app, name) => look(app, Number(name) - 1)),
    key("l", "L", "Next look", (app) => look(app, LOOKS.findIndex(({ name }) => name === lookOf(app.doc.value)) + 1)),
    key("s", "S", "Surprise me", surpriseMe),
    key("g", "G", "Random Genesis piece", (app) => void anyGenesis(app)),
    key("m", "M", "Move objects by dragging", () => show({ tool: open.peek().tool === "move" ? "turn" : "move" })),
    key("[", "[", "Turn the object left", turnLeft),
    key("]", "]", "Turn the object right", turnRight),
    key(",", ",", "Make the object smaller", shrink),
    key(".", ".", "Make the object larger", grow),
    key("d", "D", "Duplicate the selected objects", duplicate),
    key("Delete Backspace", "Delete", "Remove the selected objects", remove),
    key("Ctrl+a", "Ctrl A", "Select all objects", ({ selected, doc }) => (selected.value = idsOf(doc.value.objects))),
    key("Escape", "Esc", "Stop, or select nothing", escape),
    key("p", "P", "Switch projection", cycle("camera.projection")),
    key("h", "H", "Next shading", cycle("material.shading")),
    key("w", "W", "Wireframe", cycle("object.wireframe")),
    key("c", "C", "Cull back faces", cycle("object.cull")),
    key("i", "I", "Invert", cycle("scene.invert")),
    key("a", "A", "Anti-aliasing", cycle("scene.antialias")),
    key("Ctrl+z", "Ctrl Z", "Undo", (app) => app.undo()),
    key("Ctrl+Shift+z Ctrl+y", "Ctrl Shift Z", "Redo", (app) => app.redo()),
    key("Ctrl+s", "Ctrl S", "Download and share", (app) => void app.openDialog("download")),
    key("Enter", "Enter", "Gas, limits and stages", (app) => void app.openDialog("limits")),
    key("?", "?", "Show the keys", (app) => void app.openDialog("keys")),
];

/** What the pointer does, and how. */
export const POINTER = [
    { text: "Turn", shown: "drag" },
    { text: "Move the view", shown: "right drag, two fingers" },
    { text: "Zoom", shown: "wheel, pinch" },
    { text: "Fit into the picture", shown: "double click" },
    { text: "Select an object", shown: "click" },
    { text: "Select several", shown: "Shift click" },
    { text: "Move an object", shown: "M, then drag" },
    { text: "Lift it", shown: "M, then Shift drag" },
    { text: "Move a light", shown: "drag its sphere" },
] as const;

function escape(app: App): void {
    const cancel = app.busy.value?.cancel;
    if (cancel) cancel();
    else if (open.peek().tool === "move") show({ tool: "turn" });
    else app.selected.value = new Set();
}

const BY_NAME = new Map(KEYS.flatMap((key) => key.names.map((name) => [name, key] as const)));

/** Fields of text take all keys; sliders, choices and colours take arrows and Home, and buttons take Enter. */
const typed = (element: Element): boolean =>
    element.closest(
        "input:not([type=range], [type=checkbox], [type=radio], [type=color]), textarea, select, [contenteditable]",
    ) !== null;
const own = (element: Element, key: string): boolean =>
    key === "Enter"
        ? element.closest("button, a, summary, input, label") !== null
        : key.length > 1 && key !== "Escape" && element.closest("input:not([type=checkbox])") !== null;

/** Listen to the keys of the page. */
export function listenToKeys(app: App): void {
    document.addEventListener("keydown", (event) => {
        if (event.isComposing || event.altKey || app.dialog.value || !(event.target instanceof Element)) return;
        const control = event.ctrlKey || event.metaKey;
        const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
        const shift = event.shiftKey && (control || event.key.length > 1);
        const name = `${control ? "Ctrl+" : ""}${shift ? "Shift+" : ""}${key}`;
        const found = BY_NAME.get(name);
        if (!found || typed(event.target) || (!control && own(event.target, event.key))) return;
        event.preventDefault();
        found.does(app, name);
    });
}
