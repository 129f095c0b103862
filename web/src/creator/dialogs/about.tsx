// What this is, what it does not do, and whose work is in it.

import type { App } from "../app.js";
import { useMade } from "./widgets.js";

export function About({ app }: { app: App }) {
    const licences = useMade(() => app.assets.text("LICENSES.txt"), []);
    return (
        <>
            <section class="prose">
                <p>
                    Shackled is a 3D renderer whose every computation runs inside Ethereum smart contracts. This page
                    makes pictures with it: every pixel, also while you drag, is computed here, in your browser, by the
                    bytecode of the contracts in an EVM. There is no second renderer. What a blockchain returns for the
                    same scene has the same bytes.
                </p>
                <h3>Nothing leaves the browser</h3>
                <p>
                    There is no server, no account, no cookie and no counting of visitors. Files that you open stay on
                    this computer. What you make is kept in the storage of this browser, and in the link, if you share
                    it. The page talks to your wallet when you mint, and to a node whose address you enter; to nobody
                    else.
                </p>
            </section>
            <section>
                <h3>Licences</h3>
                <p class="quiet">
                    The page is under the MIT licence. The objects have licences of their own, shown under the picture.
                    It contains these libraries:
                </p>
                <div class="code">
                    <pre tabIndex={0} role="region" aria-label="Licences of the libraries">
                        {licences.value ?? (licences.error || "…")}
                    </pre>
                </div>
            </section>
        </>
    );
}
