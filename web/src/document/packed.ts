// Pieces of datasets as tools/build_page.py packs them: a scene file whose meshes are numbers without loss, a third as
// long as in JSON. After the length of the JSON (4 bytes, little-endian) and the JSON itself come the numbers.

import { vertexNormals } from "../scene/mesh.js";

interface PackedMesh {
    vertices: number;
    triangles: number;
    /** Channels of colours. */
    colors?: number;
    /** Whether there are any: "computed" if they are the means of the faces around vertices, as for meshes without. */
    normals?: 1 | "computed";
    uvs?: 1;
    opacities?: 1;
}

/** Return a scene file, as a value. */
export function unpackPiece(bytes: Uint8Array<ArrayBuffer>): Record<string, unknown> {
    const length = new DataView(bytes.buffer, bytes.byteOffset).getUint32(0, true);
    const text = new TextDecoder().decode(bytes.subarray(4, 4 + length));
    const { scene, meshes } = JSON.parse(text) as { scene: Record<string, unknown>; meshes: PackedMesh[] };
    const reader = new Reader(bytes, 4 + length);
    const unpacked = meshes.map((mesh) => unpackMesh(mesh, reader));
    const objects = scene["objects"] as { mesh: number }[];
    return { ...scene, objects: objects.map((each) => ({ ...each, mesh: unpacked[each.mesh] })) };
}

function unpackMesh(mesh: PackedMesh, reader: Reader): Record<string, unknown> {
    const { vertices } = mesh;
    const [positions, faces] = [reader.floats(3 * vertices), reader.running(3 * mesh.triangles)];
    const table: Record<string, unknown> = { positions: rows(positions, 3), faces: rows(faces, 3) };
    if (mesh.colors) table["colors"] = rows(reader.integers(mesh.colors * vertices, 1), mesh.colors);
    if (mesh.normals) {
        const normals = mesh.normals === "computed" ? vertexNormals(positions, faces) : reader.floats(3 * vertices);
        table["normals"] = rows(normals, 3);
    }
    if (mesh.uvs) table["uvs"] = rows(reader.floats(2 * vertices), 2);
    if (mesh.opacities) table["opacities"] = [...reader.floats(vertices)];
    return table;
}

/** Return rows of so many numbers each. */
export function rows(numbers: ArrayLike<number>, width: number): number[][] {
    const all = Array.from(numbers);
    return Array.from({ length: all.length / width }, (_, row) => all.slice(row * width, (row + 1) * width));
}

/** Numbers, whose first bytes come first, then their second ones, and so on: equal bytes lie together. */
class Reader {
    readonly #bytes: Uint8Array;
    #at: number;

    constructor(bytes: Uint8Array, at: number) {
        this.#bytes = bytes;
        this.#at = at;
    }

    /** Whole numbers of so many bytes each. */
    integers(count: number, width: number): Uint32Array {
        const planes = this.#planes(count, width);
        return Uint32Array.from({ length: count }, (_, index) => {
            let value = 0;
            for (let byte = width - 1; byte >= 0; byte--) value = value * 256 + planes[index * width + byte];
            return value;
        });
    }

    /** Whole numbers, of which each is told by its difference from the one before. */
    running(count: number): Uint32Array {
        let value = 0;
        return this.integers(count, 4).map((difference) => (value = (value + difference) >>> 0));
    }

    /** Numbers, by a table of those without sign that differ. */
    floats(count: number): Float64Array {
        const [size] = this.integers(1, 4);
        const table = new Float64Array(this.#planes(size!, 8).buffer);
        const places = this.integers(count, size! < 1 << 15 ? 2 : 4);
        return Float64Array.from(places, (place) => (place & 1 ? -table[place >>> 1] : table[place >>> 1]));
    }

    #planes(count: number, width: number): Uint8Array<ArrayBuffer> {
        const found = new Uint8Array(count * width);
        for (let byte = 0; byte < width; byte++) {
            for (let index = 0; index < count; index++) {
                found[index * width + byte] = this.#bytes[this.#at + byte * count + index];
            }
        }
        this.#at += count * width;
        return found;
    }
}
