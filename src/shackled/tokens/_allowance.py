"""Permissions to mint before the public sale: EIP-712 messages signed by the signer of a collection."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import InputError
from ..ethereum import checksum_address, parse_address, to_hex
from ..untrusted import read_json

if TYPE_CHECKING:
    from eth_account.signers.local import LocalAccount

    from ._collection import Collection

FIELDS = [
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
    signed = signer.sign_message(encode_typed_data(domain, {"Allowance": FIELDS}, message))
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
