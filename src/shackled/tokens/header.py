"""The header of a block in the form in which it is hashed: what reveals a round of tokens."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ..errors import InputError
from ..ethereum import keccak256

#: The fields in their order: as JSON-RPC names them, and how many bytes they have; 0 for a number, None for any length.
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
#: Those that forks have added since, the oldest first; a header has them up to that of its fork.
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
    """The header in RLP of a block as `eth_getBlockByNumber` tells it, values in hexadecimal, bytes or numbers.

    InputError if a field is missing, or if the hash is not the block's: its chain has fields that are not known here.
    """
    items = []
    for name, size in FIELDS.items():
        if block.get(name) is None:
            raise InputError(f"the node does not tell the {name} of block {_number(block)}: its header cannot be made")
        items.append(_field(block[name], size))
    for name, size in LATER_FIELDS.items():
        if block.get(name) is None:
            break
        items.append(_field(block[name], size))
    header = _list(items)
    found, said = keccak256(header), _field(block.get("hash") or b"", 32)
    if found != said:
        raise InputError(
            f"the header of block {_number(block)} has the hash 0x{found.hex()}, not 0x{said.hex()}:"
            " its chain has other fields than Ethereum's"
        )
    return header


def encode_values(values: Sequence[bytes | int]) -> bytes:
    """A list of bytes and numbers in RLP."""
    return _list([_minimal(value) if isinstance(value, int) else value for value in values])


def _number(block: Mapping[str, Any]) -> int:
    return int.from_bytes(_field(block.get("number") or 0, 0), "big")


def _field(value: Any, size: int | None) -> bytes:
    """A value as RLP wants it: a number without leading zeros, anything else as it is."""
    if isinstance(value, str):
        digits = value.removeprefix("0x")
        data = bytes.fromhex(digits if len(digits) % 2 == 0 else "0" + digits)
    else:
        data = _minimal(value) if isinstance(value, int) else bytes(value)
    return data.lstrip(b"\0") if size == 0 else data.rjust(size or 0, b"\0")


def _minimal(value: int) -> bytes:
    return value.to_bytes((value.bit_length() + 7) // 8, "big")


def _list(items: Sequence[bytes]) -> bytes:
    body = b"".join(map(_string, items))
    return _head(0xC0, len(body)) + body


def _string(data: bytes) -> bytes:
    return data if len(data) == 1 and data[0] < 0x80 else _head(0x80, len(data)) + data


def _head(kind: int, length: int) -> bytes:
    if length < 56:
        return bytes([kind + length])
    size = _minimal(length)
    return bytes([kind + 55 + len(size)]) + size
