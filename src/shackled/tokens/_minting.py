"""The call that mints tokens: public, by allow list, by permission, or from the reserve."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..errors import InputError
from ._allow_list import AllowList, read_allow_list
from ._allowance import Allowance, read_allowance
from ._collection import Collection
from ._icons import icon_at


@dataclass(frozen=True)
class MintCall:
    """A function with its arguments. value: ether to send, in wei."""

    function: str
    arguments: tuple[Any, ...]
    value: int = 0


def mint_call(
    collection: Collection,
    account: str,
    quantity: int,
    allow_list: Path | AllowList | None = None,
    permission: Path | Allowance | None = None,
    reserve_to: str | None = None,
    icon: int | None = None,
) -> MintCall:
    """Return the call with which an account mints.

    reserve_to: receiver of tokens from the reserve. icon: number of the icon, for collections of icons.
    Raises InputError if the allow list or the permission is not for this account and collection.
    """
    which = () if icon is None else (icon,)
    if reserve_to is not None:
        return MintCall("mintReserve", (*which, reserve_to, quantity))
    price = collection.contract.call("price") if icon is None else icon_at(collection, icon).price
    value = quantity * int(price)
    if allow_list is not None:
        listed = allow_list if isinstance(allow_list, AllowList) else read_allow_list(allow_list)
        root = collection.contract.call("allowListRoot")
        if root != listed.root:
            actual = f"0x{root.hex()}" if any(root) else "none"
            raise InputError(
                f"the allow list has the root 0x{listed.root.hex()}, but that of the collection is {actual}"
            )
        return MintCall("mintWithProof", (*which, quantity, listed.allowance(account), listed.proof(account)), value)
    if permission is not None:
        allowed = permission if isinstance(permission, Allowance) else read_allowance(permission)
        if allowed.account != account:
            raise InputError(f"the permission is for {allowed.account}, not for {account}")
        return MintCall("mintWithSignature", (*which, quantity, allowed.struct, allowed.signature), value)
    return MintCall("mint", (*which, quantity), value)
