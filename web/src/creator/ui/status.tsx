// What the picture is, and what it costs.

import { signal, useSignalEffect } from "@preact/signals";
import type { App } from "../app.js";
import { LIMITS } from "../../document/settings.js";
import type { Drawn } from "../work/work.js";

/** Gas of a request besides that of its execution, the least gas of a byte (EIP-7623), and the largest transaction: bounds. */
const BASE = 21_000;
const BYTE = 16;
const FLOOR = 40;
const MOST_BYTES = 130_000;

/** Return where a picture fits, in a few words, and the most demanding place of these. The dialog of limits is exact. */
function whereItFits(drawn: Drawn): { text: string; place: "transaction" | "call" | "none" } {
    // a call passes on all but one 64th of the gas that is left (EIP-150)
    const gas = BASE + Math.max((drawn.gas * 64) / 63 + BYTE * drawn.calldata, FLOOR * drawn.calldata);
    const all = (kind: string) => LIMITS.filter((limit) => limit.kind === kind);
    const places = (kind: string) => all(kind).flatMap((limit) => (gas <= limit.gas ? limit.place : []));
    const nodes = places("call");
    if (!nodes.length) return { text: "Too much for usual nodes: take fewer pixels or triangles", place: "none" };
    if (nodes.length < all("call").length)
        return { text: `Free to read on ${listed(nodes)}; too much for other nodes`, place: "call" };
    const chains = drawn.calldata < MOST_BYTES ? places("transaction") : [];
    if (!chains.length) return { text: "Free to read on most nodes; too much for a transaction", place: "call" };
    const isAny = chains.length === all("transaction").length;
    return {
        text: `Free to read on most nodes; fits a transaction${isAny ? "" : ` on ${listed(chains)}`}`,
        place: isAny ? "transaction" : "call",
    };
}

function listed(words: readonly string[]): string {
    return [words.slice(0, -1).join(", "), words.at(-1)].filter(Boolean).join(" and ");
}

/** Of the picture that is shown: how many triangles are left after culling and clipping. */
const counted = signal<{ of: Drawn; triangles: number } | null>(null);

/** Count the triangles of the picture when it rests. */
function count({ shown, work }: App): (() => void) | undefined {
    const last = shown.value;
    if (!last) return undefined;
    const stop = new AbortController();
    const of = last.drawn;
    work.count(last.doc, { signal: stop.signal }).then(
        ({ triangles }) => (counted.value = { of, triangles }),
        () => undefined, // it was given up, or the picture says why
    );
    return () => stop.abort();
}

export function Status({ app }: { app: App }) {
    const { drawing, doc, shown } = app;
    useSignalEffect(() => count(app));
    const [seen, problem, last] = [drawing.seen.value, drawing.problem.value, shown.value];
    const current = last !== null && last.doc === doc.value;
    if (!seen) return <div class="below">{problem && <p role="alert">{problem}</p>}</div>;
    // an old picture is never under a new title
    const { title, notice, width, height, objects } = seen.doc;
    const { drawn } = seen;
    const left = counted.value?.of === drawn ? counted.value.triangles : null;
    const fits = whereItFits(drawn);
    const number = (value: number): string => value.toLocaleString("en");
    const name = title || (objects.length === 1 ? objects[0]?.name : "") || "Untitled";
    return (
        <div class="below" data-name="caption">
            <div class="caption">
                <h2 data-name="title">{name}</h2>
                <p>
                    {width} × {height} pixels{notice && ` · ${notice}`}
                    {left === 0 && " · Nothing is in view: press F to fit"}
                </p>
            </div>
            {problem ? (
                <p class="problem" role="alert" data-name="problem">
                    {problem}
                </p>
            ) : (
                <button
                    type="button"
                    class="status"
                    aria-haspopup="dialog"
                    title="Gas, limits and stages"
                    data-name="status"
                    onClick={() => void app.openDialog("limits")}
                >
                    <span>
                        <b data-name="gas">{number(drawn.gas)}</b> gas
                        {seen.draft && ` at ${drawn.width} × ${drawn.height}`}
                    </span>
                    <span>
                        <b data-name="triangles">{number(left ?? drawn.triangles)}</b>
                        {left !== null && ` of ${number(drawn.triangles)}`} triangles
                    </span>
                    <span>
                        <b data-name="bytes">{number(drawn.calldata)}</b> bytes
                    </span>
                    {/* of the whole picture only */}
                    <span class="fits" data-place={current ? fits.place : ""} data-name="fits">
                        <i />
                        {current ? fits.text : "…"}
                    </span>
                </button>
            )}
            <div class="unseen" role="status">
                {current && `${name}: ${number(last.drawn.gas)} gas. ${fits.text}`}
            </div>
        </div>
    );
}
