// The page's side of the workers: pictures, files and figures, all computed by the contracts.

import script from "worker:creator/work/worker.ts";
import { keptOrLoaded } from "../../evm/assets.js";
import { moduleOf } from "../../evm/evm.js";
import { checkedContracts } from "../../evm/contracts.js";
import { checkedStages, type StageGas } from "../../evm/stages.js";
import { hashPixels } from "../../picture.js";
import type { Scene } from "../../scene/types.js";
import type { PageAssets } from "../assets.js";
import { keyOf, type Document, type Meshes } from "../../document/document.js";
import { Pool, started, type WorkerLike } from "../../workers/pool.js";
import { fitted } from "./fit.js";
import { pageOf } from "./page.js";
import { idAt } from "./pick.js";
import { NEEDS } from "./protocol.js";
import type {
    Counts,
    Drawn,
    EditionTerms,
    Format,
    Kind,
    Limit,
    More,
    Options,
    Quote,
    Requests,
    Stage,
    Supplies,
} from "./protocol.js";

export { Cancelled } from "../../workers/protocol.js";
export type { Counts, Drawn, EditionTerms, Limit, Options, Quote, Stage, StageGas, StoreCall } from "./protocol.js";

export type Lane = "picture" | "background";

/** lane: "picture" has a worker of its own, the default of `draw`; all else is for the others. */
export interface DrawOptions extends Options {
    width?: number;
    height?: number;
    antialias?: boolean;
    lane?: Lane;
    /** Whether the file of the contract is returned too. */
    bmp?: boolean;
}

/** The frames of a turntable, milliseconds of each, and the side of the square that each pixel becomes. */
export interface FilmOptions extends Options {
    frames: number;
    duration: number;
    scale?: number;
}

const MOST_WORKERS = 4;
/** Milliseconds of rest after which the reserve draws new meshes, so that it remembers them, and the side of that picture. */
const REST = 400;
const SMALL = 16;
const TYPES: Record<Format, string> = {
    png: "image/png",
    transparent: "image/png",
    svg: "image/svg+xml",
    glb: "model/gltf-binary",
    apng: "image/png",
};

export class Work {
    readonly #assets: Pick<PageAssets, "bytes" | "text" | "json">;
    readonly #meshes: Meshes;
    readonly #pool: Pool<Requests, Lane>;
    readonly #supplies = new Map<keyof Supplies, Promise<Supplies[keyof Supplies]>>();
    readonly #ids = new WeakMap<Document, Promise<Requests["ids"][1]>>();
    #timer: ReturnType<typeof setTimeout> | undefined;

