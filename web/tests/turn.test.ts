import assert from "node:assert/strict";
import { test } from "node:test";
import { InputError, describeCall, encode, resizeCall, turnCall, type Scene } from "../src/index.js";
import { readCall } from "../src/call.js";
import { dot, length, subtract, type Vector } from "../src/scene/arithmetic.js";
import { TETRAHEDRON } from "./tetrahedron.js";

const SCENE: Scene = {
    objects: [
        { mesh: TETRAHEDRON, position: [0.5, 0, 0], rotation: [10, 20, 30], material: { shading: "smooth" } },
        { mesh: TETRAHEDRON, position: [-0.5, 1, 0], scale: 0.3, opacity: 0.5 },
    ],
    camera: { eye: [0, 1, 5], target: [0, 0.5, 0] },
    lights: [
        { kind: "directional", direction: [1, 2, 3] },
        { kind: "point", position: [3, 3, 3], color: "tomato" },
        { kind: "spot", position: [-2, 3, 1], direction: [2, -3, -1], color: [9, 8, 7] },
    ],
    width: 64,
    height: 48,
};
const CALL = encode(SCENE);

/** Return how the lights lie for the viewer: their vectors along the axes of the camera. */
function lightsForTheViewer(bytes: Uint8Array): number[] {
    const call = readCall(bytes);
    const forward = subtract(call.target.value, call.eye.value);
    const along = (v: Vector): number[] => [dot(v, forward) / length(forward), dot(v, call.up.value)];
    return [
        length(subtract(call.eye.value, call.middle)),
        ...along(subtract(call.middle, call.eye.value)),
        ...call.lights.flatMap(({ directional, vector }) =>
            along(directional ? vector.value : subtract(vector.value, call.eye.value)),
        ),
        ...call.spots.flatMap(({ value }) => along(value)),
    ];
}

function near(found: number[], expected: number[], most = 1e-5): void {
    assert.equal(found.length, expected.length);
    found.forEach((x, index) =>
        assert.ok(Math.abs(x - (expected[index] as number)) <= most, `${found} is not ${expected}`),
    );
}

test("no turn leaves all bytes as they are", () => {
    const turned = turnCall(CALL, { azimuth: 0, elevation: 0, zoom: 1 });
    assert.deepEqual(turned, CALL);
    assert.notEqual(turned.buffer, CALL.buffer);
    assert.deepEqual(turnCall(CALL, {}), CALL);
});

test("the viewer goes to the right, and up", () => {
    const call = encode({ ...SCENE, objects: [{ mesh: TETRAHEDRON }], camera: { eye: [0, 0, 4], target: [0, 0, 0] } });
    const back = (azimuth: number, elevation: number): number[] => {
        const { eye, middle } = readCall(turnCall(call, { azimuth, elevation }));
        return subtract(eye.value, middle).map((x) => x / length(subtract(eye.value, middle)));
    };
    near(back(90, 0), [1, 0, 0], 1e-9);
    near(back(-90, 0), [-1, 0, 0], 1e-9);
    near(back(0, 30), [0, 0.5, Math.sqrt(0.75)], 1e-9);
    near(back(90, 30), [Math.sqrt(0.75), 0.5, 0], 1e-9);
});

test("the light stays for the viewer", () => {
    const expected = lightsForTheViewer(CALL);
    for (const azimuth of [-170, -33, 0, 5, 90, 720.5]) {
        for (const elevation of [-80, -1, 0, 0.01, 70]) {
            near(lightsForTheViewer(turnCall(CALL, { azimuth, elevation })), expected);
        }
    }
});

test("only numbers of the camera and of lights change", () => {
    const turned = turnCall(CALL, { azimuth: 40, elevation: 20, zoom: 1.5 });
    const { eye, halfHeight, lights, spots } = readCall(CALL);
    const places = [...[0, 1, 2, 3, 4, 5, 6, 7, 8].map((word) => eye.place + 32 * word), halfHeight.place];
    for (const { vector } of lights) places.push(...[0, 1, 2].map((word) => vector.place + 32 * word));
    const spot = spots[0]?.place as number;
    const isAllowed = (at: number): boolean =>
        places.some((place) => at >= place && at < place + 32) || (at >= spot && at < spot + 24);
    const changed = [...turned.keys()].filter((at) => turned[at] !== CALL[at]);
    assert.ok(changed.length > 100);
    assert.deepEqual(
        changed.filter((at) => !isAllowed(at)),
        [],
    );
});

test("the viewer stops right above and right below", () => {
    const [low, high] = describeCall(CALL).elevations;
    near([high - low], [180], 1e-9);
    assert.deepEqual(turnCall(CALL, { elevation: 1000 }), turnCall(CALL, { elevation: high }));
    near(describeCall(turnCall(CALL, { elevation: high })).elevations, [-180, 0]);
    near(describeCall(turnCall(CALL, { azimuth: 50, elevation: low })).elevations, [0, 180]);
    const upsideDown = encode({ ...SCENE, camera: { ...SCENE.camera, up: [0, -1, 0] } });
    const range = describeCall(upsideDown).elevations;
    near(range, [-high, -low]);
    const { eye, target } = readCall(turnCall(upsideDown, { elevation: range[0] }));
    near([eye.value[0] / 4096, eye.value[2] / 4096], [target.value[0] / 4096, target.value[2] / 4096]);
});

