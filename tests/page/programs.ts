// Prints the programs of documents: `node programs.mjs ASKED ANSWERS`, bundled by test_programs.py.

import { readFileSync, writeFileSync } from "node:fs";
import type { PageAssets } from "../../web/src/creator/assets.js";
import { prepare, sceneOf, type Document, type StoredMesh } from "../../web/src/document/document.js";
import { MeshStore } from "../../web/src/creator/mesh_store.js";
import { castCommand, neededGas } from "../../web/src/creator/programs/cast.js";
import { pythonProgram } from "../../web/src/creator/programs/python.js";
import { solidityProgram } from "../../web/src/creator/programs/solidity.js";
import { stemOf } from "../../web/src/creator/programs/subject.js";
import { sceneFile } from "../../web/src/document/save.js";
import { toHex } from "../../web/src/bytes.js";
import type { Contracts } from "../../web/src/evm/contracts.js";
import { hashPixels } from "../../web/src/picture.js";
import { render } from "../../web/src/render.js";
import { encode } from "../../web/src/scene/encode.js";

interface Case {
    piece: string;
    /** Fields of the document, and of all its objects. */
    changes: Partial<Document>;
    item: Partial<Document["objects"][number]>;
    /** Whether its meshes are those of an opened file. */
    opened: boolean;
    link: string;
    most?: number;
}

const [asked, written] = process.argv.slice(2) as [string, string];
const { pieces, cases, evm, contracts } = JSON.parse(readFileSync(asked, "utf8")) as {
    pieces: Record<string, Record<string, unknown>>;
    cases: Case[];
    evm: string;
    contracts: Contracts;
};
const entries = Object.keys(pieces).map((name) => ({
    name,
    title: name,
    licence: name === "tetrahedron" ? "CC0" : "MIT",
    notice: "",
}));
const assets = {
    pieces: async () => entries,
    piece: async (name: string) => structuredClone(pieces[name]),
} as unknown as PageAssets;
const store = new MeshStore(assets);
const sources = { evm: new Uint8Array(Buffer.from(evm, "base64")), contracts };

const answers = [];
for (const { piece, changes, item, opened, link, most } of cases) {
    let doc: Document = await store.piece(piece);
    if (opened) {
        const meshes = new Map<string, StoredMesh>();
        const objects = doc.objects.map((each, index) => {
            meshes.set(`file${index}`, { ...store.get(each.mesh), notice: "", licence: "" });
            return { ...each, mesh: { file: `file${index}` } };
        });
        store.put(meshes);
        doc = { ...doc, objects, notice: "", licence: "" };
    }
    doc = {
        ...doc,
        ...changes,
        objects: doc.objects.map((each) => ({ ...each, ...item, material: { ...each.material, ...item.material } })),
    };
    await store.need(doc);
    await prepare(doc, store);
    const scene = sceneOf(doc, store);
    const call = encode(scene);
    const { gas, bmp, pixels } = await render(call, { assets: sources });
    const subject = { doc, meshes: store, scene, call, gas, triangles: 1234, sha256: await hashPixels(pixels), link };
    answers.push({
        stem: stemOf(doc.title),
        call: toHex(call),
        bmp: Buffer.from(bmp).toString("base64"),
        gas,
        needed: neededGas(call, gas),
        scene: sceneFile(doc, store),
        python: pythonProgram(subject),
        solidity: solidityProgram(subject, most),
        cast: castCommand(subject, contracts, false),
        anywhere: castCommand(subject, contracts, true),
    });
}
writeFileSync(written, JSON.stringify(answers));
