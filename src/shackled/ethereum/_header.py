"""RLP encoding of block headers, whose hash is that of the block. Revealing tokens needs them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..errors import InputError
from ._encoding import keccak256, to_hex

#: Fields in order: name in JSON-RPC, and size in bytes; 0 for a number, None for any length.
FIELDS: dict[str, int | None] = {
    "parentHash": 32,
    "sha3Uncles": 32,
    "miner": 20,
    "stateRoot": 32,
    "transactionsRoot": 32,
    "receiptsRoot": 32,
    "logsBloom": 256,
    "difficulty": 0,
    "number": 0,
    "gasLimit": 0,
    "gasUsed": 0,
    "timestamp": 0,
    "extraData": None,
    "mixHash": 32,
    "nonce": 8,
}
#: Fields that forks have added, the oldest first; a header has those up to its fork.
LATER_FIELDS: dict[str, int | None] = {
    "baseFeePerGas": 0,
    "withdrawalsRoot": 32,
    "blobGasUsed": 0,
    "excessBlobGas": 0,
    "parentBeaconBlockRoot": 32,
    "requestsHash": 32,
    "blockAccessListHash": 32,
}


def encode_header(block: Mapping[str, Any]) -> bytes:
    """Encode the header of a block, as `eth_getBlockByNumber` returns it, in RLP.

    Values may be hexadecimal, bytes or numbers. Raises InputError if a field is missing, or if the hash differs from
    the block's, because its chain has other fields.
    """
    items = []
    for name, size in (FIELDS | LATER_FIELDS).items():
        if block.get(name) is None:
            if name in LATER_FIELDS:
                break
            raise InputError(f"the node returned no {name} of block {_number(block)}, so its header cannot be encoded")
        items.append(_field(block[name], size))
    body = b"".join(_rlp(each) for each in items)
    header = _length(len(body), 0xC0) + body
    found, expected = keccak256(header), _field(block.get("hash") or b"", 32)
    if found != expected:
        raise InputError(
            f"the header of block {_number(block)} has the hash {to_hex(found)}, not {to_hex(expected)}:"
            " its chain has other fields than Ethereum's"
        )
    return header


def _number(block: Mapping[str, Any]) -> int:
    return int.from_bytes(_field(block.get("number") or 0, 0), "big")


def _field(value: Any, size: int | None) -> bytes:
    """Return the bytes of a field: a number without leading zeros, anything else in full length."""
    if isinstance(value, str):
        digits = value.removeprefix("0x")
        data = bytes.fromhex(digits.rjust(len(digits) + len(digits) % 2, "0"))
    elif isinstance(value, int):
        data = value.to_bytes(-(-value.bit_length() // 8), "big")
    else:
        data = bytes(value)
    return data.lstrip(b"\0") if size == 0 else data.rjust(size or 0, b"\0")


def _rlp(data: bytes) -> bytes:
    """Encode bytes in RLP."""
    return data if len(data) == 1 and data[0] < 0x80 else _length(len(data), 0x80) + data


def _length(length: int, base: int) -> bytes:
    """Return what precedes so many bytes in RLP. base: 0x80 for bytes, 0xC0 for a list."""
    if length <= 55:
        return bytes([base + length])
    size = length.to_bytes(-(-length.bit_length() // 8), "big")
    return bytes([base + 55 + len(size)]) + size
