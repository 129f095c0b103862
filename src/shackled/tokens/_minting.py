"""The call that mints tokens: public, by allow list, by a signed permission (EIP-712), or from the reserve."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..base.untrusted import read_json
from ..deploy._quote import Call
from ..errors import InputError
from ..ethereum._abi import encode_values
from ..ethereum._encoding import checksum_address, parse_address, to_hex
from ._allow_list import AllowList
from ._collection import Collection
from ._icons import icon_at

if TYPE_CHECKING:
    from eth_account.signers.local import LocalAccount


def mint_call(
    collection: Collection,
    account: str,
    quantity: int,
    allow_list: AllowList | None = None,
    permission: Allowance | None = None,
    reserve_to: str | None = None,
    icon: int | None = None,
) -> Call:
    """Return the transaction with which an account mints.

    reserve_to: receiver of tokens from the reserve. icon: number of the icon, for collections of icons.
    Raises InputError if the allow list or the permission is not for this account and collection.
    """
    prepare, which = collection.contract.prepare, () if icon is None else (icon,)
    if reserve_to is not None:
        return prepare("mintReserve", *which, reserve_to, quantity)
    value = quantity * int(collection.contract.call("price") if icon is None else icon_at(collection, icon).price)
    if allow_list is not None:
        root = collection.contract.call("allowListRoot")
        if root != allow_list.root:
            raise InputError(
                f"the allow list has the root {to_hex(allow_list.root)}, but that of the collection is "
                f"{to_hex(root) if any(root) else 'none'}"
            )
        proven = allow_list.allowance(account), allow_list.proof(account)
        return prepare("mintWithProof", *which, quantity, *proven, value=value)
    if permission is not None:
        if permission.account != account:
            raise InputError(f"the permission is for {permission.account}, not for {account}")
        signed = permission.struct, permission.signature
        return prepare("mintWithSignature", *which, quantity, *signed, value=value)
    return prepare("mint", *which, quantity, value=value)


FIELDS = {"account": "address", "quantity": "uint256", "deadline": "uint256"}


@dataclass(frozen=True)
class Allowance:
    """A permission for one account, valid for one collection on one chain.

    quantity: number of tokens in all. deadline: last second in which it is valid, in Unix time.
    """

    account: str
    quantity: int
    deadline: int
    signature: bytes

    @property
    def struct(self) -> tuple[str, int, int]:
        """The struct Allowance of the contract."""
        return self.account, self.quantity, self.deadline

    def document(self) -> dict[str, Any]:
        """Return the permission for a JSON file."""
        return {
            "account": self.account,
            "quantity": str(self.quantity),
            "deadline": str(self.deadline),
            "signature": to_hex(self.signature),
        }


def sign_allowance(
    collection: Collection, signer: LocalAccount, account: str, quantity: int, deadline: int
) -> Allowance:
    """Sign a permission for an account, valid for this collection on its chain only."""
    from eth_account.messages import encode_typed_data

    domain = {
        "name": collection.kind.title,
        "version": "1",
        "chainId": collection.connection.chain_id,
        "verifyingContract": collection.address,
    }
    types = {"Allowance": [{"name": name, "type": kind} for name, kind in FIELDS.items()]}
    message = {"account": account, "quantity": quantity, "deadline": deadline}
    signed = signer.sign_message(encode_typed_data(domain, types, message))
    return Allowance(account, quantity, deadline, bytes(signed.signature))


def read_allowance(path: Path) -> Allowance:
    """Read a permission from a file. Raises InputError if it is invalid."""
    try:
        document = read_json(path.read_text("utf-8"))
        account = checksum_address(parse_address(document["account"], "its account"))
        signature = bytes.fromhex(document["signature"].removeprefix("0x"))
        allowance = Allowance(account, int(str(document["quantity"])), int(str(document["deadline"])), signature)
        encode_values(["(address,uint256,uint256)"], [allowance.struct])
        if not signature:
            raise ValueError
    except OSError as error:
        raise InputError(f"the permission {path} cannot be read: {error.strerror}") from None
    except (AttributeError, KeyError, RecursionError, TypeError, ValueError):
        raise InputError(f"{path} is not a permission as `shackled token permit` writes it") from None
    return allowance
