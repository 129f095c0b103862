// The files of the page: beside it, each in gzip, or as elements of a page that is one file, in gzip and base64.

import { InputError } from "../errors.js";
import { fetchBytes, keptOrLoaded } from "../evm/assets.js";
import { inflate, isGzip } from "../bytes.js";
import { unpackPiece } from "../document/packed.js";

const MAX_ASSET = 1 << 26;

/** A piece of a dataset, as pieces.json lists it. */
export interface PieceEntry {
    /** "icons/diamond", "teapot". */
    name: string;
    title: string;
    /** "icons", "common" or "showcase". */
    dataset: string;
    licence: string;
    /** Credit and terms, or "". */
    notice: string;
    /** Whether the licence is known to allow commercial use, without which it cannot be minted. */
    commercial: boolean;
    triangles: number;
    objects: number;
    /** The gas of the plain piece, 128 x 128 pixels without antialiasing. */
    gas: number;
}

/** What bytes() knows by name; pieces are read by piece(). */
export type AssetName =
    | "evm.wasm" // the EVM
    | "contracts.json" // the contracts that draw: web/src/evm/contracts.ts
    | "stages.json" // their stages: web/src/evm/stages.ts
    | "more.json" // further contracts, in the form of contracts.json
    | "pieces.json" // PieceEntry[]
    | "thumbnails.json" // { [name of a piece]: a data URL of 64 x 64 pixels }
    | "page.html" // the page of `shackled export`, with {{places}} for what differs
    | "draco.wasm" // the decoder of Draco meshes
    | "LICENSES.txt"; // notices of the libraries in the page

export class PageAssets {
    readonly #kept = new Map<string, Promise<Uint8Array<ArrayBuffer>>>();

    /** The bytes of a file, which is loaded once. InputError where it cannot be had. */
    bytes(name: AssetName | `pieces/${string}`): Promise<Uint8Array<ArrayBuffer>> {
        return keptOrLoaded(this.#kept, name, () => load(name));
    }

    /** What a JSON file holds. */
    async json<T>(name: AssetName): Promise<T> {
        return JSON.parse(await this.text(name)) as T;
    }

    /** The text of a file. */
    async text(name: AssetName): Promise<string> {
        return new TextDecoder().decode(await this.bytes(name));
    }

    /** The pieces that there are. */
    pieces(): Promise<PieceEntry[]> {
        return this.json("pieces.json");
    }

    /** One of them as the value of a scene file with its meshes inside, as `shackled.load(name)` stages it. */
    async piece(name: string): Promise<Record<string, unknown>> {
        return unpackPiece(await this.bytes(`pieces/${name.replace("/", "-")}`));
    }
}

/** Return a module whose code is loaded when it is needed. InputError where it cannot be had. */
export async function loaded<T>(importing: Promise<T>): Promise<T> {
    return importing.catch(async (error: unknown) => {
        // Firefox keeps that a module could not be had: by another address it is asked for again
        const address = /https?:\S+\.js/.exec(String(error))?.[0];
        const again = address && (await import(`${address}?${Date.now()}`).catch(() => null));
        if (again) return again as T;
        console.warn(error);
        throw new InputError("A part of the page could not be loaded: try again when the network is back");
    });
}

async function load(name: string): Promise<Uint8Array<ArrayBuffer>> {
    const id = `asset-${name}`;
    if (document.getElementById(id)) return fetchBytes(`#${id}`, MAX_ASSET, name);
    const bytes = await fetchBytes(new URL(`data/${name}.gz`, document.baseURI).href, MAX_ASSET, name);
    // some servers say that a file in gzip is text in gzip, which browsers then unpack
    return isGzip(bytes) ? inflate(bytes, "gzip", MAX_ASSET, name) : bytes;
}
