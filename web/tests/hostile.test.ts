// Links, files and nodes that would keep the page busy for ever.

import assert from "node:assert/strict";
import { test } from "node:test";
import { deflateRawSync, inflateRawSync } from "node:zlib";
import { strToU8, unzipSync, zipSync } from "fflate";
import { createClient, custom, numberToHex, type EIP1193Provider, type Hex } from "viem";
import type { App } from "../src/creator/app.js";
import type { MeshStore } from "../src/creator/library.js";
import { documentOfLink } from "../src/creator/link.js";
import { shopsOf } from "../src/creator/wallet/mint.js";
import type { Session } from "../src/creator/wallet/wallet.js";
import { InputError } from "../src/errors.js";
import { inflated, unzipped } from "../src/files/inflate.js";
import { readFiles } from "../src/files/read.js";
import { processorTime } from "./processor_time.js";

const MANY = 1 << 28;
const BOMB = deflateRawSync(Buffer.alloc(MANY, " "), { level: 9 });
/** What the same takes where all of it is inflated. */
const WHOLE = processorTime(() => inflateRawSync(BOMB));

test("what is deflated is inflated as far as it may be", async () => {
    const message = { name: "InputError", message: "too much" };
    assert.ok(2 * processorTime(() => assert.throws(() => inflated(BOMB, 1 << 20, "too much"), message)) < WHOLE);
    const content = Uint8Array.from({ length: 100_000 }, (_, at) => Math.sin(at * at) * 256);
    const packed = deflateRawSync(content);
    assert.deepEqual(inflated(packed, content.length, ""), content);
    assert.throws(() => inflated(packed, content.length - 1, "too much"), message);
    assert.throws(() => inflated(packed.subarray(0, -1), content.length, ""), /unexpected EOF/);
    const link = `#1${BOMB.toString("base64url")}`;
    const refused = { name: "InputError", message: "The link holds more than 4,194,304 bytes" };
    const before = process.cpuUsage();
    await assert.rejects(documentOfLink(link, {} as MeshStore), refused);
    assert.ok(process.cpuUsage(before).user < WHOLE);
});

test("ZIP files are read as fflate does, but for those that lie", async () => {
    const files = { "a/ä.txt": strToU8("one ".repeat(9999)), "b.bin": Uint8Array.of(1, 2), "c.txt": new Uint8Array() };
    for (const level of [0, 9] as const) {
        const zip = zipSync(files, { level, comment: "PK" });
        const found = unzipped(Uint8Array.from(zip), (name) => name !== "b.bin");
        const expected = Object.entries(unzipSync(zip)).map(([name, bytes]) => ({ name, bytes }));
        assert.deepEqual(found, [expected[0], expected[2]]);
    }
    const zip = Uint8Array.from(zipSync({ "a.obj": BOMB }, { level: 0 }));
    const [local, entry] = [0, zip.length - 22 - 46 - 5];
    const view = new DataView(zip.buffer);
    // its bytes are deflated, and become as many as a file of the page may have
    for (const at of [local + 8, entry + 10]) view.setUint16(at, 8, true);
    for (const at of [local + 22, entry + 24]) view.setUint32(at, 1000, true);
    const before = process.cpuUsage();
    await assert.rejects(readFiles([{ name: "a.zip", bytes: zip }], { size: 64 }), {
        name: "InputError",
        message: "a.obj in the ZIP file is larger than it says.",
    });
    assert.ok(process.cpuUsage(before).user < WHOLE);
    for (const [at, value, words] of [
        [zip.length - 22, 0, /no directory/],
        [entry, 0, /directory is damaged/],
        [entry + 8, 1, /encrypted/],
        [entry + 10, 12, /by method 12/],
    ] as const)
        assert.throws(() => unzipped(zip.with(at, value), () => true), words);
});

test("a node that says that there are endless editions", async () => {
    Object.assign(globalThis, { location: { protocol: "file:" } });
    const doc = { title: "", objects: [] };
    const assets = {
        json: async () => ({ contracts: { Editions: { address: `0x${"11".repeat(20)}`, code: "0x01" } } }),
    };
    for (const count of [2n ** 24n + 1n, 2n ** 255n + 1n, 2n ** 256n - 1n]) {
        const answers: Record<string, Hex> = { eth_getCode: "0x01", eth_call: numberToHex(count, { size: 32 }) };
        const provider = { request: async ({ method }: { method: string }) => answers[method] };
        const client = createClient({ transport: custom(provider as EIP1193Provider, { retryCount: 0 }) });
        const session = { client, chain: 1 } as unknown as Session;
        await assert.rejects(shopsOf({ assets, doc: { value: doc } } as unknown as App, session), (error: Error) => {
            return error instanceof InputError && error.message.includes(`has ${count} kinds of tokens`);
        });
    }
});
