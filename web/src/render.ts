// Pictures, computed by the contracts' own bytecode.

import { loadAssets, type AssetSources } from "./evm/assets.js";
import { ContractEvm } from "./evm/contracts.js";
import { drawCall, type Picture } from "./picture.js";
import { encode } from "./scene/encode.js";
import type { Scene } from "./scene/types.js";

/** gas: the most that the execution may use. assets: where evm.wasm and contracts.json are; beside this module by default. */
export interface RenderOptions {
    gas?: number | undefined;
    assets?: AssetSources | undefined;
}

const cached = new WeakMap<AssetSources, Promise<ContractEvm>>();
const DEFAULTS: AssetSources = {};

/**
 * Draw a scene, or what a call of the Renderer asks for: `render`, `renderTile`, `renderCounted`, `renderTileCounted`.
 *
 * It computes in this thread; in a page, use a worker, or `<shackled-view>`. InputError for a wrong scene, CallError where
 * the contract refuses it.
 */
export async function render(scene: Scene | Uint8Array, options: RenderOptions = {}): Promise<Picture> {
    const call = scene instanceof Uint8Array ? scene : encode(scene);
    const sources = options.assets ?? DEFAULTS;
    let evm = cached.get(sources);
    if (!evm) {
        evm = loadAssets(sources).then(({ module, contracts }) => new ContractEvm(module, contracts));
        cached.set(sources, evm);
        // what could not be loaded may be there later
        evm.catch(() => cached.delete(sources));
    }
    return drawCall(await evm, call, options.gas);
}
