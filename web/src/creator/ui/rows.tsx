// Rows of the panels: a control each.

import { signal } from "@preact/signals";
import type { VNode } from "preact";
import { useId, useLayoutEffect, useRef } from "preact/hooks";
import type { App } from "../app.js";
import { MIXED, type Control, type Value } from "../controls.js";
import type { Document } from "../../document/document.js";
import { capital } from "../../document/fields.js";
import { clamped } from "../../scene/arithmetic.js";
import { Icon } from "./icons.js";

/** Units as they are shown in fields. */
const UNITS: Readonly<Record<string, string>> = { pixels: "px", radii: "r", triangles: "" };
/** Steps of a logarithmic slider. */
const STEPS = 1000;

/** The switch that was changed last: what it did to the gas. */
const priced = signal<{ path: string; before: number; doc: Document } | null>(null);

/** Put a value into the document. */
export function put(app: App, of: Control, value: Value): void {
    const { doc, selected, meshes, shown } = app;
    const before = doc.peek();
    const merge = of.kind === "number" || of.kind === "color" ? of.path : undefined;
    app.change(of.write(before, selected.peek(), value, meshes), of.label, merge);
    if (of.kind === "switch" && shown.peek()?.doc === before) {
        priced.value = { path: of.path, before: shown.peek()?.drawn.gas ?? 0, doc: doc.peek() };
    }
}

function reset(app: App, of: Control): void {
    app.change(of.reset(app.doc.peek(), app.selected.peek(), app.own.peek(), app.meshes), `Reset ${of.label}`);
}

interface Shape {
    app: App;
    of: Control;
    value: Value;
    label: string;
    id: string;
}

/** prefix: of its spoken name. */
export function Row({ app, of, prefix = "" }: { app: App; of: Control; prefix?: string }) {
    const [doc, own, selection, { meshes }] = [app.calm.value, app.own.value, app.selected.value, app];
    const id = useId();
    if (!of.shown(doc, selection)) return null;
    const value = of.read(doc, selection, meshes);
    const label = prefix + of.label;
    const help = of.unit === "radii" ? `${of.help} One unit is the radius of the object.`.trim() : of.help;
    return (
        <div class={`row of-${of.kind}`} data-name={`row-${of.path}`} title={help || undefined}>
            <div class="name">
                {of.kind === "choice" ? <span aria-hidden="true">{of.label}</span> : <label for={id}>{of.label}</label>}
                {value === MIXED && of.kind !== "number" && of.kind !== "color" && <small>Mixed</small>}
                {of.changed(doc, selection, own, meshes) && (
                    <button
                        type="button"
                        class="reset"
                        aria-label={`Reset ${label}`}
                        title="Reset"
                        data-name={`reset-${of.path}`}
                        onClick={() => reset(app, of)}
                    >
                        <Icon name="reset" />
                    </button>
                )}
            </div>
            {SHAPES[of.kind]({ app, of, value, label, id })}
        </div>
    );
}

const SHAPES: Readonly<Record<Control["kind"], (shape: Shape) => VNode>> = {
    number: (shape) => (
        <>
            <Slider {...shape} />
            <Field {...shape} />
        </>
    ),
    color: (shape) => <Color {...shape} />,
    choice: (shape) => <Choice {...shape} />,
    switch: (shape) => <Switch {...shape} />,
};

/** The field does all that the slider does: keyboards and screen readers need only the field. */
function Slider({ app, of, value }: Shape) {
    const [low, high] = of.slider;
    const at = typeof value === "number" ? value : value === null ? high : low;
    const place = of.logarithmic ? (STEPS * Math.log(Math.max(at, low) / low)) / Math.log(high / low) : at;
    const [min, max] = of.logarithmic ? [0, STEPS] : [low, high];
    const part = clamped((place - min) / (max - min), 0, 1);
    const read = (position: number): number =>
        of.logarithmic ? Number((low * (high / low) ** (position / STEPS)).toPrecision(3)) : position;
    return (
        <input
            type="range"
            tabIndex={-1}
            aria-hidden="true"
            min={min}
            max={max}
            step={of.logarithmic ? 1 : of.step}
            value={place}
            data-name={`slider-${of.path}`}
            style={{ "--at": `${100 * part}%` }}
            onInput={({ currentTarget }) => {
                const { style, valueAsNumber: now } = currentTarget;
                style.setProperty("--at", `${(100 * (now - min)) / (max - min)}%`);
                put(app, of, read(now));
            }}
            onPointerDown={() => app.drawing.hold(true)}
            onPointerUp={() => app.drawing.hold(false)}
            onPointerCancel={() => app.drawing.hold(false)}
        />
    );
}

