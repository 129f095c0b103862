// Make it fit: the largest canvas, then the most triangles, with which a document fits a limit.

import { InputError } from "../../errors.js";
import { Cancelled } from "../../workers/protocol.js";
import { encode } from "../../scene/encode.js";
import type { Scene } from "../../scene/types.js";
import type { Document, Meshes } from "../../document/document.js";
import { floorGas, intrinsicGas, isRelayed } from "./calls.js";
import type { Host } from "./host.js";
import { CALL_GAS, TRANSACTION_GAS, type EditionTerms, type Limit, type Options } from "./protocol.js";
import { quoteOf } from "./quote.js";

/** Longest sides of the canvas: the least that is good enough, and the least at all. */
const GOOD_SIDE = 128;
const LEAST_SIDE = 64;
const STEP = 8;
/** Shares of the triangles, and the fewest of an object. */
const SHARES = Array.from({ length: 25 }, (_, step) => 0.85 ** (24 - step));
const FEWEST = 12;
/** The terms of an edition whose own are not known. */
const TERMS: EditionTerms = { name: "Edition", price: 0n, supply: null, royalty: 500, copies: 1, model: false };

/** Whether a scene fits a limit, as the contracts find. */
export function fitsIn(host: Host, scene: Scene, limit: Limit, terms = TERMS): boolean {
    if (limit === "edition") return quoteOf(host, scene, terms).fits;
    const call = encode(scene);
    if (limit === "call") return host.suffices(call, CALL_GAS - intrinsicGas(call));
    const isSmall = isRelayed(call) && floorGas(call) <= TRANSACTION_GAS;
    return isSmall && host.suffices(call, TRANSACTION_GAS - intrinsicGas(call));
}

/**
 * Return the document changed as little as it needs: the largest canvas down to 128 pixels; there, the most triangles; then
 * without antialiasing, and down to 64 pixels. InputError where nothing fits.
 */
export async function fitted(
    doc: Document,
    meshes: Meshes,
    fits: (doc: Document) => Promise<boolean>,
    { signal, onProgress }: Options = {},
): Promise<Document> {
    const longest = Math.max(doc.width, doc.height);
    let [asked, all] = [0, 12];
    const ask = async (changed: Document): Promise<boolean> => {
        if (signal?.aborted) throw new Cancelled();
        onProgress?.(Math.min(asked / all, 0.99));
        asked++;
        all = Math.max(all, asked + 2);
        return fits(changed);
    };
    const canvases = (from: Document, least: number, most: number): Document[] =>
        Array.from({ length: Math.max(0, Math.floor((most - least) / STEP)) + 1 }, (_, step) =>
            sized(from, Math.min(most, least + STEP * step)),
        );
    const reduced = (from: Document): Document[] => SHARES.map((share) => withShare(from, meshes, share));
    /** Return the last of some documents that fits; those before one that fits do, too. */
    const last = async (documents: Document[]): Promise<Document | null> => {
        let [low, high] = [-1, documents.length - 1];
        while (low < high) {
            const middle = Math.ceil((low + high) / 2);
            if (await ask(documents[middle])) low = middle;
            else high = middle - 1;
        }
        return documents[low] ?? null;
    };
    if (await ask(doc)) return doc;
    const good = Math.min(GOOD_SIDE, longest);
    const small = sized(doc, good);
    const plain = { ...small, antialias: false };
    const tries: (() => Document[])[] = [
        () => canvases(doc, good, longest),
        () => reduced(small),
        () => (doc.antialias ? reduced(plain) : []),
        () => canvases(withShare(plain, meshes, SHARES[0]), Math.min(LEAST_SIDE, good), good),
    ];
    for (const next of tries) {
        const found = await last(next());
        if (found) return found;
    }
    throw new InputError("It does not fit, even with few pixels and triangles: remove objects, shadows or effects");
}

function sized(doc: Document, longest: number): Document {
    const part = longest / Math.max(doc.width, doc.height);
    return {
        ...doc,
        width: Math.max(1, Math.round(doc.width * part)),
        height: Math.max(1, Math.round(doc.height * part)),
    };
}

/** Return the document with a share of its triangles, but no fewer than `fewest` of an object that has more. */
export function withShare(doc: Document, meshes: Meshes, share: number, fewest = FEWEST): Document {
    if (share === 1) return doc;
    const objects = doc.objects.map((item) => {
        const now = Math.min(item.maxTriangles ?? Infinity, meshes.get(item.mesh).triangles);
        return { ...item, maxTriangles: Math.min(now, Math.max(fewest, Math.round(now * share))) };
    });
    return { ...doc, objects };
}
