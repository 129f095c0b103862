import assert from "node:assert/strict";
import { test } from "node:test";
import { encode, halfHeightOf, parseScene, type Scene } from "../src/index.js";
import { processorTime } from "./processor_time.js";

const MESH = {
    positions: [
        [0, 0, 0],
        [1, 0, 0],
        [0, 1, 0],
    ],
    faces: [[0, 1, 2]],
};
const SCENE: Scene = { objects: [{ mesh: MESH }], camera: { eye: [0, 0, 3] } };

test("rows may be flat, or typed arrays", () => {
    const expected = encode(SCENE);
    const flat = { positions: MESH.positions.flat(), faces: MESH.faces.flat() };
    assert.deepEqual(encode({ ...SCENE, objects: [{ mesh: flat }] }), expected);
    const typed = { positions: Float32Array.from(flat.positions), faces: Uint16Array.from(flat.faces) };
    assert.deepEqual(encode({ ...SCENE, objects: [{ mesh: typed }] }), expected);
});

test("colours of every kind", () => {
    const of = (ambientLight: NonNullable<Scene["ambientLight"]>): Uint8Array => encode({ ...SCENE, ambientLight });
    const expected = of([255, 128, 0]);
    assert.deepEqual(of("#ff8000"), expected);
    assert.deepEqual(of("FF8000"), expected);
    assert.deepEqual(of([1, 0.5, 0]), expected);
    assert.deepEqual(of("tomato"), of([255, 99, 71]));
    // whole numbers are not fractions
    assert.notDeepEqual(of([1, 1, 1]), of("white"));
    const mesh = { ...MESH, colors: "tomato" };
    const rows = { ...MESH, colors: [255, 99, 71, 255, 99, 71, 255, 99, 71] };
    assert.deepEqual(encode({ ...SCENE, objects: [{ mesh }] }), encode({ ...SCENE, objects: [{ mesh: rows }] }));
});

test("opacities, and colours with an alpha", () => {
    const of = (mesh: object): Uint8Array => encode({ ...SCENE, objects: [{ mesh: { ...MESH, ...mesh } }] });
    const colors = [
        [1, 2, 3, 255],
        [4, 5, 6, 51],
        [7, 8, 9, 0],
    ];
    const opaque = colors.map((row) => row.slice(0, 3));
    const seen = of({ colors });
    assert.deepEqual(of({ colors: opaque, opacities: [1, 0.2, 0] }), seen);
    assert.ok(seen.length > of({ colors: opaque }).length);
    assert.deepEqual(of({ colors: opaque, opacities: [1, 1, 0.999] }), of({ colors: opaque }));
    assert.deepEqual(of({ colors: opaque.map((row) => [...row, 255]) }), of({ colors: opaque }));
});

test("a scene file as text tells fractions from whole numbers", () => {
    const text = (color: string): string =>
        `{"objects": [], "ambient_light": ${color}, "background": {"top": [0, 0, 1]}}`;
    assert.deepEqual(parseScene(text("[1.0, 0.0, 1.0]")).ambientLight, [255, 0, 255]);
    assert.deepEqual(parseScene(text("[1, 0, 1]")).ambientLight, [1, 0, 1]);
    assert.deepEqual(parseScene(text('"\\u0074omato"')).ambientLight, [255, 99, 71]);
    assert.deepEqual(parseScene(JSON.parse(text("[1.0, 0.0, 1.0]")) as object).ambientLight, [1, 0, 1]);
});

test("the field of view is a tangent", () => {
    assert.ok(Math.abs(halfHeightOf(90) - 1) < 1e-15);
    assert.throws(() => halfHeightOf(180), /the field of view in degrees must be a finite number from 0.2 to 179.8/);
});

