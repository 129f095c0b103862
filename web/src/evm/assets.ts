// Where evm.wasm, contracts.json and stages.json come from.

import { InputError } from "../errors.js";
import { inflate, isGzip, readStream, unpack } from "../bytes.js";
import { checkedContracts, type Contracts } from "./contracts.js";
import { moduleOf } from "./evm.js";
import { checkedStages, type Stages } from "./stages.js";

/** The most bytes of each. */
const MAX_ASSET = 1 << 24;

/**
 * A URL, a response, bytes, all also in gzip; or the thing itself. "#ID" is the element of this page with that id, whose text is base64 of
 * bytes in gzip.
 */
export type AssetSource<T> = string | URL | Response | BufferSource | T;

/** What is needed to draw, and `stages` for a profile; by default the files beside this module. */
export interface AssetSources {
    evm?: AssetSource<WebAssembly.Module> | undefined;
    contracts?: AssetSource<Contracts> | undefined;
    stages?: AssetSource<Stages> | undefined;
}

export interface Assets {
    module: WebAssembly.Module;
    contracts: Contracts;
}

/** Return what a table keeps by a key, or else loads now: what could not be loaded may be there later. */
export function keptOrLoaded<K, V>(table: Loading<K, V>, key: K, load: () => Promise<V>): Promise<V> {
    const known = table.get(key);
    if (known) return known;
    const loading = load();
    table.set(key, loading);
    loading.catch(() => table.delete(key));
    return loading;
}

/** A Map or WeakMap of what was loaded, or is being loaded. */
interface Loading<K, V> {
    get(key: K): Promise<V> | undefined;
    set(key: K, value: Promise<V>): unknown;
    delete(key: K): boolean;
}

/** Load what is needed to draw. InputError where they cannot be had. */
export async function loadAssets(sources: AssetSources = {}): Promise<Assets> {
    const { evm, contracts } = sources;
    // bundlers look for URLs that are written like this
    const [module, found] = await Promise.all([
        evm instanceof WebAssembly.Module
            ? evm
            : bytesOf(evm ?? new URL("./evm.wasm", import.meta.url), "the EVM").then(moduleOf),
        isPlain(contracts)
            ? contracts
            : bytesOf(contracts ?? new URL("./contracts.json", import.meta.url), "the contracts").then((bytes) =>
                  parse(bytes, "contracts"),
              ),
    ]);
    return { module, contracts: checkedContracts(found) };
}

/** Load the stages of the contracts. InputError where they cannot be had. */
export async function loadStages({ stages }: AssetSources = {}): Promise<Stages> {
    if (isPlain(stages)) return checkedStages(stages);
    const bytes = await bytesOf(stages ?? new URL("./stages.json", import.meta.url), "the stages");
    return checkedStages(parse(bytes, "stages"));
}

/** Return the bytes of a source. */
async function bytesOf(source: AssetSource<never>, name: string): Promise<Uint8Array<ArrayBuffer>> {
    let bytes: Uint8Array<ArrayBuffer>;
    if (source instanceof ArrayBuffer) bytes = new Uint8Array(source);
    else if (ArrayBuffer.isView(source)) {
        bytes = new Uint8Array(source.buffer as ArrayBuffer, source.byteOffset, source.byteLength);
    } else if (source instanceof Response) bytes = await bodyOf(source, MAX_ASSET, name);
    else bytes = await fetchBytes(String(source), MAX_ASSET, name);
    return isGzip(bytes) ? inflate(bytes, "gzip", MAX_ASSET, name) : bytes;
}

/** Return the bytes behind a URL, or within the element "#ID" of this page. InputError where they cannot be had. */
export async function fetchBytes(
    url: string,
    most: number,
    name: string,
    signal: AbortSignal | null = null,
): Promise<Uint8Array<ArrayBuffer>> {
    if (url.startsWith("#")) {
        const element = document.getElementById(url.slice(1));
        if (!element) throw new InputError(`${name}: there is no element with the id ${url.slice(1)}`);
        return unpack(element.textContent, most, name);
    }
    if (url.startsWith("file:") && inNode()) {
        // which cannot fetch files; bundlers for browsers do not see this import
        const { readFileSync } = process.getBuiltinModule("node:fs");
        return Uint8Array.from(readFileSync(new URL(url)));
    }
    let response: Response;
    try {
        response = await fetch(url, { signal });
    } catch {
        throw new InputError(`${name} could not be loaded from ${url.slice(0, 200)}`);
    }
    return bodyOf(response, most, name);
}

async function bodyOf(response: Response, most: number, name: string): Promise<Uint8Array<ArrayBuffer>> {
    if (!response.ok) {
        throw new InputError(
            `${name} could not be loaded from ${response.url.slice(0, 200)}: HTTP status ${response.status}`,
        );
    }
    return response.body ? readStream(response.body, most, name) : new Uint8Array();
}

function inNode(): boolean {
    return typeof process === "object" && "getBuiltinModule" in process;
}

function isPlain<T extends Contracts | Stages>(source: AssetSource<T> | undefined): source is T {
    return typeof source === "object" && "contracts" in source;
}

function parse(bytes: Uint8Array, name: "contracts" | "stages"): unknown {
    try {
        return JSON.parse(new TextDecoder().decode(bytes)) as unknown;
    } catch {
        throw new InputError(`the ${name} are not those of ${name}.json`);
    }
}
