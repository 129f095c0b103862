"""shackled token add and seal: the set of icons of a collection"""

from __future__ import annotations

from typing import Annotated

import typer

from ...errors import InputError
from ...ethereum import parse_ether
from ...studio import STUDIO
from ..option import option
from ..telling import tell
from .common import Account, Chain, Key, MaxFee, Rpc, Which, Yes, address, do, open_icons


def add(
    name: Annotated[str, typer.Argument(help="A piece of a dataset, or what it is called.", metavar="NAME")],
    pointer: Annotated[
        str | None, typer.Argument(help="Where the scene is kept, as `shackled mint` prints it.", metavar="[POINTER]")
    ] = None,
    price: Annotated[str, option("--price", "Of each token, in ether; else 0.02.", "ETHER")] = "0.02",
    supply: Annotated[int, option("--supply", "How many tokens; else 100.", "N")] = 100,
    reserve: Annotated[int, option("--reserve", "Of those, for the team; else 1.", "N")] = 1,
    which: Which = "icons",
    rpc: Rpc = None,
    account: Account = None,
    private_key_env: Key = None,
    max_fee: MaxFee = None,
    chain_id: Chain = None,
    yes: Yes = False,
) -> None:
    """Add an icon to a collection that is not sealed; its scene is on the chain already. For the owner."""
    from ...tokens import (
        SCALE,
        Wanted,
        add_call,
        address_of,
        check_sale,
        chosen_pieces,
        kept_codes,
        parts_of,
        plan_storage,
    )

    wei = parse_ether(price, "--price")
    check_sale([], wei, supply, reserve)
    pieces = [] if pointer is not None else chosen_pieces(name)
    if len(pieces) > 1:
        raise InputError("one icon is added at a time")
    place = None if pointer is None else address(pointer, "the pointer")
    collection = open_icons(which, rpc, chain_id)
    if place is None:
        piece = pieces[0]
        storage = plan_storage(collection.connection, [Wanted(piece.name, piece.make())])
        if storage.missing:
            raise InputError(f"{piece.name} is not on the chain yet; run: shackled mint {piece.name}")
        name, place = piece.title, storage.pointers[0]
    arguments = (name, place, SCALE, wei, supply, reserve)
    # a scene that cannot be drawn is told here, before anything is asked
    studio = bytes.fromhex(address_of(parts_of(STUDIO, itself=True), STUDIO)[2:])
    codes = dict(kept_codes(collection.connection, studio, bytes.fromhex(place[2:])))
    ours = add_call(collection.contract.interface, collection.address, arguments, codes).ours
    receipt = do(collection, account, private_key_env, max_fee, yes, f"add {name}", "add", *arguments, ours=ours)
    tell(f"{name} is added; {receipt.gas:,} gas")


def seal(
    which: Which = "icons",
    rpc: Rpc = None,
    account: Account = None,
    private_key_env: Key = None,
    max_fee: MaxFee = None,
    chain_id: Chain = None,
    yes: Yes = False,
) -> None:
    """Fix the set of icons for ever; before it nothing can be sold. For the owner."""
    from ...tokens import icons_of

    collection = open_icons(which, rpc, chain_id)
    icons = icons_of(collection)
    title = f"fix {len(icons)} icons for ever"
    receipt = do(collection, account, private_key_env, max_fee, yes, title, "seal")
    tell(f"{collection.name} has {len(icons)} icons, for ever; {receipt.gas:,} gas")
