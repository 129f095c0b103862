// The picture, and all that is dragged on it.

import { useComputed, useSignal, useSignalEffect } from "@preact/signals";
import { useEffect, useLayoutEffect, useRef } from "preact/hooks";
import { add, type Vector } from "../../scene/arithmetic.js";
import type { App } from "../app.js";
import { panned, turned, zoomed } from "../../document/camera.js";
import type { Document, Item } from "../../document/document.js";
import { onDisc } from "../../document/lamps.js";
import { changed, chosen, sphereOf, tidied } from "../../document/measure.js";
import { listen } from "./gestures.js";
import { IconButton } from "./icons.js";
import { fit } from "./keys.js";
import { dragsLight } from "./lamp_drag.js";
import { dragged, project, type Spot } from "./place.js";
import { open, show } from "../state.js";

/** Radius of the sphere of the lights, in parts of the picture's height. */
const DISC = 0.4;
/** Pixels on both sides for the tools. */
const BESIDE = 50;
/** The part of the room that is enough. */
const FULL = 0.65;
const HINT = matchMedia("(pointer: coarse)").matches
    ? "Drag to turn · pinch to zoom"
    : "Drag to turn · scroll to zoom · drop a file to open it";
const LABEL =
    "The picture. Arrow keys turn the view, plus and minus zoom, Shift and arrow keys move it, question mark shows all keys.";

export function Picture({ app }: { app: App }) {
    const well = useRef<HTMLDivElement>(null);
    const view = useRef<HTMLDivElement>(null);
    const canvas = useRef<HTMLCanvasElement>(null);
    const space = useSignal<readonly [number, number, number]>([0, 0, 0]);
    const { seen } = app.drawing;
    const { begun, lamps, tool } = open.value;

    const title = useComputed(() => seen.value?.doc.title || "The picture");

    useLayoutEffect(() => {
        const place = well.current as HTMLDivElement;
        const measure = (): void => {
            // small screens have their tools on the picture
            const beside = matchMedia("(max-width: 700px)").matches ? 0 : BESIDE;
            space.value = [place.clientWidth - 2 * beside, place.clientHeight, beside];
        };
        const observer = new ResizeObserver(measure);
        observer.observe(place);
        return () => observer.disconnect();
    }, []);

    // pixels of the picture are whole multiples of those of the screen, where that fills most of the room
    const box = useComputed(() => {
        const { width, height } = (seen.value ?? { doc: app.doc.value }).doc;
        const ratio = window.devicePixelRatio || 1;
        const most = Math.min((space.value[0] * ratio) / width, (space.value[1] * ratio) / height);
        const exact = most >= 1 && Math.floor(most) / most > FULL;
        const factor = (exact ? Math.floor(most) : most) / ratio;
        const [w, h] = [width * factor, height * factor];
        const snap = (x: number): number => Math.round(x * ratio) / ratio;
        return { w, h, x: snap(space.value[2] + (space.value[0] - w) / 2), y: snap((space.value[1] - h) / 2), exact };
    });
    useSignalEffect(() => {
        const { w, h, x, y } = box.value;
        const style = (view.current as HTMLDivElement).style;
        // the title stays close to the picture
        well.current?.parentElement?.style.setProperty("--lift", String(Math.max(0, y)));
        const lengths = { width: w, height: h, left: x, top: y };
        for (const [name, length] of Object.entries(lengths)) style.setProperty(name, `${length}px`);
    });
    useSignalEffect(() => {
        const shown = canvas.current as HTMLCanvasElement;
        if (!seen.value) return;
        const { width, height, pixels } = seen.value.drawn;
        if (shown.width !== width || shown.height !== height) [shown.width, shown.height] = [width, height];
        shown.getContext("2d")?.putImageData(new ImageData(pixels, width, height), 0, 0);
        shown.classList.toggle("soft", !box.value.exact || width !== seen.value.doc.width);
    });
    // what tests wait for
    useSignalEffect(() => {
        const [doc, current, problem] = [app.doc.value, seen.value, app.drawing.problem.value];
        const isSeen = current?.doc === doc;
        const stage = view.current as HTMLDivElement;
        stage.dataset.state = problem ? "failed" : isSeen && !current.draft ? "ready" : "drawing";
        // another object, of which nothing is to be seen yet
        stage.classList.toggle("stale", current !== null && !isSeen && current.doc.title !== doc.title);
    });

    useEffect(() => {
        const stop = new AbortController();
        const stage = view.current as HTMLDivElement;
        const change = (next: Document, label: string): void => app.change(next, label, label);
        const gestures = {
            turn: (dx: number, dy: number) => change(turned(app.doc.peek(), dx, dy), "Turn"),
            pan: (dx: number, dy: number) => change(panned(app.doc.peek(), dx, dy), "Pan"),
            zoom: (factor: number) => change(zoomed(app.doc.peek(), factor), "Zoom"),
            grab: (from: Spot) => (open.peek().tool === "move" ? mover(app, from) : null),
            click: (at: Spot, event: PointerEvent) => void select(app, at, event.shiftKey),
            hold: (is: boolean) => {
                show({ begun: true });
                app.drawing.hold(is);
            },
        };
        listen(stage, gestures, stop.signal);
        stage.addEventListener("dblclick", () => fit(app), { signal: stop.signal });
        return () => stop.abort();
    }, []);

    return (
        <div class="well" ref={well}>
            <Tools app={app} />
            <div id="view" ref={view} tabIndex={0} role="application" aria-label={LABEL} data-tool={tool}>
                <canvas id="picture" ref={canvas} role="img" aria-label={title} width="1" height="1" />
                <Marks app={app} />
                {lamps && <Handles app={app} />}
                <div class={begun || app.canUndo.value ? "hint" : "hint first"} aria-hidden="true">
                    {tool === "move" ? "Drag an object to move it · Shift to lift it" : HINT}
                </div>
            </div>
            <Busy app={app} />
        </div>
    );
}

