// The calldata of a picture, and commands for cast, the tool of Foundry.

import { InputError } from "../../errors.js";
import { toHex } from "../../bytes.js";
import type { Contracts } from "../../evm/contracts.js";
import { RENDERER } from "../../evm/names.js";
import { floorGas, intrinsicGas } from "../work/calls.js";
import { stemOf, titleOf, type Subject } from "./subject.js";

/** The longest argument of a program on Linux. */
const MAX_ARGUMENT = 128 * 1024 - 1;

/** Return the gas limit that a request needs: a call passes on all but one 64th of the gas that is left (EIP-150). */
export function neededGas(call: Uint8Array, gas: number): number {
    return Math.max(intrinsicGas(call) + gas + Math.floor(Math.max(0, gas - 1) / 63), floorGas(call));
}

/**
 * Return a shell command that renders the picture on a node and saves it as a BMP file.
 *
 * everything: send the code of the contracts along, so that nothing need be deployed. The gas limit, which may be above the
 * default of a node, has a quarter more than needed, for nodes that count by the rules of another fork. InputError where
 * the call is too long for a command line.
 */
export function castCommand(subject: Subject, { contracts }: Contracts, everything: boolean): string {
    const data = toHex(subject.call);
    if (data.length > MAX_ARGUMENT) {
        const [size, most] = [subject.call.length, MAX_ARGUMENT / 2 - 1].map((each) =>
            Math.floor(each).toLocaleString("en"),
        );
        throw new InputError(
            `The scene has ${size} bytes, too many for a command line, which takes ${most}: save the calldata, or choose fewer triangles`,
        );
    }
    const { width, height } = subject.doc;
    const needed = neededGas(subject.call, subject.gas);
    const size = 54 + Math.floor((3 * width + 3) / 4) * 4 * height;
    const codes = everything
        ? RENDERER.map((name) => ` --override-code ${contracts[name].address}:${contracts[name].code}`)
        : [];
    // the output is two words, offset and length of the bytes, and then the bytes
    const keep = `cut -c131- | xxd -r -p | head -c ${size} > ${stemOf(titleOf(subject.doc))}.bmp`;
    const node = '--rpc-url "${ETH_RPC_URL:-http://127.0.0.1:8545}"';
    const limit = needed + Math.floor(needed / 4);
    return `cast call ${contracts.Renderer.address} ${data}${codes.join("")} --gas-limit ${limit} ${node} | ${keep}\n`;
}
