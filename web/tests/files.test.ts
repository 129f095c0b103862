// Files that are opened: what they become, and what is said of those that are wrong. tests/page/test_corpus_of_files.py
// compares what is read with Python.

import assert from "node:assert/strict";
import { test } from "node:test";
import { gzipSync, strToU8, zipSync } from "fflate";
import { MeshoptEncoder } from "meshoptimizer/encoder";
import { encode } from "../src/index.js";
import { sceneOf } from "../src/document/document.js";
import { decodeImagesBy, type Picture } from "../src/files/images.js";
import { PLAIN, partsOf } from "../src/files/parts.js";
import { readFiles, type Given, type Opened } from "../src/files/read.js";
import type { Image, Source } from "../src/files/source.js";

const CUBE = ["v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"]
    .concat(["f 4 3 2 1\n", "f 5 6 7 8\n", "f 1 2 6 5\n", "f 2 3 7 6\n", "f 3 4 8 7\n", "f 4 1 5 8\n"])
    .join("");

const text = (name: string, content: string): Given => ({ name, bytes: Uint8Array.from(strToU8(content)) });
const open = (...files: Given[]): Promise<Opened> => readFiles(files, { size: 64 });
const gltf = (keys: object, name = "a.gltf"): Given =>
    text(name, JSON.stringify({ asset: { version: "2.0" }, ...keys }));

/** Return the call of what was opened. */
function callOf({ document, meshes }: Opened): Uint8Array {
    return encode(sceneOf(document, { get: (ref) => meshes.get("file" in ref ? ref.file : "")! }));
}

test("a mesh file is one object, staged, with the name of the file", async () => {
    const { document, meshes, notes } = await open(text("folder/cube.v1.obj", CUBE));
    assert.deepEqual(notes, []);
    assert.equal(document.title, "cube.v1");
    assert.deepEqual(
        document.objects.map(({ name, cull, material }) => [name, cull, material.shading]),
        [["cube.v1", true, "flat"]],
    );
    const [{ mesh }] = document.objects;
    assert.equal(meshes.get("file" in mesh ? mesh.file : "")?.triangles, 12);
    assert.deepEqual([document.width, document.antialias, document.ground], [64, true, null]);
    assert.ok(callOf({ document, meshes, notes }).length > 100);
});

test("two files are two objects side by side, of one size, on one level", async () => {
    const { document, meshes } = await open(text("one.obj", CUBE), text("two.obj", CUBE.replaceAll(" 1", " 9000")));
    assert.equal(document.title, "one and two");
    assert.deepEqual(
        document.objects.map(({ name }) => name),
        ["one", "two"],
    );
    const low = document.objects.map(({ position, scale, mesh }) => {
        const { positions } = meshes.get("file" in mesh ? mesh.file : "")!.mesh;
        const column = (axis: number): number[] =>
            [...positions.filter((_, at) => at % 3 === axis)].map((x) => position[axis]! + scale * x);
        return { left: Math.min(...column(0)), right: Math.max(...column(0)), bottom: Math.min(...column(1)) };
    });
    assert.ok(low[0]!.right < low[1]!.left);
    assert.ok(Math.abs(low[0]!.bottom - low[1]!.bottom) < 1e-9);
});

test("a file that cannot be read is left out beside others", async () => {
    const { document, notes } = await open(text("a.obj", CUBE), text("b.obj", "v 1 2"));
    assert.equal(document.objects.length, 1);
    assert.match(notes.join(), /b\.obj: left out: Cannot open b\.obj/);
});

