// What stays in the browser, in its database: my things, the document at which one was last, and the meshes of opened files.

import { InputError } from "../errors.js";
import type { Document, StoredMesh } from "../document/document.js";

/** A document that was kept. changed: when, in milliseconds. */
export interface Thing {
    id: string;
    name: string;
    changed: number;
    document: Document;
    picture: Blob | null;
}

/** The database, and its tables. */
const [NAME, THINGS, MESHES] = ["shackled-creator", "things", "meshes"] as const;
/** The thing at which one was last. */
const LAST = "last";
/** Milliseconds for which meshes stay to which nothing refers, since another page may have them. */
const DAY = 86_400_000;

let opened: Promise<IDBDatabase> | null = null;

function database(): Promise<IDBDatabase> {
    opened ??= new Promise((resolve, reject) => {
        if (typeof indexedDB === "undefined") return reject(new InputError("This browser keeps nothing for this page"));
        const request = indexedDB.open(NAME, 1);
        request.onupgradeneeded = () => [THINGS, MESHES].forEach((table) => request.result.createObjectStore(table));
        request.onsuccess = () => resolve(request.result);
        request.onerror = () => reject(new InputError("This browser keeps nothing for this page"));
    });
    opened.catch(() => (opened = null));
    return opened;
}

/** Return what a request to a table of the database gives, once it is written. */
async function ask<T>(
    table: string,
    mode: IDBTransactionMode,
    make: (table: IDBObjectStore) => IDBRequest<T>,
): Promise<T> {
    const transaction = (await database()).transaction(table, mode);
    const request = make(transaction.objectStore(table));
    return new Promise((resolve, reject) => {
        transaction.oncomplete = () => resolve(request.result);
        const fail = (): void =>
            reject(new InputError(`This browser could not keep it: ${transaction.error?.message ?? "it has no room"}`));
        [transaction.onabort, transaction.onerror] = [fail, fail];
    });
}

async function put(thing: Thing): Promise<Thing> {
    await ask(THINGS, "readwrite", (table) => table.put(thing, thing.id));
    return thing;
}

async function thingOf(id: string): Promise<Thing> {
    const found = await ask<Thing | undefined>(THINGS, "readonly", (table) => table.get(id));
    if (found) return found;
    throw new InputError("It is not among your things any more");
}

/** Return my things, the newest first. */
export async function things(): Promise<Thing[]> {
    const found = await ask<Thing[]>(THINGS, "readonly", (table) => table.getAll());
    return found.filter(({ id }) => id !== LAST).sort((a, b) => b.changed - a.changed);
}

/** Keep a document among my things. */
export async function keepThing(document: Document, picture: Blob | null, name = document.title): Promise<Thing> {
    const id = `${Date.now().toString(36)}-${Math.floor(Math.random() * 1e9).toString(36)}`;
    return put({ id, name, changed: Date.now(), document, picture });
}

/** Return the document of one of my things. */
export async function openThing(id: string): Promise<Document> {
    return (await thingOf(id)).document;
}

export async function renameThing(id: string, name: string): Promise<void> {
    await put({ ...(await thingOf(id)), name });
}

export async function duplicateThing(id: string): Promise<Thing> {
    const { document, picture, name } = await thingOf(id);
    return keepThing(document, picture, `${name}, copy`);
}

export async function removeThing(id: string): Promise<void> {
    await ask(THINGS, "readwrite", (table) => table.delete(id));
}

/** Keep the document at which one is. */
export async function autosave(document: Document): Promise<void> {
    await put({ id: LAST, name: document.title, changed: Date.now(), document, picture: null });
}

/** Return the document at which one was last; null if there is none. Meshes that nothing refers to are removed. */
export async function autosaved(): Promise<Document | null> {
    const found = await ask<Thing[]>(THINGS, "readonly", (table) => table.getAll());
    const needed = new Set(found.flatMap(({ document }) => filesOf(document)));
    for (const key of await ask(MESHES, "readonly", (table) => table.getAllKeys())) {
        if (needed.has(String(key))) continue;
        const kept = await ask<Kept | undefined>(MESHES, "readonly", (table) => table.get(key));
        if (kept && Date.now() - kept.time > DAY) await ask(MESHES, "readwrite", (table) => table.delete(key));
    }
    return found.find(({ id }) => id === LAST)?.document ?? null;
}

interface Kept {
    mesh: StoredMesh;
    time: number;
}

/** Keep meshes of opened files by their keys. */
export async function keepMeshes(meshes: ReadonlyMap<string, StoredMesh>): Promise<void> {
    for (const [key, mesh] of meshes) {
        await ask(MESHES, "readwrite", (table) => table.put({ mesh, time: Date.now() } satisfies Kept, key));
    }
}

/** Return a mesh of an opened file; undefined if it was not kept. */
export async function keptMesh(key: string): Promise<StoredMesh | undefined> {
    return (await ask<Kept | undefined>(MESHES, "readonly", (table) => table.get(key)))?.mesh;
}

function filesOf({ objects }: Document): string[] {
    return objects.flatMap(({ mesh }) => ("file" in mesh ? [mesh.file] : []));
}
