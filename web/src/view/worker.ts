// The worker of a view: it reads what is to be drawn, turns it, and runs the contracts.

import { InputError } from "../errors.js";
import { CallError, ContractEvm } from "../evm/contracts.js";
import { NodeError, askNode, readStored } from "../evm/rpc.js";
import { drawCall, functionOf, hashPixels, withFunction } from "../picture.js";
import { isTiled } from "../scene/encode.js";
import { describeCall, resizeCall, turnCall } from "../turn.js";
import type { Checked, Drawn, Kind, Opened, Request, Requests, Source, Wish } from "./protocol.js";
import { readFile } from "../scene/call_file.js";

/** Contracts that used so much gas are compiled: all that drew a picture. */
const BUSY = 1_000_000;

let given: Pick<Requests["start"][0], "module" | "contracts"> | null = null;
let evm: ContractEvm | null = null;
let opened: Uint8Array | null = null;

/** Return an EVM with the contracts and nothing else. */
function newMachine(): ContractEvm {
    if (!given) throw new InputError("the worker was not started");
    return new ContractEvm(given.module, given.contracts);
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
    opened = withFunction(call, "render");
    return { call: withFunction(call, "render"), facts };
}

/** Return the call that draws a wish; at its own size, without a turn, the bytes that were opened. */
function callOf({ turn, width, height, samples }: Wish): Uint8Array {
    if (!opened) throw new InputError("there is no scene");
    return resizeCall(turnCall(opened, turn), width * samples, height * samples);
}

async function draw(wish: Wish): Promise<Drawn> {
    const call = callOf(wish);
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
                const [a, b, c, d] = [pixels[at], pixels[at + 4], pixels[at + row], pixels[at + row + 4]] as number[];
                result[to + channel] = ((a as number) + (b as number) + (c as number) + (d as number) + 2) >> 2;
            }
        }
    }
    return result;
}

async function check({ url, wish }: Requests["check"][0]): Promise<Checked> {
    const call = callOf(wish);
    const { contracts } = machine();
    try {
        const asked = await askNode(url, call, contracts);
        const own = drawCall(machine(), call).bmp;
        const equal = own.length === asked.bmp.length && own.every((byte, index) => byte === asked.bmp[index]);
        const who = asked.deployed ? "the contract deployed on its chain" : "the contract's code, sent along";
        return equal
            ? {
                  outcome: "equal",
                  message: `Equal: all ${own.length.toLocaleString("en")} bytes, computed there by ${who}.`,
              }
            : { outcome: "different", message: `Different: ${who}, computed other bytes there.` };
    } catch (error) {
        if (error instanceof CallError) return { outcome: "different", message: `Different: there, ${error.message}.` };
        if (error instanceof NodeError || error instanceof InputError) {
            return { outcome: "unknown", message: `The node could not be asked: ${error.message}.` };
        }
        throw error;
    }
}

const handlers: { [K in Kind]: (value: Requests[K][0]) => Promise<Requests[K][1]> | Requests[K][1] } = {
    start: ({ module, contracts, call }) => {
        given = { module, contracts };
        opened = call;
        return null;
    },
    open,
    draw,
    check,
};

async function answer<K extends Kind>({ id, kind, value }: Request<K>): Promise<void> {
    try {
        const result = await handlers[kind](value);
        const transfer = result && "pixels" in result ? [result.pixels.buffer] : [];
        self.postMessage({ id, value: result }, { transfer });
        if (kind === "draw") await evm?.compile(BUSY);
    } catch (error) {
        self.postMessage({ id, error: error instanceof Error ? error.message : String(error) });
    }
}

self.onmessage = ({ data }: MessageEvent<Request>) => void answer(data);
