"""The call that mints tokens: public, by allow list, by a signed permission (EIP-712), or from the reserve."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import InputError
from ..ethereum import checksum_address, parse_address, to_hex
from ..untrusted import read_json
from ._allow_list import AllowList, read_allow_list
from ._collection import Collection
from ._contract import ContractCall
from ._icons import icon_at

if TYPE_CHECKING:
    from eth_account.signers.local import LocalAccount


def mint_call(
    collection: Collection,
    account: str,
    quantity: int,
    allow_list: Path | AllowList | None = None,
    permission: Path | Allowance | None = None,
    reserve_to: str | None = None,
    icon: int | None = None,
) -> ContractCall:
    """Return the call with which an account mints.

    reserve_to: receiver of tokens from the reserve. icon: number of the icon, for collections of icons.
    Raises InputError if the allow list or the permission is not for this account and collection.
    """
    which = () if icon is None else (icon,)
    if reserve_to is not None:
        return ContractCall("mintReserve", (*which, reserve_to, quantity))
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
        return ContractCall(
            "mintWithProof", (*which, quantity, listed.allowance(account), listed.proof(account)), value
        )
    if permission is not None:
        allowed = permission if isinstance(permission, Allowance) else read_allowance(permission)
        if allowed.account != account:
            raise InputError(f"the permission is for {allowed.account}, not for {account}")
        return ContractCall("mintWithSignature", (*which, quantity, allowed.struct, allowed.signature), value)
    return ContractCall("mint", (*which, quantity), value)


ALLOWANCE_FIELDS = [
    {"name": "account", "type": "address"},
    {"name": "quantity", "type": "uint256"},
    {"name": "deadline", "type": "uint256"},
]


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
    message = {"account": account, "quantity": quantity, "deadline": deadline}
    signed = signer.sign_message(encode_typed_data(domain, {"Allowance": ALLOWANCE_FIELDS}, message))
    return Allowance(account, quantity, deadline, bytes(signed.signature))


def read_allowance(path: Path) -> Allowance:
    """Read a permission from a file. Raises InputError if it is invalid."""
    try:
        document = read_json(path.read_text("utf-8"))
        account, quantity, deadline, signature = (
            str(document[name]) for name in ("account", "quantity", "deadline", "signature")
        )
    except OSError as error:
        raise InputError(f"the permission {path} cannot be read: {error.strerror}") from None
    except (ValueError, KeyError, TypeError, RecursionError):
        raise InputError(f"{path} is not a permission as `shackled token permit` writes it") from None
    if not (
        re.fullmatch("[0-9]{1,78}", quantity)
        and re.fullmatch("[0-9]{1,78}", deadline)
        and max(int(quantity), int(deadline)) < 2**256
        and re.fullmatch("0x([0-9a-fA-F]{2}){1,1024}", signature)
    ):
        raise InputError(f"{path} is not a permission: its quantity, deadline or signature is invalid")
    address = checksum_address(parse_address(account, f"the account of {path}"))
    return Allowance(address, int(quantity), int(deadline), bytes.fromhex(signature[2:]))
