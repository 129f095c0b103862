// The state of the page, and all that changes it.

import { batch, computed, effect, signal, type ReadonlySignal, type Signal } from "@preact/signals";
import type { ComponentType } from "preact";
import { InputError } from "../errors.js";
import { CallError } from "../evm/contracts.js";
import type { Opened } from "../files/index.js";
import { loaded, type PageAssets, type PieceEntry } from "./assets.js";
import { fitted } from "../document/camera.js";
import { prepare, type Document } from "../document/document.js";
import { History } from "../document/history.js";
import type { MeshStore } from "./mesh_store.js";
import { linkOf } from "../document/link.js";
import { withPiece } from "../document/objects.js";
import { capital } from "../document/fields.js";
import { MissingFiles } from "../document/save.js";
import { autosave } from "./things.js";
import { calm } from "./calm.js";
import { Drawing, type Shown } from "./drawing.js";
import { doing, note, open, show, type Busy, type DialogName } from "./state.js";
import { Cancelled, type Work } from "./work/work.js";

/** A line that is shown for some seconds. */
export interface Toast {
    id: number;
    text: string;
    kind: "note" | "error";
}

/** Milliseconds after the last change until it is kept. */
const KEEP = 400;
const MOST_BYTES = 100 * 1024 * 1024;
/** The least side of the picture of a mesh file. */
const LEAST_SIDE = 256;

export class App {
    readonly doc: Signal<Document>;
    /** The document as it was opened, to which controls are reset. */
    readonly own: Signal<Document>;
    /** The ids of the objects that are selected; of none: all are meant. */
    readonly selected: Signal<ReadonlySet<string>> = signal(new Set<string>());
    /** The last finished picture at full size; null before the first. */
    readonly shown: Signal<Shown | null> = signal(null);
    readonly busy = computed(() => doing.value.busy);
    /** The dialog that is open: see `openDialog`. */
    readonly dialog = computed(() => open.value.dialog);
    readonly toasts: Signal<readonly Toast[]> = signal([]);
    /** The link of the document, without the address of the page: "#1…"; null while it is not known. */
    readonly link: Signal<string | null> = signal(null);
    /** Files that the link does not contain: their names. */
    readonly missing: Signal<readonly string[]> = signal([]);
    readonly canUndo: ReadonlySignal<boolean>;
    readonly canRedo: ReadonlySignal<boolean>;
    readonly pieces: Signal<readonly PieceEntry[]> = signal([]);
    /** The document for panels, which need not follow each frame of a movement. */
    readonly calm: ReadonlySignal<Document>;
    readonly drawing: Drawing;
    readonly #history: History;
    /** A document of which files are missing: it is shown when they were opened. */
    #waiting: Document | null = null;
    readonly #steps = signal(0);
    /** Ends the opening of files or a piece when others are opened: the last are shown. */
    #opening = new AbortController();
    #toast = 0;
    readonly #dialogs: Partial<Record<DialogName, ComponentType | undefined>> = {};

