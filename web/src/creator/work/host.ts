// What a worker has: the contracts and meshes that it was given, and the EVM that draws with them.

import { fromHex } from "../../bytes.js";
import {
    keyOf,
    prepare,
    sceneOf,
    type Document,
    type MeshRef,
    type SceneOptions,
    type StoredMesh,
} from "../../document/document.js";
import { InputError } from "../../errors.js";
import { CallError, ContractEvm } from "../../evm/contracts.js";
import { drawCall } from "../../picture.js";
import { checkedMesh } from "../../scene/checked.js";
import { encode } from "../../scene/encode.js";
import type { Scene } from "../../scene/types.js";
import type { Helper } from "./calls.js";
import type { Drawn, Supplies } from "./protocol.js";

/** Gas that a contract uses before it is compiled: more than the first picture of the page takes. */
const BUSY = 20_000_000;

export class Host {
    readonly #meshes = new Map<string, StoredMesh>();
    readonly given: Partial<Supplies> = {};
    #evm: ContractEvm | null = null;

    /** Keep what is given. */
    readonly keep = (key: string, value: unknown): void => {
        if (key === "evm" || key === "more") this.#evm = null;
        if (key === "evm" || key === "more" || key === "stages") Object.assign(this.given, { [key]: value });
        else this.#meshes.set(key, value as StoredMesh);
    };

    get({ ...ref }: MeshRef): StoredMesh {
        const found = this.#meshes.get(keyOf(ref));
        if (!found) throw new InputError(`The worker has no mesh ${keyOf(ref)}`);
        return found;
    }

    /** Return an EVM with all contracts that were given. */
    newEvm(): ContractEvm {
        const { evm, more } = this.given;
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
        const found = name === "Studio" ? this.given.evm?.contracts.contracts.Studio : this.given.more?.contracts[name];
        if (!found) throw new InputError(`The worker has no contract ${name}`);
        return fromHex(found.address);
    }

    /** Return the code of a contract. */
    codeOf(name: Helper): Uint8Array<ArrayBuffer> {
        return fromHex(this.given.more?.contracts[name]?.code ?? "0x");
    }

    async sceneOf(doc: Document, options?: SceneOptions): Promise<Scene> {
        await prepare(doc, this);
        return sceneOf(doc, this, options);
    }

    /** Return the call of `render` that draws a document. */
    async callOf(doc: Document): Promise<Uint8Array> {
        return encode(await this.sceneOf(doc));
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
}