test("wrong scenes are refused, with the place", () => {
    const cases: [unknown, RegExp][] = [
        [undefined, /the scene must be an object with objects, camera/],
        [{}, /objects must be a list, not undefined/],
        [{ ...SCENE, ambient_light: 1 }, /the scene has the unknown key "ambient_light"; known are .*ambientLight/],
        [{ ...SCENE, antialias: 1 }, /antialias must be true or false, not 1/],
        [{ ...SCENE, hemisphere: "white" }, /hemisphere must be an object with sky, ground, not "white"/],
        [{ ...SCENE, hemisphere: {} }, /hemisphere\.sky must be red, green and blue from 0 to 255, not undefined/],
        [{ ...SCENE, rim: { color: "red", power: 17 } }, /rim\.power must be a whole number from 1 to 16, not 17/],
        [
            { ...SCENE, fog: { color: "red", near: -1, far: 2 } },
            /fog\.near must be a finite number, at least 0, not -1/,
        ],
        [{ ...SCENE, fog: { color: "red", near: 2, far: 2 } }, /fog\.near, 2, must be below fog\.far, 2/],
        [{ ...SCENE, tone: { exposure: 65 } }, /tone\.exposure must be a finite number from 0 to 64, not 65/],
        [{ ...SCENE, tone: { film: true } }, /tone has the unknown key "film"; known are exposure, filmic, gamma/],
        [{ ...SCENE, width: 0 }, /width must be a whole number from 1 to 2048, not 0/],
        [{ ...SCENE, objects: [{}] }, /objects\[0\]\.mesh must be an object with positions, .* not undefined/],
        [
            { ...SCENE, objects: [{ mesh: { ...MESH, faces: [[0, 1, 3]] } }] },
            /faces\[0\] names the vertex 3, .* 0 to 2/,
        ],
        [{ ...SCENE, objects: [{ mesh: { ...MESH, positions: [1, 2] } }] }, /positions must be rows of three numbers/],
        [{ ...SCENE, objects: [{ mesh: { ...MESH, positions: [[0, 0, NaN]] } }] }, /positions\[0\] must be 3 finite/],
        [{ ...SCENE, objects: [{ mesh: { ...MESH, opacities: [0, 1] } }] }, /opacities must be one for each of 3 .* 2/],
        [
            { ...SCENE, objects: [{ mesh: { ...MESH, opacities: [0, 1, 2] } }] },
            /opacities\[2\] must be .* 0 to 1, not 2/,
        ],
        [
            { ...SCENE, objects: [{ mesh: { ...MESH, opacities: [0, 0, 0], colors: Array(3).fill([1, 2, 3, 4]) } }] },
            /mesh must have opacities, or colors with an alpha below 255, not both/,
        ],
        [{ ...SCENE, objects: [{ mesh: MESH, scale: -1 }] }, /objects\[0\]\.scale must be .* at least 0, not -1/],
        [{ ...SCENE, objects: [{ mesh: MESH, rotation: [0, 0, 0, 0] }] }, /rotation must not be the zero quaternion/],
        [{ ...SCENE, objects: [{ mesh: MESH, material: { shading: "shiny" } }] }, /shading must be one of unlit, flat/],
        [{ ...SCENE, camera: { eye: [0, 0, -1] } }, /eye and target are the same point/],
        [{ ...SCENE, camera: { up: [0, 0, 2] } }, /the camera looks along its up direction, \(0, 0, 2\)/],
        [{ ...SCENE, lights: [null] }, /lights\[0\]\.kind must be one of directional, point, spot, not undefined/],
        [
            { ...SCENE, lights: [{ kind: "point", direction: [0, 1, 0] }] },
            /lights\[0\] has the unknown key "direction"/,
        ],
        [{ ...SCENE, lights: [{ kind: "directional", direction: [0, 0, 0] }] }, /direction must not be zero/],
        [{ ...SCENE, background: "#12345" }, /background\.top must be red, .* name of a colour, not "#12345"/],
        [{ ...SCENE, background: "#f008" }, /background\.top must be opaque, not "#f008"; an object has an opacity/],
        [
            { ...SCENE, objects: [{ mesh: MESH, material: { shininess: 12.5 } }] },
            /material\.shininess must be a whole number from 1 to 128, not 12.5/,
        ],
        [{ ...SCENE, background: "no colour" }, /background\.top must be red, .* name of a colour, not "no colour"/],
    ];
    for (const [scene, message] of cases) assert.throws(() => encode(scene as Scene), { name: "InputError", message });
});

