// Nodes, asked over JSON-RPC: by whom the same picture can be computed, and where scenes are stored.

import { InputError } from "../errors.js";
import { bytesAt, fromHex, joined, readStream, toHex } from "../bytes.js";
import { CallError, describeRevert, type ContractEvm, type Contracts } from "./contracts.js";
import { RENDERER } from "./names.js";
import { FUNCTIONS, selectorOf } from "../scene/encode.js";

/** A node that could not be asked, or did not answer as nodes do. The message is one line. */
export class NodeError extends Error {
    override name = "NodeError";
}

/** A node that says, in JSON-RPC, why it does not do what was asked. data: of a revert, empty where there is none. */
class RefusedError extends NodeError {
    constructor(
        message: string,
        readonly data: Uint8Array,
    ) {
        super(message);
    }
}

/** The most bytes of an answer: a picture of 2048 x 2048 pixels in hexadecimal digits, or code. */
const MAX_ANSWER = 26_000_000;
/** Milliseconds. */
const PATIENCE = 60_000;
/** Rounds of reading parts of a stored scene: 43 for each thing stored. */
const MAX_PARTS = 1000;
const NOTHING_KEPT = "NothingKept";

/** Return the result of a request, a text of hexadecimal digits, as bytes. */
async function request(url: string, method: string, params: readonly unknown[]): Promise<Uint8Array> {
    let answer: { result?: unknown; error?: { message?: unknown; data?: unknown } } | null;
    try {
        const body = JSON.stringify({ jsonrpc: "2.0", id: 1, method, params });
        const headers = { "content-type": "application/json" };
        const signal = AbortSignal.timeout(PATIENCE);
        const response = await fetch(checkedUrl(url), { method: "POST", headers, body, signal, credentials: "omit" });
        const text =
            response.body && new TextDecoder().decode(await readStream(response.body, MAX_ANSWER, "the answer"));
        try {
            answer = JSON.parse(text ?? "") as typeof answer;
        } catch {
            throw new NodeError(`it answered with HTTP status ${response.status}, and not in JSON`);
        }
        // errors of JSON-RPC may come with any status
        if (!response.ok && !answer?.error) throw new NodeError(`it answered with HTTP status ${response.status}`);
    } catch (error) {
        if (error instanceof NodeError || error instanceof InputError) throw error;
        if (error instanceof DOMException && error.name === "TimeoutError") {
            throw new NodeError(`it did not answer within ${PATIENCE / 1000} s`);
        }
        throw new NodeError("there was no answer, or the node does not let pages read it (CORS)");
    }
    if (answer?.error) {
        const { message, data } = answer.error;
        throw new RefusedError(`it says: ${oneLine(String(message))}`, revertData(data));
    }
    const result = answer?.result;
    if (typeof result !== "string") throw new NodeError(`its answer to ${method} is none`);
    return fromHex(result);
}

function checkedUrl(url: string): string {
    const found = URL.canParse(url) ? new URL(url) : null;
    if (found?.protocol === "http:" || found?.protocol === "https:") return found.href;
    throw new InputError("the address of a node begins with http:// or https://");
}

function revertData(data: unknown): Uint8Array {
    const text = typeof data === "object" && data && "data" in data ? data.data : data;
    return typeof text === "string" && /^0x(?:[0-9a-f]{2})*$/i.test(text) ? fromHex(text) : new Uint8Array();
}

function oneLine(text: string): string {
    return text.slice(0, 200).replace(/[\s\p{C}]+/gu, " ");
}

/** The bitmap that a node computed, and how. deployed: by the contract that is deployed there. */
export interface Asked {
    bmp: Uint8Array;
    deployed: boolean;
}

/**
 * Return the bitmap that a node computes for a call of `render`: by the Renderer deployed there, otherwise by the code of
 * `contracts`, sent along as a state override.
 *
 * NodeError where it cannot be asked, CallError where the contract refuses the call there.
 */
export async function askNode(url: string, call: Uint8Array, contracts: Contracts): Promise<Asked> {
    const entries = RENDERER.map((name) => contracts.contracts[name]);
    const codes = await Promise.all(entries.map(({ address }) => request(url, "eth_getCode", [address, "latest"])));
    const deployed = entries.every(({ code }, index) => toHex(codes[index]) === code.toLowerCase());
    const overrides = Object.fromEntries(entries.map(({ address, code }) => [address, { code }]));
    const transaction = { to: contracts.contracts.Renderer.address, data: toHex(call) };
    try {
        const output = await request(url, "eth_call", [transaction, "latest", ...(deployed ? [] : [overrides])]);
        return { bmp: bytesAt(output, 0), deployed };
    } catch (error) {
        if (!(error instanceof RefusedError) || !error.data.length) throw error;
        throw new CallError(`the contract refused: ${describeRevert(error.data, contracts)}`, error.data);
    }
}

/**
 * Return the call that draws a scene stored by the contract Studio, read through a node.
 *
 * The node need not be trusted: Studio's own code, run here, tells which bytes it needs next, and refuses those that do not
 * belong to their address.
 */
export async function readStored(
    evm: ContractEvm,
    url: string,
    studio: string,
    pointer: string,
): Promise<Uint8Array<ArrayBuffer>> {
    const [place, target] = [addressOf(studio, "studio"), addressOf(pointer, "pointer")];
    evm.put(place, fromHex(evm.contracts.contracts.Studio.code));
    const call = joined([selectorOf(SCENE), new Uint8Array(12), target]);
    const asked = new Set<string>();
    for (;;) {
        try {
            const { output } = evm.call(place, call);
            // what `scene` returns is encoded as the argument of `render` is
            return joined([selectorOf(FUNCTIONS.render), output]);
        } catch (error) {
            const missing = error instanceof CallError ? missingPart(error.data, evm.contracts) : null;
            if (!missing) throw error;
            if (asked.has(missing))
                throw new NodeError(`the bytes that the node has at ${missing} do not belong there`);
            if (asked.size === MAX_PARTS) throw new NodeError("the stored scene has too many parts");
            asked.add(missing);
            const code = await request(url, "eth_getCode", [missing, "latest"]);
            if (!code.length) throw new NodeError(`nothing is stored at ${missing} on the chain of the node`);
            evm.put(fromHex(missing), code);
        }
    }
}

/** The selector of scene(address). */
const SCENE = 0x47e87b0b;

/** Return the address in the error NothingKept(address); null for another error. */
function missingPart(data: Uint8Array, { errors }: Contracts): string | null {
    const selector = toHex(data.subarray(0, 4));
    const name = Object.hasOwn(errors, selector) ? errors[selector]?.[0] : undefined;
    return name === NOTHING_KEPT && data.length >= 36 ? toHex(data.subarray(16, 36)) : null;
}

function addressOf(text: string, name: string): Uint8Array {
    if (!/^0x[0-9a-f]{40}$/i.test(text)) throw new InputError(`${name} must be 0x and 40 hexadecimal digits`);
    return fromHex(text);
}
