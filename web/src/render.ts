// Pictures, computed by the contracts' own bytecode.

import { keptOrLoaded, loadAssets, loadStages, type AssetSources } from "./evm/assets.js";
import { ContractEvm } from "./evm/contracts.js";
import type { StageGas } from "./evm/stages.js";
import { drawCall, type Picture } from "./picture.js";
import { encode } from "./scene/encode.js";
import type { Scene } from "./scene/types.js";

/** gas: the most that the execution may use. assets: where the files that are needed are; beside this module by default. */
export interface RenderOptions {
    gas?: number | undefined;
    assets?: AssetSources | undefined;
}

/** Gas that a contract uses before it is compiled: that of several pictures. */
const BUSY = 100_000_000;

const DEFAULTS: AssetSources = {};
const evms = once(async (sources) => {
    const { module, contracts } = await loadAssets(sources);
    return new ContractEvm(module, contracts);
});
const stageMaps = once(loadStages);

/** Return a function that loads something once for the same sources. */
function once<T>(load: (sources: AssetSources) => Promise<T>): (sources: AssetSources | undefined) => Promise<T> {
    const cached = new WeakMap<AssetSources, Promise<T>>();
    return (sources = DEFAULTS) => keptOrLoaded(cached, sources, () => load(sources));
}

/**
 * Draw a scene, or what a call of the Renderer asks for: `render`, `renderTile`, `renderCounted`, `renderTileCounted`.
 *
 * It computes in this thread; in a page, use a worker, or `<shackled-view>`. InputError for a wrong scene, CallError where
 * the contract refuses it.
 */
export async function render(scene: Scene | Uint8Array, options: RenderOptions = {}): Promise<Picture> {
    const call = scene instanceof Uint8Array ? scene : encode(scene);
    const evm = await evms(options.assets);
    await evm.compile(BUSY);
    return drawCall(evm, call, options.gas);
}

/**
 * Return the gas of the same call by stage, as `shackled gas` prints it: in the order in which a picture is made, all
 * stages, which sum to the gas of `render` exactly.
 *
 * It takes several times as long as `render`, and loads `options.assets.stages`. A call may be of any function of the
 * Renderer. Errors are those of `render`.
 */
export async function profile(scene: Scene | Uint8Array, options: RenderOptions = {}): Promise<StageGas[]> {
    const call = scene instanceof Uint8Array ? scene : encode(scene);
    const [evm, stages] = await Promise.all([evms(options.assets), stageMaps(options.assets)]);
    return evm.profile(call, stages, options.gas);
}