test("zoom makes objects larger, within the limits of the contracts", () => {
    const halfHeight = (zoom: number): number => readCall(turnCall(CALL, { zoom })).halfHeight.value;
    near([halfHeight(2), halfHeight(0.5)], [0.5 / 2.145, 2 / 2.145], 1e-9);
    assert.deepEqual([halfHeight(2 ** 20), halfHeight(2 ** -20)], [2 ** -10, 2 ** 10]);
});

test("another size", () => {
    const resized = resizeCall(CALL, 128, 96);
    assert.deepEqual(resized, encode({ ...SCENE, width: 128, height: 96 }));
    assert.deepEqual(describeCall(resized).width, 128);
    const tile = encode(SCENE, "renderTile", { x: 0, y: 0, width: 8, height: 8 });
    assert.throws(() => resizeCall(tile, 128, 96), /a call of renderTile has a size of its own/);
    for (const side of [0, 2049, 1.5, NaN]) {
        assert.throws(() => resizeCall(CALL, side, 96), /width must be a whole number from 1 to 2048/);
    }
});

test("a Buffer of Node is not changed", () => {
    const buffer = Buffer.concat([Buffer.alloc(7), CALL]).subarray(7);
    assert.deepEqual(turnCall(buffer, { azimuth: 9 }), turnCall(CALL, { azimuth: 9 }));
    assert.deepEqual(new Uint8Array(buffer), CALL);
});

test("facts of a call", () => {
    const { width, height, triangles } = describeCall(CALL);
    assert.deepEqual([width, height, triangles], [64, 48, 8]);
});

test("wrong turns are refused", () => {
    assert.throws(() => turnCall(CALL, { azimuth: NaN }), /azimuth must be a finite number, not NaN/);
    assert.throws(() => turnCall(CALL, { zoom: 0 }), /zoom must be a finite number from .* not 0/);
});

test("wrong bytes are refused, with the place", () => {
    const wrong = (change: (bytes: Uint8Array) => void): Uint8Array => {
        const bytes = new Uint8Array(CALL);
        change(bytes);
        return bytes;
    };
    const cases: [Uint8Array, RegExp][] = [
        [new Uint8Array(), /must begin with the selector of render/],
        [CALL.slice(0, 100), /the offset at byte 4 of the call leads beyond its end: 672 bytes must follow/],
        [CALL.slice(0, -64), /at byte \d+ of the call leads beyond its end/],
        [
            wrong((bytes) => bytes.fill(255, 36, 68)),
            /the width of the canvas at byte 36 of the call must be from 0 to 2048/,
        ],
        [
            wrong((bytes) => bytes.fill(0, 36, 68)),
            /the width of the canvas, at byte 36 of the call, must be from 1 to 2048/,
        ],
        [wrong((bytes) => bytes.fill(1, 36 + 32 * 2, 36 + 32 * 3)), /the camera's eye at byte 100 of the call/],
        [wrong((bytes) => bytes.fill(0, 36 + 32 * 2, 36 + 32 * 8)), /the camera of the call has no direction/],
        [wrong((bytes) => bytes.fill(9, 36 + 32 * 11, 36 + 32 * 12)), /the projection at byte 388 of the call/],
    ];
    for (const [bytes, message] of cases) {
        assert.throws(() => turnCall(bytes, { azimuth: 1 }), { name: "InputError", message });
    }
});

test("bytes from anybody are refused or turned", () => {
    let state = 1;
    const random = (below: number): number => {
        state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
        return Math.floor((state / 2 ** 32) * below);
    };
    let refused = 0;
    for (let round = 0; round < 3000; round++) {
        let bytes = new Uint8Array(CALL);
        for (let change = random(3); change >= 0; change--) {
            const word = 4 + 32 * random(Math.floor(bytes.length / 32));
            const kind = random(4);
            if (kind === 0) bytes.fill(random(2) * 255, word, word + 32);
            else if (kind === 1) bytes[word + 31] = random(256);
            else if (kind === 2) bytes[word + random(32)] = random(256);
            else bytes = bytes.slice(0, random(bytes.length));
        }
        try {
            assert.equal(turnCall(bytes, { azimuth: 10, elevation: 5, zoom: 2 }).length, bytes.length);
        } catch (error) {
            assert.ok(error instanceof InputError, String((error as Error).stack));
            refused++;
        }
    }
    assert.ok(refused > 1000);
});

test("meshes that overlap are refused before much is read", () => {
    const call = encode({
        ...SCENE,
        objects: Array.from({ length: 40 }, () => SCENE.objects[0] as Scene["objects"][0]),
    });
    // each length of a mesh is that of all bytes after it
    const { name } = readCall(call);
    assert.equal(name, "render");
    const bytes = new Uint8Array(call.length * 400);
    bytes.set(call);
    const view = new DataView(bytes.buffer);
    const scene = 36;
    const objects = scene + view.getUint32(scene + 19 * 32 + 28);
    for (let index = 0; index < 40; index++) {
        const object = objects + 32 + view.getUint32(objects + 32 + 32 * index + 28);
        const mesh = object + view.getUint32(object + 28);
        view.setUint32(mesh + 28, 5 + 13 * 60_000);
        view.setUint16(mesh + 32 + 1, 60_000);
        view.setUint16(mesh + 32 + 3, 0);
    }
    assert.throws(() => describeCall(bytes), /the meshes of the call overlap/);
});
