// The looks, each as a picture of the objects that are shown.

import { signal, useSignalEffect, type Signal } from "@preact/signals";
import { useMemo } from "preact/hooks";
import type { App } from "../app.js";
import type { Document } from "../../document/document.js";
import { LOOKS, applyLook, lookOf } from "../../document/looks.js";
import { Thumb } from "./icons.js";
import { urlOf } from "./shelf.js";

const SIDE = 64;
/** Milliseconds without a change until the pictures are drawn again. */
const WAIT = 700;

/** Pictures of looks by their names, all of the same objects. */
type Pictures = Readonly<Record<string, string>>;

export function Looks({ app }: { app: App }) {
    const pictures = useMemo(() => signal<Pictures>({}), []);
    useSignalEffect(() => drawLooks(app, pictures));
    const current = lookOf(app.calm.value);
    const choose = (name: string): void => {
        app.change(applyLook(app.doc.value, name, app.selected.value), `Look: ${name}`);
    };
    return (
        <section class="looks" aria-labelledby="looks" id="page-looks">
            <h2 id="looks">Looks</h2>
            <div class="chips">
                {LOOKS.map(({ name, title, help }) => (
                    <Thumb
                        key={name}
                        id={`look-${name}`}
                        title={title}
                        hint={help}
                        url={pictures.value[name]}
                        pressed={current === name}
                        onClick={() => choose(name)}
                    />
                ))}
            </div>
        </section>
    );
}

/** What the pictures show: not what looks replace. */
function subject(doc: Document): string {
    return JSON.stringify([doc.objects.map(({ mesh }) => mesh), doc.frame]);
}

let drawn = "";

/** Draw the looks of the document when it rests. Pictures of other objects go at once; those of another view when all new ones are there. */
function drawLooks(app: App, pictures: Signal<Pictures>): () => void {
    const seen = app.drawing.seen.value;
    const stop = new AbortController();
    if (seen && subject(seen.doc) !== drawn) [drawn, pictures.value] = [subject(seen.doc), {}];
    const timer = setTimeout(() => void draw(), WAIT);
    const draw = async (): Promise<void> => {
        if (!seen || seen.draft) return;
        const doc = seen.doc;
        const width = Math.max(1, Math.round(SIDE * Math.min(1, doc.width / doc.height)));
        const height = Math.max(1, Math.round(SIDE * Math.min(1, doc.height / doc.width)));
        const options = { width, height, antialias: true, lane: "background" as const, signal: stop.signal };
        const made: Record<string, string> = {};
        const replace = Object.keys(pictures.peek()).length > 0;
        try {
            for (const { name } of LOOKS) {
                made[name] = urlOf(await app.work.draw(applyLook(doc, name), options));
                if (stop.signal.aborted) return;
                if (!replace) pictures.value = { ...made };
            }
            pictures.value = made;
        } catch {
            // given up for newer ones, or the objects cannot be drawn so: the names will do
        }
    };
    return () => {
        clearTimeout(timer);
        stop.abort();
    };
}
