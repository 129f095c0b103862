// What an edition costs: the scene is stored and added in an EVM of its own, by the contracts that will do it on the chain.

import { InputError } from "../../errors.js";
import { bytesAt, joined, toHex } from "../../bytes.js";
import { CallError, type ContractEvm } from "../../evm/contracts.js";
import { checkedMesh } from "../../scene/checked.js";
import { WORD, dynamicBytes, encode } from "../../scene/encode.js";
import { OBJECT_WORDS, Reader } from "../../scene/reader.js";
import type { Scene, SceneObject } from "../../scene/types.js";
import { SELECTORS, addressIn, callOf, intrinsicGas, structOf, word, type Argument } from "./calls.js";
import { compact, compressZeros, vertexOrder } from "./compact.js";
import type { Host } from "./host.js";
import {
    OPEN_SUPPLY,
    TRANSACTION_GAS,
    type EditionTerms,
    type Quote,
    type StoreCall,
    type TokenUri,
} from "./protocol.js";

/** The largest side of the picture in a `tokenURI` if that of the scene is smaller, in pixels. */
const SIDE = 512;
const MAX_SCALE = 8;
const MAX_NAME = 64;
const MAX_ROYALTY = 1000;
const MAX_COPIES = 100;
/** The most bytes of a `tokenURI` that marketplaces show. */
const MAX_URI = 100_000;
/** Bytes of a part of what is stored. */
const MAX_PART = 24_575;
/** First bytes of what is stored: contracts/src/mesh/Kinds.sol. */
const POINTED = 0x12;
const PARTS = 0x13;
const SCENE = 0x20;
/** Gas that is not counted on, since the state of a chain is another, such as the number of the edition. */
const RESERVE = 50_000;
/** Gas limits that are tried, as multiples of the gas: each call passes on all but a 64th of what is left. */
const MARGINS = [1.05, 1.1, 1.15, 1.25];
/** Words of the struct Scene up to the offset of its objects. */
const OBJECTS_AT = 19;

/** Return what an edition of a scene needs, and whether it is possible. InputError for terms that are not. */
export function quoteOf(host: Host, scene: Scene, terms: EditionTerms): Quote {
    const name = checkedTerms(terms);
    // its state is that of this edition
    const evm = host.newEvm();
    const [studio, collection] = [host.addressOf("Studio"), host.addressOf("Editions")];
    const side = Math.max(scene.width ?? 128, scene.height ?? 128);
    const scale = Math.max(1, Math.min(MAX_SCALE, Math.floor(SIDE / side)));
    const { calls: storing, pointer } = store(evm, studio, scene);
    const { price, supply, royalty, copies, model } = terms;
    const add = callOf(
        SELECTORS.Editions.add,
        { bytes: name },
        { address: pointer },
        ...[scale, Number(model), price, supply ?? OPEN_SUPPLY, royalty, copies],
    );
    const intrinsic = intrinsicGas(add);
    const adding = attempt(evm, collection, add, TRANSACTION_GAS - intrinsic - RESERVE);
    const limit = limitOf(evm, collection, add, adding);
    const isAdded = typeof adding === "number";
    const tokenUri = isAdded ? added(evm, collection, add, terms) : drawn(evm, studio, pointer, scale, model);
    const gas = intrinsic + (isAdded ? adding : tokenUri.gas);
    const reason = problem(storing, adding, tokenUri);
    return {
        studio: toHex(studio),
        collection: toHex(collection),
        code: host.codeOf("Editions"),
        scale,
        storing,
        stored: storing.reduce((sum, { code }) => sum + code.length - 1, 0),
        add: { data: add, gas, limit },
        tokenUri,
        gas: storing.reduce((sum, each) => sum + each.gas, gas),
        fits: !reason,
        reason,
    };
}

