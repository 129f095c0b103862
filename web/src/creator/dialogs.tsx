// The dialogs.

import type { ComponentType } from "preact";
import type { App } from "./app.js";
import type { DialogName } from "./state.js";
import { loaded } from "./assets.js";
import { About } from "./dialogs/about.js";
import { Download } from "./dialogs/download.js";
import { Keys } from "./dialogs/keys.js";
import { Limits } from "./dialogs/limits.js";
import { Sheet } from "./dialogs/widgets.js";
import { Things } from "./dialogs/things.js";

const TITLES: Record<DialogName, string> = {
    download: "Download and share",
    limits: "Gas, limits and stages",
    keys: "Keys and pointer",
    things: "My things",
    about: "About the Creator",
    mint: "Mint a token",
    edition: "Make it an edition",
    reveal: "Reveal tokens",
};
const CONTENTS = { download: Download, limits: Limits, keys: Keys, things: Things, about: About };

/** Return a dialog, whose code is loaded when it is needed. InputError where it cannot be had. */
export async function dialogOf(name: DialogName, app: App): Promise<ComponentType> {
    const isOfWallet = name === "mint" || name === "edition" || name === "reveal";
    const Content = isOfWallet ? (await loaded(import("./wallet/dialogs.js"))).DIALOGS[name] : CONTENTS[name];
    return () => (
        <Sheet app={app} name={name} title={TITLES[name]} wide={name === "limits" || name === "download"}>
            <Content app={app} />
        </Sheet>
    );
}
