// Runs functions of web/src/scene on meshes: `node geometry.mjs ASKED ANSWERS`, bundled by test_geometry.py.

import { readFileSync, writeFileSync } from "node:fs";
import { checkedMesh, type Mesh } from "../../web/src/scene/checked.js";
import { creased } from "../../web/src/scene/normals.js";
import { loadSimplifier, simplify } from "../../web/src/scene/simplify.js";
import type * as given from "../../web/src/scene/types.js";
import { rgbaOf } from "../../web/src/scene/weld.js";
import { isClosed, wound } from "../../web/src/scene/winding.js";

const [asked, written] = process.argv.slice(2) as [string, string];
const questions = JSON.parse(readFileSync(asked, "utf8")) as {
    does: "creased" | "wound" | "simplified";
    meshes: given.Mesh[];
    option: never;
}[];
await loadSimplifier();

const rows = (mesh: Mesh): unknown => ({ ...mesh, colors: rgbaOf(mesh) });
const doers = {
    creased: ([mesh]: Mesh[], degrees: number | null) => ({
        mesh: rows(creased(mesh, degrees)),
        closed: isClosed(mesh),
    }),
    wound: (meshes: Mesh[], split: boolean) => {
        const parts = meshes.map((mesh) => ({ mesh, isOpaque: mesh.opacities === undefined }));
        const found = wound(parts, split);
        return { turned: found.turned, parts: found.parts.map(({ mesh, cull }) => ({ mesh: rows(mesh), cull })) };
    },
    simplified: ([mesh]: Mesh[], count: number) => rows(simplify(mesh, count)),
};
const answers = questions.map(({ does, meshes, option }) =>
    doers[does](
        meshes.map((mesh) => checkedMesh(mesh, "a mesh")),
        option,
    ),
);
writeFileSync(
    written,
    JSON.stringify(answers, (_, value: unknown) =>
        ArrayBuffer.isView(value) ? Array.from(value as Float64Array) : value,
    ),
);
