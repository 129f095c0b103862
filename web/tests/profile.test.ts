import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

import { CallError, encode, profile, render, type Scene } from "../src/index.js";
import type { Stages } from "../src/evm/stages.js";
import { TETRAHEDRON } from "./tetrahedron.js";

const json = (name: string): Uint8Array<ArrayBuffer> => readFileSync(`../src/shackled/web/${name}.json`);
const assets = {
    evm: readFileSync("../src/shackled/evm/evm.wasm"),
    contracts: json("contracts"),
    stages: json("stages"),
};
const { stages: STAGES, contracts: MAPS } = JSON.parse(assets.stages.toString()) as Stages;
const scene = (shading: "unlit" | "flat" | "smooth", more: Partial<Scene> = {}): Scene => ({
    objects: [{ mesh: TETRAHEDRON, rotation: [0, 25, 0], material: { shading } }],
    width: 48,
    height: 40,
    ...more,
});

test("the stages sum to the gas of the picture", async () => {
    const scenes = [
        scene("unlit"),
        scene("flat"),
        scene("smooth", { antialias: true }),
        scene("smooth", { tone: { exposure: 1.2, gamma: true } }),
        { ...scene("flat"), objects: [] },
    ];
    for (const each of scenes) {
        const found = await profile(each, { assets });
        assert.deepEqual(
            found.map(({ stage }) => stage),
            STAGES,
        );
        const sum = found.reduce((gas, stage) => gas + stage.gas, 0);
        assert.equal(sum, (await render(each, { assets })).gas);
    }
});

test("a stage takes gas where its work is", async () => {
    const gas = async (each: Scene): Promise<Record<string, number>> =>
        Object.fromEntries((await profile(each, { assets })).map(({ stage, gas }) => [stage, gas]));
    const [unlit, smooth, empty] = await Promise.all([
        gas(scene("unlit")),
        gas(scene("smooth")),
        gas({ ...scene("flat"), objects: [] }),
    ]);
    const work = ["vertex shader", "primitive assembly", "triangle set-up"] as const;
    for (const stage of work) assert.ok(unlit[stage] && smooth[stage] && !empty[stage], stage);
    assert.ok(smooth["fragment shader"] && !unlit["fragment shader"]);
    assert.ok(unlit["rows of plain triangles"] && !smooth["rows of plain triangles"]);
    for (const stage of ["checks", "compositor", "encoding"]) assert.ok(empty[stage], stage);
});

test("a tile, and other functions", async () => {
    const tile = encode(scene("flat"), "renderTile", { x: 2, y: 1, width: 20, height: 10 });
    const sum = (found: { gas: number }[]): number => found.reduce((gas, each) => gas + each.gas, 0);
    assert.equal(sum(await profile(tile, { assets })), (await render(tile, { assets })).gas);
    const svg = await profile(encode(scene("flat"), "renderSVG"), { assets });
    const bitmap = await profile(scene("flat"), { assets });
    const encoding = STAGES.indexOf("encoding");
    assert.ok((svg[encoding]?.gas ?? 0) > 2 * (bitmap[encoding]?.gas ?? 0));
});

test("what is refused", async () => {
    const call = encode(scene("flat"));
    call.fill(0, 36, 68);
    await assert.rejects(profile(call, { assets }), {
        name: "CallError",
        message: "the contract refused: CanvasSize(width=0, height=40)",
    });
    await assert.rejects(profile(scene("flat"), { assets, gas: 20_000 }), CallError);
    for (const stages of [
        new TextEncoder().encode("{}"),
        { stages: STAGES, contracts: { ...MAPS, Engine: { ...MAPS.Engine, runs: [5, STAGES.length + 1] } } },
    ]) {
        await assert.rejects(profile(scene("flat"), { assets: { ...assets, stages } }), {
            name: "InputError",
            message: "the stages are not those of stages.json",
        });
    }
    const other = { ...MAPS, Engine: { ...MAPS.Engine, address: `0x${"00".repeat(20)}` } };
    await assert.rejects(
        profile(scene("flat"), { assets: { ...assets, stages: { stages: STAGES, contracts: other } } }),
        {
            name: "InputError",
            message: "the stages are not those of this Engine",
        },
    );
});
