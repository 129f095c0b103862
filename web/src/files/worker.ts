// The worker that reads files.

import type { MeshRef, StoredMesh } from "../document/document.js";
import { InputError } from "../errors.js";
import type { Order, Report } from "./index.js";
import { readFiles } from "./read.js";

const waiting = new Map<number, (order: { answer?: unknown; error?: string }) => void>();
const pieces = new Map<string, StoredMesh>();

function tell(report: Report): void {
    postMessage(report);
}

/** Ask the page for pieces, or, for null, for the decoder of Draco's meshes. */
function ask<T>(refs: readonly MeshRef[] | null): Promise<T> {
    const id = waiting.size;
    return new Promise((resolve, reject) => {
        waiting.set(id, ({ answer, error }) =>
            error === undefined ? resolve(answer as T) : reject(new InputError(error)),
        );
        tell({ id, refs });
    });
}

const library = {
    load: async (refs: readonly MeshRef[]): Promise<void> => {
        const found = await ask<StoredMesh[]>(refs);
        refs.forEach((ref, at) => pieces.set(JSON.stringify(ref), found[at]));
    },
    get: (ref: MeshRef): StoredMesh => pieces.get(JSON.stringify(ref)) as StoredMesh,
};

onmessage = ({ data }: MessageEvent<Order>) => {
    if ("id" in data) return waiting.get(data.id)?.(data);
    const { files, ...options } = data;
    const onProgress = (progress: string): void => tell({ progress });
    readFiles(files, { ...options, library, onProgress, draco: () => ask<Uint8Array>(null) }).then(
        (opened) => tell({ opened }),
        (error: Error) => tell({ error: error.message, isInput: error instanceof InputError }),
    );
};