test("colours are those of CSS", () => {
    const encoded = (background: string, colors: unknown) =>
        encode({ ...SCENE, background, objects: [{ mesh: { ...MESH, colors } }] } as Scene);
    for (const [short, long] of [
        ["#f0a", [255, 0, 170]],
        ["#F0AF", [255, 0, 170]],
        ["#ff00aaff", [255, 0, 170]],
        [" #123", [17, 34, 51]],
    ] as const) {
        assert.deepEqual(
            encoded(short, short),
            encode({ ...SCENE, background: long, objects: [{ mesh: { ...MESH, colors: Array(3).fill(long) } }] }),
        );
    }
    const rows = Array(3).fill([255, 0, 170, 136]);
    for (const clear of ["#f0a8", "#ff00aa88"]) assert.deepEqual(encoded("red", clear), encoded("red", rows));
});

test("tiles lie on the canvas, and belong to functions of tiles", () => {
    assert.throws(() => encode(SCENE, "draw" as "render"), /the function must be one of render, .* not "draw"/);
    assert.throws(() => encode(SCENE, "renderTile"), /renderTile needs a tile/);
    assert.throws(() => encode(SCENE, "render", { x: 0, y: 0, width: 1, height: 1 }), /render takes no tile/);
    for (const tile of [{ x: -1 }, { width: 0 }, { x: 120, width: 9 }, { y: 0.5 }]) {
        const whole = { x: 0, y: 0, width: 1, height: 1, ...tile };
        assert.throws(() => encode(SCENE, "renderTile", whole), /does not lie on the canvas of 128 x 128 pixels/);
    }
});

test("wrong scene files are refused, with the place", () => {
    const cases: [string, RegExp][] = [
        ["{", /the scene is not valid JSON: /],
        ["[]", /a scene must be a table with keys of size, objects/],
        ['{"size": [1, 2, 3]}', /size must be a number of pixels, or width and height/],
        ['{"antialias": "yes"}', /antialias must be true or false, not "yes"/],
        ['{"fog": {"color": "red", "near": 1}}', /fog\.far must be a finite number, at least 0, not undefined/],
        ['{"rim": "red"}', /rim must be a table with keys of color, power/],
        ['{"tone": {"gamma": 1}}', /tone\.gamma must be true or false, not 1/],
        ['{"objects": [{"mesh": "teapot.obj"}]}', /objects\[0\]\.mesh must be a table .* no files are read/],
        ['{"camera": {"fov": 40, "half_height": 1}}', /camera\.fov and camera\.half_height exclude each other/],
        ['{"camera": {"eye": [0, 0, 1]}}', /camera must have an eye and a target, or neither/],
        ['{"camera": {"fov": 40, "projection": "orthographic"}}', /camera\.fov is for the perspective projection/],
        ['{"lights": [{"kind": "spot", "position": [0, 0, 1]}]}', /lights\[0\] must have a direction, as its kind/],
        ['{"lights": [{"kind": "point", "position": [0, 0, 1], "inner_angle": 1}]}', /must have no inner_angle/],
        ['{"canvasDim": 64, "verts": []}', /faces is missing/],
    ];
    for (const [text, message] of cases) assert.throws(() => parseScene(text), { name: "InputError", message });
});

test("the time of an encoding is in proportion to the number of objects", () => {
    const of = (count: number): Scene => ({
        objects: Array.from({ length: count }, (_, index) => ({
            mesh: { positions: MESH.positions.map((row) => row.map((x) => x * (1 + index / 7))), faces: MESH.faces },
            position: [Math.sin(index), Math.cos(index), index % 7],
            opacity: index % 2 ? 1 : 0.5,
        })),
        ground: { color: "tomato" },
        lights: [{ kind: "point", position: [9, 9, 9], shadow: true }],
    });
    const time = (scene: Scene): number =>
        Math.min(...Array.from({ length: 12 }, () => processorTime(() => void encode(scene))));
    const [few, many] = [of(200), of(1600)];
    time(few);
    // 64 times as long where each object looks at all others
    assert.ok(time(many) < 40 * time(few));
});
