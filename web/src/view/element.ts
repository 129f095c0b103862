// The custom element <shackled-view>.

import { InputError } from "../errors.js";
import { Scheduler, type Job, type Plan } from "../draw/scheduler.js";
import type { Size } from "../draw/speed.js";
import { fetchBytes, keptOrLoaded, loadAssets, type Assets, type AssetSources } from "../evm/assets.js";
import { clamped } from "../scene/arithmetic.js";
import { MAX_SIDE } from "../scene/fields.js";
import type { CallFacts } from "../turn.js";
import script from "worker:view/worker.ts";
import { Pool, started } from "../workers/pool.js";
import { Cancelled } from "../workers/protocol.js";
import { listen, type Change, type Gestures } from "./gestures.js";
import type { Checked, Drawn, Requests, Source, Wish } from "./protocol.js";
import { MAX_FILE } from "../scene/call_file.js";
import { STYLE } from "./style.js";

/** What the event `turn` tells: degrees, and a factor. */
export type TurnDetail = Change;

/** What the event `picture` tells of the picture at rest, in the contract's own pixels. */
export interface PictureDetail {
    gas: number;
    width: number;
    height: number;
    /** That the contracts took. */
    milliseconds: number;
    /** Of red, green and blue of all pixels, rows from the top; null in pages that browsers give no cryptography. */
    sha256: string | null;
}

const START: Change = { azimuth: 0, elevation: 0, zoom: 1 };
const MAX_ZOOM = 50;
/** Milliseconds, by an estimate that is usually far too high, above which the picture at rest is not larger than the call's. */
const PATIENCE = 15_000;
/** Where the place of the picture has become so many times larger, it is drawn again. */
const ENLARGED = 1.2;
/** Milliseconds in which the speed of a drag that was let go falls to a third, and the speed at which it ends. */
const INERTIA = 160;
const SLOWEST = 0.01;
/** Milliseconds that a picture may take, unless the attribute `timeout` says otherwise; and a check by a node. */
const TIMEOUT = 30_000;
const CHECK_TIMEOUT = 300_000;
const SOURCES = ["src", "rpc", "studio", "pointer"];

/** Shows a scene as the contracts draw it, in a worker. docs/export.md describes its attributes, properties and events. */
export class ShackledView extends HTMLElement {
    /** Where evm.wasm and contracts.json come from, for all elements without attributes `evm` and `contracts`. */
    static get assets(): AssetSources {
        return this.#sources;
    }

    static set assets(sources: AssetSources) {
        this.#sources = sources;
        this.#loaded.clear();
    }

    static readonly observedAttributes = [...SOURCES, "exact", "label"];
    static #sources: AssetSources = {};
    static readonly #loaded = new Map<string, Promise<Assets>>();

    readonly #parts: Parts;
    #source: Source | null = null;
    #call: Uint8Array<ArrayBuffer> | null = null;
    #facts: CallFacts | null = null;
    #turn: Change = { ...START };
    #picture: (PictureDetail & { pixels: Uint8ClampedArray<ArrayBuffer> }) | null = null;

