// The worker of a view: it reads what is to be drawn, turns it, and runs the contracts.

import { InputError } from "../errors.js";
import { CallError, ContractEvm } from "../evm/contracts.js";
import { NodeError, askNode, readStored } from "../evm/rpc.js";
import { drawCall, hashPixels, withFunction } from "../picture.js";
import { functionOf, isTiled } from "../scene/encode.js";
import { describeCall, resizeCall, turnCall } from "../turn.js";
import { serve, type Asking } from "../workers/serve.js";
import type { Checked, Drawn, Opened, Requests, Source, Supplies, Wish } from "./protocol.js";
import { readFile } from "../scene/call_file.js";

/** Contracts that used so much gas are compiled: all that drew a picture. */
const BUSY = 1_000_000;

const kept: Partial<Supplies> = {};
let evm: ContractEvm | null = null;

/** Return an EVM with the contracts and nothing else. */
function newMachine(): ContractEvm {
    if (!kept.evm) throw new InputError("the worker was not started");
    return new ContractEvm(kept.evm.module, kept.evm.contracts);
}

/** Return the EVM that draws. */
function machine(): ContractEvm {
    return (evm ??= newMachine());
}

async function open(source: Source): Promise<Opened> {
    const call =
        "file" in source
            ? await readFile(source.file)
            : // a node places no code in the EVM that draws, and every node is asked for all parts
              await readStored(newMachine(), source.rpc, source.studio, source.pointer);
    const facts = describeCall(call);
    if (isTiled(functionOf(call) ?? "render")) {
        throw new InputError("the call draws a part of a picture: give one of render, which draws the whole");
    }
    kept.call = withFunction(call, "render");
    return { call: withFunction(call, "render"), facts };
}

/** Return the call that draws a wish; at its own size, without a turn, the bytes that were opened. */
function callOf(opened: Uint8Array, { turn, width, height, samples }: Wish): Uint8Array {
    return resizeCall(turnCall(opened, turn), width * samples, height * samples);
}

async function draw(wish: Wish, { need }: Asking): Promise<Drawn> {
    if (!kept.call) await need(["call"]);
    const call = callOf(kept.call as Uint8Array, wish);
    const begin = performance.now();
    const picture = drawCall(machine(), call);
    const milliseconds = performance.now() - begin;
    const pixels = wish.samples === 2 ? halved(picture.pixels, picture.width) : picture.pixels;
    const sha256 = wish.hashed ? await hashPixels(pixels) : null;
    return { width: wish.width, height: wish.height, pixels, gas: picture.gas, milliseconds, sha256 };
}

/** Return the means of squares of 2 x 2 pixels. */
function halved(pixels: Uint8ClampedArray, width: number): Uint8ClampedArray<ArrayBuffer> {
    const result = new Uint8ClampedArray(pixels.length / 4);
    const row = 4 * width;
    for (let y = 0, to = 0; y < pixels.length; y += 2 * row) {
        for (let x = y; x < y + row; x += 8, to += 4) {
            for (let channel = 0; channel < 4; channel++) {
                const at = x + channel;
                const sum = pixels[at] + pixels[at + 4] + pixels[at + row] + pixels[at + row + 4];
                result[to + channel] = (sum + 2) >> 2;
            }
        }
    }
    return result;
}

async function check({ url, wish, call: opened }: Requests["check"][0]): Promise<Checked> {
    const call = callOf(opened, wish);
    const { contracts } = machine();
    try {
        const asked = await askNode(url, call, contracts);
        const own = drawCall(machine(), call).bmp;
        const equal = own.length === asked.bmp.length && own.every((byte, index) => byte === asked.bmp[index]);
        const who = asked.deployed ? "the contract deployed on its chain" : "the contract's code, sent along";
        if (!equal) return { outcome: "different", message: `Different: ${who}, computed other bytes there.` };
        const count = own.length.toLocaleString("en");
        return { outcome: "equal", message: `Equal: all ${count} bytes, computed there by ${who}.` };
    } catch (error) {
        if (error instanceof CallError) return { outcome: "different", message: `Different: there, ${error.message}.` };
        if (error instanceof NodeError || error instanceof InputError) {
            return { outcome: "unknown", message: `The node could not be asked: ${error.message}.` };
        }
        throw error;
    }
}

const keep = (key: string, value: unknown): void => void Object.assign(kept, { [key]: value });
serve<Requests>({ open, draw, check }, keep, () => evm?.compile(BUSY));
