// What is open on the page, and what is being done: besides the document, all that it shows.

import { signal, type Signal } from "@preact/signals";
import type { ComponentType } from "preact";

export type DialogName = "download" | "limits" | "keys" | "things" | "about" | "mint" | "edition" | "reveal";

/** Something that takes long. part: 0..1, where it is known. */
export interface Busy {
    what: string;
    part?: number;
    cancel?: () => void;
}

export interface Open {
    /** The dialog that is open; and that which opens once its code is there. */
    dialog: { name: DialogName; Dialog: ComponentType } | null;
    asked: DialogName | null;
    /** What is shown of the dialog of downloads. */
    tab: "picture" | "files" | "chain";
    /** On small screens, what is below the picture. */
    page: "shelf" | "looks" | "scene";
    shelf: "icons" | "common" | "genesis";
    /** What is searched on the shelf. */
    words: string;
    /** Whether what is opened is added to the scene. */
    adding: boolean;
    /** What a drag on the picture does: it turns the view, or moves objects. */
    tool: "turn" | "move";
    /** Whether lights are shown on the picture, to be dragged. */
    lamps: boolean;
    /** The id of the object whose name is typed. */
    naming: string | null;
    /** Whether files are held over the page. */
    dropping: boolean;
    /** Whether the visitor has done something: until then a line says what can be done. */
    begun: boolean;
    /** "light" or "dark" where it was chosen; "" as in the system. */
    theme: string;
}

/** The one thing that the wallet does, or how the last thing ended that a dialog had it do. */
export interface Job {
    state: "running" | "done" | "failed";
    words: string;
}

export interface Doing {
    /** What the page does. */
    busy: Busy | null;
    /** What the wallet does or did, by dialog. It goes on when its dialog is closed: what is sent cannot be taken back. */
    jobs: Partial<Record<DialogName, Job>>;
}

export const open: Signal<Open> = signal<Open>({
    ...{ dialog: null, asked: null, tab: "picture", page: "looks", shelf: "icons", words: "", adding: false },
    ...{ tool: "turn", lamps: false, naming: null, dropping: false, begun: false, theme: "" },
});
export const doing: Signal<Doing> = signal<Doing>({ busy: null, jobs: {} });

/** Change some of what is open. */
export function show(change: Partial<Open>): void {
    const now = open.peek();
    if (Object.entries(change).some(([key, value]) => now[key as keyof Open] !== value))
        open.value = { ...now, ...change };
}

/** Change some of what is being done. */
export function note({ busy = doing.peek().busy, jobs = {} }: Partial<Doing>): void {
    doing.value = { busy, jobs: { ...doing.peek().jobs, ...jobs } };
}
