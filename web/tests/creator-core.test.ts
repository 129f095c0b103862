// Documents of the Creator, and what changes them.

import { createHash } from "node:crypto";
import assert from "node:assert/strict";
import { test } from "node:test";
import { InputError } from "../src/errors.js";
import { axesOf, fitted, orbitOf, panned, turned, viewOf, withCamera, zoomed } from "../src/document/camera.js";
import {
    CONTROLS,
    MIXED,
    controlOf,
    lightControls,
    resetGroup,
    type Control,
    type Value,
} from "../src/creator/controls.js";
import { prepare, sceneOf, type Document } from "../src/document/document.js";
import { History } from "../src/document/history.js";
import {
    addLight,
    fromDisc,
    lampOf,
    lightOf,
    onDisc,
    removeLight,
    setShadow,
    withLamp,
} from "../src/document/lamps.js";
import { MeshStore } from "../src/creator/mesh_store.js";
import { documentOfLink, linkOf } from "../src/document/link.js";
import { LOOKS, applyLook, lookOf, surprise } from "../src/document/looks.js";
import { boundsOfPoints, chosen, pointsOf, sphereOfAll, tidy } from "../src/document/measure.js";
import { duplicated, removed, renamed, reordered, withPiece } from "../src/document/objects.js";
import { MissingFiles, documentOfScene, openSceneFile, sceneFile } from "../src/document/save.js";
import { SETTINGS } from "../src/document/settings.js";
import { encode } from "../src/scene/encode.js";
import { parseScene } from "../src/scene/file.js";
import type { Scene } from "../src/scene/types.js";
import { TETRAHEDRON } from "./tetrahedron.js";

const ALL: ReadonlySet<string> = new Set();
const CUBE = {
    positions: [0, 1, 2, 3, 4, 5, 6, 7].map((n) => [n & 1, (n >> 1) & 1, n >> 2]),
    faces: [
        ...[
            [0, 2, 3],
            [0, 3, 1],
            [4, 5, 7],
            [4, 7, 6],
            [0, 1, 5],
            [0, 5, 4],
        ],
        ...[
            [2, 6, 7],
            [2, 7, 3],
            [0, 4, 6],
            [0, 6, 2],
            [1, 3, 7],
            [1, 7, 5],
        ],
    ],
};
const PLACE = { position: [1, 2, 3], scale: 2 };
const PIECES: Record<string, Record<string, unknown>> = {
    tetrahedron: { size: 128, objects: [{ mesh: TETRAHEDRON, ...PLACE }] },
    cubes: {
        size: [200, 100],
        ground: { color: "#808080" },
        lights: [
            { kind: "directional", direction: [1, 2, 3], shadow: true },
            { kind: "spot", position: [3, 4, 5], direction: [-3, -4, -5], outer_angle: 30 },
        ],
        objects: [
            { mesh: CUBE, color: "#102030" },
            { mesh: CUBE, position: [2, 0, 0], rotation: [0, 30, 0], scale: 0.5, material: { shading: "unlit" } },
        ],
    },
};

function makeStore(): MeshStore {
    const about = { dataset: "common", licence: "MIT", notice: "", commercial: true, triangles: 4, objects: 1, gas: 0 };
    const entries = Object.keys(PIECES).map((name) => ({ ...about, name, title: name }));
    return new MeshStore({
        pieces: async () => entries,
        piece: async (name) => PIECES[name] as Record<string, unknown>,
    });
}

const store = makeStore();
const tetrahedron = await store.piece("tetrahedron");
const cubes = await store.piece("cubes");

function near(found: ArrayLike<number>, wanted: ArrayLike<number>, error = 1e-5): void {
    const close = Array.from(wanted).every(
        (x, at) => Math.abs(x - (found[at] as number)) <= error * Math.max(1, Math.abs(x)),
    );
    assert.ok(
        close && found.length === wanted.length,
        `${Array.from(found).join()} is not ${Array.from(wanted).join()}`,
    );
}

function hashOf(scene: Scene): string {
    return createHash("sha256").update(encode(scene)).digest("hex");
}

function bytes(doc: Document, meshes = store): string {
    return hashOf(sceneOf(doc, meshes));
}

