// What the page asks its workers, and what they answer.

import type { Contracts } from "../../evm/contracts.js";
import type { StageGas, Stages } from "../../evm/stages.js";
import type { Camera, Scene } from "../../scene/types.js";
import type { Document, SceneOptions } from "../../document/document.js";
import { LIMITS } from "../../document/settings.js";

export type { StageGas };

/** Of every question. onProgress: of 0..1, where it is known. */
export interface Options {
    signal?: AbortSignal;
    onProgress?: (part: number) => void;
}

/** A picture. milliseconds: those of the contracts. triangles: of all objects. calldata: its bytes. */
export interface Drawn {
    width: number;
    height: number;
    pixels: Uint8ClampedArray<ArrayBuffer>;
    bmp?: Uint8Array<ArrayBuffer>;
    gas: number;
    calldata: number;
    triangles: number;
    milliseconds: number;
}

/** The triangles left after culling and clipping, and the pixels that any covers. */
export interface Counts {
    triangles: number;
    pixels: number;
}

/** The picture of a stage of the pipeline. detail: figures in words. */
export interface Stage {
    title: string;
    detail: string;
    drawn: Pick<Drawn, "width" | "height" | "pixels">;
}

/** price: in wei. supply: null for no limit. royalty: in hundredths of a percent. copies: of the artist. */
export interface EditionTerms {
    name: string;
    price: bigint;
    supply: number | null;
    royalty: number;
    copies: number;
    model: boolean;
}

/** A transaction to the Studio. code: that of `pointer` afterwards. gas: of the whole transaction. */
export interface StoreCall {
    pointer: string;
    data: Uint8Array<ArrayBuffer>;
    code: Uint8Array<ArrayBuffer>;
    gas: number;
}

/** The metadata of a token: its size, the gas to read it, and whether it can be read with that of a transaction. */
export interface TokenUri {
    gas: number;
    bytes: number;
    fits: boolean;
}

/** What an edition needs: transactions in the order in which they are sent, `storing` to the Studio, then `add`. */
export interface Quote {
    studio: string;
    collection: string;
    /** The code of the collection. */
    code: Uint8Array<ArrayBuffer>;
    /** Side of the square that each pixel becomes. */
    scale: number;
    storing: StoreCall[];
    /** Bytes that are stored. */
    stored: number;
    /** gas: of the whole transaction. limit: a gas limit with which it succeeded here. */
    add: { data: Uint8Array<ArrayBuffer>; gas: number; limit: number };
    tokenUri: TokenUri;
    /** Sum of the gas of all transactions. */
    gas: number;
    fits: boolean;
    /** Why it does not fit; "" where it does. */
    reason: string;
}

/** The smallest limit of a kind, in gas. */
const leastGas = (kind: string): number =>
    Math.min(...LIMITS.filter((each) => each.kind === kind).map(({ gas }) => gas));
/** The largest transaction on Ethereum (EIP-7825), in gas. */
export const TRANSACTION_GAS = leastGas("transaction");
/** The supply of an edition without a limit. */
export const OPEN_SUPPLY = 2 ** 32 - 1;
/** The read call of most nodes, in gas. */
export const CALL_GAS = leastGas("call");
/** The largest number of pixels a side of a file. */
export const MAX_FILE_SIDE = 4096;

/** Further contracts, in the form of contracts.json. */
export type More = Pick<Contracts, "errors"> & { contracts: Record<string, { address: string; code: string }> };

/** What a worker keeps by names; meshes it keeps by their keys. */
export interface Supplies {
    evm: { module: WebAssembly.Module; contracts: Contracts };
    more: More;
    stages: Stages;
}

/** How a document is to be drawn. bmp: whether the file is wanted, too. */
export interface Wish extends SceneOptions {
    doc: Document;
    bmp?: boolean | undefined;
}

/** The camera of a turntable, and the axis about which it goes around. */
export interface Path {
    camera: Camera;
    middle: readonly [number, number, number];
}

export type Limit = "transaction" | "call" | "edition";
export type Format = "png" | "transparent" | "svg" | "glb" | "apng";
export interface Film {
    frames: number;
    duration: number;
    scale: number;
}

/** What is asked, and what is answered. */
export interface Requests {
    draw: [Wish, Drawn];
    count: [{ doc: Document }, Counts];
    call: [{ doc: Document }, Uint8Array<ArrayBuffer>];
    suffices: [{ doc: Document; gas: number }, boolean];
    stages: [{ doc: Document }, Stage[]];
    profile: [{ doc: Document }, StageGas[]];
    file: [{ doc: Document; format: Format } & Partial<Film>, Uint8Array<ArrayBuffer>];
    path: [{ doc: Document; frames: number }, Path];
    frame: [{ doc: Document; path: Path; degrees: number }, Drawn];
    gif: [{ frames: Drawn[] } & Omit<Film, "frames">, Uint8Array<ArrayBuffer>];
    genesis: [{ seed: bigint }, Scene];
    ids: [{ doc: Document }, { width: number; height: number; ids: Int32Array<ArrayBuffer> }];
    quote: [{ doc: Document; terms: EditionTerms }, Quote];
    fits: [{ doc: Document; limit: Limit; terms?: EditionTerms | undefined }, boolean];
}
export type Kind = keyof Requests;

/** What a worker must have been given for a request, beside the EVM and meshes. */
export const NEEDS: { [K in Kind]?: "more" | "stages" } = {
    profile: "stages",
    file: "more",
    genesis: "more",
    quote: "more",
    fits: "more",
};
