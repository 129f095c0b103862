// Where meshes come from: pieces of datasets, which are loaded when they are needed, and opened files.

import { InputError } from "../errors.js";
import type { Scene } from "../scene/types.js";
import type { PageAssets } from "./assets.js";
import type { Document, MeshRef, StoredMesh } from "../document/document.js";
import { documentOfScene, openSceneFile, type Library, type Made } from "../document/save.js";
import { keptMesh, keepMeshes } from "./things.js";

/** Pieces of Genesis are named by the 64 hexadecimal digits of their seed, or their number in the collection. */
const GENESIS = /^genesis\/([0-9a-f]{64}|0|[1-9]\d{0,3})$/;

/** The meshes of a page. */
export class MeshStore implements Library {
    readonly #assets: Pick<PageAssets, "pieces" | "piece">;
    readonly #pieces = new Map<string, { document: Document; meshes: readonly StoredMesh[] }>();
    readonly #files = new Map<string, StoredMesh>();
    /** Returns the scene of a seed of Genesis. */
    genesis: ((seed: bigint) => Promise<Scene>) | null = null;

    constructor(assets: Pick<PageAssets, "pieces" | "piece">) {
        this.#assets = assets;
    }

    get(ref: MeshRef): StoredMesh {
        const found = this.#find(ref);
        if (found) return found;
        if ("file" in ref) throw new InputError("A file of this picture is not here: open it again");
        throw new InputError(`There is no object ${ref.object} of the piece “${ref.piece}”`);
    }

    has(ref: MeshRef): boolean {
        return this.#find(ref) !== undefined;
    }

    #find(ref: MeshRef): StoredMesh | undefined {
        return "file" in ref ? this.#files.get(ref.file) : this.#pieces.get(ref.piece)?.meshes[ref.object];
    }

    /** Add opened meshes; they stay in this browser as long as something refers to them. */
    put(meshes: ReadonlyMap<string, StoredMesh>): void {
        for (const [key, mesh] of meshes) this.#files.set(key, mesh);
        void keepMeshes(meshes).catch(() => undefined); // without a database, they last as long as the page
    }

    /** Load the meshes of a document. */
    async need({ objects }: Document): Promise<void> {
        await this.load(objects.map(({ mesh }) => mesh));
    }

    async load(refs: readonly MeshRef[]): Promise<void> {
        const missing = refs.filter((ref) => !this.has(ref));
        const pieces = new Set(missing.flatMap((ref) => ("piece" in ref ? [ref.piece] : [])));
        const files = new Set(missing.flatMap((ref) => ("file" in ref ? [ref.file] : [])));
        await Promise.all([
            ...[...pieces].map((name) => this.piece(name)),
            ...[...files].map(async (key) => {
                const mesh = await keptMesh(key).catch(() => undefined);
                if (mesh) this.#files.set(key, mesh);
            }),
        ]);
    }

    /** Return the document of a piece. InputError if there is none of that name. */
    async piece(name: string): Promise<Document> {
        const known = this.#pieces.get(name);
        if (known) return known.document;
        const { document, meshes } = await this.#open(name);
        const stored: StoredMesh[] = [];
        const objects = document.objects.map((item) => {
            const object = Number(item.id) - 1;
            stored[object] = meshes.get((item.mesh as { file: string }).file) as StoredMesh;
            return { ...item, mesh: { piece: name, object } };
        });
        const made = { document: { ...document, objects }, meshes: stored };
        this.#pieces.set(name, made);
        return made.document;
    }

    async #open(name: string): Promise<Made> {
        const label = GENESIS.exec(name)?.[1];
        if (label && this.genesis) {
            const scene = await this.genesis(label.length < 64 ? await seedOf(Number(label)) : BigInt(`0x${label}`));
            return documentOfScene(scene, { title: `Genesis ${label.slice(0, 8)}`, licence: "MIT" });
        }
        const about = (await this.#assets.pieces()).find((each) => each.name === name);
        if (!about) throw new InputError(`There is no piece “${name}”`);
        const { title, notice, licence } = about;
        return openSceneFile(await this.#assets.piece(name), this, { title, notice, licence });
    }
}

/** Return the seed of a piece of the collection Genesis, by its number from 0 to 1023. */
async function seedOf(number: number): Promise<bigint> {
    const { keccak_256 } = await import("@noble/hashes/sha3.js");
    const digest = keccak_256(new TextEncoder().encode(`shackled-${number}`));
    return digest.reduce((seed, byte) => (seed << 8n) | BigInt(byte), 0n);
}
