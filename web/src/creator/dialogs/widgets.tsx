// What dialogs are made of.

import type { ComponentChildren } from "preact";
import { useEffect, useId, useLayoutEffect, useRef, useState } from "preact/hooks";
import type { App } from "../app.js";
import type { DialogName } from "../state.js";
import type { Document } from "../../document/document.js";
import { capital } from "../../document/fields.js";
import type { Subject } from "../programs/subject.js";
import { IconButton } from "../ui/icons.js";
import type { Drawn } from "../work/work.js";

/** Characters of a text that are shown; copies are complete. */
const SHOWN = 1500;

/** A dialog that is open as long as it is there. Esc, its button and a click beside it close it. */
export function Sheet(props: {
    app: App;
    name: DialogName;
    title: string;
    wide: boolean;
    children: ComponentChildren;
}) {
    const { app, name, title } = props;
    const dialog = useRef<HTMLDialogElement>(null);
    useLayoutEffect(() => {
        const [shown, before] = [dialog.current as HTMLDialogElement, document.activeElement];
        shown.showModal();
        return () => {
            shown.close();
            if (before instanceof HTMLElement) before.focus();
        };
    }, []);
    const close = (): void => {
        // the event of a dialog that is gone must not close one that was opened since
        if (dialog.current && app.dialog.value?.name === name) app.closeDialog();
    };
    // the second click of two may come beside a dialog that the first one made smaller
    const beside = ({ target, detail }: MouseEvent): void => void (target === dialog.current && detail < 2 && close());
    const [id, look] = [`${name}-title`, props.wide ? "wide" : ""];
    return (
        <dialog ref={dialog} id={name} class={look} aria-labelledby={id} onClose={close} onMouseDown={beside}>
            <header>
                <h2 id={id}>{title}</h2>
                <IconButton name="close" label="Close" onClick={close} />
            </header>
            <div class="box" tabIndex={0}>
                {props.children}
            </div>
        </dialog>
    );
}

/** A button. look: further classes. label: what it says to screen readers, where that is more than its text. */
export function Button(props: {
    name: string;
    does: () => void;
    off?: boolean;
    look?: string;
    label?: string;
    children: ComponentChildren;
}) {
    const { name, does, off, look = "", label, children } = props;
    const say = label ? { "aria-label": label } : {};
    return (
        <button type="button" class={`button ${look}`} data-name={name} disabled={off ?? false} onClick={does} {...say}>
            {children}
        </button>
    );
}

/** Return what a promise gives, null before, and the words of its error. It is cancelled when the component goes. */
export function useMade<T>(make: (signal: AbortSignal) => Promise<T>, of: readonly unknown[]): Remade<T> {
    const [found, set] = useState<Made<T>>({ value: null, error: "" });
    const [tries, setTries] = useState(0);
    useEffect(() => {
        const stop = new AbortController();
        const tell = (value: T | null, error = ""): void => void (stop.signal.aborted || set({ value, error }));
        tell(null);
        make(stop.signal).then(tell, (error: unknown) => tell(null, wordsOf(error)));
        return () => stop.abort();
    }, [...of, tries]);
    return { ...found, again: () => setTries(tries + 1) };
}

/** Work that a button starts. part: 0..1, null where nothing runs, NaN where it is not known. */
export interface Task {
    part: number | null;
    error: string;
    start(work: (signal: AbortSignal, onProgress: (part: number) => void) => Promise<void>): void;
    cancel(): void;
}

export function useTask(): Task {
    const [state, set] = useState<{ part: number | null; error: string }>({ part: null, error: "" });
    const stop = useRef<AbortController>(undefined);
    useEffect(() => () => stop.current?.abort(), []);
    return {
        ...state,
        start(work) {
            stop.current?.abort();
            const own = (stop.current = new AbortController());
            const tell = (part: number | null, error = ""): void => {
                if (stop.current === own) set({ part, error });
            };
            tell(Number.NaN);
            work(own.signal, (part) => own.signal.aborted || tell(part)).then(
                () => tell(null),
                (error: unknown) => tell(null, own.signal.aborted ? "" : wordsOf(error)),
            );
        },
        cancel() {
            stop.current?.abort();
            stop.current = undefined;
            set({ part: null, error: "" });
        },
    };
}

/** The progress of a task, with a button that ends it, and its error. */
export function Progress({ task, what }: { task: Task; what: string }) {
    if (task.error || task.part === null) return <Trouble text={task.error} />;
    const known = Number.isFinite(task.part);
    return (
        <div class="job" role="status">
            <span class="quiet">{known ? `${what} ${Math.round(100 * task.part)} %` : `${what} …`}</span>
            <progress aria-label={what} {...(known ? { value: task.part } : {})} max={1} />
            <Button name="cancel" look="small" does={task.cancel}>
                Cancel
            </Button>
        </div>
    );
}

