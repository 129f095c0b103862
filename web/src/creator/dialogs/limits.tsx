// Where the picture fits, how to make it fit, the six pictures of the pipeline, and gas by stage.

import type { ComponentChildren } from "preact";
import { useState } from "preact/hooks";
import type { App } from "../app.js";
import type { Document } from "../../document/document.js";
import { capital } from "../../document/fields.js";
import { neededGas } from "../programs/cast.js";
import { titleOf } from "../programs/subject.js";
import { LIMITS, type Limit } from "../../document/settings.js";
import { MAX_TRANSACTION, intrinsicGas, isRelayed } from "../work/calls.js";
import { CALL_GAS, TRANSACTION_GAS } from "../work/protocol.js";
import type { EditionTerms, Quote, Stage } from "../work/work.js";
import { Button, Pixels, Progress, Trouble, count, drawnOf, gasWords, useMade, useTask, type Made } from "./widgets.js";

interface Fit {
    title: string;
    remark: string;
    gas: number;
    needed: number;
    fits: boolean;
    kind: "transaction" | "call";
    /** Why not, where it is not the gas. */
    reason: string;
}

export function Limits({ app }: { app: App }) {
    const doc = app.doc.value;
    const stages = useMade((signal) => app.work.stages(doc, { signal }), [doc]);
    const gas = useMade((signal) => app.work.profile(doc, { signal }), [doc]);
    return (
        <>
            <Fits app={app} doc={doc} />
            <section>
                <h3>How it is made</h3>
                <Stages stages={stages.value} />
                <Trouble text={stages.error} />
            </section>
            <section>
                <h3>Gas by stage</h3>
                {gas.value && <Bars rows={gas.value.filter((each) => each.gas > 0)} />}
                {!gas.value && !gas.error && <p class="quiet">Counting every instruction …</p>}
                <Trouble text={gas.error} />
            </section>
        </>
    );
}

function Fits({ app, doc }: { app: App; doc: Document }) {
    const fits = useMade((signal) => fitsOf(app, doc, signal), [doc]);
    const token = useMade((signal) => tokenOf(app, doc, signal), [doc]);
    const fit = useFit(app, doc);
    const small = fits.value?.filter((each) => !each.fits) ?? [];
    const wanted = [
        ["edition", "Make it fit a token", token.value?.fits === false],
        [
            "transaction",
            "Make it fit a transaction",
            small.some(({ kind, gas }) => kind === "transaction" && gas <= TRANSACTION_GAS),
        ],
        ["call", "Make it fit a read call", small.some(({ kind, gas }) => kind === "call" && gas <= CALL_GAS)],
    ] as const;
    return (
        <section>
            <h3>Where it fits</h3>
            <Trouble text={fits.error} />
            <table class="bars">
                <tbody>
                    {fits.value?.map(({ title, remark, gas, needed, fits, reason }) => (
                        <Line
                            key={title}
                            title={title}
                            small={gasWords(gas)}
                            remark={remark}
                            of={[needed, gas]}
                            bad={!fits}
                        >
                            <td class={fits ? "yes" : "no"}>{fits ? "fits" : reason || "does not fit"}</td>
                        </Line>
                    ))}
                    <TokenLine token={token} />
                </tbody>
            </table>
            <div class="scales">
                {wanted.map(
                    ([limit, words, isWanted]) =>
                        isWanted && (
                            <Button key={limit} name={`fit-${limit}`} off={fit.off} does={() => fit.make(limit)}>
                                {words}
                            </Button>
                        ),
                )}
            </div>
            {fit.shown}
        </section>
    );
}

/** What makes a document fit, and how far that is or what it changed. */
export function useFit(app: App, doc: Document) {
    const task = useTask();
    const [said, say] = useState("");
    const make = (limit: "transaction" | "edition" | "call", terms?: EditionTerms | null): void =>
        task.start(async (signal, onProgress) => {
            const fitted = await app.work.fit(doc, limit, { ...(terms && { terms }), signal, onProgress });
            if (signal.aborted) return;
            say(changesOf(doc, fitted));
            app.change(fitted, "Make it fit");
        });
    const shown = (
        <>
            <Progress task={task} what="Trying sizes and triangles" />
            {said && <p role="status">{said}</p>}
        </>
    );
    return { make, shown, off: task.part !== null };
}

/** Whether a token of an edition with this picture fits. */
function TokenLine({ token: { value, error } }: { token: Made<Token> }) {
    const small = `drawn and made a PNG within ${gasWords(TRANSACTION_GAS)}`;
    const [look, words] = value ? [value.fits ? "yes" : "no", value.words] : [error && "no", error || "computing …"];
    return (
        <Line title="Token of an edition" small={small} of={[value?.gas ?? 0, TRANSACTION_GAS]} bad={look === "no"}>
            <td class={look}>{words}</td>
        </Line>
    );
}

interface Token {
    gas: number;
    fits: boolean;
    words: string;
}

/** Return what a token of an edition needs; and where that is too much, by how much, and which size would do. */
async function tokenOf(app: App, doc: Document, signal: AbortSignal): Promise<Token> {
    const [drawn, quote] = await Promise.all([
        drawnOf(app, doc, signal),
        app.work.quote(doc, termsOf(doc), { signal }),
    ]);
    return { gas: quote.tokenUri.gas, fits: quote.fits, words: tokenWords(quote, doc, drawn.gas) || "fits" };
}

