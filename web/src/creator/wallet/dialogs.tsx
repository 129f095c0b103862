// The dialogs that need the visitor's wallet; they are loaded when one is opened.

import type { VNode } from "preact";
import type { App } from "../app.js";
import { EditionDialog } from "./edition_dialog.js";
import { MintDialog } from "./mint_dialog.js";
import { RevealDialog } from "./reveal_dialog.js";

export const DIALOGS: Record<"mint" | "edition" | "reveal", (props: { app: App }) => VNode> = {
    mint: MintDialog,
    edition: EditionDialog,
    reveal: RevealDialog,
};
