"""Addresses: how they are written, and where contracts are that were created with CREATE2."""

from __future__ import annotations

import re

from ..errors import InputError
from ._data import keccak256

#: The deterministic-deployment proxy, at the same address on every chain:
#: github.com/Arachnid/deterministic-deployment-proxy
PROXY = bytes.fromhex("4e59b44847b379578588920cA78FbF26c0B4956C")
#: The salt of contracts of which there is one on each chain.
SALT = bytes(32)


def create2_address(creation: bytes, salt: bytes = SALT, creator: bytes = PROXY) -> bytes:
    """Return where CREATE2 puts a contract (EIP-1014).

    creation: the creation code, followed by the arguments of the constructor. creator: the contract that creates it.
    """
    return keccak256(b"\xff" + creator + salt + keccak256(creation))[12:]


def checksum_address(address: bytes) -> str:
    """Write an address with a checksum in its capitals (EIP-55)."""
    from eth_utils.address import to_checksum_address

    return str(to_checksum_address(address))


def parse_address(text: str, name: str) -> bytes:
    """Return the bytes of an address.

    Raises InputError, which says `name`, if it is none or its capitals are not its checksum.
    """
    if not re.fullmatch("0x[0-9a-fA-F]{40}", text.strip()):
        raise InputError(f"{name} must be an address, 0x and 40 hexadecimal digits, not {text!r}")
    digits = text.strip()[2:]
    address = bytes.fromhex(digits)
    if digits not in (digits.lower(), digits.upper()) and checksum_address(address)[2:] != digits:
        raise InputError(f"{name} is mistyped, its capitals do not fit its digits: {text!r}")
    return address
