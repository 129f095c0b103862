// Modules that come without types.

/** A table of the Python package, as JSON has it: web/build.mjs. */
declare module "toml:*" {
    const table: unknown;
    export default table;
}

declare module "three/src/extras/lib/earcut.js" {
    /** Return the triangles of an outline, x and y of each point, as numbers of points. */
    export default function earcut(
        outline: readonly number[],
        holes?: readonly number[],
        dimensions?: number,
    ): number[];
}

declare module "three/examples/jsm/libs/draco/gltf/draco_wasm_wrapper.js" {
    /** Start the decoder, whose classes are those of C++. */
    export default function make(options: { wasmBinary: Uint8Array }): Promise<unknown>;
}