    /** One worker draws; another one asks nodes. */
    readonly #workers = new Pool<Requests, "draw" | "check">(
        {
            start: () => started(script),
            supplies: async ([lacks]) =>
                new Map<string, unknown>([lacks ? ["call", this.#call] : ["evm", await this.#assets()]]),
        },
        { draw: 1, check: 1 },
    );
    /** Whether it was seen: pictures that nobody sees cost nothing. */
    #isSeen = false;
    /** Ends what is asked of the scene that is shown. */
    #asked = new AbortController();
    #connected: AbortController | null = null;
    readonly #scheduler = new Scheduler<TurnDetail, Drawn>({
        beginsSmall: false,
        value: () => (this.#facts ? this.#turn : null),
        plan: () => this.#plan(),
        draw: (turn, job, signal) => this.#draw(turn, job, signal),
        show: (_, job, drawn) => this.#show(job, drawn),
        fail: (_, error) => this.#fail(error),
    });
    #queued = false;
    #checking = false;
    #inertia = 0;

    constructor() {
        super();
        this.#parts = build(this.attachShadow({ mode: "open" }));
        const { exact, panel, more, reset, form } = this.#parts;
        exact.onclick = () => this.toggleAttribute("exact");
        more.onclick = () => {
            panel.hidden = !panel.hidden;
            more.setAttribute("aria-expanded", String(!panel.hidden));
        };
        reset.onclick = () => this.reset();
        form.onsubmit = (event) => {
            event.preventDefault();
            void this.check(this.#parts.url.value.trim());
        };
    }

    /** The bytes of the call that is shown, unturned; null before there is one. Set them to show another. */
    get call(): Uint8Array | null {
        return this.#call && new Uint8Array(this.#call);
    }

    set call(call: Uint8Array) {
        if (!(call instanceof Uint8Array)) throw new InputError("call must be a Uint8Array");
        this.#take({ file: new Uint8Array(call) });
    }

    /** Show a scene file: its JSON as text, or as a value. */
    set scene(scene: string | object) {
        const text = typeof scene === "string" ? scene : JSON.stringify(scene);
        this.#take({ file: new TextEncoder().encode(text) });
    }

    /** Show the scene of a file: the bytes of a call, a scene file, or a PNG file that Shackled wrote. */
    async open(file: Blob): Promise<void> {
        if (file.size > MAX_FILE)
            return this.#fail(new InputError(`a file must have up to ${MAX_FILE.toLocaleString("en")} bytes`));
        this.#take({ file: new Uint8Array(await file.arrayBuffer()) });
    }

    /** From where the scene is seen: degrees to the right and upward, and a factor. */
    get turn(): TurnDetail {
        return { ...this.#turn };
    }

    set turn(turn: Partial<TurnDetail>) {
        cancelAnimationFrame(this.#inertia);
        this.#face({ ...START, ...turn });
    }

    /** The last picture at rest, with the contract's own pixels in RGBA; null before there is one. */
    get picture(): (PictureDetail & { pixels: Uint8ClampedArray }) | null {
        return this.#picture;
    }

    /** See the scene as its call does. */
    reset(): void {
        cancelAnimationFrame(this.#inertia);
        if (this.#facts) this.#face(START);
    }

    /** Have a node compute the same picture, and compare all bytes. url: of its JSON-RPC. The element shows the outcome. */
    async check(url: string): Promise<Checked> {
        const { outcome, send } = this.#parts;
        const show = (checked: Checked | null): void => {
            outcome.textContent = checked?.message ?? "Asking the node ...";
            if (checked) outcome.dataset["outcome"] = checked.outcome;
            else delete outcome.dataset["outcome"];
        };
        let checked: Checked = { outcome: "unknown", message: "There is no picture to check." };
        if (this.#call && this.#facts && !this.#checking) {
            show(null);
            this.#checking = send.disabled = true;
            try {
                const { width, height } = this.#facts;
                const wish = { turn: this.#turn, width, height, samples: 1, hashed: false } as const;
                const options = { signal: this.#asked.signal, limit: CHECK_TIMEOUT };
                checked = await this.#workers.ask("check", { url, wish, call: this.#call }, "check", options);
            } catch (error) {
                const why = error instanceof Cancelled ? "the scene changed" : messageOf(error);
                checked = { outcome: "unknown", message: `The check was interrupted: ${why}.` };
            } finally {
                this.#checking = send.disabled = false;
            }
        }
        show(checked);
        return checked;
    }

    connectedCallback(): void {
        // what the page set before it knew the class
        for (const name of ["call", "scene"] as const) {
            const own = Object.getOwnPropertyDescriptor(this, name);
            if (!own) continue;
            delete (this as Partial<Record<typeof name, unknown>>)[name];
            this[name] = own.value as Uint8Array & string;
        }
        this.#connected = new AbortController();
        const { signal } = this.#connected;
        const { stage } = this.#parts;
        const gestures: Gestures = {
            change: (change, held) => this.#change(change, held),
            release: (speed) => this.#release(speed),
            reset: () => this.reset(),
        };
        listen(stage, gestures, signal);
        this.#listenToFiles(signal);
        const sizes = new ResizeObserver(() => {
            const { canvas, stage } = this.#parts;
            const [shown, place] = [canvas.width, stage.clientWidth * devicePixelRatio];
            const isSmall = this.#picture && !this.hasAttribute("exact") && place > ENLARGED * shown;
            if (isSmall && this.#scheduler.isResting) this.#scheduler.again();
        });
        sizes.observe(stage);
        const observer = new IntersectionObserver(
            (entries) => {
                if (!entries.some((entry) => entry.isIntersecting)) return;
                observer.disconnect();
                this.#isSeen = true;
                if (this.#source) void this.#open(this.#source);
                else this.#load();
            },
            { rootMargin: "200px" },
        );
        observer.observe(this);
        signal.addEventListener("abort", () => {
            sizes.disconnect();
            observer.disconnect();
        });
    }

    disconnectedCallback(): void {
        this.#connected?.abort();
        this.#connected = null;
        cancelAnimationFrame(this.#inertia);
        this.#isSeen = false;
        this.#facts = null;
        this.#asked.abort();
        this.#scheduler.stop();
        this.#workers.stop();
    }

    attributeChangedCallback(name: string, before: string | null, after: string | null): void {
        const { exact, stage } = this.#parts;
        if (name === "label") stage.setAttribute("aria-label", after || "3D scene");
        if (name === "exact") {
            exact.setAttribute("aria-pressed", String(after !== null));
            if ((before === null) !== (after === null)) this.#scheduler.again();
        }
        if (name === "rpc" && after) this.#parts.url.value = after;
        if (SOURCES.includes(name) && before !== after) {
            this.#source = null;
            if (this.#queued) return;
            // attributes that are set one after the other are one source
            this.#queued = true;
            queueMicrotask(() => {
                this.#queued = false;
                this.#load();
            });
        }
    }

    /** Begin with what the attributes name. */
    #load(): void {
        if (!this.#isSeen || this.#source) return;
        const [src, rpc, studio, pointer] = SOURCES.map((name) => this.getAttribute(name)) as (string | null)[];
        if (src) {
            const { signal } = this.#next();
            const url = src.startsWith("#") ? src : new URL(src, document.baseURI).href;
            fetchBytes(url, MAX_FILE, "the scene", signal).then(
                (file) => signal.aborted || this.#take({ file }),
                (error: unknown) => signal.aborted || this.#fail(error),
            );
        } else if (rpc && studio && pointer) {
            this.#take({ rpc, studio, pointer });
        }
    }

    #assets(): Promise<Assets> {
        const { assets } = ShackledView;
        const own = { evm: this.getAttribute("evm"), contracts: this.getAttribute("contracts") };
        const load = () => loadAssets({ evm: own.evm ?? assets.evm, contracts: own.contracts ?? assets.contracts });
        return keptOrLoaded(ShackledView.#loaded, JSON.stringify(own), load);
    }

    #listenToFiles(signal: AbortSignal): void {
        const { stage } = this.#parts;
        const mark = (event: DragEvent, on: boolean): void => {
            if (!event.dataTransfer?.types.includes("Files")) return;
            event.preventDefault();
            stage.classList.toggle("drop", on);
        };
        this.addEventListener("dragover", (event) => mark(event, true), { signal });
        this.addEventListener("dragleave", (event) => mark(event, false), { signal });
        this.addEventListener(
            "drop",
            (event) => {
                mark(event, false);
                const file = event.dataTransfer?.files[0];
                if (file) void this.open(file);
            },
            { signal },
        );
    }

    /** Show another scene. */
    #take(source: Source): void {
        this.#source = source;
        this.#turn = { ...START };
        this.#parts.reset.hidden = true;
        if (this.#isSeen) void this.#open(source);
    }

    /** End what belongs to the scene before. */
    #next(): AbortController {
        this.#asked.abort();
        return (this.#asked = new AbortController());
    }

    async #open(source: Source): Promise<void> {
        const { signal } = this.#next();
        cancelAnimationFrame(this.#inertia);
        this.#facts = this.#call = this.#picture = null;
        this.#turn = { ...this.#turn };
        this.#scheduler.stop();
        this.#scheduler.forget();
        this.#clearOutcome();
        this.#busy(true);
        this.#say("");
        try {
            const limit = "file" in source ? this.#timeout : CHECK_TIMEOUT;
            const { call, facts } = await this.#workers.ask("open", source, "draw", { signal, limit });
            if (signal.aborted) return;
            [this.#call, this.#facts] = [call, facts];
            this.#parts.canvas.style.aspectRatio = `${facts.width} / ${facts.height}`;
            const { azimuth, elevation, zoom } = this.#turn;
            if (azimuth || elevation || zoom !== 1) this.#face(this.#turn, true);
            this.#scheduler.wake();
        } catch (error) {
            if (signal.aborted) return;
            this.#fail(error);
            // nothing of the scene before it remains
            const { canvas, poster, bar, panel, more } = this.#parts;
            canvas.hidden = bar.hidden = panel.hidden = true;
            more.setAttribute("aria-expanded", "false");
            poster.hidden = false;
        }
    }

    get #timeout(): number {
        const given = Number(this.getAttribute("timeout"));
        return given > 0 ? given : TIMEOUT;
    }

    // ---- movement ----

    #change(change: Partial<Change>, held: boolean): void {
        cancelAnimationFrame(this.#inertia);
        if (!this.#facts) return;
        const { azimuth = 0, elevation = 0, zoom = 1 } = change;
        if (azimuth || elevation || zoom !== 1) this.#turnBy(azimuth, elevation, zoom);
        if (held) this.#scheduler.hold(true);
    }

    #turnBy(azimuth: number, elevation: number, zoom: number): void {
        const { azimuth: a, elevation: e, zoom: z } = this.#turn;
        this.#face({ azimuth: a + azimuth, elevation: e + elevation, zoom: z * zoom });
    }

    /** Go on for a moment at the speed at which the scene was let go. */
    #release(speed: { azimuth: number; elevation: number }): void {
        const isStill = matchMedia("(prefers-reduced-motion: reduce)").matches;
        const glides = !isStill && Math.hypot(speed.azimuth, speed.elevation) >= SLOWEST;
        this.#scheduler.hold(false, glides);
        if (!glides) return;
        let last = performance.now();
        let { azimuth, elevation } = speed;
        const step = (now: number): void => {
            const time = Math.max(now - last, 0);
            last = now;
            if (Math.hypot(azimuth, elevation) < SLOWEST) return;
            this.#turnBy(azimuth * time, elevation * time, 1);
            const decay = Math.exp(-time / INERTIA);
            azimuth *= decay;
            elevation *= decay;
            this.#inertia = requestAnimationFrame(step);
        };
        this.#inertia = requestAnimationFrame(step);
    }

    /** The outcome of a check is that of one picture. */
    #clearOutcome(): void {
        if (!this.#checking) this.#parts.outcome.textContent = "";
        delete this.#parts.outcome.dataset["outcome"];
    }

    /** Take a turn, within its range, and draw frames until the viewer rests. */
    #face({ azimuth, elevation, zoom }: Change, atRest = false): void {
        const [low, high] = this.#facts?.elevations ?? [-90, 90];
        if (![azimuth, elevation, zoom].every(Number.isFinite)) throw new InputError("turn must consist of numbers");
        this.#turn = {
            // within half a turn, so that numbers stay short
            azimuth: azimuth - 360 * Math.round(azimuth / 360),
            elevation: clamped(elevation, low, high),
            zoom: clamped(zoom, 1 / MAX_ZOOM, MAX_ZOOM),
        };
        const { reset } = this.#parts;
        reset.hidden = !(this.#turn.azimuth || this.#turn.elevation || this.#turn.zoom !== 1);
        this.#clearOutcome();
        this.dispatchEvent(new CustomEvent<TurnDetail>("turn", { detail: this.turn, bubbles: true, composed: true }));
        if (!this.#facts || atRest) return;
        this.#parts.stage.dataset["moving"] = "";
        this.#scheduler.moved();
    }

    // ---- pictures ----

    /** The contract's own pixels, and, unless these are to be shown, the mean of four for each. */
    #plan(): Plan {
        const { width, height } = this.#facts as CallFacts;
        const shown = this.#shownSize();
        const isExact = this.hasAttribute("exact") || 2 * Math.max(...shown) > MAX_SIDE;
        const exact = { size: [width, height], samples: 1 } as const;
        return { exact, finer: isExact ? null : { size: shown, samples: 4 }, share: 1, isPlain: false };
    }

    async #draw(turn: TurnDetail, { quality, size: [width, height] }: Job, signal: AbortSignal): Promise<Drawn> {
        if (quality !== "draft") delete this.#parts.stage.dataset["moving"];
        if (quality === "exact") this.#busy(true);
        const wish: Wish = { turn, width, height, samples: quality === "finer" ? 2 : 1, hashed: quality === "exact" };
        return this.#workers.ask("draw", wish, "draw", { signal, limit: this.#timeout });
    }

    #show({ quality, size: [width, height] }: Job, drawn: Drawn): void {
        const { gas, milliseconds, sha256, pixels } = drawn;
        const isExact = this.hasAttribute("exact");
        const { finer } = this.#plan();
        if (quality === "draft") {
            this.#paint(drawn, isExact);
            this.dispatchEvent(new CustomEvent("frame", { detail: { width, height, milliseconds } }));
        } else if (quality === "exact") {
            // the finer picture may take seconds: until then, what is finer than the last frame of the movement is shown
            const isFiner = !this.#picture || !finer || this.#parts.canvas.width < width;
            this.#picture = { gas, width, height, milliseconds, sha256, pixels };
            if (isFiner) this.#paint(drawn, isExact);
            this.#say("");
            this.#report(this.#picture, finer?.size ?? null);
        } else this.#paint(drawn, false);
        if (quality === (finer ? "finer" : "exact")) this.#busy(false);
    }

    #paint({ pixels, width, height }: Drawn, exact: boolean): void {
        const { canvas, poster, veil } = this.#parts;
        canvas.width = width;
        canvas.height = height;
        canvas.classList.toggle("exact", exact);
        canvas.getContext("2d")?.putImageData(new ImageData(pixels, width, height), 0, 0);
        canvas.hidden = false;
        poster.hidden = veil.hidden = true;
    }

    /**
     * Return the size of the smoothed picture at rest: that of its place on the screen, at least that of the call, and the
     * latter where it would take too long.
     */
    #shownSize(): Size {
        const { width, height } = this.#facts ?? { width: 1, height: 1 };
        const wanted = (this.#parts.stage.clientWidth * devicePixelRatio) / width;
        const scale = Math.min(wanted, MAX_SIDE / 2 / Math.max(width, height));
        if (scale <= 1) return [width, height];
        const [w, h] = [Math.round(width * scale), Math.round(height * scale)];
        return this.#scheduler.predict(4 * w * h) > PATIENCE ? [width, height] : [w, h];
    }

    #report(picture: PictureDetail, shown: Size | null): void {
        const { figures, hash, exact, bar } = this.#parts;
        bar.hidden = false;
        const { gas, width, height, milliseconds, sha256 } = picture;
        const words = [`${width} x ${height} pixels`, `${gas.toLocaleString("en")} gas`, duration(milliseconds)];
        if (shown) words.push(`smoothed to ${shown[0]} x ${shown[1]}`);
        figures.replaceChildren(...words.map((text) => create("span", { text })));
        hash.textContent = sha256 ?? "not available: the page is neither from https nor from this machine";
        exact.hidden = 2 * Math.max(width, height) > MAX_SIDE;
        const detail: PictureDetail = { gas, width, height, milliseconds, sha256 };
        this.dispatchEvent(new CustomEvent<PictureDetail>("picture", { detail, bubbles: true, composed: true }));
    }

    #busy(busy: boolean): void {
        const { stage, veil, canvas } = this.#parts;
        stage.setAttribute("aria-busy", String(busy));
        veil.hidden = !(busy && canvas.hidden);
    }

    #fail(error: unknown): void {
        if (error instanceof Cancelled) return;
        const message = messageOf(error);
        this.#busy(false);
        delete this.#parts.stage.dataset["moving"];
        this.#say(`${message.charAt(0).toUpperCase()}${message.slice(1)}.`);
        this.dispatchEvent(new ErrorEvent("error", { message }));
    }

    #say(message: string): void {
        const { error } = this.#parts;
        error.textContent = message;
        error.hidden = !message;
    }
}

function messageOf(error: unknown): string {
    return (error instanceof Error ? error.message : String(error)).slice(0, 500);
}

function duration(milliseconds: number): string {
    return milliseconds < 1000
        ? `${Math.max(1, Math.round(milliseconds))} ms`
        : `${(milliseconds / 1000).toFixed(1)} s`;
}

type Parts = ReturnType<typeof build>;

function build(root: ShadowRoot) {
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(STYLE);
    root.adoptedStyleSheets = [sheet];

    const canvas = create("canvas", { part: "canvas", hidden: "" });
    const poster = create("slot", {});
    const veil = create("span", { class: "veil", text: "Drawing ...", hidden: "" });
    const stage = create(
        "div",
        {
            ...{ class: "stage", part: "stage", tabindex: "0", role: "application", "aria-label": "3D scene" },
            "aria-roledescription": "picture that can be turned",
            "aria-describedby": "help",
        },
        [canvas, poster, veil],
    );
    const keys = "Drag or use the arrow keys to turn it, the wheel or plus and minus to zoom, Home to go back.";
    const help = create("p", { id: "help", class: "hidden", text: keys });
    const error = create("p", { class: "error", part: "error", role: "alert", hidden: "" });

    const figures = create("p", { class: "figures", part: "figures", role: "status" });
    const reset = button("Reset", { hidden: "", title: "See the scene as at first (Home)" });
    const exact = button("Exact pixels", {
        "aria-pressed": "false",
        title: "Show the contract's own pixels; otherwise each is the mean of 2 x 2",
    });
    const more = button("Check", { "aria-expanded": "false", "aria-controls": "panel" });
    const buttons = create("div", { class: "buttons" }, [reset, exact, more]);
    const bar = create("div", { class: "bar", part: "bar", hidden: "" }, [figures, buttons]);

    const hash = create("code", {});
    const url = create("input", {
        ...{ type: "url", required: "", placeholder: "https://...", "aria-label": "Address of a node (JSON-RPC)" },
        spellcheck: "false",
        autocomplete: "off",
    });
    const send = create("button", { type: "submit", text: "Ask the node" });
    const form = create("form", {}, [url, send]);
    const outcome = create("p", { class: "outcome", role: "status" });
    const panel = create("div", { class: "panel", part: "panel", id: "panel", hidden: "" }, [
        create("p", {}, ["SHA-256 of the exact pixels: ", hash]),
        create("p", {
            text: "A node of your choice is sent the scene and computes the same picture; all bytes are compared.",
        }),
        form,
        outcome,
    ]);
    root.append(stage, help, bar, error, panel);
    return {
        ...{ canvas, poster, veil, stage, error, figures, reset, exact },
        ...{ more, bar, hash, url, send, form, outcome, panel },
    };
}

function button(text: string, attributes: Record<string, string>): HTMLButtonElement {
    return create("button", { type: "button", text, ...attributes });
}

function create<K extends keyof HTMLElementTagNameMap>(
    tag: K,
    { text, ...attributes }: Record<string, string>,
    children: (Node | string)[] = [],
): HTMLElementTagNameMap[K] {
    const element = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    element.append(...(text === undefined ? children : [text]));
    return element;
}