/** Return the name as bytes. InputError for terms that the contract would refuse. */
function checkedTerms({ name, price, supply, royalty, copies }: EditionTerms): Uint8Array {
    const bytes = new TextEncoder().encode(name);
    const whole = (value: number, low: number, high: number): boolean =>
        Number.isInteger(value) && value >= low && value <= high;
    const most = Math.min(supply ?? MAX_COPIES, MAX_COPIES);
    const checks: [boolean, string][] = [
        [bytes.length > 0, "An edition needs a name"],
        [bytes.length <= MAX_NAME, `The name is too long: ${MAX_NAME} letters are possible, fewer with accents`],
        [price >= 0n && price < 2n ** 96n, "The price is not possible"],
        [supply === null || whole(supply, 1, OPEN_SUPPLY), "The number of tokens must be a whole number from 1"],
        [whole(royalty, 0, MAX_ROYALTY), `The royalty must be 0 to ${MAX_ROYALTY / 100} %`],
        [whole(copies, 0, most), `The artist can receive 0 to ${most} tokens`],
    ];
    const failed = checks.find(([holds]) => !holds);
    if (failed) throw new InputError(failed[1]);
    return bytes;
}

/** Return the gas of a call, or why it fails. */
function attempt(evm: ContractEvm, to: Uint8Array, call: Uint8Array, gas: number): number | CallError {
    try {
        return evm.call(to, call, gas).gas;
    } catch (error) {
        if (error instanceof CallError) return error;
        throw error;
    }
}

/** Add the edition, and return what its first token costs to read. */
function added(evm: ContractEvm, collection: Uint8Array, add: Uint8Array, { price, copies }: EditionTerms): TokenUri {
    evm.send(collection, add);
    if (!copies) evm.send(collection, callOf(SELECTORS.Editions.mint, 0, 1), undefined, price);
    const read = callOf(SELECTORS.Editions.tokenURI, 0);
    const { gas, output } = evm.call(collection, read);
    const found = attempt(evm, collection, read, TRANSACTION_GAS - intrinsicGas(read));
    return { gas, bytes: bytesAt(output, 0).length, fits: typeof found === "number" };
}

/** Return what a token that cannot be added would cost to read, from what the Studio needs for it. */
function drawn(evm: ContractEvm, studio: Uint8Array, pointer: Uint8Array, scale: number, model: boolean): TokenUri {
    const { renderDataURI, glbDataURI } = SELECTORS.Studio;
    const calls: [number, ...Argument[]][] = [[renderDataURI, { address: pointer }, scale]];
    if (model) calls.push([glbDataURI, { address: pointer }]);
    let [gas, bytes] = [0, 0];
    for (const [selector, ...values] of calls) {
        const answer = evm.call(studio, callOf(selector, ...values));
        gas += answer.gas;
        bytes += answer.output.length;
    }
    return { gas, bytes: Math.ceil((bytes * 4) / 3), fits: false };
}

/** Return a gas limit with which the transaction succeeds; the largest where none does. */
function limitOf(evm: ContractEvm, to: Uint8Array, call: Uint8Array, gas: number | CallError): number {
    const intrinsic = intrinsicGas(call);
    const limits = typeof gas === "number" ? MARGINS.map((margin) => Math.ceil(gas * margin)) : [];
    const found = limits.find((each) => typeof attempt(evm, to, call, each) === "number") ?? TRANSACTION_GAS;
    return Math.min(found + RESERVE + intrinsic, TRANSACTION_GAS);
}

/** Return why an edition is not possible, or "". */
function problem(storing: StoreCall[], adding: number | CallError, { gas, bytes, fits }: TokenUri): string {
    const say = (count: number): string => count.toLocaleString("en");
    const most = `of which a transaction has ${say(TRANSACTION_GAS)}`;
    const dear = storing.find((each) => each.gas > TRANSACTION_GAS);
    if (dear) return `Storing a part takes ${say(dear.gas)} gas, ${most}`;
    if (adding instanceof CallError && !/out of gas|OutOfGas/.test(adding.message)) return adding.message;
    if (!fits) return `A token takes ${say(gas)} gas to read, ${most}, and calls within it a little less`;
    return bytes > MAX_URI ? `A token has ${say(bytes)} bytes, and marketplaces show no more than ${say(MAX_URI)}` : "";
}

// ---- storing ----