test("the document of a piece is its scene, with its meshes by reference", async () => {
    assert.deepEqual(
        cubes.objects.map(({ mesh }) => mesh),
        [
            { piece: "cubes", object: 0 },
            { piece: "cubes", object: 1 },
        ],
    );
    assert.equal(cubes.title, "cubes");
    assert.equal(bytes(cubes), hashOf(parseScene(PIECES["cubes"] as object)));
    const [one, two] = [sceneOf(cubes, store), sceneOf(cubes, store)];
    assert.equal(one.objects[0]?.mesh, two.objects[0]?.mesh);
    assert.equal(sceneOf(cubes, store, { width: 10, height: 20, antialias: true }).height, 20);
    await assert.rejects(store.piece("cow"), InputError);
    assert.throws(() => store.get({ file: "none" }), /open it again/);
});

test("a scene file is the document again, also where meshes are inside", async () => {
    const own: Scene = { ...parseScene(PIECES["cubes"] as object), fog: { color: "#445566", near: 1, far: 9 } };
    const { document, meshes } = documentOfScene(own, { title: "mine", licence: "CC0" });
    store.put(meshes);
    assert.equal(meshes.size, 2);
    const changed = {
        ...document,
        lightsFollow: true,
        objects: document.objects.map((item) => ({ ...item, crease: 20 })),
    };
    for (const doc of [document, changed, cubes, applyLook(cubes, "clay")]) {
        const json = sceneFile(doc, store);
        const made = await openSceneFile(json, store, { title: "?" });
        store.put(made.meshes);
        assert.equal(bytes(made.document), bytes(doc));
        assert.deepEqual(made.document, doc);
        if (made.meshes.size) assert.equal(hashOf(parseScene(json)), bytes(doc));
    }
    await assert.rejects(
        openSceneFile({ objects: [{ mesh: "a.obj" }] }, store, { title: "" }),
        /give all files together/,
    );
});

test("an object that is a ground becomes the ground", () => {
    const scene = parseScene(PIECES["cubes"] as object);
    const flat = {
        positions: [
            [-1, 0, -1],
            [-1, 0, 1],
            [1, 0, 1],
            [1, 0, -1],
        ],
        faces: [
            [0, 1, 2],
            [0, 2, 3],
        ],
        colors: "#808080",
    };
    const material = { ambient: 0.4, diffuse: 0.7, specular: 0 };
    const object = { mesh: flat, position: [1, -0.5, 2], scale: 6, fade: [2, 6], material } as const;
    const own = { ...scene, ground: undefined, objects: [...scene.objects, object] };
    const { document } = documentOfScene(own, { title: "" });
    assert.equal(document.objects.length, 2);
    assert.deepEqual(document.ground, { color: "#808080", height: -0.5, radius: 6, center: [1, 2], inner: 2 });
    // another one stays an object, which looks do not paint
    const shiny = { ...object, material: { ...material, specular: 1 } };
    const other = documentOfScene({ ...own, objects: [shiny, ...scene.objects] }, { title: "" });
    store.put(other.meshes);
    assert.equal(bytes(other.document), hashOf({ ...own, objects: [shiny, ...scene.objects] }));
    assert.equal(applyLook(other.document, "gold").objects[0]?.color, null);
    near(other.document.frame.middle, cubes.frame.middle);
});

test("a document with fewer triangles is simplified, and comes back", async () => {
    const doc = { ...cubes, objects: cubes.objects.map((item) => ({ ...item, maxTriangles: 8 })) };
    await prepare(doc, store);
    assert.ok(sceneOf(doc, store).objects.every(({ mesh }) => mesh.faces.length <= 24));
    const { document } = await openSceneFile(sceneFile(doc, store), store, { title: "" });
    assert.deepEqual(document, doc);
});

