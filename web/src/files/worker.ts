// The worker that reads files.

import { keyOf, type MeshRef, type StoredMesh } from "../document/document.js";
import { serve } from "../workers/serve.js";
import { DRACO, type Requests } from "./protocol.js";
import { readFiles } from "./read.js";

const kept = new Map<string, unknown>();

serve<Requests>(
    {
        read({ files, ...options }, { need }) {
            const library = {
                load: async (refs: readonly MeshRef[]): Promise<void> => void (await need(refs.map(keyOf))),
                get: (ref: MeshRef): StoredMesh => kept.get(keyOf(ref)) as StoredMesh,
            };
            const draco = async (): Promise<Uint8Array> => (await need([DRACO]))[0] as Uint8Array;
            return readFiles(files, { ...options, library, draco });
        },
    },
    (key, value) => kept.set(key, value),
);
