// Pictures, computed by the contracts' own bytecode.

import { loadAssets, type Assets, type AssetSources } from "./evm/assets.js";
import { ContractEvm } from "./evm/contracts.js";
import { drawCall, type Picture } from "./picture.js";
import { encode } from "./scene/encode.js";
import type { Scene } from "./scene/types.js";

/** gas: the most that the execution may use. assets: where evm.wasm and contracts.json are; beside this module by default. */
export interface RenderOptions {
    gas?: number | undefined;
    assets?: AssetSources | undefined;
}

const cached = new WeakMap<object, Promise<Assets>>();
const DEFAULTS: AssetSources = {};

/**
 * Draw a scene, or what a call of the Renderer asks for: `render`, `renderTile`, `renderCounted`, `renderTileCounted`.
 *
 * It computes in this thread; in a page, use a worker, or `<shackled-view>`. InputError for a wrong scene, CallError where
 * the contract refuses it.
 */
export async function render(scene: Scene | Uint8Array, options: RenderOptions = {}): Promise<Picture> {
    const call = scene instanceof Uint8Array ? scene : encode(scene, "renderCounted");
    const sources = options.assets ?? DEFAULTS;
    let assets = cached.get(sources);
    if (!assets) {
        assets = loadAssets(sources);
        cached.set(sources, assets);
        // what could not be loaded may be there later
        assets.catch(() => cached.delete(sources));
    }
    const { module, contracts } = await assets;
    return drawCall(new ContractEvm(module, contracts), call, options.gas);
}
