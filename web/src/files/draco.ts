// The decoder of Draco's meshes for GLTFLoader, in this thread: three's own one needs workers and addresses.

import { BufferAttribute, BufferGeometry } from "three";
import type { DRACOLoader } from "three/examples/jsm/loaders/DRACOLoader.js";
import type { Source } from "./source.js";

type Draco = any; // eslint-disable-line @typescript-eslint/no-explicit-any

const KINDS = { Int8Array, Uint8Array, Int16Array, Uint16Array, Uint32Array, Float32Array };
type Kind = keyof typeof KINDS;

let pending: Promise<Draco> | undefined;

async function load(wasm: () => Promise<Uint8Array>): Promise<Draco> {
    // in Node the library uses what modules lack
    const node = globalThis.process?.getBuiltinModule?.("module");
    if (node) Object.assign(globalThis, { require: node.createRequire("/"), __dirname: "/" });
    const { default: make } = await import("three/examples/jsm/libs/draco/gltf/draco_wasm_wrapper.js");
    return make({ wasmBinary: await wasm() });
}

/** Return what GLTFLoader calls of a DRACOLoader. */
export function dracoLoader({ draco }: Source): DRACOLoader {
    const decode = async (
        data: ArrayBuffer,
        names: Record<string, number>,
        kinds: Record<string, Kind>,
    ): Promise<BufferGeometry> => {
        const library = await (pending ??= load(draco));
        const [decoder, mesh] = [new library.Decoder(), new library.Mesh()];
        const status = decoder.DecodeArrayToMesh(new Int8Array(data), data.byteLength, mesh);
        if (!status.ok() || !mesh.ptr) throw new Error(`its data of Draco cannot be decoded: ${status.error_msg()}`);
        const table = (
            kind: Kind,
            width: number,
            count: number,
            fill: (size: number, at: number) => void,
        ): BufferAttribute => {
            const size = width * count * KINDS[kind].BYTES_PER_ELEMENT;
            const at = library._malloc(size);
            fill(size, at);
            const values = new KINDS[kind](library.HEAPF32.buffer, at, width * count).slice();
            library._free(at);
            return new BufferAttribute(values, width);
        };
        const geometry = new BufferGeometry();
        for (const [name, number] of Object.entries(names)) {
            const [attribute, kind] = [decoder.GetAttributeByUniqueId(mesh, number), kinds[name] ?? "Float32Array"];
            const type = library[`DT_${kind === "Float32Array" ? "FLOAT32" : kind.replace("Array", "").toUpperCase()}`];
            const read = (size: number, at: number): void =>
                decoder.GetAttributeDataArrayForAllPoints(mesh, attribute, type, size, at);
            geometry.setAttribute(name, table(kind, attribute.num_components(), mesh.num_points(), read));
        }
        const read = (size: number, at: number): void => decoder.GetTrianglesUInt32Array(mesh, size, at);
        geometry.setIndex(table("Uint32Array", 1, 3 * mesh.num_faces(), read));
        library.destroy(mesh);
        library.destroy(decoder);
        return geometry;
    };
    const decodeDracoFile = (
        data: ArrayBuffer,
        done: (found: BufferGeometry) => void,
        ...rest: [Record<string, number>, Record<string, Kind>, string, (error: unknown) => void]
    ): void => void decode(data, rest[0], rest[1]).then(done, rest[3]);
    return { preload: () => undefined, decodeDracoFile } as unknown as DRACOLoader;
}