test("a ZIP file of a scene with a mesh file, whose path is that of another machine", async () => {
    const scene =
        'size = 32\n[[objects]]\nmesh = "C:\\\\models\\\\Cube.OBJ"\ncolor = [1.0, 0.5, 0.0]\n[[objects]]\nmesh = "a.stl"\n';
    const facet =
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 5\nendloop\nendfacet\nendsolid";
    const zip = zipSync({
        "in/scene.toml": strToU8(scene),
        "in/cube.obj": strToU8(CUBE),
        "in/a.stl": strToU8(facet),
        "__MACOSX/x.obj": strToU8("no"),
    });
    const { document, meshes, notes } = await open({ name: "all.zip", bytes: Uint8Array.from(zip) });
    assert.deepEqual(notes, []);
    assert.deepEqual([document.title, document.width, document.objects.length], ["scene", 32, 2]);
    assert.equal(document.objects[0]!.color, "#ff8000");
    const { mesh } = document.objects[1]!;
    // z is up in STL files
    assert.deepEqual([...meshes.get("file" in mesh ? mesh.file : "")!.mesh.positions], [0, 0, 0, 1, 0, 0, 0, 5, -1]);
});

test("the same picture comes back from a call", async () => {
    const call = callOf(await open(text("cube.obj", CUBE)));
    const again = await open({ name: "call.bin", bytes: new Uint8Array(call) });
    assert.deepEqual(callOf(again), call);
    assert.deepEqual(callOf(await open(text("call.txt", `0x${Buffer.from(call).toString("hex")}`))), call);
});

test("a large mesh has as many triangles as the canvas shows, or all", async () => {
    const side = 80;
    const rows = Array.from(
        { length: side * side },
        (_, at) => `v ${at % side} ${Math.sin(at / 900)} ${Math.floor(at / side)}`,
    );
    const faces = Array.from({ length: side * (side - 1) }, (_, at) =>
        (at + 1) % side ? `f ${at + 1} ${at + 2} ${at + 2 + side} ${at + 1 + side}` : "",
    );
    const file = text("field.obj", [...rows, ...faces].join("\n"));
    const count = ({ meshes }: Opened): number =>
        [...meshes.values()].reduce((sum, { triangles }) => sum + triangles, 0);
    const shown = await open(file);
    assert.ok(count(shown) <= 4096);
    assert.match(shown.notes.join(), /simplified from 12,482 to [34],\d+ triangles, as 64 x 64 pixels show no more/);
    assert.equal(count(await readFiles([file], { size: 64, maxTriangles: "all" })), 12482);
});

test("meshes that meshopt has compressed", async () => {
    await MeshoptEncoder.ready;
    const points = new Uint8Array(Float32Array.of(0, 0, 0, 2, 0, 0, 0, 1, 0).buffer);
    const packed = MeshoptEncoder.encodeGltfBuffer(points, 3, 12, "ATTRIBUTES");
    const name = "EXT_meshopt_compression";
    const { meshes, notes } = await open(
        gltf({
            buffers: [
                { byteLength: packed.length, uri: `data:;base64,${Buffer.from(packed).toString("base64")}` },
                { byteLength: 36 },
            ],
            bufferViews: [
                {
                    buffer: 1,
                    byteLength: 36,
                    extensions: {
                        [name]: { buffer: 0, byteLength: packed.length, byteStride: 12, count: 3, mode: "ATTRIBUTES" },
                    },
                },
            ],
            accessors: [{ bufferView: 0, componentType: 5126, count: 3, type: "VEC3" }],
            meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
            nodes: [{ mesh: 0 }],
            extensionsUsed: [name],
            extensionsRequired: [name],
        }),
    );
    assert.deepEqual(notes, []);
    assert.deepEqual([...[...meshes.values()][0]!.mesh.positions], [0, 0, 0, 2, 0, 0, 0, 1, 0]);
});

const png = Uint8Array.from(
    Buffer.from(
        "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg==",
        "base64",
    ),
);
const many = zipSync(Object.fromEntries(Array.from({ length: 1001 }, (_, at) => [`${at}.txt`, new Uint8Array()])));
const bomb = zipSync({ "a.obj": new Uint8Array(101 * 2 ** 20) }, { level: 9 });
const node = (more: object): Given => gltf({ nodes: [more] });