    constructor(
        readonly assets: PageAssets,
        readonly meshes: MeshStore,
        readonly work: Work,
        /** Loads a dialog. */
        private readonly dialogOf: (name: DialogName, app: App) => Promise<ComponentType>,
        first: Document,
        own = first,
    ) {
        this.doc = signal(first);
        this.calm = calm(this.doc);
        this.own = signal(own);
        this.#history = new History(first);
        this.canUndo = computed(() => this.#steps.value >= 0 && this.#history.canUndo);
        this.canRedo = computed(() => this.#steps.value >= 0 && this.#history.canRedo);
        this.drawing = new Drawing(this);
        this.#keep();
    }

    // ---- changes ----

    /** Show another document, as one step of undo; steps with the same `merge` within a second are one. */
    change(next: Document, label: string, merge?: string): void {
        if (next === this.doc.peek()) return;
        this.#history.push(next, label, merge);
        if (merge !== undefined) this.drawing.moved();
        this.#show(this.#history.value);
    }

    undo(): void {
        this.#show(this.#history.undo());
    }

    redo(): void {
        this.#show(this.#history.redo());
    }

    #show(doc: Document | null): void {
        if (!doc) return;
        batch(() => {
            this.doc.value = doc;
            this.#steps.value += 1;
            const there = [...this.selected.peek()].filter((id) => doc.objects.some((item) => item.id === id));
            if (there.length < this.selected.peek().size) this.selected.value = new Set(there);
        });
    }

    /** Select an object, or none. more: besides the others, or not any more. */
    select(id: string | null, more = false): void {
        const others = [...this.selected.peek()].filter((each) => each !== id);
        const wasThere = others.length < this.selected.peek().size;
        if (id === null) this.selected.value = more ? this.selected.peek() : new Set();
        else this.selected.value = new Set(more ? (wasThere ? others : [...others, id]) : [id]);
    }

    // ---- opening ----

    /** Open files, as from a drop. */
    async open(files: readonly File[]): Promise<void> {
        if (!files.length) return;
        const what = files.length === 1 ? (files[0] as File).name : `${files.length} files`;
        const read = async (signal: AbortSignal): Promise<void> => {
            if (files.reduce((sum, { size }) => sum + size, 0) > MOST_BYTES) {
                throw new InputError("All files together may have up to 100 MB");
            }
            const { readFiles } = await loaded(import("../files/index.js"));
            const given = files.map(async (file) => {
                return { name: file.webkitRelativePath || file.name, bytes: new Uint8Array(await file.arrayBuffer()) };
            });
            const { width, height } = this.doc.peek();
            const draco = (): Promise<Uint8Array> => this.assets.bytes("draco.wasm");
            const options = { size: Math.max(width, height, LEAST_SIDE), library: this.meshes, draco, signal };
            const opened = await readFiles(await Promise.all(given), options);
            signal.throwIfAborted();
            await this.take(opened);
        };
        await this.run(`Reading ${what}`, read, this.#openNext());
    }

    /** End what is being opened, for what is opened now. */
    #openNext(): AbortController {
        this.#opening.abort();
        return (this.#opening = new AbortController());
    }

    /** Show what was opened elsewhere, and say what is not as in its file. */
    async take({ document, meshes, notes }: Opened, label = "Open a file"): Promise<void> {
        this.meshes.put(meshes);
        const waiting = this.#waiting;
        const isComplete = waiting?.objects.every(({ mesh }) => "piece" in mesh || this.meshes.has(mesh));
        if (isComplete) this.#waiting = null;
        await this.openDocument(waiting && isComplete ? waiting : document, label);
        for (const note of notes) this.tell(note);
    }

    /** Open a piece of a dataset, or of Genesis by its number or seed: "genesis/7". add: as further objects of the scene. */
    async openPiece(name: string, add = false): Promise<void> {
        const open = async (signal: AbortSignal): Promise<void> => {
            const piece = await this.meshes.piece(name);
            signal.throwIfAborted();
            await this.#open(piece, add);
        };
        await this.run("Opening", open, add ? new AbortController() : this.#openNext());
    }

    async #open(piece: Document, add: boolean): Promise<void> {
        const now = this.doc.peek();
        if (!add) {
            // in its own shape, as large as the picture before
            const scale = Math.max(now.width, now.height) / Math.max(piece.width, piece.height);
            const size = { width: Math.round(scale * piece.width), height: Math.round(scale * piece.height) };
            return this.openDocument({ ...piece, ...size, antialias: now.antialias }, `Open ${piece.title}`);
        }
        this.addObjects(fitted(withPiece(now, piece, this.meshes), this.meshes), `Add ${piece.title}`);
    }

    /** Show a document with further objects at the end of its list, which are selected. */
    addObjects(next: Document, label: string): void {
        const added = next.objects.slice(this.doc.peek().objects.length);
        this.own.value = { ...this.own.peek(), objects: [...this.own.peek().objects, ...added] };
        this.change(next, label);
        this.selected.value = new Set(added.map(({ id }) => id));
    }

    /** Open a document, such as one of my things. own: what its controls are reset to. */
    async openDocument(doc: Document, label: string, own = doc): Promise<void> {
        await this.meshes.need(doc);
        batch(() => {
            this.own.value = own;
            this.selected.value = new Set();
            this.change(doc, label);
        });
    }

    /** Open a dialog in place of another. It is open once its code is there. */
    async openDialog(name: DialogName): Promise<void> {
        show({ asked: name });
        const Dialog = (this.#dialogs[name] ??= await this.run("Opening", () => this.dialogOf(name, this)));
        if (Dialog && open.peek().asked === name) show({ dialog: { name, Dialog } });
    }

    closeDialog(): void {
        show({ asked: null, dialog: null });
    }

    /** The address that restores the picture; "" while it is not known. */
    get address(): string {
        return this.link.value === null ? "" : `${location.href.split("#")[0]}${this.link.value}`;
    }

    // ---- what is kept ----

    /** Keep the document in the address and in the browser, some time after its last change. */
    #keep(): void {
        let timer: ReturnType<typeof setTimeout> | undefined;
        effect(() => {
            const doc = this.doc.value;
            this.link.value = null;
            clearTimeout(timer);
            timer = setTimeout(() => void this.#keepNow(doc).catch((error: unknown) => console.warn(error)), KEEP);
        });
    }

    async #keepNow(doc: Document): Promise<void> {
        await prepare(doc, this.meshes);
        const { text, missing } = await linkOf(doc, this.meshes);
        if (doc !== this.doc.peek()) return;
        batch(() => {
            this.link.value = text;
            this.missing.value = missing;
        });
        // as long as nothing was done, the address stays as it is, and so does what was kept before
        if (!this.#steps.peek()) return;
        history.replaceState(null, "", location.pathname + (missing.length ? "" : text));
        await autosave(doc);
    }

    // ---- long work, and words ----

    /** Run something long: shows that the page is busy, cancels it by the button, and shows its error. undefined where it failed. */
    async run<T>(
        what: string,
        work: (signal: AbortSignal, progress: (part: number) => void) => Promise<T>,
        abort = new AbortController(),
    ): Promise<T | undefined> {
        let mine: Busy = { what, cancel: () => abort.abort() };
        note({ busy: mine });
        const progress = (part: number): void => {
            if (this.busy.peek() !== mine) return;
            note({ busy: (mine = { ...mine, part }) });
        };
        try {
            return await work(abort.signal, progress);
        } catch (error) {
            if (!abort.signal.aborted) this.fail(error);
            return undefined;
        } finally {
            if (this.busy.peek() === mine) note({ busy: null });
        }
    }

    /** Show a sentence for some seconds. */
    tell(text: string): void {
        this.#say(text, "note");
    }

    /** Show an error. */
    fail(error: unknown): void {
        if (error instanceof Cancelled) return;
        if (error instanceof MissingFiles) this.#waiting = error.document;
        this.#say(this.sentence(error), "error");
    }

    /** Return what an error says, for an artist. */
    sentence(error: unknown): string {
        if (error instanceof InputError || error instanceof CallError) return capital(error.message);
        console.error(error);
        return `Something went wrong: ${error instanceof Error ? error.message : String(error)}`;
    }

    #say(text: string, kind: Toast["kind"]): void {
        const toast = { id: (this.#toast += 1), text, kind };
        const others = this.toasts.peek().filter((each) => each.text !== text);
        this.toasts.value = [...others.slice(-2), toast];
        setTimeout(() => this.dismiss(toast.id), kind === "error" ? 15_000 : 3000 + 70 * text.length);
    }

    dismiss(id: number): void {
        this.toasts.value = this.toasts.peek().filter((each) => each.id !== id);
    }

    /** Hand a file to the visitor. */
    save(blob: Blob, name: string): void {
        const href = URL.createObjectURL(blob);
        const anchor = Object.assign(document.createElement("a"), { href, download: name });
        document.body.append(anchor);
        anchor.click();
        anchor.remove();
        setTimeout(() => URL.revokeObjectURL(href), 60_000);
    }

    /** Copy a text, and say so. */
    async copy(text: string): Promise<void> {
        try {
            await navigator.clipboard.writeText(text);
            this.tell("Copied");
        } catch {
            this.#say("The browser does not allow the page to copy: select the text and copy it", "error");
        }
    }
}
