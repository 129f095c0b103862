"""Bytes as Ethereum writes, hashes and charges for them."""

from __future__ import annotations

from Crypto.Hash import keccak


def to_hex(data: bytes) -> str:
    """Return bytes as JSON-RPC writes them: 0x and two hexadecimal digits each."""
    return "0x" + data.hex()


def word(value: int | bytes) -> bytes:
    """Return a number, or at most 32 bytes such as an address, as a word of the ABI: 32 bytes, filled on the left."""
    return value.to_bytes(32, "big") if isinstance(value, int) else value.rjust(32, b"\0")


def keccak256(data: bytes) -> bytes:
    """Hash data with Ethereum's hash function."""
    # not by eth_utils, whose import takes a tenth of a second
    return keccak.new(digest_bits=256, data=data).digest()


def intrinsic_gas(data: bytes) -> int:
    """Return what a transaction with this data costs before anything is executed, by the rules of Cancun."""
    zeros = data.count(0)
    return 21_000 + 4 * zeros + 16 * (len(data) - zeros)