/** A document of one mesh of so many vertices, all zero. */
function shown(count: number, more: object): Given {
    const accessors = [count, 1 << 21].map((each) => ({ componentType: 5126, type: "VEC3", count: each }));
    return gltf({
        accessors,
        meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
        nodes: [{ mesh: 0 }],
        ...more,
    });
}
const instanced = (count: number): object => ({
    mesh: 0,
    extensions: { EXT_mesh_gpu_instancing: { attributes: { TRANSLATION: count && 1 } } },
});
/** A polygon with so many corners, every other one of which is half as far away. */
function star(count: number): string {
    const point = (at: number): string => {
        const [angle, far] = [(2 * Math.PI * at) / count, 1 - (at % 2) / 2];
        return `v ${far * Math.cos(angle)} ${far * Math.sin(angle)} 0\n`;
    };
    return `${Array.from({ length: count }, (_, at) => point(at)).join("")}f ${Array.from({ length: count }, (_, at) => at + 1).join(" ")}\n`;
}

/** What is opened, and the sentence that says what is wrong. */
// prettier-ignore
const WRONG: [Given[], RegExp][] = [
    [[], /^There is no file to open\. Known are/],
    [[text("a.xyz", "1 2 3")], /^This is no 3D file: a\.xyz\. Known are \.glb, /],
    [[text("notes.txt", "Buy milk.")], /^This is no 3D file: notes\.txt\. Known are \.glb, /],
    [[text("a.doc", ""), text("b.xls", "")], /^These are no 3D files: a\.doc and b\.xls\. Known are \.glb, /],
    [[text("a.obj", "")], /^Cannot open a\.obj: it is empty\.$/],
    [[text("a.obj", "v 0 0 0\n")], /^Cannot open a\.obj: it has no faces; only faces are drawn\.$/],
    [[text("a.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")], /nothing to see: none of its 1 triangle has an area\.$/],
    [[text("a.obj", "v 0 0 0\nf 1 2 3\n")], /none of its triangles has vertices at finite numbers\.$/],
    [[{ name: "a.obj", bytes: Uint8Array.of(1, 0, 2) }], /it is not a text file/],
    [[text("a.ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nend_header\n1\n")], /it ends, or has a word that is no number, in element 1 of the 2 elements vertex/],
    [[text("a.ply", "ply\nelement vertex many\nend_header\n")], /line 2 of its header is none that is known: 'element vertex many'/],
    [[text("a.off", "OFF\n1 1 0\n0 0 zero\n")], /line 3 should hold the 3 numbers of a vertex, not '0 0 zero'/],
    [[{ name: "a.stl", bytes: new Uint8Array(90) }], /^Cannot open a\.stl: /],
    [[{ name: "a.glb", bytes: Uint8Array.from(Buffer.from("glTF\x02\x00\x00\x00\xff\x00\x00\x00...........", "latin1")), }], /it ends after \d+ of its 255 bytes\.$/],
    [[text("a.gltf", "{")], /it is not valid JSON/],
    [[text("a.gltf", "{}")], /asset, with the version of glTF, is missing/],
    [[gltf({ asset: { version: "1.0" } })], /its version is "1\.0"; glTF 2\.0 is read/],
    [[gltf({ extensionsRequired: ["KHR_texture_basisu"] })], /requires the extension KHR_texture_basisu, which is not read; export it without/],
    [[gltf({ buffers: [{ uri: "a.bin", byteLength: 9 }] })], /it needs a\.bin, which was not given: choose or drop both files, or a ZIP/],
    [[gltf({ bufferViews: [{ buffer: 0, byteLength: 9 }] })], /bufferViews\[0\] needs 9 bytes of a buffer that has 0/],
    [[gltf({ accessors: [{ componentType: 5126, type: "VEC3", count: 2 ** 40 }] })], /it unpacks to [\d,]+ bytes, too many for a file of this size/],
    [[node({ mesh: 7 })], /names number 7 of its meshes, of which there are 0/],
    [[node({ children: [0] })], /it has no triangles|hangs on several nodes, or on itself/],
    [[gltf({ nodes: [{ children: [1] }, { children: [0] }], scenes: [{ nodes: [0] }] })], /nodes\[0\] hangs on several nodes, or on itself/],
    [[text("a.toml", "size = ")], /^Cannot open a\.toml: it is not valid TOML/],
    [[text("a.toml", "[[objects]]\nmesh = 'lost.obj'\n")], /objects\[0\]\.mesh names lost\.obj, which was not given/],
    [[text("a.json", '{"sise": 3}')], /^Cannot open a\.json: .*sise/],
    [[text("a.json", '{"objects": [{"mesh": {"piece": "teapot", "object": 0}}]}')], /it names 1 piece of datasets, which are not here/],
    [[text("a.toml", ""), text("b.toml", "")], /^Open one scene at a time: a\.toml and b\.toml are 2\.$/],
    [[{ name: "a.png", bytes: png }], /^This PNG was not made by Shackled: it holds no scene\.$/],
    [[text("a.bin", "what is this")], /^This is no 3D file: a\.bin\. Known are /],
    [[text("a.hex", "0x12345")], /^Cannot open a\.hex: the text is not 0x and pairs of hexadecimal digits\.$/],
    [[text("a.zip", "no")], /^Cannot open a\.zip: it is no ZIP file that can be read/],
    [[{ name: "a.zip", bytes: Uint8Array.from(bomb) }], /^All files together may have up to 100 MB/],
    [[{ name: "a.stl", bytes: Uint8Array.from(many) }], /^Cannot open a\.stl: it is a zip archive: unpack it, and give a file that is in it\.$/],
    [[text("a.3mf", "PK\x03\x04".padEnd(30) + "3D/x.model")], /^Cannot open a\.3mf: it is a 3MF file: save it as STL, OBJ or GLB/],
    [[text("a.gltf", "version https://git-lfs.github.com/spec/v1\n")], /it is a Git LFS pointer, not the file itself: run `git lfs pull`/],
    [[text("a.stl", "<!DOCTYPE html>")], /it is a web page, not the file that was to be downloaded/],
    [[{ name: "a.stl", bytes: png }], /^This PNG was not made by Shackled/],
    [[text("a.glb", `x\0${"\ufffd".repeat(8)}`)], /it is binary data that was damaged when it was copied as text/],
    [[{ name: "a.obj.gz", bytes: Uint8Array.from(gzipSync(new Uint8Array(65 * 2 ** 20))) }], /^Cannot open a\.obj\.gz: what it holds must have up to 67,108,864 bytes\.$/],
    [[text("a.obj", "v 0 0 0\nf 1 1,000 1\n")], /its face 'f 1 1,000 1' has a comma/],
    [[text("a.obj", star(8200))], /the face f 1 2 3 .{12}\.\.\. is not convex and has 8200 corners; up to 8192 are cut\.$/],
    // what small files would become
    [[gltf({ nodes: Array.from({ length: 2002 }, (_, at) => ({ children: at < 2001 ? [at + 1] : [] })) })], /hang on one another in more than 2000 levels/],
    [[shown(1 << 20, { nodes: [{ mesh: 0 }, { mesh: 0 }, { mesh: 0 }, { mesh: 0 }] })], /shows more triangles than a file of this size may: up to 1,048,576/],
    [[shown(3, { nodes: [instanced(1 << 21)] })], /shows more triangles/],
    [[shown(3, { nodes: Array(66000).fill({ mesh: 0 }) })], /shows more than 65536 meshes/],
    [[shown(1 << 19, { meshes: [{ primitives: [{ attributes: { POSITION: 0 }, targets: Array(64).fill({ POSITION: 0 }) }] }] })], /shows more vertices/],
    [[gltf({ bufferViews: Array(9).fill({ byteLength: 2 ** 25 }) })], /unpacks to 301,989,888 bytes, too many/],
    [[{ name: "a.zip", bytes: Uint8Array.from(many) }], /^A ZIP file may hold up to 1000 files\.$/],
];

