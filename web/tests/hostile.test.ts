// Links, files and nodes that would keep the page busy for ever.

import assert from "node:assert/strict";
import { test } from "node:test";
import { deflateRawSync, inflateRawSync } from "node:zlib";
import { Zip, ZipDeflate, strToU8, unzipSync, zipSync } from "fflate";
import { createClient, custom, numberToHex, type EIP1193Provider, type Hex } from "viem";
import type { App } from "../src/creator/app.js";
import type { MeshStore } from "../src/creator/mesh_store.js";
import { documentOfLink } from "../src/document/link.js";
import { shopsOf } from "../src/creator/wallet/mint.js";
import type { Session } from "../src/creator/wallet/wallet.js";
import { InputError } from "../src/errors.js";
import { inflate, joined } from "../src/bytes.js";
import { readFiles } from "../src/files/read.js";
import { unzipped } from "../src/files/zip.js";
import { processorTime } from "./processor_time.js";

/** Bytes of the end of the directory of a ZIP file. */
const END_SIZE = 22;
const MANY = 1 << 28;
const BOMB = new Uint8Array(deflateRawSync(Buffer.alloc(MANY, " "), { level: 9 }));
/** What the same takes where all of it is inflated. */
const WHOLE = processorTime(() => inflateRawSync(BOMB));

/** Check that something is refused, in half of that time. */
async function refused(work: () => Promise<unknown>, message: string): Promise<void> {
    const before = process.cpuUsage();
    await assert.rejects(work, { name: "InputError", message });
    assert.ok(2 * process.cpuUsage(before).user < WHOLE);
}

test("what is deflated is inflated as far as it may be", async () => {
    const content = Uint8Array.from({ length: 100_000 }, (_, at) => Math.sin(at * at) * 256);
    const packed = new Uint8Array(deflateRawSync(content));
    const of = (bytes: Uint8Array<ArrayBuffer>, most: number) => () => inflate(bytes, "deflate-raw", most, "this");
    assert.deepEqual(await of(packed, content.length)(), content);
    await refused(of(packed, content.length - 1), "this must have up to 99,999 bytes");
    await refused(of(packed.subarray(0, -1), content.length), "this: the compressed bytes are damaged");
    await refused(of(BOMB, 1 << 20), "this must have up to 1,048,576 bytes");
    const link = `#1${Buffer.from(BOMB).toString("base64url")}`;
    await refused(() => documentOfLink(link, {} as MeshStore), "What is in the link must have up to 4,194,304 bytes");
    const zip = Uint8Array.from(zipSync({ "a.obj": BOMB }, { level: 0 }));
    const [entry, view] = [zip.length - END_SIZE - 46 - "a.obj".length, new DataView(zip.buffer)];
    // its bytes are deflated, and become as many as a file of the page may have
    view.setUint16(entry + 10, 8, true);
    view.setUint32(entry + 24, 1000, true);
    const message = "Cannot open a.zip: by the directory, a.obj must have up to 1,000 bytes.";
    await refused(() => readFiles([{ name: "a.zip", bytes: zip }], { size: 64 }), message);
});

test("ZIP files are read as fflate does, but for those that lie", async () => {
    const files = { "a/ä.txt": strToU8("one ".repeat(9999)), "b.bin": Uint8Array.of(1, 2), "c.txt": new Uint8Array() };
    const zips = ([0, 9] as const).map((level) => zipSync(files, { level, comment: "PK" }));
    // as it is written to a pipe: sizes follow the files
    const parts: Uint8Array[] = [];
    const stream = new Zip((_, part) => void parts.push(part));
    for (const [name, bytes] of Object.entries(files)) {
        const file = new ZipDeflate(name);
        stream.add(file);
        file.push(bytes, true);
    }
    stream.end();
    zips.push(joined(parts));
    for (const zip of zips) {
        const found = await unzipped(Uint8Array.from(zip), (name) => name !== "b.bin");
        const expected = Object.entries(unzipSync(zip)).map(([name, bytes]) => ({ name, bytes }));
        assert.deepEqual(found, [expected[0], expected[2]]);
    }
    // sizes of eight bytes (ZIP64)
    const sizes = new Uint8Array(16);
    sizes[0] = sizes[8] = 2;
    const content = Uint8Array.of(3, 4);
    const large = Uint8Array.from(zipSync({ a: [content, { level: 0, extra: { 1: sizes } }] }));
    const wide = large.length - END_SIZE - 20 - "a".length - 46;
    assert.deepEqual(await unzipped(large.fill(255, wide + 20, wide + 28), () => true), [
        { name: "a", bytes: content },
    ]);
    const zip = Uint8Array.from(zipSync({ a: content }, { level: 0 }));
    const entry = zip.length - END_SIZE - 46 - "a".length;
    for (const [at, value, words] of [
        [zip.length - END_SIZE, 0, /no directory/],
        [entry, 0, /directory is damaged/],
        [entry + 8, 1, /encrypted/],
        [entry + 10, 12, /by method 12/],
        [entry + 24, 3, /a is cut off/],
    ] as const)
        await assert.rejects(
            unzipped(zip.with(at, value), () => true),
            words,
        );
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
