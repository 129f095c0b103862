"""Hexadecimal text, ABI words, hashes, addresses, the intrinsic gas of data, and the RLP of block headers."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from Crypto.Hash import keccak

from ..errors import InputError

#: The deterministic-deployment proxy, at the same address on every chain:
#: github.com/Arachnid/deterministic-deployment-proxy
PROXY = bytes.fromhex("4e59b44847b379578588920cA78FbF26c0B4956C")
#: The salt of contracts that exist once on each chain.
SALT = bytes(32)


def to_hex(data: bytes) -> str:
    """Write bytes as hexadecimal digits after 0x."""
    return "0x" + data.hex()


def word(value: int | bytes) -> bytes:
    """Encode a number, or up to 32 bytes such as an address, as an ABI word: 32 bytes, padded on the left."""
    return value.to_bytes(32, "big") if isinstance(value, int) else value.rjust(32, b"\0")


def keccak256(data: bytes) -> bytes:
    """Return the Keccak-256 hash of data, 32 bytes."""
    return keccak.new(digest_bits=256, data=data).digest()


def intrinsic_gas(data: bytes) -> int:
    """Return the gas of a transaction before its execution, from its data, by the rules of Cancun."""
    zeros = data.count(0)
    return 21_000 + 4 * zeros + 16 * (len(data) - zeros)


def create2_address(creation: bytes, salt: bytes = SALT, creator: bytes = PROXY) -> bytes:
    """Return the address of a contract that CREATE2 creates (EIP-1014).

    creation: creation code followed by the constructor's arguments. creator: the contract that executes CREATE2.
    """
    return keccak256(b"\xff" + creator + salt + keccak256(creation))[12:]


def checksum_address(address: bytes) -> str:
    """Write an address with the checksum of EIP-55, which is in its capitals."""
    digits = address.hex()
    marks = keccak256(digits.encode()).hex()
    capital = (each.upper() if mark > "7" else each for each, mark in zip(digits, marks, strict=False))
    return f"0x{''.join(capital)}"


def parse_address(text: str, name: str) -> bytes:
    """Return the 20 bytes of an address. Raises InputError, which names `name`, if the text or checksum is invalid."""
    if not re.fullmatch("0x[0-9a-fA-F]{40}", text.strip()):
        raise InputError(f"{name} must be an address, 0x and 40 hexadecimal digits, not {text!r}")
    digits = text.strip()[2:]
    address = bytes.fromhex(digits)
    if digits not in (digits.lower(), digits.upper()) and checksum_address(address)[2:] != digits:
        raise InputError(f"{name} has an invalid checksum, its capitals do not match its digits: {text!r}")
    return address


PUSH1, PUSH32 = 0x60, 0x7F


def instructions(code: bytes) -> list[int]:
    """Return the positions of the instructions of a code, without pushed values."""
    places, at = [], 0
    while at < len(code):
        places.append(at)
        at += 1 + (code[at] - PUSH1 + 1 if PUSH1 <= code[at] <= PUSH32 else 0)
    return places


#: The fields of a header in JSON-RPC, in order.
HEADER_FIELDS = (
    *("parentHash", "sha3Uncles", "miner", "stateRoot", "transactionsRoot", "receiptsRoot", "logsBloom", "difficulty"),
    *("number", "gasLimit", "gasUsed", "timestamp", "extraData", "mixHash", "nonce"),
)
#: Fields that forks have added, the oldest first; a header has those up to its fork.
LATER_FIELDS = (
    *("baseFeePerGas", "withdrawalsRoot", "blobGasUsed", "excessBlobGas", "parentBeaconBlockRoot", "requestsHash"),
    "blockAccessListHash",
)
#: Fields that are numbers, which RLP has without leading zeros.
NUMBERS = {"difficulty", "number", "gasLimit", "gasUsed", "timestamp", "baseFeePerGas", "blobGasUsed", "excessBlobGas"}


def encode_header(block: Mapping[str, Any]) -> bytes:
    """Encode the header of a block, as `eth_getBlockByNumber` returns it, in RLP; its hash is that of the block.

    Raises InputError, which names the field, if one is missing or is not hexadecimal.
    """
    items = []
    for name in HEADER_FIELDS + LATER_FIELDS:
        value = block.get(name)
        if value is None and name in LATER_FIELDS:
            break
        if not isinstance(value, str) or not re.fullmatch("0x[0-9a-fA-F]*", value):
            raise InputError(f"the header of a block cannot be encoded: its {name} is {value!r:.60}, not hexadecimal")
        data = bytes.fromhex("0" * (len(value) % 2) + value[2:])
        items.append(data.lstrip(b"\0") if name in NUMBERS else data)
    body = b"".join(map(_rlp, items))
    return _length(len(body), 0xC0) + body


def _rlp(data: bytes) -> bytes:
    return data if len(data) == 1 and data[0] < 0x80 else _length(len(data), 0x80) + data


def _length(length: int, base: int) -> bytes:
    """Return what precedes so many bytes in RLP. base: 0x80 for bytes, 0xC0 for a list."""
    if length <= 55:
        return bytes([base + length])
    size = length.to_bytes(-(-length.bit_length() // 8), "big")
    return bytes([base + 55 + len(size)]) + size
