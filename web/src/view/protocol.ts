// What a page asks its worker, and what the worker answers.

import type { Contracts } from "../evm/contracts.js";
import type { CallFacts, Turn } from "../turn.js";

/** A file, or a scene that the contract Studio stores. */
export type Source = { file: Uint8Array<ArrayBuffer> } | { rpc: string; studio: string; pointer: string };

/** A picture. samples: along each side of a pixel. hashed: whether to return the hash of the pixels. */
export interface Wish {
    turn: Turn;
    width: number;
    height: number;
    samples: 1 | 2;
    hashed: boolean;
}

export interface Drawn {
    width: number;
    height: number;
    pixels: Uint8ClampedArray<ArrayBuffer>;
    gas: number;
    /** That the contracts took. */
    milliseconds: number;
    sha256: string | null;
}

export interface Opened {
    call: Uint8Array<ArrayBuffer>;
    facts: CallFacts;
}

/** What a node computed for the same call: whether the bytes are the same, and who computed them. */
export interface Checked {
    outcome: "equal" | "different" | "unknown";
    message: string;
}

export interface Requests {
    open: [Source, Opened];
    draw: [Wish, Drawn];
    check: [{ url: string; wish: Wish; call: Uint8Array }, Checked];
}

/** What a worker keeps: the EVM, and the call of `open`, which another worker may have answered. */
export interface Supplies {
    evm: { module: WebAssembly.Module; contracts: Contracts };
    call: Uint8Array;
}