for (const [given, wanted] of WRONG) {
    test(`wrong: ${wanted.source}`, async () => {
        await assert.rejects(open(...given), (error: Error) => {
            assert.equal(error.name, "InputError");
            assert.match(error.message, wanted);
            assert.match(error.message, /^[A-Z][^\n]*\.$/);
            return true;
        });
    });
}

const marked = (content: string): Uint8Array<ArrayBuffer> =>
    Uint8Array.from(Buffer.from(`\ufeff${content}`, "utf16le"));
const gzipped = Uint8Array.from(gzipSync(strToU8(CUBE)));
const PLY =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 9 9 9 0\n1,5 0 0 9 9 9 0\n0 1 0 9 9 9 0\n3 0 1 2\n";
const OPACITY = "its opacity is 0 everywhere, which cannot be meant; it is drawn opaque";
const COMMAS = "its numbers have decimal commas, which are read as points";

const TWO_FACES = PLY.replace("face 1", "face 2").replace("1,5", "1").replaceAll("9 9 9 0", "9 9 9 9");
const MISSING = "1 triangle left out, with vertices that do not exist or are not at finite numbers";
const data = Buffer.concat(
    [Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0), Uint8Array.of(0, 1, 2, 0, 1, 9)].map((each) =>
        Buffer.from(each.buffer),
    ),
);
const MISSED = gltf({
    buffers: [{ uri: `data:;base64,${data.toString("base64")}` }],
    bufferViews: [
        { buffer: 0, byteLength: 36 },
        { buffer: 0, byteOffset: 36, byteLength: 6 },
    ],
    accessors: [
        { bufferView: 0, componentType: 5126, type: "VEC3", count: 3 },
        { bufferView: 1, componentType: 5121, type: "SCALAR", count: 6 },
    ],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    nodes: [{ mesh: 0 }],
});

