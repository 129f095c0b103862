// Compiled contracts: the same bytes for the same gas, and what keeps the interpreter.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { loadAssets } from "../src/evm/assets.js";
import { ContractEvm } from "../src/evm/contracts.js";
import { Evm } from "../src/evm/evm.js";
import { encode } from "../src/scene/encode.js";
import { TETRAHEDRON } from "./tetrahedron.js";

/** Counts down from 1,000. */
const LOOP = Uint8Array.of(0x61, 3, 0xe8, 0x5b, 0x60, 1, 0x90, 3, 0x80, 0x60, 3, 0x57, 0);
const assets = {
    evm: readFileSync("../src/shackled/evm/evm.wasm"),
    contracts: readFileSync("../src/shackled/web/contracts.json"),
};

test("compiled contracts return the same", async () => {
    const { module, contracts } = await loadAssets(assets);
    const evm = new ContractEvm(module, contracts);
    const call = encode({ objects: [{ mesh: TETRAHEDRON }], camera: { eye: [4, 3, 5] }, width: 24, height: 24 });
    const before = evm.call(evm.renderer, call);
    await evm.compile(1);
    assert.deepEqual(evm.call(evm.renderer, call), before);
    // also where the gas does not suffice
    for (const gas of [before.gas - 1, before.gas / 2, 30_000]) {
        assert.throws(() => evm.call(evm.renderer, call, gas), /ran out of gas/);
    }
});

test("only what used much gas is compiled, and nothing without tail calls", async (context) => {
    const { module } = await loadAssets(assets);
    const evm = new Evm(module);
    const address = new Uint8Array(20);
    evm.put(address, LOOP);
    const compile = context.mock.method(WebAssembly, "instantiate");
    const before = evm.call(address, new Uint8Array());
    assert.equal(before.status, "success");
    await evm.compile(before.gas + 1);
    const validate = context.mock.method(WebAssembly, "validate", () => false);
    await evm.compile(1);
    assert.equal(compile.mock.callCount(), 0);
    validate.mock.restore();
    await Promise.all([evm.compile(1), evm.compile(1)]);
    assert.equal(compile.mock.callCount(), 1);
    assert.deepEqual(evm.call(address, new Uint8Array()), before);
    await evm.compile(1);
    assert.equal(compile.mock.callCount(), 1);
});

test("a page whose policy forbids it keeps the interpreter", async (context) => {
    const { module } = await loadAssets(assets);
    const evm = new Evm(module);
    const address = new Uint8Array(20);
    evm.put(address, LOOP);
    const before = evm.call(address, new Uint8Array());
    context.mock.method(WebAssembly, "instantiate", () => Promise.reject(new WebAssembly.CompileError("no")));
    await evm.compile(1);
    assert.deepEqual(evm.call(address, new Uint8Array()), before);
});
