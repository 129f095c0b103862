// The custom element <shackled-view>: a picture that the contracts draw in the reader's browser, and that can be turned.

import { ShackledView as Class } from "./element.js";

const NAME = "shackled-view";

export type { AssetSource, AssetSources } from "../evm/assets.js";
export type { PictureDetail, TurnDetail } from "./element.js";

/** The class of the element: of pages that load this module twice, the first. */
export const ShackledView = (customElements.get(NAME) as typeof Class | undefined) ?? Class;
export type ShackledView = Class;

if (ShackledView === Class) customElements.define(NAME, Class);

declare global {
    interface HTMLElementTagNameMap {
        [NAME]: Class;
    }
}
