// The page's side of reading files: a worker reads, which is ended to cancel.

import script from "worker:files/worker.ts";
import { refOf, type Meshes } from "../document/document.js";
import { InputError } from "../errors.js";
import { Pool, started, type AskOptions, type WorkerLike } from "../workers/pool.js";
import { DRACO, type Requests } from "./protocol.js";
import type { Given, Opened, Options } from "./read.js";

export type { Given, Opened, Options } from "./read.js";

/** Return the document of files. InputError, a sentence, if nothing of them can be shown. */
export async function readFiles(files: readonly Given[], options: Options & AskOptions): Promise<Opened> {
    const { size, maxTriangles, library, draco, signal } = options;
    const supply = async (key: string): Promise<[string, unknown]> => {
        if (key !== DRACO) return [key, (library as Meshes).get(refOf(key))];
        if (!draco) throw new InputError("the decoder of Draco is not here");
        return [key, await draco()];
    };
    const supplies = async (lacks: readonly string[]): Promise<Map<string, unknown>> => {
        const refs = lacks.filter((key) => key !== DRACO).map(refOf);
        if (refs.length && !library) throw new InputError("pieces of datasets are not here");
        await library?.load(refs);
        return new Map(await Promise.all(lacks.map(supply)));
    };
    const pool = new Pool<Requests, "read">({ start: inClosedFrame, supplies }, { read: 1 });
    try {
        return await pool.ask("read", { files, size, maxTriangles }, "read", { signal });
    } finally {
        pool.stop();
    }
}

/** Start the worker in a frame whose workers reach no address: they have its policy besides that of the page, which allows nodes. */
async function inClosedFrame(): Promise<WorkerLike> {
    const policy = "connect-src data: blob:";
    const srcdoc = `<meta http-equiv="Content-Security-Policy" content="${policy}">`;
    const frame = Object.assign(document.createElement("iframe"), { hidden: true, srcdoc });
    await new Promise((resolve) => {
        frame.onload = resolve;
        document.body.append(frame);
    });
    const worker = started(script, frame.contentWindow as Window & typeof globalThis);
    const terminate = worker.terminate.bind(worker);
    worker.terminate = () => {
        terminate();
        frame.remove();
    };
    return worker;
}
