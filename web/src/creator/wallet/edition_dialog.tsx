// The picture as an edition: first whether it fits, then its terms, then what the wallet will sign, then the token.

import { signal } from "@preact/signals";
import { useRef, useState } from "preact/hooks";
import type { Address } from "viem";
import type { App } from "../app.js";
import { tokenWords, useFit } from "../dialogs/limits.js";
import { Button, Pixels, Trouble, count, gasWords, useMade, wordsOf } from "../dialogs/widgets.js";
import type { Document } from "../../document/document.js";
import { titleOf } from "../programs/subject.js";
import { TRANSACTION_GAS } from "../work/protocol.js";
import type { EditionTerms, Quote } from "../work/work.js";
import { ETHER_CHAINS, addressBook, chainName, chainsOf } from "./chains.js";
import { add, planOf, termsOf, type Added, type Fields, type Plan, type Quoted } from "./edition.js";
import { allows, rightsOf } from "./licence.js";
import { Act, Chains, Poor, Said, TokenView, WalletLine, atMost, perform, running } from "./widgets.js";
import { plainly, session } from "./wallet.js";

const COMMAND = "shackled store SCENE.json --licence LICENCE; shackled token edition add POINTER NAME --price 0.01";
const LICENCE =
    "State the licence of the files: my own work, CC0, CC BY, MIT or another that allows to sell changed copies.";
/** Milliseconds after the last key until the token is drawn anew. */
const CALM = 400;
const FIELDS = [
    ["name", "Name", "1 to 64 letters"],
    ["price", "Price of a token, in ether", "0 for free tokens"],
    ["supply", "Number of tokens", "no limit"],
    ["royalty", "Royalty of resales, in percent", "0 to 10"],
    ["licence", "Licence of the files", "my own work"],
] as const;

/** What was added last, and of which document. */
const last = signal<(Added & { doc: Document; chain: number; address: Address }) | null>(null);

export function EditionDialog({ app }: { app: App }) {
    const [doc, now] = [app.doc.value, session.value];
    const rights = useMade(() => rightsOf(app, doc), [doc]);
    const [fields, set] = useState<Fields>(() => ({
        ...{ name: titleOf(doc), price: "0.01", supply: "", royalty: "5", licence: "", model: false },
    }));
    const [again, setAgain] = useState<Document | null>(null);
    const licence = fields.licence || rights.value?.stated || "";
    const { quoted, shown, problem, error, terms } = useQuote(app, doc, fields);
    const plan = useMade(
        async () => ({ of: quoted, plan: now && quoted?.quote.fits ? await plainly(planOf(now, quoted)) : undefined }),
        [now, quoted, running() === null],
    );
    // what was planned last stays in sight while it is planned anew, and where that fails
    const told = useRef<Plan | null>(null);
    const ready = plan.value?.of === quoted ? plan.value?.plan : undefined;
    const isSame = told.current?.session === now && told.current?.quote === quoted?.quote;
    if (ready !== undefined || !isSame) told.current = ready ?? null;
    if (rights.value?.refused) return <Trouble text={rights.value.refused} />;
    if (last.value?.doc === doc && again !== doc) return <Result of={last.value} again={() => setAgain(doc)} />;
    const isFree = rights.value !== null && (!rights.value.isOwn || allows(licence));
    const start = (): void => {
        if (!ready || !isFree || ready.session !== now) return;
        setAgain(null);
        perform("edition", async (tell) => {
            const found = await add(app, ready, tell);
            last.value = { ...found, doc, chain: ready.session.chain, address: ready.quote.collection as Address };
        });
    };
    return (
        <>
            <Fit app={app} doc={doc} quote={shown} terms={terms} error={error} />
            <form class="terms" onSubmit={(event) => event.preventDefault()}>
                {FIELDS.slice(0, rights.value?.isOwn ? 5 : 4).map(([name, label, hint]) => (
                    <label key={name}>
                        {label}
                        <input
                            class="field"
                            name={name}
                            value={name === "licence" ? licence : fields[name]}
                            placeholder={hint}
                            onInput={({ currentTarget: { value } }) => set({ ...fields, [name]: value })}
                        />
                    </label>
                ))}
                <label class="check">
                    <input
                        type="checkbox"
                        name="model"
                        checked={fields.model}
                        onChange={({ currentTarget: { checked } }) => set({ ...fields, model: checked })}
                    />
                    With a 3D model, which marketplaces turn
                </label>
                <p class="quiet">
                    The first token is yours. Anyone can mint the others, and what they pay is yours. Nothing of it can
                    be changed later.
                </p>
            </form>
            <Trouble text={problem || (rights.value && !isFree ? LICENCE : "")} />
            <WalletLine app={app} of="edition" command={COMMAND} />
            {now && ready === null && quoted && <Elsewhere quote={quoted.quote} chain={now.chain} />}
            {told.current && (
                <Cost
                    plan={told.current}
                    off={!isFree || !ready}
                    again={again === doc}
                    allow={() => setAgain(doc)}
                    start={start}
                />
            )}
            <Said of="edition" made={plan} />
        </>
    );
}

