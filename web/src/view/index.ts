// The custom element <shackled-view>: a picture that the contracts draw in the reader's browser, and that can be turned.

import { ShackledView } from "./element.js";

export { ShackledView };
export type { AssetSource, AssetSources } from "../evm/assets.js";
export type { PictureDetail, TurnDetail } from "./element.js";

if (!customElements.get("shackled-view")) customElements.define("shackled-view", ShackledView);

declare global {
    interface HTMLElementTagNameMap {
        "shackled-view": ShackledView;
    }
}