    /** meshes: `need`, where it has one, loads those of a document. size: the number of workers, at least two. */
    constructor(
        assets: Pick<PageAssets, "bytes" | "text" | "json">,
        meshes: Meshes & { need?(doc: Document): Promise<void> },
        start: () => WorkerLike = () => started(script),
        size = Math.min(MOST_WORKERS, navigator.hardwareConcurrency),
    ) {
        this.#assets = assets;
        this.#meshes = meshes;
        const supplies = async (_: unknown, kind: Kind, { doc }: { doc?: Document }): Promise<Map<string, unknown>> => {
            const names = ["evm" as const, NEEDS[kind] ?? []].flat();
            const kept = await Promise.all(names.map(async (name) => [name, await this.#supply(name)] as const));
            if (doc) await meshes.need?.(doc);
            const own = doc?.objects.map(({ mesh }) => [keyOf(mesh), meshes.get(mesh)] as const) ?? [];
            return new Map<string, unknown>([...kept, ...own]);
        };
        this.#pool = new Pool<Requests, Lane>({ start, supplies }, { picture: 2, background: Math.max(1, size - 1) });
    }

    async draw(
        doc: Document,
        { lane = "picture", signal, width, height, antialias, bmp }: DrawOptions = {},
    ): Promise<Drawn> {
        const drawn = await this.#pool.ask("draw", { doc, width, height, antialias, bmp }, lane, { signal });
        if (lane !== "picture") return drawn;
        clearTimeout(this.#timer);
        const small = { doc, width: SMALL, height: SMALL, antialias: false };
        const keys = doc.objects.map(({ mesh }) => keyOf(mesh));
        this.#timer = setTimeout(() => this.#pool.prepare("draw", small, lane, keys), REST);
        return drawn;
    }

    count(doc: Document, options?: Options): Promise<Counts> {
        return this.#ask("count", { doc }, options);
    }

    /** The six pictures of the pipeline: docs/explain.md. */
    stages(doc: Document, options?: Options): Promise<Stage[]> {
        return this.#ask("stages", { doc }, options);
    }

    /** The gas of a picture by stage. */
    profile(doc: Document, options?: Options): Promise<StageGas[]> {
        return this.#ask("profile", { doc }, options);
    }

    /** The calldata of `render`. */
    call(doc: Document, options?: Options): Promise<Uint8Array<ArrayBuffer>> {
        return this.#ask("call", { doc }, options);
    }

    /** Whether `render` succeeds with so much gas for its execution. */
    suffices(doc: Document, gas: number, options?: Options): Promise<boolean> {
        return this.#ask("suffices", { doc, gas }, options);
    }

    png(
        doc: Document,
        { scale = 1, transparent = false, ...options }: Options & { scale?: number; transparent?: boolean } = {},
    ): Promise<Blob> {
        return this.#file(doc, transparent ? "transparent" : "png", options, { scale });
    }

    /** The file that the contract returns. */
    async bmp(doc: Document, options: Options = {}): Promise<Blob> {
        const { bmp } = await this.draw(doc, { ...options, lane: "background", bmp: true });
        return new Blob([bmp!], { type: "image/bmp" });
    }

    svg(doc: Document, options?: Options): Promise<Blob> {
        return this.#file(doc, "svg", options);
    }

    glb(doc: Document, options?: Options): Promise<Blob> {
        return this.#file(doc, "glb", options);
    }

    /** A page of one file that shows the scene in any browser, as `shackled export` makes it. */
    async page(doc: Document, options: Options = {}): Promise<Blob> {
        const [drawn, png, call] = await Promise.all([
            this.draw(doc, { ...options, lane: "background" }),
            this.png(doc, options),
            this.call(doc, options),
        ]);
        const sha256 = (await hashPixels(drawn.pixels)) ?? "";
        const file = new Uint8Array(await png.arrayBuffer());
        const page = await pageOf(this.#assets, { doc, drawn, png: file, call, sha256 });
        return new Blob([page], { type: "text/html" });
    }

    /** A full turn as the contract Turntable makes it, in one call. Its progress is an estimate. */
    async apng(doc: Document, { frames, duration, scale = 1, signal, onProgress }: FilmOptions): Promise<Blob> {
        const { milliseconds } = await this.draw(doc, { lane: "background", ...(signal ? { signal } : {}) });
        const begin = performance.now();
        // the contract encodes each frame, too
        const whole = 1.5 * frames * milliseconds;
        const timer = setInterval(() => onProgress?.(Math.min(0.99, (performance.now() - begin) / whole)), 200);
        try {
            return await this.#file(doc, "apng", signal ? { signal } : {}, { frames, duration, scale });
        } finally {
            clearInterval(timer);
        }
    }

    /** A full turn, of which all workers but that of the picture draw frames. */
    async gif(doc: Document, { frames, duration, scale = 1, onProgress, ...options }: FilmOptions): Promise<Blob> {
        const path = await this.#ask("path", { doc, frames }, options);
        let done = 0;
        const drawn = await Promise.all(
            Array.from({ length: frames }, async (_, frame) => {
                const degrees = (360 * frame) / frames;
                const picture = await this.#ask("frame", { doc, path, degrees }, options);
                onProgress?.(++done / (frames + 1));
                return picture;
            }),
        );
        return new Blob([await this.#ask("gif", { frames: drawn, duration, scale }, options)], { type: "image/gif" });
    }

    /** The scene of the contract Genesis for a seed. */
    genesis(seed: bigint, options?: Options): Promise<Scene> {
        return this.#ask("genesis", { seed }, options);
    }

    /** The index of the object at a fraction of the canvas from its upper left corner; -1 for none. */
    async pick(doc: Document, x: number, y: number, options?: Options): Promise<number> {
        const ids = await keptOrLoaded(this.#ids, doc, () => this.#ask("ids", { doc }, options));
        return idAt(ids, x, y);
    }

    /** What an edition takes, and whether it is possible. InputError for terms that are not. */
    quote(doc: Document, terms: EditionTerms, options?: Options): Promise<Quote> {
        return this.#ask("quote", { doc, terms }, options);
    }

    /** The document with the largest canvas, then the most triangles, that fits. InputError where none does. */
    fit(doc: Document, limit: Limit, options: Options & { terms?: EditionTerms } = {}): Promise<Document> {
        const fits = (changed: Document): Promise<boolean> =>
            this.#ask("fits", { doc: changed, limit, terms: options.terms }, options);
        return fitted(doc, this.#meshes, fits, options);
    }

    /** End all that was asked; each answer is Cancelled. */
    cancelAll(): void {
        this.#pool.stop();
    }

    #ask<K extends Kind>(kind: K, value: Requests[K][0], { signal }: Options = {}): Promise<Requests[K][1]> {
        return this.#pool.ask(kind, value, "background", { signal });
    }

    async #file(
        doc: Document,
        format: Format,
        options?: Options,
        film: Partial<Omit<FilmOptions, keyof Options>> = {},
    ): Promise<Blob> {
        return new Blob([await this.#ask("file", { doc, format, ...film }, options)], { type: TYPES[format] });
    }

    #supply<N extends keyof Supplies>(name: N): Promise<Supplies[N]> {
        return keptOrLoaded(this.#supplies, name, () => this.#load(name)) as Promise<Supplies[N]>;
    }

    async #load(name: keyof Supplies): Promise<Supplies[keyof Supplies]> {
        if (name === "more") return this.#assets.json<More>("more.json");
        if (name === "stages") return checkedStages(await this.#assets.json("stages.json"));
        const [module, contracts] = await Promise.all([
            this.#assets.bytes("evm.wasm").then(moduleOf),
            this.#assets.json("contracts.json").then(checkedContracts),
        ]);
        return { module, contracts };
    }
}
