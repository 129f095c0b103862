import assert from "node:assert/strict";
import { test } from "node:test";
import { encode, type Scene } from "../src/index.js";
import { decodeCall } from "../src/scene/decode.js";
import { processorTime } from "./processor_time.js";
import { TETRAHEDRON } from "./tetrahedron.js";

test("a disc that is not matte is no ground", () => {
    const mesh = { positions: [-1, 0, -1, -1, 0, 1, 1, 0, 1, 1, 0, -1], faces: [0, 1, 2, 0, 2, 3] };
    const call = encode({ camera: { eye: [0, 1, 5] }, objects: [{ mesh, scale: 5, fade: [1, 5] }] });
    assert.deepEqual([decodeCall(call).ground, decodeCall(call).objects.length], [undefined, 1]);
});

test("one mesh of all bytes, for many objects, is refused", () => {
    const objects = Array.from({ length: 40 }, () => ({ mesh: TETRAHEDRON }));
    const many = encode({ objects, camera: { eye: [0, 0, 5] } });
    const view = new DataView(many.buffer);
    const [list, word] = [36 + view.getUint32(36 + 32 * 19 + 28) + 32, 32];
    const first = view.getUint32(list + 28);
    for (let index = 0; index < 40; index++) view.setUint32(list + word * index + 28, first);
    const mesh = list + first + view.getUint32(list + first + 28);
    view.setUint32(mesh + 28, many.length - mesh - word);
    assert.throws(() => decodeCall(many), { name: "InputError", message: /the objects of the call overlap/ });
});

test("the same meshes are encoded in little time, from any side", () => {
    const rows = 60;
    const grid = Array.from({ length: rows * rows }, (_, at) => [at % rows, Math.sin(at), Math.floor(at / rows)]);
    const faces = grid.flatMap((_, at) =>
        at % rows === rows - 1 || at >= rows * (rows - 1)
            ? []
            : [at, at + rows, at + 1, at + 1, at + rows, at + rows + 1],
    );
    const objects = [{ mesh: { positions: grid.flat(), faces }, material: { shading: "smooth" } as const }];
    const from = (angle: number): Scene => ({
        objects,
        camera: { eye: [200 * Math.sin(angle), 90, 200 * Math.cos(angle)], target: [30, 0, 30] },
        ground: { color: "tan" },
    });
    const fresh = (angle: number): Scene => {
        const scene = from(angle);
        return { ...scene, objects: scene.objects.map((each) => ({ ...each, mesh: { ...each.mesh } })) };
    };
    assert.deepEqual(encode(from(1)), encode(fresh(1)));
    const time = (make: (angle: number) => Scene): number => {
        const scenes = Array.from({ length: 50 }, (_, index) => make(index));
        return processorTime(() => scenes.forEach((scene) => void encode(scene)));
    };
    const slow = time(fresh);
    assert.ok(time(from) < slow / 4);
});
