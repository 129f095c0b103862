"""shackled token add and seal: the icons of a collection"""

from __future__ import annotations

from typing import Annotated

from ...errors import InputError
from ...ethereum import parse_ether
from ..chain_options import parse_checksum_address
from ..option import argument, option
from ..output import print_line
from .options import IconsOptions, TokenPayerOptions


def add(
    name: Annotated[str, argument("A dataset piece; with POINTER, the name of the icon.", "NAME")],
    which: IconsOptions,
    payer: TokenPayerOptions,
    pointer: Annotated[str | None, argument("Address of the stored scene, from `shackled store`.", "[POINTER]")] = None,
    price: Annotated[str, option("--price", "Price of a token, in ether.", "ETHER")] = "0.02",
    supply: Annotated[int, option("--supply", "Number of tokens.", "N")] = 100,
    reserve: Annotated[int, option("--reserve", "Number of these tokens reserved for the team.", "N")] = 1,
) -> None:
    """Add an icon, whose scene is stored already, to a collection that is not sealed. For the owner."""
    from ...deploy import local_chain
    from ...studio import STUDIO, stored_codes
    from ...tokens import SCALE, SceneToStore, add_call, check_sale, chosen_pieces, plan_storage, token_scene

    wei = parse_ether(price, "--price")
    check_sale([], wei, supply, reserve)
    pieces = [] if pointer is not None else chosen_pieces(name)
    if len(pieces) > 1:
        raise InputError("one icon can be added at a time")
    place = None if pointer is None else parse_checksum_address(pointer, "the pointer")
    collection = which.open()
    if place is None:
        piece = pieces[0]
        storage = plan_storage(collection.connection, [SceneToStore(piece.name, token_scene(piece))])
        if storage.missing:
            raise InputError(f"{piece.name} is not on the chain yet; run: shackled store {piece.name}")
        name, place = piece.title, storage.pointers[0]
    arguments = (name, place, SCALE, wei, supply, reserve)
    # fails before the confirmation if the scene cannot be drawn
    codes = stored_codes(collection.connection, local_chain().address(STUDIO), bytes.fromhex(place[2:]))
    gas = add_call(collection.contract.interface, collection.address, arguments, codes).gas
    receipt = payer.send(collection, f"add {name}", "add", *arguments, gas=gas)
    print_line(f"{name} is added; {receipt.gas:,} gas")


def seal(which: IconsOptions, payer: TokenPayerOptions) -> None:
    """Seal the set of icons; required before the sale. Cannot be undone. For the owner."""
    from ...tokens import icons_of

    collection = which.open()
    icons = icons_of(collection)
    receipt = payer.send(collection, f"seal the collection with {len(icons)} icons", "seal")
    print_line(f"{collection.name} is sealed with {len(icons)} icons; {receipt.gas:,} gas")