export function Trouble({ text }: { text: string }) {
    return text ? <p class="trouble" role="alert" children={text} /> : null;
}

/** The pixels of a picture. */
export function Pixels({ drawn, label }: { drawn: Pick<Drawn, "width" | "height" | "pixels"> | null; label: string }) {
    const canvas = useRef<HTMLCanvasElement>(null);
    const { width, height } = drawn ?? { width: 1, height: 1 };
    useLayoutEffect(() => {
        const context = canvas.current?.getContext("2d");
        if (drawn) context?.putImageData(new ImageData(drawn.pixels, width, height), 0, 0);
    }, [drawn]);
    const size = { width, height, style: { "--aspect": width / height } };
    return <canvas ref={canvas} class="pixels" role="img" aria-label={label} {...size} />;
}

/** What is made for a text, or the words of the error. */
export interface Made<T> {
    value: T | null;
    error: string;
}

/** What the tabs of a dialog show. drawn, subject: null until they are made. */
export interface TabProps {
    app: App;
    doc: Document;
    drawn: Drawn | null;
    subject: Made<Subject>;
}

/** Return the text that is made of what is made, or the words of the error. */
export function madeOf({ value, error }: Made<Subject>, make: (subject: Subject) => string): Made<string> {
    try {
        return { value: value && make(value), error };
    } catch (problem) {
        return { value: null, error: wordsOf(problem) };
    }
}

/** What can be made again, as where a network failed. */
export interface Remade<T> extends Made<T> {
    again(): void;
}

/** A text to copy or to save. */
export function Code(props: { app: App; name: string; title: string; help: string; file: string; made: Made<string> }) {
    const { app, name, title, file, made } = props;
    const [text, id] = [made.value ?? "", useId()];
    const rest = text.length > SHOWN ? `…\n\n${count(text.length)} characters; Copy and Save take all of them` : "";
    const save = (): void => app.save(new Blob([text], { type: "text/plain" }), file);
    return (
        <section>
            <div class="snippet">
                <h3 id={id}>{title}</h3>
                <p class="quiet">{props.help}</p>
                <span class="pair">
                    <Button
                        name={`copy-${name}`}
                        look="small"
                        label={`Copy: ${title}`}
                        off={!text}
                        does={() => void app.copy(text)}
                    >
                        Copy
                    </Button>
                    <Button name={`take-${name}`} look="small" label={`Save: ${title}`} off={!text} does={save}>
                        Save
                    </Button>
                </span>
            </div>
            <Trouble text={made.error} />
            <div class="code" hidden={made.error !== ""}>
                <pre tabIndex={0} role="region" aria-labelledby={id}>
                    {text.slice(0, SHOWN) + rest || "…"}
                </pre>
            </div>
        </section>
    );
}

/** A title, what it is, and a button that does it. */
export function Row(props: {
    title: string;
    help: string;
    name: string;
    does: () => void;
    off?: boolean;
    word?: string;
    children?: ComponentChildren;
}) {
    const { title, name, does, off = false, word = "Save" } = props;
    return (
        <div class="snippet">
            <h3>{title}</h3>
            <p class="quiet">{props.help}</p>
            <Button name={name} look="small" label={`${word}: ${title}`} off={off} does={does}>
                {word}
            </Button>
            {props.children}
        </div>
    );
}

/** Choices of which one is taken. */
export function Choices<T extends string | number>(props: {
    name: string;
    label: string;
    value: T;
    of: readonly (readonly [T, string])[];
    does: (value: T) => void;
}) {
    const { name, does } = props;
    return (
        <div class="choices" role="radiogroup" aria-label={props.label}>
            {props.of.map(([value, title]) => (
                <label key={value}>
                    <input
                        type="radio"
                        name={name}
                        value={value}
                        checked={value === props.value}
                        onChange={() => does(value)}
                    />
                    {title}
                </label>
            ))}
        </div>
    );
}

/** Return the picture of a document: the one that is shown, if it is that. */
export async function drawnOf({ shown, work }: App, doc: Document, signal: AbortSignal): Promise<Drawn> {
    const last = shown.value;
    return last?.doc === doc ? last.drawn : work.draw(doc, { lane: "background", signal });
}

/** Return the words of an error, as a sentence. */
export function wordsOf(error: unknown): string {
    return capital(error instanceof Error ? error.message : String(error));
}

export function count(value: number): string {
    return value.toLocaleString("en");
}

/** Return gas as it is said: 12.3 million. */
export function gasWords(gas: number): string {
    return gas < 1e6 ? `${count(Math.round(gas))} gas` : `${(gas / 1e6).toFixed(gas < 1e8 ? 1 : 0)} million gas`;
}
