// The dialogs, which are loaded when the first is opened.

import type { App, DialogName } from "../app.js";
import { loaded } from "../assets.js";
import { About } from "./about.js";
import { Download } from "./download.js";
import { Keys } from "./keys.js";
import { Limits } from "./limits.js";
import { Button, Sheet, Trouble, useMade } from "./parts.js";
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

export function Dialog({ app, name }: { app: App; name: DialogName }) {
    const Content = name === "mint" || name === "edition" || name === "reveal" ? null : CONTENTS[name];
    return (
        <Sheet app={app} name={name} title={TITLES[name]} wide={name === "limits" || name === "download"}>
            {Content ? <Content app={app} /> : <OfWallet app={app} name={name as WalletDialog} />}
        </Sheet>
    );
}

type WalletDialog = "mint" | "edition" | "reveal";

/** A dialog of wallets, whose code is loaded when it is needed. */
function OfWallet({ app, name }: { app: App; name: WalletDialog }) {
    const {
        value: Content,
        error,
        again,
    } = useMade(async () => (await loaded(import("../wallet/dialogs.js"))).DIALOGS[name], [name]);
    if (Content) return <Content app={app} />;
    if (!error) return <p class="quiet">Loading …</p>;
    return (
        <>
            <Trouble text={error} />
            <div class="scales">
                <Button name="retry" does={again}>
                    Try again
                </Button>
            </div>
        </>
    );
}