/** What is read in another way than its name or its letter says: its triangles and notes. */
// prettier-ignore
const ODD: [Given[], number, string[]][] = [
    [[text("a.ply", `${TWO_FACES}3 0 1 9\n`)], 1, [`a.ply: ${MISSING}`]],
    [[text("a.ply", `${TWO_FACES}4 0 1 2 9\n`)], 1, [`a.ply: ${MISSING}`]],
    [[text("a.ply", `${TWO_FACES}3 0 1`)], 1, ["a.ply: 1 of its 2 elements face and all behind left out: it ends, or has a word that is no number, in element 1 of the 2 elements face"]],
    [[text("a.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 -1\n")], 1, [`a.off: ${MISSING}`]],
    [[MISSED], 1, [`a.gltf: ${MISSING}`]],
    [[text("model", CUBE)], 12, []],
    [[text("a.vrm", CUBE)], 12, ["a.vrm: it is an OBJ file, and is read as one"]],
    [[text("a.stl", CUBE)], 12, ["a.stl: it is an OBJ file, and is read as one"]],
    [[{ name: "a.obj", bytes: marked(CUBE) }], 12, []],
    [[{ name: "a.obj", bytes: marked(CUBE).map((_, at, all) => all[at ^ 1]!) }], 12, []],
    [[{ name: "a.obj.gz", bytes: gzipped }], 12, []],
    [[{ name: "model", bytes: gzipped }], 12, []],
    [[text("a.obj", `${CUBE}\0\0`)], 12, []],
    [[text("a.obj", CUBE.replaceAll("v 1 ", "v 1,5 "))], 12, [`a.obj: ${COMMAS}`]],
    [[text("a.ply", PLY)], 1, [`a.ply: ${COMMAS}`, `a.ply: ${OPACITY}`]],
    [[text("a.obj", `mtllib m.mtl\nusemtl m\n${CUBE}`), text("m.mtl", "newmtl m\nKd 1 0 0\nTr 1\n")], 12, [`a.obj: ${OPACITY}`]],
    [[text("a.obj", `mtllib m.mtl\nusemtl m\n${CUBE}`), text("m.mtl", "newmtl m\nTr 0,5\n")], 12, [`a.obj: ${COMMAS}`]],
    [[text("a.stl", "solid a facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet endsolid a")], 1, ["a.stl: it is read as z up, and turned upright"]],
];

