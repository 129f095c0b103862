// What a worker does: the contracts draw, count and encode scenes of documents.

import { InputError } from "../../errors.js";
import { fromHex } from "../../evm/bytes.js";
import { CallError, ContractEvm } from "../../evm/contracts.js";
import { drawCall, withFunction } from "../../picture.js";
import { checkedMesh } from "../../scene/checked.js";
import { encode } from "../../scene/encode.js";
import type { Scene } from "../../scene/types.js";
import { prepare, sceneOf, type Document, type MeshRef, type SceneOptions, type StoredMesh } from "../document.js";
import type { Helper } from "./calls.js";
import { fileOf, gifOf } from "./encoders.js";
import { fitsIn } from "./fit.js";
import { genesisOf } from "./genesis.js";
import { idsOf } from "./pick.js";
import { keyOf, type Drawn, type Kind, type Message, type Reply, type Requests, type Supplies } from "./protocol.js";
import { quoteOf } from "./quote.js";
import { stagesOf } from "./stages.js";
import { pathOf, seenFrom } from "./turntable.js";

/** Gas that a contract uses before it is compiled: more than the first picture of the page takes. */
const BUSY = 20_000_000;

export class Machine {
    readonly #meshes = new Map<string, StoredMesh>();
    readonly #given: Supplies = {};
    #evm: ContractEvm | null = null;

    /** Do what a message asks. */
    async reply(message: Message): Promise<Reply | null> {
        if ("give" in message) {
            for (const [key, mesh] of message.give.meshes ?? []) this.#meshes.set(key, mesh);
            Object.assign(this.#given, { ...message.give, meshes: undefined });
            if (message.give.more || message.give.evm) this.#evm = null;
            return null;
        }
        const { id, kind, value } = message;
        try {
            return { id, value: await this.answer(kind, value as Requests[Kind][0]) };
        } catch (error) {
            const { name, message } = error instanceof Error ? error : new Error(String(error));
            return { id, error: { name, message } };
        }
    }

    async answer<K extends Kind>(kind: K, value: Requests[K][0]): Promise<Requests[K][1]> {
        if ("doc" in value) await prepare(value.doc, this);
        return this.#handlers[kind](value);
    }

    get({ ...ref }: MeshRef): StoredMesh {
        const found = this.#meshes.get(keyOf(ref));
        if (!found) throw new InputError(`The worker has no mesh ${keyOf(ref)}`);
        return found;
    }

    /** Return an EVM with all contracts that were given. */
    newEvm(): ContractEvm {
        const { evm, more } = this.#given;
        if (!evm) throw new InputError("The worker has no EVM");
        const errors = { ...evm.contracts.errors, ...more?.errors };
        const made = new ContractEvm(evm.module, { ...evm.contracts, errors });
        const { Studio } = evm.contracts.contracts;
        for (const { address, code } of [Studio, ...Object.values(more?.contracts ?? {})]) {
            made.put(fromHex(address), fromHex(code));
        }
        return made;
    }

    get evm(): ContractEvm {
        return (this.#evm ??= this.newEvm());
    }

    /** Compile the contracts that drew a few pictures. */
    async compile(): Promise<void> {
        await this.#evm?.compile(BUSY);
    }

    /** Return where a contract is. */
    addressOf(name: Helper): Uint8Array {
        const found =
            name === "Studio" ? this.#given.evm?.contracts.contracts.Studio : this.#given.more?.contracts[name];
        if (!found) throw new InputError(`The worker has no contract ${name}`);
        return fromHex(found.address);
    }

    /** Return the code of a contract. */
    codeOf(name: Helper): Uint8Array<ArrayBuffer> {
        return fromHex(this.#given.more?.contracts[name]?.code ?? "0x");
    }

    sceneOf(doc: Document, options?: SceneOptions): Scene {
        return sceneOf(doc, this, options);
    }

    /** Return the call of `render` that draws a document. */
    callOf(doc: Document, options?: SceneOptions): Uint8Array {
        return encode(this.sceneOf(doc, options));
    }

    /** Return the picture of a scene. */
    draw(scene: Scene, withFile = false): Drawn {
        const call = encode(scene);
        const begin = performance.now();
        const { bmp, width, height, pixels, gas } = drawCall(this.evm, call);
        const milliseconds = performance.now() - begin;
        const triangles = scene.objects.reduce((sum, { mesh }) => sum + checkedMesh(mesh, "").faces.length / 3, 0);
        const file = withFile ? { bmp: bmp.slice() } : {};
        return { width, height, pixels, gas, calldata: call.length, triangles, milliseconds, ...file };
    }

    /** Whether a call of `render` succeeds with so much gas. */
    suffices(call: Uint8Array, gas: number): boolean {
        if (gas < 0) return false;
        try {
            this.evm.call(this.evm.renderer, call, gas);
            return true;
        } catch (error) {
            if (error instanceof CallError && /out of gas/.test(error.message)) return false;
            throw error;
        }
    }

    readonly #handlers: { [K in Kind]: (value: Requests[K][0]) => Requests[K][1] | Promise<Requests[K][1]> } = {
        draw: ({ doc, bmp, ...options }) => this.draw(this.sceneOf(doc, options), bmp),
        count: ({ doc }) => {
            const { triangles = 0, litPixels = 0 } = drawCall(
                this.evm,
                withFunction(this.callOf(doc), "renderCounted"),
            );
            return { triangles, pixels: litPixels };
        },
        call: ({ doc }) => new Uint8Array(this.callOf(doc)),
        suffices: ({ doc, gas }) => this.suffices(this.callOf(doc), gas),
        stages: ({ doc }) => stagesOf(this, this.sceneOf(doc)),
        profile: ({ doc }) => {
            if (!this.#given.stages) throw new InputError("The worker has no stages");
            return this.evm.profile(this.callOf(doc), this.#given.stages);
        },
        file: ({ doc, ...how }) => fileOf(this, this.sceneOf(doc), how),
        path: ({ doc, frames }) => pathOf(this.sceneOf(doc), frames),
        frame: ({ doc, path, degrees }) => this.draw(seenFrom(this.sceneOf(doc), path, degrees)),
        gif: gifOf,
        genesis: ({ seed }) => genesisOf(this, seed),
        ids: ({ doc }) => idsOf(this, this.sceneOf(doc)),
        quote: ({ doc, terms }) => quoteOf(this, this.sceneOf(doc), terms),
        fits: ({ doc, limit, terms }) => fitsIn(this, this.sceneOf(doc), limit, terms),
    };
}
