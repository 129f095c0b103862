// The documents of a page, for undo and redo.

import type { Document } from "./document.js";

/** Number of steps that can be undone. */
const MAX_STEPS = 200;
/** Milliseconds within which changes with the same key are one step. */
const TOGETHER = 1000;

/** The documents before and after the one that is shown. A drag is one step, however many documents it goes through. */
export class History {
    #past: { doc: Document; label: string }[] = [];
    #future: { doc: Document; label: string }[] = [];
    #merge: { key: string; time: number } | null = null;
    value: Document;

    constructor(first: Document) {
        this.value = first;
    }

    /** Add a document, and drop the undone ones; an equal one adds nothing. label: what is undone then. */
    push(doc: Document, label: string, merge?: string, now = Date.now()): void {
        if (doc === this.value || JSON.stringify(doc) === JSON.stringify(this.value)) return;
        const last = this.#merge;
        if (!last || last.key !== merge || now - last.time > TOGETHER) {
            this.#past = [...this.#past, { doc: this.value, label }].slice(-MAX_STEPS);
        }
        this.#merge = merge === undefined ? null : { key: merge, time: now };
        this.#future = [];
        this.value = doc;
    }

    /** Go back one step; null where there is none. */
    undo(): Document | null {
        return this.#step(this.#past, this.#future);
    }

    /** Go forward one undone step; null where there is none. */
    redo(): Document | null {
        return this.#step(this.#future, this.#past);
    }

    get canUndo(): boolean {
        return this.#past.length > 0;
    }

    get canRedo(): boolean {
        return this.#future.length > 0;
    }

    /** What the next undo takes back; "" where there is nothing. */
    get label(): string {
        return this.#past.at(-1)?.label ?? "";
    }

    #step(from: { doc: Document; label: string }[], to: { doc: Document; label: string }[]): Document | null {
        const step = from.pop();
        this.#merge = null;
        if (!step) return null;
        to.push({ doc: this.value, label: step.label });
        this.value = step.doc;
        return step.doc;
    }
}
