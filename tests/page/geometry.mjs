// Runs functions of web/src/scene on meshes, for test_geometry.py, which says what the numbers of the files are.
//
//   node geometry.mjs BUNDLE ASKED ANSWERS

import { readFileSync, writeFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [bundle, asked, answers] = process.argv.slice(2);
const scene = await import(pathToFileURL(bundle));
await scene.loadSimplifier();
const data = readFileSync(asked);
const numbers = new Float64Array(data.buffer, data.byteOffset, data.length / 8);
let place = 0;

function take(count) {
    place += count;
    return numbers.subarray(place - count, place);
}

function meshFrom() {
    const [vertices, faces, hasNormals, hasUvs] = take(4);
    const mesh = { positions: take(3 * vertices), faces: take(3 * faces), colors: take(4 * vertices) };
    mesh.colors = Array.from({ length: vertices }, (_, at) => mesh.colors.subarray(4 * at, 4 * at + 4));
    if (hasNormals) mesh.normals = take(3 * vertices);
    if (hasUvs) mesh.uvs = take(2 * vertices);
    return scene.checkedMesh(mesh, "a mesh");
}

const made = [];
function give(mesh, ...more) {
    const { positions, faces, normals, uvs } = mesh;
    made.push(...more, positions.length / 3, faces.length / 3, normals ? 1 : 0, uvs ? 1 : 0);
    for (const table of [positions, faces, scene.rgbaOf(mesh), normals, uvs]) for (const x of table ?? []) made.push(x);
}

const functions = {
    creased: (meshes, degrees) => give(scene.creased(meshes[0], Number.isNaN(degrees) ? null : degrees)),
    wound: (meshes, split) => {
        const { parts, turned } = scene.wound(
            meshes.map((mesh) => ({ mesh, isOpaque: mesh.opacities === undefined })),
            split === 1,
        );
        made.push(turned, parts.length);
        for (const { mesh, cull } of parts) give(mesh, cull ? 1 : 0);
    },
    closed: ([mesh]) => made.push(Number(scene.isClosed(mesh))),
    simplified: (meshes, count) => give(scene.simplify(meshes[0], count)),
};

while (place < numbers.length) {
    const [name, argument, count] = take(3);
    functions[Object.keys(functions)[name]](Array.from({ length: count }, meshFrom), argument);
}
writeFileSync(answers, Float64Array.from(made));
