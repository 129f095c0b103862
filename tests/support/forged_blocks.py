"""Blocks that a lying node makes up."""

from __future__ import annotations

from typing import Any

import pytest

from shackled.errors import InputError
from shackled.ethereum import encode_header


def forged(block: dict[str, Any], **changes: str) -> dict[str, Any]:
    """A block with other fields, and the hash that belongs to them."""
    other = {key: value for key, value in block.items() if key != "hash"} | changes
    with pytest.raises(InputError, match="has the hash") as caught:
        encode_header(other)
    return other | {"hash": str(caught.value).partition("has the hash ")[2][:66]}
