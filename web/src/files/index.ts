// The page's side of reading files: a worker reads, which is ended to cancel.

import script from "worker:files/worker.ts";
import type { MeshRef, StoredMesh } from "../document/document.js";
import { InputError } from "../errors.js";
import type { Given, Opened, Options } from "./read.js";

export type { Given, Opened, Options } from "./read.js";

/** What the worker is told: what to read, or an answer. */
export type Order =
    | { files: readonly Given[]; size: number; maxTriangles: Options["maxTriangles"] }
    | { id: number; answer?: unknown; error?: string };

/** What the worker tells: what it does, how it ended, or a question: for pieces, or for the decoder of Draco's meshes. */
export type Report =
    | { progress: string }
    | { opened: Opened }
    | { error: string; isInput: boolean }
    | { id: number; refs: readonly MeshRef[] | null };

/** Return the document of files. InputError, a sentence, if nothing of them can be shown. */
export async function readFiles(files: readonly Given[], options: Options): Promise<Opened> {
    const { size, maxTriangles, library, draco, signal, onProgress } = options;
    const answer = async (refs: readonly MeshRef[] | null): Promise<Uint8Array | StoredMesh[]> => {
        if (refs === null && draco) return draco();
        if (!refs || !library)
            throw new InputError(refs ? "pieces of datasets are not here" : "the decoder of Draco is not here");
        await library.load(refs);
        return refs.map((ref) => library.get(ref));
    };
    const frame = await closedFrame();
    const { Blob, URL, Worker } = frame.contentWindow as Window & typeof globalThis;
    const url = URL.createObjectURL(new Blob([script], { type: "text/javascript" }));
    const worker = new Worker(url);
    const tell = (order: Order): void => worker.postMessage(order);
    try {
        signal?.throwIfAborted();
        return await new Promise((resolve, reject) => {
            signal?.addEventListener("abort", () => reject(signal.reason), { once: true });
            worker.onerror = ({ message }) => reject(new Error(message));
            worker.onmessage = ({ data }: MessageEvent<Report>) => {
                if ("progress" in data) onProgress?.(data.progress);
                else if ("opened" in data) resolve(data.opened);
                else if ("error" in data) reject(data.isInput ? new InputError(data.error) : new Error(data.error));
                else {
                    const { id, refs } = data;
                    answer(refs).then(
                        (answer) => tell({ id, answer }),
                        (error: Error) => tell({ id, error: error.message }),
                    );
                }
            };
            tell({ files, size, maxTriangles });
        });
    } finally {
        worker.terminate();
        URL.revokeObjectURL(url);
        frame.remove();
    }
}

/** Return a frame whose workers reach no address: they have its policy besides that of the page, which allows nodes. */
async function closedFrame(): Promise<HTMLIFrameElement> {
    const policy = "connect-src data: blob:";
    const srcdoc = `<meta http-equiv="Content-Security-Policy" content="${policy}">`;
    const frame = Object.assign(document.createElement("iframe"), { hidden: true, srcdoc });
    await new Promise((resolve) => {
        frame.onload = resolve;
        document.body.append(frame);
    });
    return frame;
}
