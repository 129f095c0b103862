// Starts the Creator.

import { render } from "preact";
import { App } from "./app.js";
import { open, type DialogName } from "./state.js";
import { PageAssets, loaded } from "./assets.js";
import { turned } from "../document/camera.js";
import type { Document } from "../document/document.js";
import { MeshStore } from "./mesh_store.js";
import { documentOfLink } from "../document/link.js";
import { autosaved } from "./things.js";
import { restoreTheme } from "./ui/header.js";
import { listenToKeys } from "./ui/keys.js";
import { Page } from "./ui/page.js";
import { showToasts } from "./ui/toasts.js";
import { Work } from "./work/work.js";
import { clamped } from "../scene/arithmetic.js";
import "./ui/style.css";

/** What is shown where nothing else is asked for. */
const FIRST = { piece: "icons/crystals", side: 256 } as const;
/** The first piece turns into view: so far, in so many milliseconds, if a draft takes no more than this. */
const ENTRANCE = { turn: 0.3, time: 1500, draft: 120 } as const;

interface Start {
    doc: Document;
    /** What its controls are reset to. */
    own?: Document;
    notes?: readonly string[];
    isFirst?: boolean;
}

/** What `shackled creator INPUT` says of its input. */
type Input = { names: string[] } | { piece: string };

async function start(): Promise<void> {
    restoreTheme();
    const assets = new PageAssets();
    const meshes = new MeshStore(assets);
    const work = new Work(assets, meshes);
    meshes.genesis = (seed) => work.genesis(seed);
    const problems: unknown[] = [];
    const attempt = async (make: () => Promise<Start | null>): Promise<Start | null> => {
        try {
            const found = await make();
            if (found) await meshes.need(found.doc);
            return found;
        } catch (error) {
            problems.push(error);
            return null;
        }
    };
    const found =
        (await attempt(() => fromLink(location.hash, meshes))) ??
        (await attempt(() => fromInput(meshes, assets))) ??
        (await attempt(() => fromBefore(meshes))) ??
        (await first(meshes));
    const dialogOf = async (name: DialogName, app: App) => (await loaded(import("./dialogs.js"))).dialogOf(name, app);
    const app = new App(assets, meshes, work, dialogOf, found.doc, found.own);
    listenToKeys(app);
    // for consoles, and tests
    Object.assign(globalThis, { shackledApp: app });
    render(<Page app={app} />, document.getElementById("app") as HTMLElement);
    showToasts(app);
    for (const error of problems) app.fail(error);
    for (const note of found.notes ?? []) app.tell(note);
    addEventListener("hashchange", ({ newURL }) => void openLink(app, new URL(newURL).hash));
    void assets.pieces().then((pieces) => (app.pieces.value = pieces));
    if (found.isFirst) turnIntoView(app);
}

/** The link in the address, if there is one. */
async function fromLink(hash: string, meshes: MeshStore): Promise<Start | null> {
    if (hash.length < 3) return null;
    const doc = await documentOfLink(hash, meshes);
    return { doc, own: await ownOf(doc, meshes) };
}

/** Open a link that was put into the address, which may be that of the document of before again: it is kept a moment after a change. */
async function openLink(app: App, hash: string): Promise<void> {
    if (hash === app.link.value) return;
    await app.run("Opening the link", async () => {
        const found = await fromLink(hash, app.meshes);
        if (found) await app.openDocument(found.doc, "Open a link", found.own);
    });
}

/** What the command opened, if it was started with something. */
async function fromInput(meshes: MeshStore, assets: PageAssets): Promise<Start | null> {
    if (!new URLSearchParams(location.search).has("input")) return null;
    const input = (await (await fetch("input.json")).json()) as Input;
    if ("piece" in input) return { doc: await meshes.piece(input.piece) };
    const [{ readFiles }, files] = await Promise.all([
        loaded(import("../files/index.js")),
        Promise.all(
            input.names.map(async (name) => {
                const path = name.split("/").map(encodeURIComponent).join("/");
                return { name, bytes: new Uint8Array(await (await fetch(`input/${path}`)).arrayBuffer()) };
            }),
        ),
    ]);
    const draco = () => assets.bytes("draco.wasm");
    const opened = await readFiles(files, { size: FIRST.side, library: meshes, draco });
    meshes.put(opened.meshes);
    return { doc: opened.document, notes: opened.notes };
}

/** What was on the page when it was left. */
async function fromBefore(meshes: MeshStore): Promise<Start | null> {
    const doc = await autosaved();
    return doc && { doc, own: await ownOf(doc, meshes) };
}

/** Return what the controls of a document are reset to: the piece of which it is made, where it is one. */
async function ownOf(doc: Document, meshes: MeshStore): Promise<Document> {
    const pieces = new Set(doc.objects.map(({ mesh }) => ("piece" in mesh ? mesh.piece : "")));
    const [name] = pieces;
    if (pieces.size !== 1 || !name) return doc;
    const { width, height, antialias } = doc;
    return { ...(await meshes.piece(name)), width, height, antialias };
}

async function first(meshes: MeshStore): Promise<Start> {
    const piece = await meshes.piece(FIRST.piece);
    return { doc: { ...piece, width: FIRST.side, height: FIRST.side, antialias: true }, isFirst: true };
}

/** Turn the first piece into view, unless motion is unwanted, drafts are slow, or the visitor has begun. */
function turnIntoView(app: App): void {
    const end = app.doc.peek();
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) return;
    const at = performance.now();
    const isOver = (): boolean =>
        open.peek().begun || (app.drawing.seen.peek()?.drawn.milliseconds ?? 0) > ENTRANCE.draft;
    let now = end;
    const step = (time: number): void => {
        if (app.doc.peek() !== now) return;
        const part = clamped((time - at) / ENTRANCE.time, 0, 1);
        const left = (1 - part) ** 3;
        app.drawing.moved();
        app.doc.value = now = part === 1 || isOver() ? end : turned(end, ENTRANCE.turn * left, 0);
        if (now !== end) requestAnimationFrame(step);
        else app.drawing.hold(false);
    };
    step(at);
}

start().catch((error: unknown) => {
    console.error(error);
    const place = document.getElementById("app") as HTMLElement;
    render(
        <p class="failed">The Creator could not start: {error instanceof Error ? error.message : String(error)}</p>,
        place,
    );
});
