"""What the owner does with a new collection before its sale: the allow-list, and the icons."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..artifacts import artifact
from ..chain import Connection
from ..deploy import Call, Fees, Quote, make_quotes
from ..errors import InputError
from ._actions import call_of
from ._collection import Collection
from ._deploying import Launch
from ._icons import add_call, icons_of

NOBODY = "0x" + "00" * 20


@dataclass(frozen=True)
class Equipment:
    """A transaction of the owner. what: is done then, in words."""

    what: str
    quote: Quote


def plan_equipment(
    connection: Connection,
    launch: Launch,
    fees: Fees,
    listing: tuple[bytes, str | None] | None,
    icons: Sequence[tuple[Any, ...]],
    codes: Mapping[bytes, bytes],
    known: Sequence[Quote],
) -> list[Equipment]:
    """Return what is missing of it, which is all where the collection is not there yet.

    listing: root of the allow-list and who signs permissions; None sets none. icons: the arguments of `add` of each.
    codes: by address, what the chain keeps of their scenes. known: quotes for what is done before.

    InputError if icons are missing in a collection that is sealed.
    """
    made = None if launch.quote is not None else Collection(connection, launch.kind, launch.address)
    interface = artifact(launch.kind.contract).interface
    wanted: list[tuple[str, Call]] = []
    if listing is not None:
        root, signer = listing[0], listing[1] or NOBODY
        terms = None if made is None else made.terms()
        if terms is None or (terms.allow_list_root, terms.allow_list_signer) != (root, signer):
            call = call_of(interface, launch.address, "setAllowList", root, signer)
            wanted.append(("the allow-list is set", call))
    there = {} if made is None or not icons else {icon.name: icon.scene for icon in icons_of(made)}
    missing = [each for each in icons if there.get(each[0]) != each[1]]
    if made is not None and missing and made.contract.call("isSealed"):
        raise InputError(f"{made.name} at {made.address} is sealed, and has no {missing[0][0]}: take another `salt`")
    wanted += [(f"{each[0]}: added", add_call(interface, launch.address, each, codes)) for each in missing]
    quotes = make_quotes(connection, [call for _, call in wanted], fees, known)
    return [Equipment(what, quote) for (what, _), quote in zip(wanted, quotes, strict=True)]