/** Return what moves the object that is seen there, or turns the view where there is none. */
function mover(app: App, from: Spot): (to: Spot, event: PointerEvent) => void {
    const start = app.doc.peek();
    let ids: ReadonlySet<string> | null | undefined;
    let last = from;
    let late: (() => void) | null = null;
    const move = (to: Spot, upright: boolean): void => {
        const selection = ids as ReadonlySet<string>;
        const { middle } = sphereOf(chosen(start, selection)[0] as Item, app.meshes);
        const by = dragged(start, middle as Vector, from, to, upright);
        const before = new Map(start.objects.map(({ id, position }) => [id, position as Vector]));
        const moved = (item: Item): Item => {
            const position = add(before.get(item.id) ?? (item.position as Vector), by);
            return { ...item, position: tidied(position, start.frame.radius) };
        };
        // what else changes meanwhile, such as the zoom, stays
        app.change(changed(app.doc.peek(), selection, moved), "Move", "Move");
    };
    const found = (index: number): void => {
        const hit = start.objects[index];
        if (hit && !app.selected.peek().has(hit.id)) app.select(hit.id);
        ids = hit ? app.selected.peek() : null;
        late?.();
    };
    app.work.pick(start, from[0], from[1]).then(found, () => (ids = null));
    return (to, { shiftKey }) => {
        const [dx, dy] = [to[0] - last[0], to[1] - last[1]];
        last = to;
        if (ids === null) app.change(turned(app.doc.peek(), (dx * start.width) / start.height, dy), "Turn", "Turn");
        else if (ids) move(to, shiftKey);
        else late = () => ids && move(to, shiftKey);
    };
}

async function select(app: App, [x, y]: Spot, more: boolean): Promise<void> {
    const doc = app.doc.peek();
    try {
        app.select(doc.objects[await app.work.pick(doc, x, y)]?.id ?? null, more);
    } catch {
        // it changed meanwhile
    }
}

function toggleLamps(): void {
    show({ lamps: !open.peek().lamps });
}

const TOOLS = [
    { name: "turn", label: "Turn", hint: "Drag turns the view", does: () => show({ tool: "turn" }) },
    { name: "move", label: "Move objects", hint: "Drag moves objects (M)", does: () => show({ tool: "move" }) },
    { name: "light", label: "Lights", hint: "Show lights that can be dragged", does: toggleLamps },
] as const;

function Tools({ app }: { app: App }) {
    return (
        <div class="tools" role="toolbar" aria-label="Tools">
            {TOOLS.map(({ name, label, hint, does }) => {
                const pressed = name === "light" ? open.value.lamps : open.value.tool === name;
                return (
                    <IconButton
                        name={name}
                        label={label}
                        hint={hint}
                        id={`tool-${name}`}
                        pressed={pressed}
                        onClick={does}
                    />
                );
            })}
            <IconButton name="fit" label="Fit" hint="Fit into the picture (F)" id="fit" onClick={() => fit(app)} />
        </div>
    );
}

/** Small marks on selected objects. */
function Marks({ app }: { app: App }) {
    const doc = app.doc.value;
    const items = doc.objects.filter(({ id }) => app.selected.value.has(id));
    return (
        <>
            {items.map((item) => {
                const at = project(doc, sphereOf(item, app.meshes).middle as Vector);
                return (
                    at && <i key={item.id} class="mark" style={{ left: `${100 * at[0]}%`, top: `${100 * at[1]}%` }} />
                );
            })}
        </>
    );
}

/** Lights as small spheres, on a sphere about the middle of the picture; the fields in the panel do all that they do. */
function Handles({ app }: { app: App }) {
    const doc = app.doc.value;
    const aspect = doc.width / doc.height;
    const picture = (element: HTMLElement): DOMRect => (element.parentElement as HTMLElement).getBoundingClientRect();
    const handles = doc.lights.map((light, number) => {
        const { x, y, near } = onDisc(doc, light);
        const [left, top] = [`${50 + (100 * x * DISC) / aspect}%`, `${50 + 100 * y * DISC}%`];
        const style = { left, top, background: near ? String(light.color) : "transparent" };
        const drags = dragsLight(app, number, picture, DISC);
        const name = near ? "handle" : "handle behind";
        return (
            <div key={number} class={name} style={style} aria-hidden="true" data-name={`handle-${number}`} {...drags}>
                <b>{number + 1}</b>
            </div>
        );
    });
    return <>{handles}</>;
}

function Busy({ app }: { app: App }) {
    const busy = app.busy.value;
    if (!busy) return null;
    return (
        <div class="busy" data-name="busy">
            {busy.part === undefined ? <i class="turning" /> : <progress value={busy.part} aria-label={busy.what} />}
            <span role="status">{busy.what} …</span>
            {busy.cancel && (
                <button type="button" data-name="cancel" onClick={busy.cancel}>
                    Cancel
                </button>
            )}
        </div>
    );
}
