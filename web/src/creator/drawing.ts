// The loop that draws the document: small drafts without antialiasing while something moves, then the picture.

import { effect, signal, type Signal } from "@preact/signals";
import { Speed, scaled, type Size } from "../view/speed.js";
import type { Document } from "../document/document.js";
import type { Drawn, Work } from "./work/work.js";

/** Milliseconds without movement after which the picture is drawn. */
const REST = 160;
/** Milliseconds above which a picture is given up for a newer one, has a draft before it, and is said to be drawing. */
const INTERRUPT = 60;
const LONG = 300;
const BUSY = 350;
/** By how many times pictures with antialiasing take longer. */
const ANTIALIASING = 3;
/** Pixels a side of the first draft, of which nothing is known. */
const FIRST = 96;

/** The picture that is seen, and the document of which it is the picture. */
export interface Shown {
    drawn: Drawn;
    doc: Document;
}

/** Something that takes long. part: 0..1, where it is known. */
export interface Busy {
    what: string;
    part?: number;
    cancel?: () => void;
}

/** What is drawn, and where it is told what happens. */
interface Easel {
    doc: Signal<Document>;
    shown: Signal<Shown | null>;
    busy: Signal<Busy | null>;
    work: Work;
    tell(text: string): void;
    sentence(error: unknown): string;
}

/** What is on the canvas. */
export interface Seen extends Shown {
    /** Whether it is smaller than the picture. */
    draft: boolean;
}

interface Flight {
    doc: Document;
    full: boolean;
    abort: AbortController;
    predicted: number;
}

export class Drawing {
    readonly seen = signal<Seen | null>(null);
    /** Why the document cannot be drawn. */
    readonly problem = signal<string | null>(null);
    readonly #app: Easel;
    #speed = new Speed();
    /** Pixels of the last picture of these objects, and its milliseconds without antialiasing. */
    #last: readonly [number, number] | null = null;
    #moving = false;
    #flight: Flight | null = null;
    /** The document that cannot be drawn, or was given up. */
    #given: Document | null = null;
    #held = false;
    #movedAt = -Infinity;
    #timer: ReturnType<typeof setTimeout> | undefined;

    constructor(app: Easel) {
        this.#app = app;
        let meshes = "";
        effect(() => {
            const now = app.doc.value.objects.map(({ mesh }) => JSON.stringify(mesh)).join();
            if (now !== meshes) [this.#speed, this.#last, meshes] = [new Speed(), null, now];
            this.#wake();
        });
    }

    /** Note that the document moves: drafts will do for a moment. */
    moved(): void {
        this.#movedAt = performance.now();
    }

    /** Note whether a finger or a button is down. */
    hold(is: boolean): void {
        this.#held = is;
        if (!is) this.#movedAt = -Infinity;
        this.#wake();
    }

    #wake(): void {
        const doc = this.#app.doc.peek();
        const seen = this.seen.peek();
        const { doc: drawing, full, predicted, abort } = this.#flight ?? {};
        if (drawing) {
            if (full && drawing !== doc && (predicted ?? 0) > INTERRUPT) abort?.abort();
            return;
        }
        if (this.#given === doc) return;
        if (seen?.doc === doc && !seen.draft) {
            // such as after undo of what could not be drawn, which redo tries again
            this.#given = this.problem.value = null;
            return;
        }
        const size: Size = [doc.width, doc.height];
        const moving = this.#held || performance.now() - this.#movedAt < REST;
        // what was slow before, when nothing was compiled or the machine was busy, may be fast now
        if (moving && !this.#moving && this.#last) {
            this.#speed = new Speed();
            this.#speed.add(...this.#last);
        }
        this.#moving = moving;
        const time = this.#speed.predict(doc.width * doc.height) * (doc.antialias ? ANTIALIASING : 1);
        const isSeen = seen?.doc === doc;
        if (!isSeen && !this.#last) void this.#draw(doc, false, scaled(size, FIRST / Math.max(...size)));
        else if (!isSeen && (moving || time > LONG)) void this.#draw(doc, false, this.#speed.movingSize(size, size));
        else if (!moving) void this.#draw(doc, true, size);
        else if (!this.#held) {
            clearTimeout(this.#timer);
            this.#timer = setTimeout(() => this.#wake(), REST);
        }
    }

    async #draw(doc: Document, full: boolean, [width, height]: Size): Promise<void> {
        const abort = new AbortController();
        const pixels = width * height;
        const samples = full && doc.antialias ? ANTIALIASING : 1;
        const predicted = this.#speed.predict(pixels) * samples;
        const flight = { doc, full, abort, predicted };
        this.#flight = flight;
        const busy = setTimeout(() => {
            if (full) this.#app.busy.value ??= { what: "Drawing", cancel: () => this.#giveUp(flight) };
        }, BUSY);
        try {
            const options = { width, height, lane: "picture" as const, signal: abort.signal };
            const drawn: Drawn = await this.#app.work.draw(doc, full ? options : { ...options, antialias: false });
            this.#last = [pixels, drawn.milliseconds / samples];
            this.#speed.add(...this.#last);
            const exact = full || (width === doc.width && height === doc.height && !doc.antialias);
            this.#show({ drawn, doc, draft: !exact });
        } catch (error) {
            if (!abort.signal.aborted) {
                this.#given = doc;
                if (doc === this.#app.doc.peek()) this.problem.value = this.#app.sentence(error);
            }
        } finally {
            clearTimeout(busy);
            if (this.#app.busy.peek()?.what === "Drawing") this.#app.busy.value = null;
            this.#flight = null;
            this.#wake();
        }
    }

    #giveUp({ doc, abort }: Flight): void {
        this.#given = doc;
        abort.abort();
        this.#app.tell("Stopped. The next change draws the picture again.");
    }

    #show(seen: Seen): void {
        this.problem.value = null;
        this.seen.value = seen;
        if (!seen.draft) this.#app.shown.value = seen;
    }
}
