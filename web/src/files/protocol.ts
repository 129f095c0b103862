// What the page asks the worker that reads files.

import type { Given, Opened, Options } from "./read.js";

/** The key of the decoder of Draco's meshes; meshes of pieces have theirs. */
export const DRACO = "draco";

export interface Requests {
    read: [{ files: readonly Given[] } & Pick<Options, "size" | "maxTriangles">, Opened];
}
