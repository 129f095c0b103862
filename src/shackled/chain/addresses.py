"""Addresses: how they are written, and where a contract stands on every chain."""

from __future__ import annotations

import re

from Crypto.Hash import keccak

from ..errors import InputError

#: The deterministic-deployment proxy, at the same address on every chain:
#: github.com/Arachnid/deterministic-deployment-proxy
PROXY = bytes.fromhex("4e59b44847b379578588920cA78FbF26c0B4956C")
#: What the addresses are made of, beside the code and the proxy.
SALT = bytes(32)


def create2_address(creation: bytes, salt: bytes = SALT) -> bytes:
    """Where the proxy puts the contract of some creation code, arguments of its constructor included (EIP-1014)."""
    return keccak256(b"\xff" + PROXY + salt + keccak256(creation))[12:]


def keccak256(data: bytes) -> bytes:
    """The hash of Ethereum."""
    return keccak.new(digest_bits=256, data=data).digest()


def show_address(address: bytes) -> str:
    """As people and tools write it: capitals are its checksum (EIP-55)."""
    digits = address.hex()
    marks = keccak256(digits.encode()).hex()
    return "0x" + "".join(
        digit.upper() if int(mark, 16) > 7 else digit for digit, mark in zip(digits, marks, strict=False)
    )


def parse_address(text: str, name: str) -> bytes:
    """The bytes of an address. InputError, which says `name`, if it is none or its capitals are not its checksum."""
    if not re.fullmatch("0x[0-9a-fA-F]{40}", text.strip()):
        raise InputError(f"{name} must be an address, 0x and 40 hexadecimal digits, not {text!r}")
    digits = text.strip()[2:]
    address = bytes.fromhex(digits)
    if digits not in (digits.lower(), digits.upper()) and show_address(address)[2:] != digits:
        raise InputError(f"{name} is mistyped, its capitals do not fit its digits: {text!r}")
    return address
