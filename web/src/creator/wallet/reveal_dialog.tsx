// Revealing tokens of Genesis: which collection, the transaction for this wallet or another one, and what it revealed.

import { useState } from "preact/hooks";
import { getAddress, isAddress } from "viem";
import { plural } from "../../files/source.js";
import type { App } from "../app.js";
import { Code, Progress, useMade, useTask } from "../dialogs/widgets.js";
import { addressBook, chainName, chainsOf } from "./chains.js";
import { Act, Chains, Poor, Said, WalletLine, atMost, perform } from "./widgets.js";
import { COMMAND, findReveal, sendReveal, type Reveal } from "./reveal.js";
import { plainly, session } from "./wallet.js";

export function RevealDialog({ app }: { app: App }) {
    const now = session.value;
    const book = useMade(addressBook, []);
    const [typed, type] = useState<string | null>(null);
    const [found, set] = useState<Reveal | "nothing" | null>(null);
    const [words, say] = useState("");
    const task = useTask();
    const chains = chainsOf(book.value, "GenesisCollection");
    const address = typed ?? book.value?.[now?.chain ?? chains[0] ?? 0]?.GenesisCollection ?? "";
    const find = (): void => {
        set(null);
        task.start(async (signal) => {
            if (!isAddress(address.trim(), { strict: false }))
                throw new Error("An address is 0x and 40 hexadecimal digits");
            const tell = (text: string): void => void (signal.aborted || say(text));
            const reveal = await plainly(findReveal(now!, getAddress(address.trim()), tell, signal));
            if (!signal.aborted) set(reveal ?? "nothing");
        });
    };
    const ready = found !== "nothing" && found?.session === now ? found : null;
    const start = (reveal: Reveal): void =>
        perform("reveal", async (tell) => {
            const revealed = await sendReveal(reveal, tell);
            set(null);
            return revealed;
        });
    return (
        <>
            <p>
                Tokens of Genesis are minted without a seed. Some 150 blocks later anyone can reveal them: the
                collection then takes their seeds from the block that determines them.
            </p>
            <label class="named">
                Address of the collection
                <input
                    class="field"
                    name="collection"
                    value={address}
                    placeholder="0x…"
                    spellcheck={false}
                    onInput={({ currentTarget: { value } }) => (set(null), type(value))}
                />
            </label>
            <WalletLine app={app} of="reveal" command={`${COMMAND} --calldata FILE`} />
            {now && (
                <section>
                    <div class="scales">
                        <Act name="find" look={ready ? "" : "main"} off={task.part !== null} does={find}>
                            Find what can be revealed
                        </Act>
                        <Chains of="reveal" chains={chains} />
                    </div>
                    <Progress task={task} what={words} />
                    {found === "nothing" && (
                        <p role="status">There is nothing to reveal: all is revealed, or none minted.</p>
                    )}
                </section>
            )}
            {ready && (
                <>
                    <section data-name="transaction">
                        <p>
                            This transaction reveals {plural(ready.rounds.length, "round")} on{" "}
                            {chainName(ready.session.chain)}. {ready.later} Gas costs at most{" "}
                            <b>{atMost(ready.most)}</b>.
                        </p>
                        <Poor {...ready} />
                        <div class="scales">
                            <Act
                                name="send"
                                look="main"
                                off={task.part !== null || ready.balance < ready.most}
                                does={() => start(ready)}
                            >
                                Send it
                            </Act>
                        </div>
                    </section>
                    <Code
                        app={app}
                        name="reveal"
                        title="For another wallet"
                        help={`To ${ready.call.to}, without ether, with this data.`}
                        file="reveal.hex"
                        made={{ value: ready.call.data, error: "" }}
                    />
                </>
            )}
            <Said of="reveal" />
        </>
    );
}
