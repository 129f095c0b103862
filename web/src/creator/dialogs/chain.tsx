// The call that draws the picture, the same picture on a node, and tokens.

import { useState } from "preact/hooks";
import { toHex } from "../../bytes.js";
import type { Contracts } from "../../evm/contracts.js";
import { askNode } from "../../evm/rpc.js";
import type { DialogName } from "../state.js";
import { castCommand } from "../programs/cast.js";
import { stemOf, titleOf } from "../programs/subject.js";
import { Code, Progress, Row, madeOf, useMade, useTask, type Made, type TabProps } from "./widgets.js";

const TOKENS: readonly [DialogName, string, string][] = [
    ["edition", "Make it an edition", "Stores the picture on chain, as tokens that anyone can mint."],
    ["mint", "Mint a token", "Of an icon or of Genesis, where the collection is deployed."],
    ["reveal", "Reveal tokens", "For holders of Shackled Genesis: gives tokens their pictures."],
];

export function ChainTab({ app, doc, subject }: TabProps) {
    const stem = stemOf(titleOf(doc));
    const contracts = useMade(() => app.assets.json<Contracts>("contracts.json"), []);
    const cast = (everything: boolean): Made<string> => {
        const { value, error } = contracts;
        return value ? madeOf(subject, (each) => castCommand(each, value, everything)) : { value, error };
    };
    const calldata = madeOf(subject, ({ call }) => `${toHex(call)}\n`);
    const codes = [
        ["cast", "cast call", "For a chain on which the contracts are deployed.", ".sh", cast(false)],
        [
            "cast-anywhere",
            "cast call, with code",
            "Nothing need be deployed: a state override.",
            "-anywhere.sh",
            cast(true),
        ],
        ["calldata", "Calldata", "The data of the call render(Scene), in hexadecimal.", ".hex", calldata],
    ] as const;
    return (
        <>
            <section class="files">
                {TOKENS.map(([name, title, help]) => (
                    <Row
                        key={name}
                        title={title}
                        help={help}
                        name={`open-${name}`}
                        word="Open"
                        does={() => void app.openDialog(name)}
                    />
                ))}
            </section>
            <Node app={app} subject={subject} contracts={contracts.value} />
            {codes.map(([name, title, help, ending, made]) => (
                <Code
                    key={name}
                    app={app}
                    name={name}
                    title={title}
                    help={help}
                    file={`${stem}${ending}`}
                    made={made}
                />
            ))}
        </>
    );
}

function Node({ app, subject, contracts }: Pick<TabProps, "app" | "subject"> & { contracts: Contracts | null }) {
    const [url, setUrl] = useState("");
    const [said, say] = useState<{ same: boolean; words: string } | null>(null);
    const task = useTask();
    const scene = subject.value;
    const ask = (event: Event): void => {
        event.preventDefault();
        if (!scene || !contracts) return;
        say(null);
        task.start(async (signal) => {
            const start = performance.now();
            const { bmp, deployed } = await askNode(url, scene.call, contracts);
            const seconds = (performance.now() - start) / 1000;
            const own = new Uint8Array(await (await app.work.bmp(scene.doc, { signal })).arrayBuffer());
            if (signal.aborted) return;
            const same = own.length === bmp.length && own.every((byte, place) => byte === bmp[place]);
            const how = deployed ? "by the contracts deployed there" : "by the contracts' code, sent along";
            say({
                same,
                words: `${same ? "The same bytes as here" : "NOT the same bytes as here"}, drawn ${how}, in ${seconds.toFixed(1)} s.`,
            });
        });
    };
    const off = !scene || !contracts || task.part !== null;
    return (
        <section>
            <h3>Draw it on a node</h3>
            <form class="linkline" onSubmit={ask}>
                <input
                    class="field"
                    type="url"
                    name="node"
                    required
                    placeholder="http://127.0.0.1:8545"
                    aria-label="Address of a node"
                    onInput={(event) => setUrl(event.currentTarget.value)}
                />
                <button type="submit" class="button" data-name="node" disabled={off}>
                    Draw and compare
                </button>
            </form>
            <Progress task={task} what="Drawing on the node" />
            {said && <p class={said.same ? "yes" : "trouble"} role="status" children={said.words} />}
            <p class="quiet">
                Nothing is sent before you press the button; then the scene goes to this node, and to nobody else. A
                node answers to web pages only if it allows them (CORS): anvil does, geth with --http.corsdomain. Its
                address begins with https, or is on this computer.
            </p>
        </section>
    );
}
