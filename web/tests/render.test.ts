import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { test } from "node:test";

import { CallError, InputError, encode, render, type Scene } from "../src/index.js";
import { describeRevert } from "../src/evm/contracts.js";
import { Evm } from "../src/evm/evm.js";
import { hashPixels } from "../src/picture.js";

const assets = {
    evm: readFileSync("../src/shackled/evm/evm.wasm"),
    contracts: readFileSync("../src/shackled/web/contracts.json"),
};
const triangle: Scene = {
    objects: [
        {
            mesh: {
                positions: [
                    [-1, -1, -4],
                    [1, -1, -4],
                    [0, 1, -4],
                ],
                faces: [[0, 1, 2]],
            },
            material: { shading: "unlit" },
        },
    ],
    camera: {},
    background: "#102030",
    width: 8,
    height: 6,
};

test("a scene", async () => {
    const picture = await render(triangle, { assets });
    assert.deepEqual([picture.width, picture.height, picture.pixels.length], [8, 6, 4 * 8 * 6]);
    assert.deepEqual([...picture.pixels.subarray(0, 4)], [0x10, 0x20, 0x30, 255]);
    assert.equal(picture.bmp.length, 54 + 24 * 6);
    assert.ok(picture.gas > 10_000);
    const again = await render(encode(triangle), { assets });
    assert.deepEqual(again, picture);
});

test("counts, tiles and hashes", async () => {
    const whole = await render(encode(triangle, "renderCounted"), { assets });
    assert.equal(whole.triangles, 1);
    assert.ok(whole.litPixels);
    const tile = await render(encode(triangle, "renderTile", { x: 2, y: 1, width: 3, height: 2 }), { assets });
    const row = (y: number): number[] => [...whole.pixels.subarray(4 * (8 * y + 2), 4 * (8 * y + 5))];
    assert.deepEqual([...tile.pixels], [...row(1), ...row(2)]);
    const rgb = whole.pixels.filter((_, index) => index % 4 !== 3);
    assert.equal(await hashPixels(whole.pixels), createHash("sha256").update(rgb).digest("hex"));
});

test("what contracts refuse", async () => {
    const call = encode(triangle);
    call.fill(0, 36, 68);
    await assert.rejects(render(call, { assets }), {
        name: "CallError",
        message: "the contract refused: CanvasSize(width=0, height=6)",
    });
    await assert.rejects(render(call.subarray(0, 50), { assets }), CallError);
    await assert.rejects(render(encode(triangle), { assets, gas: 20_000 }), {
        message: "the call ran out of gas: 20,000 did not suffice",
    });
    await assert.rejects(render(new Uint8Array([1, 2, 3, 4]), { assets }), InputError);
    await assert.rejects(render(encode(triangle, "renderSVG"), { assets }), InputError);
});

test("descriptions of reverts", () => {
    const { errors } = JSON.parse(assets.contracts.toString()) as Parameters<typeof describeRevert>[1];
    const bytes = (text: string): Uint8Array => Uint8Array.from(Buffer.from(text, "hex"));
    const word = (value: number): string => value.toString(16).padStart(64, "0");
    assert.equal(describeRevert(bytes(`4e487b71${word(0x11)}`), { errors }), "Panic(0x11)");
    assert.equal(describeRevert(bytes(`08c379a0${word(32)}${word(2)}6869${"00".repeat(30)}`), { errors }), "hi");
    assert.equal(describeRevert(bytes("08c379a0"), { errors }), "error 0x08c379a0");
    assert.equal(describeRevert(bytes("12345678"), { errors }), "error 0x12345678");
    assert.match(describeRevert(bytes(""), { errors }), /not a scene/);
});

test("codes that are replaced are released", async () => {
    const { Instance } = WebAssembly;
    const memories: WebAssembly.Memory[] = [];
    WebAssembly.Instance = class extends Instance {
        constructor(module: WebAssembly.Module) {
            super(module);
            memories.push(this.exports.memory as WebAssembly.Memory);
        }
    };
    try {
        const evm = await Evm.load(assets.evm);
        const address = new Uint8Array(20);
        evm.call(address, address);
        const [memory] = memories as [WebAssembly.Memory];
        const put = (from: number, to: number): number => {
            for (let index = from; index < to; index++) evm.put(address, new Uint8Array(20_000).fill(index));
            return memory.buffer.byteLength;
        };
        const before = put(0, 20);
        assert.ok(put(20, 220) - before <= 1 << 17);
    } finally {
        WebAssembly.Instance = Instance;
    }
});

test("the EVM alone", async () => {
    const evm = await Evm.load(assets.evm);
    const address = new Uint8Array(20).fill(7);
    // PUSH1 42 PUSH0 MSTORE PUSH1 32 PUSH0 RETURN
    evm.put(address, Uint8Array.of(0x60, 42, 0x5f, 0x52, 0x60, 32, 0x5f, 0xf3));
    const { status, output, gas } = evm.call(address, new Uint8Array());
    assert.deepEqual([status, output.at(-1), output.length, gas], ["success", 42, 32, 16]);
    // INVALID
    evm.put(address, Uint8Array.of(0xfe));
    assert.equal(evm.call(address, new Uint8Array(), 1000).status, "failure");
    assert.throws(() => evm.put(new Uint8Array(3), address), InputError);
    // what is no number is no gas
    for (const gas of [null, "1000", 10n, NaN]) {
        assert.throws(() => evm.call(address, new Uint8Array(), gas as number), InputError);
    }
    assert.throws(() => evm.call(address, new Uint8Array(2 ** 26 + 1)), InputError);
    assert.throws(() => evm.call(address, new Uint8Array(), Number.NaN), InputError);
});

test("assets that are none", async () => {
    await assert.rejects(
        render(triangle, { assets: { ...assets, contracts: new TextEncoder().encode("{}") } }),
        InputError,
    );
    await assert.rejects(render(triangle, { assets: { ...assets, evm: new Uint8Array(4) } }), WebAssembly.CompileError);
});
