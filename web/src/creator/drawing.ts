// The document on the canvas.

import { computed, effect, signal, type Signal } from "@preact/signals";
import { keyOf, type Document } from "../document/document.js";
import { Scheduler, type Job, type Plan } from "../draw/scheduler.js";
import type { MeshStore } from "./mesh_store.js";
import { doing, note } from "./state.js";
import { withShare } from "./work/fit.js";
import type { Drawn, Work } from "./work/work.js";

/** Milliseconds above which a picture is said to be drawing. */
const BUSY = 350;
/** By how many times pictures with antialiasing take longer. */
const ANTIALIASING = 3;
/** The share of the triangles in drafts of slow pictures; an object keeps so many. */
const SHARE = 0.25;
const FEWEST = 200;

/** The picture that is seen, and the document of which it is the picture. */
export interface Shown {
    drawn: Drawn;
    doc: Document;
}

/** What is on the canvas. */
export interface Seen extends Shown {
    /** Whether it is less than the picture. */
    draft: boolean;
}

/** What is drawn, and where it is told what happens. */
interface Page {
    doc: Signal<Document>;
    shown: Signal<Shown | null>;
    meshes: MeshStore;
    work: Work;
    tell(text: string): void;
    sentence(error: unknown): string;
}

export class Drawing {
    readonly seen = signal<Seen | null>(null);
    readonly #failed = signal<{ doc: Document; words: string } | null>(null);
    /** Why the document cannot be drawn. */
    readonly problem = computed(() => {
        const failed = this.#failed.value;
        return failed?.doc === this.page.doc.value ? failed.words : null;
    });
    readonly #scheduler: Scheduler<Document, Drawn>;

    constructor(private readonly page: Page) {
        this.#scheduler = new Scheduler({
            beginsSmall: true,
            value: () => page.doc.peek(),
            plan: (doc) => this.#plan(doc),
            draw: (doc, job, signal) => this.#draw(doc, job, signal),
            show: (doc, { quality }, drawn) => {
                this.seen.value = { drawn, doc, draft: quality === "draft" };
                if (quality !== "draft") page.shown.value = this.seen.value;
            },
            fail: (doc, error) => (this.#failed.value = { doc, words: page.sentence(error) }),
        });
        let meshes = "";
        effect(() => {
            const now = page.doc.value.objects.map(({ mesh }) => keyOf(mesh)).join();
            if (now !== meshes) this.#scheduler.forget();
            meshes = now;
            this.#scheduler.wake();
        });
    }

    /** Note that the document moves: drafts will do for a moment. */
    moved(): void {
        this.#scheduler.moved();
    }

    /** Note whether a finger or a button is down. */
    hold(is: boolean): void {
        this.#scheduler.hold(is);
    }

    #plan({ width, height, antialias, objects }: Document): Plan {
        const { meshes } = this.page;
        const isLarge = objects.some(({ mesh, maxTriangles }) => {
            const all = meshes.has(mesh) ? meshes.get(mesh).triangles : 0;
            return Math.min(maxTriangles ?? all, all) * SHARE > FEWEST;
        });
        const exact = { size: [width, height], samples: antialias ? ANTIALIASING : 1 } as const;
        return { exact, finer: null, share: isLarge ? SHARE : 1, isPlain: !antialias };
    }

    async #draw(doc: Document, { quality, size, share }: Job, signal: AbortSignal): Promise<Drawn> {
        const { meshes, work } = this.page;
        const cancel = (): void => {
            this.#scheduler.giveUp();
            this.page.tell("Stopped. The next change draws the picture again.");
        };
        const timer = setTimeout(() => {
            if (quality === "exact" && !doing.peek().busy) note({ busy: { what: "Drawing", cancel } });
        }, BUSY);
        try {
            const [width, height] = size;
            const options = { width, height, lane: "picture" as const, signal };
            if (quality === "exact") return await work.draw(doc, options);
            return await work.draw(withShare(doc, meshes, share, FEWEST), { ...options, antialias: false });
        } finally {
            clearTimeout(timer);
            if (doing.peek().busy?.what === "Drawing") note({ busy: null });
        }
    }
}
