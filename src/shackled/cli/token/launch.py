"""shackled token deploy"""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ...checks import choice, number
from ...errors import InputError
from ...ethereum import checksum_address, parse_ether
from ...tokens import KINDS, SCALE
from ..option import option
from ..payer import ask, open_signer, parse_max_fee
from ..payer import price as price_of
from ..telling import say, tell
from .common import Account, Chain, Json, Key, MaxFee, Rpc, Yes, address, connect

if TYPE_CHECKING:
    from ...deploy import Receipt, Step

#: Of an icon, in wei.
ICON_PRICE = 2 * 10**16


def deploy(
    collection: Annotated[str, typer.Argument(help="genesis or icons.", metavar="COLLECTION")],
    rpc: Rpc = None,
    account: Account = None,
    private_key_env: Key = None,
    max_fee: MaxFee = None,
    price: Annotated[
        str | None, option("--price", "Of each token, in ether; else 0.15, of an icon 0.02.", "ETHER")
    ] = None,
    reserve: Annotated[
        int | None, option("--reserve", "Tokens kept for the team; else 20, of each icon 1.", "N")
    ] = None,
    icons: Annotated[
        str | None, option("--icons", "Which objects, with commas, as heart,diamond; else all icons.", "NAMES")
    ] = None,
    supply: Annotated[int | None, option("--supply", "Tokens of each icon; else 100.", "N")] = None,
    per_transaction: Annotated[
        int, option("--per-transaction", "The most tokens that one call mints; else 5.", "N")
    ] = 5,
    royalty: Annotated[float, option("--royalty", "Of resales, in percent, 0 to 10; else 5.", "PERCENT")] = 5,
    royalty_receiver: Annotated[
        str | None, option("--royalty-receiver", "Whose the royalties are; else the owner's.", "ADDRESS")
    ] = None,
    owner: Annotated[str | None, option("--owner", "Whose the sale is; else the payer's.", "ADDRESS")] = None,
    allow_list: Annotated[
        Path | None,
        option("--allow-list", "Who may mint early: lines account,quantity, or OpenZeppelin's tree as JSON.", "FILE"),
    ] = None,
    signer: Annotated[str | None, option("--signer", "Whose signatures allow others to mint early.", "ADDRESS")] = None,
    salt: Annotated[int, option("--salt", "Another number gives the same collection another address.", "N")] = 0,
    chain_id: Chain = None,
    any_chain: Annotated[
        bool, option("--any-chain", "Genesis on another chain than Ethereum, its test networks and development nodes.")
    ] = False,
    yes: Yes = False,
    as_json: Json = False,
) -> None:
    """Put a collection on a chain, after the contracts that it needs. What it costs is told first; what is there
    already is left alone.
    """
    from ...deploy import Transactor
    from ...tokens import (
        Offer,
        Wanted,
        check_randomness,
        check_sale,
        chosen_pieces,
        launch,
        plan_equipment,
        plan_launch,
        plan_storage,
        read_allow_list,
        store,
    )

    kind = KINDS[choice(collection, "the collection", tuple(KINDS))]
    listed = None if allow_list is None else read_allow_list(allow_list)
    trusted = None if signer is None else address(signer, "--signer")
    wei = None if price is None else parse_ether(price, "--price")
    percent = number(royalty, "--royalty", 0, 10)
    if kind.hidden and (icons is not None or supply is not None):
        raise InputError("--icons and --supply are for icons")
    of_each = (ICON_PRICE if wei is None else wei, 100 if supply is None else supply, 1 if reserve is None else reserve)
    chosen = [] if kind.hidden else chosen_pieces(icons)
    if not kind.hidden:
        check_sale(chosen, *of_each)
    most = parse_max_fee(max_fee)
    connection = connect(rpc, chain_id)
    if kind.hidden:
        check_randomness(connection, any_chain)
    payer = open_signer(account, private_key_env)
    mine = str(payer.address)
    whose = mine if owner is None else address(owner, "--owner")
    if whose != mine and (listed is not None or trusted is not None):
        raise InputError(f"only the owner can set the allow-list: leave out --owner, or let {whose} set it later")
    if whose != mine and chosen:
        raise InputError("only the owner can add icons: leave out --owner")
    defaults = Offer(whose, whose)
    offer = Offer(
        owner=whose,
        royalty_receiver=whose if royalty_receiver is None else address(royalty_receiver, "--royalty-receiver"),
        price=defaults.price if wei is None else wei,
        reserve=defaults.reserve if reserve is None or chosen else reserve,
        per_transaction=per_transaction,
        royalty=round(100 * percent),
        salt=salt,
    )
    transactor = Transactor(connection, payer, max_fee=most)
    transactor.settle()
    fees = transactor.fees()
    plan = plan_launch(connection, kind, offer, fees)
    missing = [step.name for step in plan.parts.missing]
    before = f", after {', '.join(missing)}" if missing else ""
    if plan.quote is None:
        say(f"{kind.title}: this very collection stands at {plan.address} on chain {connection.chain_id} already")
    else:
        say(f"{kind.title} on chain {connection.chain_id}, at {plan.address}{before}")
    wanted = [Wanted(piece.name, piece.make()) for piece in chosen]
    storage = plan_storage(connection, wanted, fees) if chosen else None
    icons_wanted = [
        (piece.title, pointer, SCALE, *of_each)
        for piece, pointer in zip(chosen, () if storage is None else storage.pointers, strict=True)
    ]
    stored = [] if storage is None else storage.quotes
    listing = None if listed is None and trusted is None else (bytes(32) if listed is None else listed.root, trusted)
    codes = {} if storage is None else storage.codes
    equipment = plan_equipment(connection, plan, fees, listing, icons_wanted, codes, [*plan.quotes, *stored])
    if chosen:
        say(f"with {len(chosen)} icons: {', '.join(piece.title for piece in chosen)}")
    quotes = [*plan.quotes, *stored, *(each.quote for each in equipment)]
    if quotes:
        say(f"it costs {price_of(quotes)}")
        if not yes:
            ask(transactor.name)
    else:
        say("nothing is missing, and nothing was sent; another --salt makes another collection")

    spent: list[int] = []

    def report(step: Step, receipts: Sequence[Receipt]) -> None:
        spent.extend(each.gas for each in receipts)
        gas = sum(each.gas for each in receipts)
        say(f"{step.name}: at {checksum_address(step.address)}, {gas:,} gas, transaction {receipts[-1].hash}")

    made, receipt = launch(plan, transactor, report)
    if storage is not None:
        store(storage, transactor, report)
    for each in equipment:
        done = transactor.send(each.quote)
        spent.append(done.gas)
        say(f"{each.what}, {done.gas:,} gas, transaction {done.hash}")
    if as_json:
        document = {
            "collection": kind.name,
            "address": made.address,
            "chain_id": connection.chain_id,
            "transaction": None if receipt is None else receipt.hash,
            "gas": sum(spent),
        }
        print(json.dumps(document))
        return
    tell(f"{kind.title}: {made.address}" + ("" if receipt is None else f", transaction {receipt.hash}"))
    if chosen:
        tell("look at the icons, then fix them for ever: shackled token seal -c icons")
    tell(f"the sale is closed; open it with: shackled token phase public -c {kind.name}")
