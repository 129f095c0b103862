"""Blocks that a lying node makes up."""

from __future__ import annotations

from typing import Any

from shackled.ethereum._encoding import encode_header, keccak256, to_hex


def forged(block: dict[str, Any], **changes: str) -> dict[str, Any]:
    """A block with other fields, and the hash that belongs to them."""
    other = block | changes
    return other | {"hash": to_hex(keccak256(encode_header(other)))}