/** Return the quote for the terms of the form, once nothing is typed any more. shown: until then, that of earlier terms. */
function useQuote(app: App, doc: Document, fields: Fields) {
    let [problem, terms]: [string, EditionTerms | null] = ["", null];
    try {
        terms = termsOf(fields);
    } catch (error) {
        problem = wordsOf(error);
    }
    const [key, before] = [terms && Object.values(terms).join(), useRef<Quoted & { key: string | null }>(undefined)];
    const made = useMade(
        async (signal) => {
            if (!terms) return null;
            await new Promise((resume) => setTimeout(resume, before.current?.doc === doc ? CALM : 0));
            return (before.current = { doc, terms, key, quote: await app.work.quote(doc, terms, { signal }) });
        },
        [doc, key],
    );
    const quoted = made.value?.doc === doc && made.value.key === key ? made.value : null;
    return {
        quoted,
        shown: before.current?.doc === doc ? before.current.quote : null,
        problem,
        error: made.error,
        terms,
    };
}

/** Whether a token of this fits, by how much not, and what would. */
function Fit(props: { app: App; doc: Document; quote: Quote | null; terms: EditionTerms | null; error: string }) {
    const { app, doc, quote, terms, error } = props;
    const fit = useFit(app, doc);
    const drawn = app.shown.value?.doc === doc ? app.shown.value.drawn : null;
    const sides = [doc.width, doc.height].map((side) => side * (quote?.scale ?? 1)).join(" × ");
    return (
        <section class="take" data-name="fit">
            <Pixels drawn={drawn} label={titleOf(doc)} />
            <div>
                <h3>{titleOf(doc)}</h3>
                {!quote && !error && <p role="status">Drawing the token as the chain will …</p>}
                <Trouble text={error} />
                {quote?.fits && (
                    <p>
                        <b class="yes">It fits a token.</b> To read it takes {gasWords(quote.tokenUri.gas)} of{" "}
                        {gasWords(TRANSACTION_GAS)}; its picture has {sides} pixels.
                    </p>
                )}
                {quote && !quote.fits && (
                    <>
                        <Trouble text={`It does not fit a token: ${tokenWords(quote, doc, drawn?.gas ?? 0)}.`} />
                        <Button name="fit" look="main" off={fit.off} does={() => fit.make("edition", terms)}>
                            Make it fit
                        </Button>
                    </>
                )}
                {fit.shown}
                {quote?.fits && (
                    <p class="quiet">
                        Up to {quote.storing.length + 1} signatures, {gasWords(quote.gas)}, {count(quote.stored)} bytes
                        stored.
                    </p>
                )}
            </div>
        </section>
    );
}

/** What the wallet will sign, and the button that has it do so; again, where this scene was added before. */
function Cost(props: { plan: Plan; off: boolean; again: boolean; allow: () => void; start: () => void }) {
    const { plan, off, again, allow, start } = props;
    const { calls, most, balance, isKnown } = plan;
    const words =
        calls.length === 1
            ? "1 signature adds the edition: its scene is stored already."
            : `${calls.length} signatures: the last adds the edition, those before store its scene.`;
    return (
        <section>
            <p data-name="cost">
                {words} Gas costs at most <b>{atMost(most)}</b> in total, usually about half of it.
            </p>
            <Poor balance={balance} most={most} />
            {isKnown && !again && <p>This account has added this very scene already.</p>}
            <div class="scales">
                {isKnown && !again ? (
                    <Act name="again" does={allow}>
                        Make another edition of it …
                    </Act>
                ) : (
                    <Act name="add" look="main" off={off || balance < most} does={start}>
                        Add the edition
                    </Act>
                )}
            </div>
        </section>
    );
}

/** A chain without the collection, and where it may be. */
function Elsewhere({ quote, chain }: { quote: Quote; chain: number }) {
    const book = useMade(addressBook, []);
    const found = chainsOf(book.value, "Editions");
    return (
        <section>
            <Trouble text={wordsOf(`${chainName(chain)} has no collection of editions at ${quote.collection}.`)} />
            <p class="quiet">
                Switch to a chain that has one, or deploy it: <code>shackled deploy --contracts Editions</code>
            </p>
            <Chains of="edition" chains={found.length ? found : ETHER_CHAINS} />
        </section>
    );
}

function Result({ of, again }: { of: NonNullable<typeof last.value>; again: () => void }) {
    return (
        <TokenView {...of}>
            <p class="yes" role="status">
                Added: edition {String(of.number)} of Shackled Editions; token {String(of.token.number)} is yours.
            </p>
            {of.isSame ? (
                <p>Its picture, read back from the chain (tokenURI), is the same as here.</p>
            ) : (
                <Trouble text="What the chain returned for the token is NOT the picture of this page." />
            )}
            <p>
                Anyone can mint it: on this page by <i>Mint a token</i>, or by{" "}
                <code>shackled token edition mint {String(of.number)}</code>
            </p>
            <Act name="again" look="small" does={again}>
                Make another edition of it …
            </Act>
        </TokenView>
    );
}
