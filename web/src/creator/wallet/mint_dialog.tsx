// One token of a collection: what there is, what it costs at most, and the token as the chain has it.

import { useState } from "preact/hooks";
import type { App } from "../app.js";
import { Choices, useMade } from "../dialogs/widgets.js";
import { addressBook, chainName, chainsOf } from "./chains.js";
import { TITLES, mint, offerOf, shopsOf, type Shop } from "./mint.js";
import { Act, Chains, Poor, Said, TokenView, WalletLine, atMost, perform, running } from "./widgets.js";
import type { Token } from "./tokens.js";
import { plainly, session, type Session } from "./wallet.js";

const COMMAND = "shackled token mint 1; shackled token edition mint NUMBER";

export function MintDialog({ app }: { app: App }) {
    const now = session.value;
    const shops = useMade(async () => now && plainly(shopsOf(app, now)), [now]);
    const book = useMade(addressBook, []);
    const [chosen, choose] = useState<Shop["contract"]>("Editions");
    const found = shops.value ?? [];
    const shop = found.find(({ contract }) => contract === chosen) ?? found[0];
    return (
        <>
            <WalletLine app={app} of="mint" command={COMMAND} />
            {now && shops.value && !shop && (
                <section>
                    <p>No collection is known on {chainName(now.chain)}.</p>
                    <Chains of="mint" chains={chainsOf(book.value, ...Object.keys(TITLES))} />
                </section>
            )}
            {shop && found.length > 1 && (
                <Choices
                    name="collection"
                    label="Collection"
                    value={shop.contract}
                    of={found.map(({ contract }) => [contract, TITLES[contract].replace("Shackled ", "")] as const)}
                    does={choose}
                />
            )}
            {now && shop ? (
                <Shelf key={`${now.chain} ${shop.contract}`} now={now} shop={shop} />
            ) : (
                <Said of="mint" made={shops} />
            )}
        </>
    );
}

function Shelf({ now, shop }: { now: Session; shop: Shop }) {
    const [number, setNumber] = useState(shop.first);
    const [token, setToken] = useState<Token | null>(null);
    const isEmpty = shop.kinds?.length === 0;
    const offer = useMade(
        async () => (isEmpty ? null : { number, ...(await plainly(offerOf(now, shop, number))) }),
        [now, number, running() === null],
    );
    if (isEmpty) return <p>There is nothing in {TITLES[shop.contract]} on this chain yet.</p>;
    if (token) {
        return (
            <TokenView token={token} address={shop.address} chain={now.chain}>
                <p class="yes" role="status">
                    Minted: token {String(token.number)} of {TITLES[shop.contract]} is yours.
                </p>
                <p>The picture is what the chain returns for it (tokenURI).</p>
                <Act name="again" look="small" does={() => setToken(null)}>
                    Mint another …
                </Act>
            </TokenView>
        );
    }
    const found = offer.value?.session === now && offer.value.number === number ? offer.value : null;
    const start = (): void => {
        if (found) perform("mint", async (tell) => setToken(await mint(found, tell)));
    };
    return (
        <section class="take" data-name="offer">
            {found?.image ? <img class="pixels" src={found.image} alt={found.words} /> : <span />}
            <div>
                {shop.kinds && (
                    <label class="named">
                        {shop.contract === "Editions" ? "Edition" : "Icon"}
                        <select
                            class="field"
                            name="number"
                            value={number}
                            onChange={({ currentTarget: { value } }) => setNumber(Number(value))}
                        >
                            {shop.kinds.map((each) => (
                                <option key={each.number} value={each.number} children={each.name} />
                            ))}
                        </select>
                    </label>
                )}
                {found && (
                    <p data-name="cost">
                        {found.words} With gas, at most <b>{atMost(found.most)}</b> in total.
                    </p>
                )}
                {found && <Poor {...found} />}
                <Act name="mint" look="main" off={!found || found.balance < found.most} does={start}>
                    Mint one token
                </Act>
                <Said of="mint" made={offer} />
            </div>
        </section>
    );
}
