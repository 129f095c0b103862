// The dialog that is open, if any.

import type { App, DialogName } from "../app.js";
import { About } from "./about.js";
import { Download } from "./download.js";
import { Keys } from "./keys.js";
import { Limits } from "./limits.js";
import { Sheet, Trouble, useMade } from "./parts.js";
import { Things } from "./things.js";

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

export function Dialogs({ app }: { app: App }) {
    const name = app.dialog.value;
    if (!name) return null;
    const Content = name === "mint" || name === "edition" || name === "reveal" ? null : CONTENTS[name];
    return (
        <Sheet key={name} app={app} name={name} title={TITLES[name]} wide={name === "limits" || name === "download"}>
            {Content ? <Content app={app} /> : <OfWallet app={app} name={name as WalletDialog} />}
        </Sheet>
    );
}

type WalletDialog = "mint" | "edition" | "reveal";

/** A dialog of wallets, whose code is loaded when it is needed. */
function OfWallet({ app, name }: { app: App; name: WalletDialog }) {
    const { value, error } = useMade(async () => (await import("../wallet/dialogs.js")).DIALOGS[name], [name]);
    if (!value)
        return error ? <Trouble text="This part of the page could not be loaded." /> : <p class="quiet">Loading …</p>;
    const Content = value;
    return <Content app={app} />;
}
