// Scenes of the contract Genesis.

import { FUNCTIONS } from "../../scene/encode.js";
import { decodeCall } from "../../scene/decode.js";
import type { Scene } from "../../scene/types.js";
import { SELECTORS, callOf } from "./calls.js";
import type { Host } from "./host.js";

/** Return the scene of a seed. CallError for the few that have none. */
export function genesisOf(host: Host, seed: bigint): Scene {
    const { output } = host.evm.call(host.addressOf("Genesis"), callOf(SELECTORS.Genesis.scene, seed));
    // what is returned is encoded as the argument of `render` is
    return decodeCall(callOf(FUNCTIONS.render, { encoded: output.subarray(32) }));
}