/** Return why a token of an edition does not fit, by how much, and which size would do; "" where it fits. */
export function tokenWords({ tokenUri: { gas }, reason }: Quote, doc: Document, drawnGas: number): string {
    if (gas <= TRANSACTION_GAS) return reason;
    // the PNG is about as large for any size of the picture, whose gas is nearly that of its pixels
    const left = 0.97 * TRANSACTION_GAS - (gas - drawnGas);
    const [w, h] = [doc.width, doc.height].map((side) => 8 * Math.floor((side * Math.sqrt(left / drawnGas)) / 8));
    const size = w && h ? `; about ${w} × ${h} pixels would fit` : "";
    return `${gasWords(gas - TRANSACTION_GAS)} too much${size}`;
}

function Stages({ stages }: { stages: readonly Stage[] | null }) {
    const [at, go] = useState(0);
    const stage = stages?.[at] ?? stages?.[0];
    if (!stages || !stage) return <p class="quiet">Drawing the six pictures …</p>;
    const number = stages.indexOf(stage);
    const scrub = (event: { currentTarget: HTMLInputElement }): void => go(event.currentTarget.valueAsNumber);
    return (
        <div class="stages">
            <figure>
                <Pixels drawn={stage.drawn} label={stage.title} />
                <figcaption aria-live="polite">
                    <b>{`${number + 1}. ${stage.title}`}</b>
                    <span>{stage.detail}</span>
                </figcaption>
            </figure>
            <input
                type="range"
                max={stages.length - 1}
                value={number}
                onInput={scrub}
                aria-label="Stage of the pipeline"
                aria-valuetext={stage.title}
            />
            <div class="strip-of-stages" aria-hidden="true">
                {stages.map((each, index) => (
                    <button key={each.title} tabIndex={-1} aria-pressed={index === number} onClick={() => go(index)}>
                        <Pixels drawn={each.drawn} label={each.title} />
                    </button>
                ))}
            </div>
        </div>
    );
}

function Bars({ rows }: { rows: readonly { stage: string; gas: number }[] }) {
    const total = rows.reduce((sum, { gas }) => sum + gas, 0);
    return (
        <table class="bars">
            <tbody>
                {rows.map(({ stage, gas }) => (
                    <Line key={stage} title={capital(stage)} of={[gas, total]}>
                        <td class="number">{count(gas)}</td>
                    </Line>
                ))}
                <tr class="total">
                    <th scope="row" colSpan={3} children="Total" />
                    <td class="number">{count(total)}</td>
                </tr>
            </tbody>
        </table>
    );
}

/** A line of a table: a title, a bar, the part of a whole, and what follows. */
function Line(props: {
    title: string;
    small?: string;
    remark?: string;
    of: readonly [number, number];
    bad?: boolean;
    children: ComponentChildren;
}) {
    const { of, bad, small } = props;
    const part = of[0] / of[1];
    return (
        <tr>
            <th scope="row" title={props.remark}>
                {props.title}
                {small && <small>{small}</small>}
            </th>
            <td class="bar">
                <progress class={bad ? "bad" : ""} value={Math.min(1, part)} max={1} aria-hidden="true" />
            </td>
            <td class="number">{part < 0.1 ? `${(100 * part).toFixed(1)} %` : `${count(Math.round(100 * part))} %`}</td>
            {props.children}
        </tr>
    );
}

async function fitsOf(app: App, doc: Document, signal: AbortSignal): Promise<Fit[]> {
    const [call, drawn] = await Promise.all([app.work.call(doc, { signal }), drawnOf(app, doc, signal)]);
    const [intrinsic, needed] = [intrinsicGas(call), neededGas(call, drawn.gas)];
    // nodes with the same limit share a row
    const firsts = LIMITS.filter((one, index) => LIMITS.findIndex((other) => isLike(one, other)) === index);
    return Promise.all(
        firsts.map(async (first) => {
            const { kind, gas } = first;
            const limits = LIMITS.filter((other) => isLike(first, other));
            const tooLong = kind === "transaction" && !isRelayed(call);
            // a call must be given a little more than it uses: how much, only the call itself can tell
            const close = needed > gas && intrinsic + drawn.gas <= gas;
            const fits =
                !tooLong && (needed <= gas || (close && (await app.work.suffices(doc, gas - intrinsic, { signal }))));
            const places = limits.map(({ place }) => place).join(", ");
            const title = `${kind === "transaction" ? "Transaction on" : "Read call of"} ${places}`;
            const remark = limits.map(({ name, source, date }) => `${name}: ${source}, ${date}`).join("\n");
            const reason = tooLong ? `${count(call.length)} bytes; nodes relay ${count(MAX_TRANSACTION)}` : "";
            return { title, remark, gas, kind, fits, needed: close && fits ? gas : needed, reason };
        }),
    );
}

function isLike(one: Limit, other: Limit): boolean {
    return one.kind === other.kind && one.gas === other.gas;
}

/** Return the terms of an edition for which a quote is asked. */
function termsOf(doc: Document): EditionTerms {
    return { name: titleOf(doc).slice(0, 16), price: 0n, supply: null, royalty: 0, copies: 1, model: false };
}

/** Say what is different in a document that was made to fit. */
function changesOf(before: Document, after: Document): string {
    const words: string[] = [];
    if (before.antialias && !after.antialias) words.push("without anti-aliasing");
    if (before.width !== after.width || before.height !== after.height)
        words.push(`at ${after.width} × ${after.height} pixels`);
    if (after.objects.some((item, index) => item.maxTriangles !== before.objects[index]?.maxTriangles))
        words.push("with fewer triangles");
    return words.length
        ? `Now it is drawn ${words.join(", ")}. Undo brings the former picture back.`
        : "It fits as it is.";
}
