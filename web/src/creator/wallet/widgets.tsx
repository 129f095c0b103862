// What the dialogs of wallets are made of, and the one thing that a wallet is asked to do at a time.

import type { ComponentChildren, ComponentProps } from "preact";
import { useEffect } from "preact/hooks";
import { formatEther, type Address } from "viem";
import type { App } from "../app.js";
import { doing, note, type DialogName, type Job } from "../state.js";
import { Button, Trouble, wordsOf as sentence, type Remade } from "../dialogs/widgets.js";
import { stemOf, titleOf } from "../programs/subject.js";
import { sceneFile } from "../../document/save.js";
import { chainName } from "./chains.js";
import type { Token } from "./tokens.js";
import { connect, discover, isDeclined, session, switchTo, wallets, wordsOf, type Tell } from "./wallet.js";

/** What the wallet does; null for nothing. */
export function running(): string | null {
    return Object.values(doing.value.jobs).find(({ state }) => state === "running")?.words ?? null;
}

/** Do one thing with the wallet, unless another is being done. work: returns what to say at the end. */
export function perform(of: DialogName, work: (tell: Tell) => Promise<string | void>): void {
    if (running() !== null) return;
    const tell = (words: string, state: Job["state"] = "running"): void => note({ jobs: { [of]: { state, words } } });
    tell("Waiting for the wallet …");
    work((words) => tell(words)).then(
        (words) => tell(words ?? "", "done"),
        (error: unknown) => (isDeclined(error) ? tell("Cancelled", "done") : tell(sentence(wordsOf(error)), "failed")),
    );
}

/** What is being done now, or how it ended. made: what the dialog reads; where it could not, it says so, and can try again. */
export function Said({ of, made }: { of: DialogName; made?: Remade<unknown> }) {
    const { words, state } = doing.value.jobs[of] ?? { words: "", state: "done" };
    const now = running();
    const forget = (): void => {
        if (doing.peek().jobs[of]?.state !== "running") note({ jobs: { [of]: { words: "", state: "done" } } });
    };
    // what was seen is not said again
    useEffect(() => forget, []);
    const again = (): void => (forget(), made?.again());
    return (
        <>
            {now === null && state === "failed" ? (
                <Trouble text={words} />
            ) : (
                <p role="status" data-name="said" children={now ?? words} />
            )}
            {made?.error && made.error !== words && <Trouble text={made.error} />}
            {made?.error && (
                <div class="scales">
                    <Act name="retry" does={again}>
                        Try again
                    </Act>
                </div>
            )}
        </>
    );
}

/** What is said where an account has less than something costs. */
export function Poor({ balance, most }: { balance: bigint; most: bigint }) {
    return <Trouble text={balance < most ? `The account has ${ether(balance)}, less than that.` : ""} />;
}

/** A button that is dead while something is being done. */
export function Act(props: ComponentProps<typeof Button>) {
    return <Button {...props} off={running() !== null || (props.off ?? false)} />;
}

/** The wallet: those to choose from, or the one that is connected. command: what to do without one. */
export function WalletLine({ app, of, command }: { app: App; of: DialogName; command: string }) {
    useEffect(discover, []);
    const now = session.value;
    if (!now && !wallets.value.length) return <NoWallet app={app} command={command} />;
    if (!now) {
        const button = (wallet: (typeof wallets.value)[number]) => (
            <Act key={wallet.id} name="connect" look="main" does={() => perform(of, () => connect(wallet))}>
                Connect {wallet.name}
            </Act>
        );
        return <section class="wallets" children={wallets.value.map(button)} />;
    }
    return (
        <section class="wallets">
            <p>
                {now.wallet.name}: account <code title={now.account}>{short(now.account)}</code> on{" "}
                <b data-name="chain">{chainName(now.chain)}</b>
            </p>
            <Act name="disconnect" look="small" does={() => void (session.value = null)}>
                Use another wallet
            </Act>
        </section>
    );
}

function NoWallet({ app, command }: { app: App; command: string }) {
    const doc = app.doc.value;
    const isFile = location.protocol === "file:";
    const save = async (): Promise<void> =>
        app.save(new Blob([await sceneFile(doc, app.meshes)]), `${stemOf(titleOf(doc))}.json`);
    return (
        <section data-name="no-wallet">
            <h3>There is no wallet in this browser.</h3>
            <p>
                {isFile
                    ? "This page is a file, and wallets talk to pages from a server only: open it there (http or https)."
                    : "On a phone, open this page in the browser in your wallet's app. Elsewhere, wallets are extensions."}
            </p>
            <p class="quiet">
                Or, with the saved scene, by the command line: <code>{command}</code>
            </p>
            <div class="scales">
                <Act name="copy-page" look="small" off={isFile} does={() => void app.copy(location.href)}>
                    Copy the address
                </Act>
                <Act name="save-scene" look="small" does={() => void save().catch((error: unknown) => app.fail(error))}>
                    Save the scene
                </Act>
            </div>
        </section>
    );
}

/** Buttons that ask the wallet to change to a chain. */
export function Chains({ of, chains }: { of: DialogName; chains: readonly number[] }) {
    const now = session.value;
    const button = (chain: number) => (
        <Act key={chain} name={`switch-${chain}`} does={() => perform(of, () => switchTo(now!, chain))}>
            Switch to {chainName(chain)}
        </Act>
    );
    return now && <div class="scales" children={chains.filter((chain) => chain !== now.chain).map(button)} />;
}

/** A token with its picture as the chain returned it. */
export function TokenView(props: { token: Token; address: Address; chain: number; children: ComponentChildren }) {
    const { token, address, chain, children } = props;
    return (
        <section class="take" data-name="token">
            <img class="pixels" src={token.image} alt={token.name} />
            <div>
                <h3>{token.name}</h3>
                {children}
                <p class="quiet">
                    Collection <code>{address}</code> on {chainName(chain)}
                </p>
            </div>
        </section>
    );
}

/** Return an amount exactly. */
export function ether(wei: bigint): string {
    return `${formatEther(wei)} ether`;
}

/** Return the most that something costs, rounded up. */
export function atMost(wei: bigint): string {
    const format = new Intl.NumberFormat("en", { maximumSignificantDigits: 3, roundingMode: "ceil" });
    return `${format.format(Number(formatEther(wei)))} ether`;
}

export function short(address: Address): string {
    return `${address.slice(0, 6)}…${address.slice(-4)}`;
}