function Field({ app, of, value, label, id }: Shape) {
    const field = useRef<HTMLInputElement>(null);
    const typing = useRef(false);
    useLayoutEffect(() => {
        const text = typeof value === "number" ? String(Number(value.toFixed(of.step >= 1 ? 1 : 2))) : "";
        if (!typing.current && field.current) field.current.value = text;
    });
    const end = (text: string): void => {
        typing.current = false;
        const number = Number(text);
        if (text === "") {
            if (of.none) put(app, of, null);
            else reset(app, of);
        } else {
            if (number < of.low || number > of.high) {
                const [low, high] = [of.low, of.high].map((end) => end.toLocaleString("en"));
                app.tell(`${of.label} can be from ${low} to ${high} ${of.unit}`);
            }
            put(app, of, number);
        }
    };
    const unit = UNITS[of.unit] ?? of.unit;
    const none = of.none.length > 6 ? "Auto" : capital(of.none);
    return (
        <span class="number" data-unit={unit || undefined}>
            <input
                ref={field}
                type="number"
                id={id}
                min={of.low}
                max={of.high}
                step={of.step}
                placeholder={value === MIXED ? "Mixed" : none}
                aria-label={of.unit ? `${label}, ${of.unit}` : label}
                aria-description={value === null ? of.none : undefined}
                data-name={of.path}
                onInput={() => (typing.current = true)}
                onChange={({ currentTarget }) => end(currentTarget.value)}
                onBlur={() => (typing.current = false)}
            />
        </span>
    );
}

function Color({ app, of, value, label, id }: Shape) {
    const isColor = typeof value === "string" && value !== MIXED;
    return (
        <div class="wide color">
            <input
                type="color"
                class={isColor ? "" : "none"}
                value={isColor ? value : "#808080"}
                aria-label={`${label}, palette`}
                data-name={`palette-${of.path}`}
                onInput={({ currentTarget }) => put(app, of, currentTarget.value)}
            />
            <input
                type="text"
                id={id}
                value={isColor ? value : ""}
                placeholder={value === MIXED ? "Mixed" : capital(of.none)}
                autocomplete="off"
                spellcheck={false}
                maxLength={32}
                aria-label={label}
                data-name={of.path}
                onChange={({ currentTarget }) => {
                    const color = colorOf(currentTarget.value);
                    if (color) put(app, of, color);
                    else if (!currentTarget.value.trim() && of.none) put(app, of, null);
                    else {
                        app.tell(`${of.label} is a colour such as #c8674a or teal`);
                        currentTarget.value = isColor ? value : "";
                    }
                }}
            />
        </div>
    );
}

/** Return a colour as "#rrggbb" that is written as in CSS, also without #; null if it is none. */
function colorOf(text: string): string | null {
    const word = text.trim();
    const css = /^[0-9a-f]{3}([0-9a-f]{3})?$/i.test(word) ? `#${word}` : word;
    const context = document.createElement("canvas").getContext("2d") as CanvasRenderingContext2D;
    const made = ["#000000", "#ffffff"].map((start) => {
        context.fillStyle = start;
        context.fillStyle = css;
        return String(context.fillStyle);
    });
    return made[0] === made[1] && made[0]?.startsWith("#") ? made[0] : null;
}

function Choice({ app, of, value, label, id }: Shape) {
    return (
        <div
            class="wide choices"
            role="radiogroup"
            aria-label={label}
            aria-description={value === MIXED ? "Mixed" : undefined}
        >
            {of.choices.map(([name, title]) => (
                <label key={name}>
                    <input
                        type="radio"
                        name={id}
                        value={name}
                        checked={value === name}
                        data-name={`${of.path}-${name}`}
                        onChange={() => put(app, of, name)}
                    />
                    {title}
                </label>
            ))}
        </div>
    );
}

function Switch({ app, of, value, label, id }: Shape) {
    return (
        <>
            <Price app={app} path={of.path} />
            <input
                type="checkbox"
                role="switch"
                class="toggle"
                id={id}
                aria-label={label}
                checked={value === true}
                indeterminate={value === MIXED}
                data-name={of.path}
                onChange={({ currentTarget }) => put(app, of, currentTarget.checked)}
            />
        </>
    );
}

/** What a switch did to the gas of the picture, once it is drawn. */
function Price({ app, path }: { app: App; path: string }) {
    const shown = app.shown.value;
    const last = priced.value;
    if (!last || last.path !== path || !last.before || shown?.doc !== last.doc) return <span class="price" />;
    const factor = shown.drawn.gas / last.before;
    const text =
        factor >= 1.095
            ? `${factor.toFixed(1)}× the gas`
            : `${factor < 1 ? "−" : "+"}${Math.abs(100 * (factor - 1)).toFixed(0)} % gas`;
    return (
        <span class={factor >= 2 ? "price dear" : "price"} role="status" data-name={`price-${path}`}>
            {text}
        </span>
    );
}
