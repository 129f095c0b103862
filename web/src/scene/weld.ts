// From what corners of faces have to a mesh, whose vertices have it: src/shackled/scene/_mesh.py.

import { checkedMesh, type Mesh } from "./checked.js";
import { beside, numbered, rowsOf } from "./topology.js";

/** What each corner of each face has: `rgba` four bytes, `normals` three numbers, `uvs` two. */
export interface Corners {
    rgba?: Uint8Array | undefined;
    normals?: Float64Array | undefined;
    uvs?: Float64Array | undefined;
}

/** Return a mesh with one vertex for each distinct position, colour, normal and texture coordinate that a face uses. */
export function weld(positions: Float64Array, faces: Uint32Array, corners: Corners = {}): Mesh {
    const { rgba, normals, uvs } = corners;
    const { rows, width } = beside([rowsOf(positions, faces), rgba, normals, uvs], faces.length);
    const { numbers, firsts } = numbered(rows, width);
    return meshOf(rowsOf(positions, rowsOf(faces, firsts, 1)), numbers, ofRows({ rgba, normals, uvs }, firsts));
}

/** Return what some corners, or vertices, have. */
function ofRows({ rgba, normals, uvs }: Corners, rows: Uint32Array): Corners {
    return {
        rgba: rgba && rowsOf(rgba, rows, 4),
        normals: normals && rowsOf(normals, rows),
        uvs: uvs && rowsOf(uvs, rows, 2),
    };
}

/** Return some faces of a mesh, with the vertices that they use. */
export function partOf(mesh: Mesh, faces: Uint32Array): Mesh {
    const numbers = new Uint32Array(mesh.positions.length / 3);
    for (const vertex of faces) numbers[vertex] = 1;
    const used = Uint32Array.from(numbers.keys()).filter((vertex) => numbers[vertex]);
    used.forEach((vertex, number) => (numbers[vertex] = number));
    const corners = faces.map((vertex) => numbers[vertex]);
    return meshOf(rowsOf(mesh.positions, used), corners, ofRows({ ...mesh, rgba: rgbaOf(mesh) }, used));
}

/** Return the mesh of what its vertices have. */
export function meshOf(positions: Float64Array, faces: Uint32Array, { rgba, normals, uvs }: Corners): Mesh {
    const alpha = rgba?.filter((_, at) => at % 4 === 3);
    const [colors, opacities] = [
        rgba?.filter((_, at) => at % 4 < 3),
        alpha && Float64Array.from(alpha, (x) => x / 255),
    ];
    return checkedMesh({ positions, faces, colors, normals, uvs, opacities }, "a mesh");
}

/** Return the colours of vertices with the opacities as alpha, four bytes each. */
export function rgbaOf({ colors, opacities }: Mesh): Uint8Array {
    const count = colors.length / 3;
    const rgba = new Uint8Array(4 * count).fill(255);
    for (let vertex = 0; vertex < count; vertex++) {
        for (let channel = 0; channel < 3; channel++) rgba[4 * vertex + channel] = colors[3 * vertex + channel];
        if (opacities) rgba[4 * vertex + 3] = Math.round(255 * opacities[vertex]);
    }
    return rgba;
}