test("a link is the document again; larger files stay out of it", async () => {
    for (const doc of [tetrahedron, cubes, surprise(cubes, store, () => 0.3)]) {
        const { text, missing } = await linkOf(doc, store);
        assert.match(text, /^#1[\w-]+$/);
        assert.deepEqual(missing, []);
        assert.deepEqual(await documentOfLink(text, store), doc);
    }
    const size = 120;
    const positions = Array.from({ length: 3 * size * size }, (_, at) => Math.sin(at * at));
    const faces = Array.from({ length: size * size - 2 }, (_, at) => [at, at + 1, at + 2]);
    const { document, meshes } = documentOfScene({ objects: [{ mesh: { positions, faces } }] }, { title: "scan" });
    store.put(meshes);
    const { text, missing } = await linkOf(document, store);
    assert.deepEqual(missing, ["scan"]);
    assert.ok(text.length < 2000);
    assert.deepEqual(await documentOfLink(text, store), document);
    // another browser does not have it, until it is opened there
    const there = makeStore();
    const missed = await documentOfLink(text, there).catch((error: unknown) => error);
    assert.ok(missed instanceof MissingFiles && missed.names[0] === "scan");
    there.put(meshes);
    assert.equal(bytes(missed.document, there), bytes(document));
    for (const bad of ["", "#1", "#2abc", "#1abc", "#1%%", text.slice(0, -9)]) {
        await assert.rejects(documentOfLink(bad, makeStore()), InputError, bad);
    }
});

test("undo takes back a drag as one step", () => {
    const history = new History(cubes);
    const documents = [1, 2, 3, 4].map((width) => ({ ...cubes, width }));
    history.push(documents[0] as Document, "Width", "width", 0);
    history.push(documents[1] as Document, "Width", "width", 900);
    history.push({ ...(documents[1] as Document) }, "nothing", undefined, 1000);
    history.push(documents[2] as Document, "Width", "width", 5000);
    assert.equal(history.undo()?.width, 2);
    assert.equal(history.undo(), cubes);
    assert.equal(history.undo(), null);
    assert.equal(history.redo()?.width, 2);
    history.push(documents[3] as Document, "Width");
    assert.ok(history.canUndo && !history.canRedo && history.label === "Width");
});

/** Return a value of a control that is not the present one. */
function other({ kind, slider, whole, choices }: Control, now: Value): Value {
    if (kind === "switch") return !now;
    if (kind === "color") return "#123456";
    if (kind === "choice") return choices.find(([value]) => value !== now)?.[0] ?? null;
    const values = [0.05, 0.06, 0.1].map((part) => tidy(slider[0] + part * (slider[1] - slider[0])));
    return (whole ? values.map(Math.round) : values).find((x) => x !== now) ?? null;
}

test("every control changes its value, and resets it", () => {
    const lit = ["directional", "point", "spot"].map((kind) => withLamp(cubes, 1, { kind: kind as "spot" }));
    const smooth = applyLook(cubes, "studio");
    for (const row of [...CONTROLS, ...lightControls(1)]) {
        const own = [...lit, smooth].find((doc) => row.shown(doc, ALL)) ?? cubes;
        // details of effects are there once these are on
        const owner = row.path.split(".")[0] as string;
        const doc = row.shown(own, ALL) ? own : (controlOf(`${owner}.on`) as Control).write(own, ALL, true, store);
        assert.ok(row.shown(doc, ALL), row.path);
        assert.ok(row.label && row.group && row.slider[0] < row.slider[1], row.path);
        const before = row.read(doc, ALL, store);
        const value = other(row, before);
        const next = row.write(doc, ALL, value, store);
        assert.deepEqual(row.read(next, ALL, store), value, row.path);
        assert.ok(row.changed(next, ALL, own, store), row.path);
        assert.doesNotThrow(() => encode(sceneOf(next, store)), row.path);
        const back = row.reset(next, ALL, own, store);
        assert.ok(!row.changed(back, ALL, own, store), row.path);
        if (doc === own) assert.deepEqual(back, own, row.path);
        assert.deepEqual(row.read(back, new Set(["1"]), store), row.read(doc, new Set(["1"]), store), row.path);
        if (row.none) assert.equal(row.read(row.write(next, ALL, null, store), ALL, store), null, row.path);
    }
});

test("each setting of a number, switch, colour or choice has a control, with its range", () => {
    for (const { name, part, kind, low, high } of SETTINGS) {
        if (!part || !["object", "material", "tone", "scene"].includes(part)) continue;
        if (!["number", "whole", "flag", "color", "choice"].includes(kind)) continue;
        const row = controlOf(`${part}.${name}`);
        assert.ok(row, name);
        if (low !== null) assert.deepEqual([row.low, row.high], [low, high]);
    }
    const exposure = controlOf("tone.exposure") as Control;
    assert.deepEqual([exposure.slider, exposure.high], [[0, 4], 64]);
    assert.equal(exposure.write(cubes, ALL, 1e9, store).tone?.exposure, 64);
    assert.equal(exposure.write(exposure.write(cubes, ALL, 2, store), ALL, 1, store).tone, null);
});

test("controls of objects are those of the selection, and say where it differs", () => {
    const [shading, size] = [controlOf("material.shading"), controlOf("pose.size")] as [Control, Control];
    assert.equal(shading.read(cubes, ALL, store), MIXED);
    assert.equal(shading.read(cubes, new Set(["2"]), store), "unlit");
    const made = shading.write(cubes, new Set(["1"]), "unlit", store);
    assert.equal(shading.read(made, ALL, store), "unlit");
    assert.equal(shading.read(shading.reset(made, ALL, cubes, store), ALL, store), MIXED);
    const grown = size.write(cubes, ALL, 2 * (size.read(cubes, ALL, store) as number), store);
    near(
        grown.objects.map(({ scale }) => scale),
        [2, 1],
    );
    near(sphereOfAll(grown.objects, store).middle, sphereOfAll(cubes.objects, store).middle);
    const turn = controlOf("pose.rotation.x") as Control;
    const tilted = turn.write(cubes, new Set(["2"]), 90, store);
    assert.deepEqual(tilted.objects[1]?.rotation, [90, 30, 0]);
    const [before, after] = [cubes, tilted].map((doc) => sphereOfAll(chosen(doc, new Set(["2"])), store).middle);
    near(after ?? [], before ?? []);
    assert.equal(turn.write(cubes, ALL, 190, store).objects[0]?.rotation[0], -170);
    assert.deepEqual(resetGroup(grown, "object", ALL, cubes, store), cubes);
    // what is turned alike turns about its middle, and back
    const alike = { ...cubes, objects: cubes.objects.map((item) => ({ ...item, rotation: [0, 20, 0] as const })) };
    const around = turn.write(alike, ALL, 70, store);
    assert.notDeepEqual(around.objects[1]?.position, alike.objects[1]?.position);
    assert.deepEqual(turn.reset(around, ALL, alike, store), alike);
    // and a spot light that became another one is itself again
    const kind = controlOf("lights.1.kind") as Control;
    for (const value of ["point", "directional"]) {
        assert.deepEqual(kind.reset(kind.write(cubes, ALL, value, store), ALL, cubes, store), cubes);
    }
});

test("cameras are orbits, and follow the pointer", () => {
    const orbit = {
        azimuth: 30,
        elevation: 20,
        roll: 10,
        distance: 3,
        target: [0.1, 0.2, 0.3] as [number, number, number],
        projection: "perspective" as const,
        fov: 40,
    };
    for (const change of [
        {},
        { projection: "orthographic" as const },
        { elevation: 90, roll: 0 },
        { elevation: -90, roll: 0, azimuth: -100 },
    ]) {
        assert.deepEqual(orbitOf(viewOf({ ...orbit, ...change }, cubes.frame, null), cubes.frame), {
            ...orbit,
            ...change,
        });
    }
    const doc = withCamera(cubes, orbit);
    assert.equal(orbitOf(turned(withCamera(doc, { roll: 0 }), 0.1, 0.9).camera, doc.frame).azimuth, 12);
    assert.equal(orbitOf(turned(doc, 0, 0.9).camera, doc.frame).elevation, 90);
    near([orbitOf(zoomed(doc, 2).camera, doc.frame).distance], [1.5]);
    // what was in the middle is where the pointer is
    const moved = panned(doc, 0.25, 0);
    const { right } = axesOf(doc.camera);
    const by = right.reduce(
        (sum, x, axis) => sum + x * ((moved.camera.eye[axis] as number) - (doc.camera.eye[axis] as number)),
        0,
    );
    near([by], [-0.25 * 2 * 3 * Math.tan((20 * Math.PI) / 180) * doc.frame.radius]);
    const { middle } = boundsOfPoints(pointsOf(cubes.objects, store));
    near(fitted(moved, store).camera.target, middle);
    // a target that is only a direction
    const far = { ...cubes.camera, eye: [0, 0, 100] as const, target: [0, 0, 99] as const };
    near([orbitOf(far, { middle: [0, 0, 0], radius: 2 }).distance], [50]);
});

test("lights follow the camera, and move on a disc, also behind the object", () => {
    const follow = { ...cubes, lightsFollow: true };
    const disc = (doc: Document): number[] =>
        doc.lights.flatMap((light) => [onDisc(doc, light).x, onDisc(doc, light).y]);
    near(disc(withCamera(follow, { azimuth: 100, elevation: -30, roll: 5 })), disc(follow));
    assert.deepEqual(withCamera(cubes, { azimuth: 100 }).lights, cubes.lights);
    const behind = fromDisc(cubes, 0, 1.5, 0);
    const place = onDisc(behind, behind.lights[0] as Document["lights"][number]);
    near([place.x, place.y], [0.5, 0]);
    assert.ok(!place.near);
    const spot = {
        ...lampOf(cubes.lights[1] as Document["lights"][number], cubes.frame),
        target: [0.5, 0.25, 1] as [number, number, number],
    };
    near(lampOf(lightOf(spot, cubes.frame), cubes.frame).target, spot.target);
});

test("one light has the shadow, which looks and angles keep", () => {
    const shadows = (doc: Document): unknown[] => doc.lights.map(({ shadow }) => shadow);
    assert.deepEqual(shadows(withLamp(cubes, 0, { azimuth: -39 })), [true, false]);
    assert.deepEqual(shadows(withLamp(cubes, 1, { shadow: true })), [false, true]);
    assert.deepEqual(shadows(setShadow(cubes, null)), [false, false]);
    assert.deepEqual(shadows(applyLook(cubes, "gold")), [true, false]);
    assert.deepEqual(shadows(applyLook(setShadow(cubes, null), "gold")), [false, false]);
    const four = addLight(addLight(addLight(cubes)));
    assert.equal(four.lights.length, 4);
    assert.equal(removeLight(four, 0).lights.length, 3);
});

test("looks keep edges, grounds and culling", () => {
    for (const { name, color } of LOOKS) {
        const doc = applyLook(cubes, name);
        assert.deepEqual(doc.ground, cubes.ground);
        assert.deepEqual(
            doc.objects.map(({ cull, color }) => [cull, color]),
            cubes.objects.map(({ cull }) => [cull, color]),
        );
        assert.equal(lookOf(doc), name);
        // a cube has no curves
        assert.ok(sceneOf(doc, store).objects.every(({ material }) => material?.shading !== "smooth"));
        assert.doesNotThrow(() => encode(sceneOf(doc, store)));
    }
    assert.equal(lookOf(cubes), null);
    const one = applyLook(cubes, "gold", new Set(["2"]));
    assert.deepEqual(
        one.objects.map(({ color }) => color),
        [cubes.objects[0]?.color, "#e0a52e"],
    );
    let state = 1;
    const random = (): number => (state = (state * 48271) % 2147483647) / 2147483647;
    for (let turn = 0; turn < 20; turn++)
        assert.doesNotThrow(() => encode(sceneOf(surprise(cubes, store, random), store)));
});

test("objects are added, copied, renamed, moved in their order, and removed", () => {
    const doc = withPiece(cubes, tetrahedron, store);
    assert.deepEqual(
        doc.objects.map(({ id }) => id),
        ["1", "2", "3"],
    );
    assert.equal(doc.title, "cubes, tetrahedron");
    const [left, right] = [cubes.objects, doc.objects.slice(2)].map((items) => pointsOf(items, store));
    const axis = (points: Float64Array | undefined, at: number): number[] =>
        [...(points ?? [])].filter((_, index) => index % 3 === at);
    assert.ok(Math.min(...axis(right, 0)) > Math.max(...axis(left, 0)), "beside");
    near([Math.min(...axis(right, 1))], [Math.min(...axis(left, 1))]);
    const copied = duplicated(doc, new Set(["3"]), store);
    assert.deepEqual([copied.objects.length, copied.objects[3]?.id], [4, "4"]);
    assert.deepEqual(
        reordered(doc, "3", -2).objects.map(({ id }) => id),
        ["3", "1", "2"],
    );
    assert.deepEqual(
        removed(renamed(doc, "2", "box"), new Set(["1"])).objects.map(({ name }) => name),
        ["box", "tetrahedron"],
    );
});