for (const [at, [given, triangles, wanted]] of ODD.entries()) {
    test(`odd file ${at}: ${given[0]!.name}`, async () => {
        const { document, meshes, notes } = await open(...given);
        assert.deepEqual(notes, wanted);
        assert.equal([...meshes.values()][0]!.triangles, triangles);
        assert.ok(document.objects.every(({ opacity }) => opacity > 0));
    });
}

test("an image is decoded once, whatever it is called, and all images have a bound", async () => {
    let count = 0;
    decodeImagesBy(() => (count++, { width: 8192, height: 8192, pixels: new Uint8Array(4) }));
    const names = [
        "a.png",
        "./a.png",
        "x/../A.PNG",
        "%61.png",
        "C:\\b\\a.png?v=1",
        ...[1, 2, 3, 4, 5].map((at) => `${at}.png`),
    ];
    const mtl = names.map((name, at) => `newmtl m${at}\nmap_Kd ${name}\n`).join("");
    const faces = names.map((_, at) => `usemtl m${at}\nf 1/1 2/1 3/1\n`).join("");
    const images = ["a", 1, 2, 3, 4, 5].map((name, at) => ({ name: `${name}.png`, bytes: Uint8Array.of(at) }));
    const { notes } = await open(text("a.obj", `mtllib m.mtl\n${CUBE}vt 0 0\n${faces}`), text("m.mtl", mtl), ...images);
    assert.equal(count, 5);
    assert.match(
        notes.join("\n"),
        /the texture 5\.png is left out: all textures together may have up to 268,435,456 pixels; reduce them/,
    );
});

test("surfaces are one mesh where their images and the use of these are the same, and an image counts once", () => {
    const pixels = Uint8Array.from({ length: 4 * 256 * 256 }, (_, at) => (97 * at) % 256);
    const [one, other]: Image[] = [pixels, pixels].map((each) => ({ width: 256, height: 256, pixels: each }));
    const picture: Picture = {
        image: one,
        name: "t.png",
        hasAlpha: false,
        filter: "bilinear",
        wraps: ["repeat", "repeat"],
        cutoff: 0,
    };
    const pictures = [
        picture,
        { ...picture },
        { ...picture, hasAlpha: true },
        { ...picture, hasAlpha: true, cutoff: 9 },
        { ...picture, image: other },
        { ...picture },
    ];
    const corner = [0, 0, 0, 1, 0, 0, 0, 1, 0];
    const count = pictures.length;
    const parts = partsOf(
        {
            positions: Float64Array.from(pictures.flatMap((_, at) => corner.map((x) => x + at))),
            faces: Uint32Array.from({ length: 3 * count }, (_, at) => at),
            colors: new Uint8Array(12 * count).fill(255),
            uvs: Float64Array.from(pictures.flatMap(() => [0, 0, 1, 0, 0, 1])),
            surface: pictures.map((_, at) => at),
            surfaces: pictures.map((each) => ({ ...PLAIN, picture: each })),
        },
        { tell: assert.fail } as unknown as Source,
    );
    assert.deepEqual(
        parts.map(({ mesh, texture }) => [mesh.faces.length / 3, texture?.width, texture?.cutoff, !!texture?.alpha]),
        [
            [3, 256, 0, false],
            [1, 256, 0, true],
            [1, 256, 9, true],
            [1, 256, 0, false],
        ],
    );
});
