// Links: the scene file of a document, deflated, behind the # of the address of the page.

import { InputError } from "../errors.js";
import { deflate, fromBase64, inflating, readStream, toBase64 } from "../bytes.js";
import type { Document, Item, Meshes } from "./document.js";
import { openSceneFile, sceneTable, type Library, type Made } from "./save.js";

const VERSION = "1";
/** The most bytes of a link with meshes in it, and of the JSON in any link. */
const MOST_INLINE = 24 * 1024;
const MOST_JSON = 1 << 22;
/** Above, meshes are too large for a link, whatever they are. */
const MOST_VERTICES = 2500;

/** Return the link of a document, "#1…", and the names of the files that are not in it. `prepare` must have been called. */
export async function linkOf(doc: Document, meshes: Meshes): Promise<{ text: string; missing: string[] }> {
    const files = doc.objects.filter(({ mesh }) => "file" in mesh);
    const heavy = [...files, ...doc.objects.filter(({ maxTriangles }) => maxTriangles !== null)];
    const isSmall = heavy.reduce((sum, item) => sum + verticesOf(item, meshes), 0) <= MOST_VERTICES;
    const inside = isSmall ? await packed(sceneTable(doc, meshes, true)) : null;
    if (inside && (!heavy.length || inside.length <= MOST_INLINE)) return { text: textOf(inside), missing: [] };
    const missing = [...new Set(files.map(({ name }) => name))];
    return { text: textOf(await packed(sceneTable(doc, meshes, false))), missing };
}

/** Return about how many vertices of an object would be in the link; Infinity where its mesh is not here. */
function verticesOf({ mesh, maxTriangles }: Item, meshes: Meshes): number {
    try {
        const { vertices } = meshes.get(mesh);
        return Math.min(vertices, maxTriangles ?? vertices);
    } catch {
        return Infinity;
    }
}

function packed(table: object): Promise<Uint8Array> {
    return deflate(JSON.stringify(table), "deflate-raw");
}

function textOf(bytes: Uint8Array): string {
    return `#${VERSION}${toBase64(bytes).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "")}`;
}

/** Return the document of a link, whose meshes are put into the store. InputError if it is damaged. */
export async function documentOfLink(
    hash: string,
    store: Library & { put(meshes: Made["meshes"]): void },
): Promise<Document> {
    const json = await unpacked(bytesOf(hash));
    if (!json) throw new InputError("The link is damaged: copy all of it");
    const { document, meshes } = await openSceneFile(json, store, { title: "" });
    store.put(meshes);
    return document;
}

function bytesOf(hash: string): Uint8Array<ArrayBuffer> {
    const [, version, digits] = /^#?(.)([\w-]*)$/.exec(hash.trim()) ?? [];
    if (version !== VERSION || digits === undefined) {
        throw new InputError("The link is damaged, or of a newer page: copy all of it");
    }
    const bytes = fromBase64(digits.replaceAll("-", "+").replaceAll("_", "/"));
    if (bytes) return bytes;
    throw new InputError("The link is damaged: copy all of it");
}

/** Return the object whose JSON was deflated; null if it is none. */
async function unpacked(bytes: Uint8Array<ArrayBuffer>): Promise<Record<string, unknown> | null> {
    try {
        const json = await readStream(inflating(bytes, "deflate-raw"), MOST_JSON, "What is in the link");
        const value: unknown = JSON.parse(new TextDecoder("utf-8", { fatal: true }).decode(json));
        const isTable = typeof value === "object" && value !== null && !Array.isArray(value);
        return isTable ? (value as Record<string, unknown>) : null;
    } catch (error) {
        if (error instanceof InputError) throw error;
        return null;
    }
}