/** Store each mesh of a scene once, then the scene, whose pointer is returned. */
function store(evm: ContractEvm, studio: Uint8Array, scene: Scene): { calls: StoreCall[]; pointer: Uint8Array } {
    const calls: StoreCall[] = [];
    const send = (data: Uint8Array<ArrayBuffer>, content: Uint8Array): Uint8Array => {
        const { output, gas } = evm.send(studio, data);
        const pointer = addressIn(output);
        calls.push({
            pointer: toHex(pointer),
            data,
            code: joined([new Uint8Array(1), content]),
            gas: gas + intrinsicGas(data),
        });
        return pointer;
    };
    /** Store bytes by a call; in parts where they are too many for a contract. */
    const keep = (content: Uint8Array, data: Uint8Array<ArrayBuffer>): Uint8Array => {
        if (content.length <= MAX_PART) return send(data, content);
        const parts: Uint8Array[] = [];
        for (let at = 0; at < content.length; at += MAX_PART) {
            const part = content.subarray(at, at + MAX_PART);
            parts.push(send(callOf(SELECTORS.Studio.storePart, { bytes: part }), part));
        }
        const list = joined([word(parts.length), ...parts.map((part) => joined([new Uint8Array(12), part]))]);
        return send(callOf(SELECTORS.Studio.join, { encoded: list }), joined([Uint8Array.of(PARTS), ...parts]));
    };
    const pointers = new Map<string, Uint8Array>();
    const places = objectsIn(encode(scene)).map(({ mesh }) => {
        const bytes = compact(mesh);
        const key = toHex(bytes);
        const found = pointers.get(key) ?? keep(bytes, callOf(SELECTORS.Studio.storeMesh, { bytes }));
        pointers.set(key, found);
        return found;
    });
    const struct = pointed(encode(asStored(scene)), places);
    const content = joined([Uint8Array.of(SCENE), compressZeros(joined([word(WORD), struct]))]);
    return { pointer: keep(content, callOf(SELECTORS.Studio.storeScene, { encoded: struct })), calls };
}

/** Return the objects in a call of `render`: their words behind the first, which is the offset of the mesh, and the mesh. */
function objectsIn(call: Uint8Array): { words: Uint8Array; mesh: Uint8Array }[] {
    return new Reader(call).objects().map(({ place, mesh, size }) => ({
        words: call.subarray(place + WORD, place + WORD * OBJECT_WORDS),
        mesh: call.subarray(mesh, mesh + size),
    }));
}

/** Return the struct of a call of `render` with pointers in place of its meshes. */
function pointed(call: Uint8Array, pointers: readonly Uint8Array[]): Uint8Array<ArrayBuffer> {
    const { encoded: struct } = structOf(call);
    const view = new DataView(struct.buffer, struct.byteOffset, struct.byteLength);
    const offset = (at: number): number => view.getUint32(WORD * at + WORD - 4);
    const objects = objectsIn(call).map(({ words }, index) =>
        joined([word(WORD * OBJECT_WORDS), words, dynamicBytes(joined([Uint8Array.of(POINTED), pointers[index]]))]),
    );
    let end = WORD * objects.length;
    const offsets = objects.map((each) => word((end += each.length) - each.length));
    const [from, to] = [offset(OBJECTS_AT), offset(OBJECTS_AT + 1)];
    const array = joined([word(objects.length), ...offsets, ...objects]);
    const head = joined([struct.subarray(0, WORD * (OBJECTS_AT + 1)), word(from + array.length)]);
    return joined([head, struct.subarray(head.length, from), array, struct.subarray(to)]);
}

/** Return the scene with texture coordinates and opacities in the order that vertices have in a stored mesh. */
function asStored(scene: Scene): Scene {
    return {
        ...scene,
        objects: scene.objects.map((object) => (object.mesh.uvs || object.mesh.opacities ? reordered(object) : object)),
    };
}

function reordered(object: SceneObject): SceneObject {
    const mesh = checkedMesh(object.mesh, "the mesh");
    // unused vertices, which are not sent, stay where they are
    const used = [...new Set(mesh.faces)].sort((a, b) => a - b);
    const numbers = new Map(used.map((vertex, number) => [vertex, number]));
    const faces = mesh.faces.map((vertex) => numbers.get(vertex)!);
    const order = vertexOrder(faces, used.length);
    const permuted = (table: Float64Array | undefined, width: number): Float64Array | undefined => {
        const made = table?.slice();
        order.forEach((from, to) => {
            for (let at = 0; at < width; at++) made![width * used[to] + at] = table![width * used[from] + at];
        });
        return made;
    };
    const { uvs, opacities } = mesh;
    return {
        ...object,
        mesh: { ...mesh, uvs: uvs && permuted(uvs, 2), opacities: opacities && permuted(opacities, 1) },
    };
}
