// Scenes of the contract Genesis.

import { FUNCTIONS } from "../../scene/encode.js";
import { decodeCall } from "../../scene/decode.js";
import type { Scene } from "../../scene/types.js";
import { SELECTORS, callOf } from "./calls.js";
import type { Machine } from "./machine.js";

/** Return the scene of a seed. CallError for the few that have none. */
export function genesisOf(machine: Machine, seed: bigint): Scene {
    const { output } = machine.evm.call(machine.addressOf("Genesis"), callOf(SELECTORS.Genesis.scene, seed));
    // what is returned is encoded as the argument of `render` is
    return decodeCall(callOf(FUNCTIONS.render, { encoded: output.subarray(32) }));
}
