import assert from "node:assert/strict";
import { test } from "node:test";
import { deflateSync, gzipSync } from "node:zlib";

import { InputError, encode } from "../src/index.js";
import { readFile } from "../src/scene/call_file.js";

const document = JSON.stringify({
    size: 8,
    objects: [
        {
            mesh: {
                positions: [
                    [0, 0, 0],
                    [1, 0, 0],
                    [0, 1, 0],
                ],
                faces: [[0, 1, 2]],
            },
        },
    ],
});
const call = encode({
    objects: [{ mesh: { positions: [0, 0, 0, 1, 0, 0, 0, 1, 0], faces: [0, 1, 2] } }],
    width: 8,
    height: 8,
});
const hex = `0x${Buffer.from(call).toString("hex")}`;

function bytes(content: string | Uint8Array): Uint8Array<ArrayBuffer> {
    return Uint8Array.from(typeof content === "string" ? new TextEncoder().encode(content) : content);
}

function chunk(kind: string, content: Uint8Array): Buffer {
    const [size, sum] = [Buffer.alloc(4), Buffer.alloc(4)];
    size.writeUInt32BE(content.length);
    return Buffer.concat([size, Buffer.from(kind), content, sum]);
}

function png(...texts: string[]): Uint8Array<ArrayBuffer> {
    const chunks = texts.map((text) => chunk("zTXt", Buffer.concat([Buffer.from("shackled\0\0"), deflateSync(text)])));
    const signature = Buffer.from("89504e470d0a1a0a", "hex");
    return bytes(
        Buffer.concat([signature, chunk("IHDR", Buffer.alloc(13)), ...chunks, chunk("IEND", Buffer.alloc(0))]),
    );
}

test("files of every kind hold the same call", async () => {
    for (const file of [
        bytes(call),
        bytes(hex),
        bytes(` ${hex}\n`),
        bytes(document),
        bytes(`\n${document}`),
        png(hex),
    ]) {
        assert.deepEqual(await readFile(file), bytes(call));
        assert.deepEqual(await readFile(bytes(gzipSync(file))), bytes(call));
    }
});

test("what is no file", async () => {
    const bomb = gzipSync(Buffer.alloc(1 << 26));
    for (const [file, message] of [
        [png(), /carries no scene/],
        [png(hex, hex), /carries 2 scenes/],
        [png("0xzz"), /hexadecimal/],
        [png(`0x${"00".repeat(4_000_000)}`), /up to 8,000,000 bytes/],
        [bytes(bomb), /up to 16,777,216 bytes/],
        [bytes(gzipSync(hex).subarray(0, 40)), /damaged/],
        [bytes('{"objects": 3}'), /objects/],
        [bytes("0x123"), /hexadecimal/],
    ] as const) {
        await assert.rejects(
            readFile(file),
            (error: Error) => error instanceof InputError && message.test(error.message),
        );
    }
});

test("damaged files are read or refused", async () => {
    const whole = png(hex);
    for (let place = 8; place < whole.length; place++) {
        const broken = whole.slice();
        broken[place] = (broken[place] as number) ^ (1 << (place % 8));
        await readFile(broken).catch((error: unknown) => assert.ok(error instanceof InputError, String(error)));
        await readFile(whole.slice(0, place)).catch((error: unknown) => assert.ok(error instanceof InputError));
    }
});
