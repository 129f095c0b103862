"""The Genesis collection, and the pieces of other seeds."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ...errors import InputError
from ...ethereum import keccak256
from .. import Piece
from ._piece import GenesisPiece

COUNT = 1024


def seed_of(number: int) -> bytes:
    """Return the seed of a piece of the collection, from 0 to 1023."""
    if not 0 <= number < COUNT:
        raise InputError(f"the pieces of the collection are numbered from 0 to {COUNT - 1}, not {number}")
    return keccak256(f"shackled-{number}".encode("ascii"))


def parse_seed(text: str) -> bytes:
    """Return the seed of 64 hexadecimal digits, with or without 0x, or of the number of a piece."""
    if re.fullmatch(r"(0[xX])?[0-9a-fA-F]{64}", text):
        return bytes.fromhex(text[-64:])
    if re.fullmatch(r"0|[1-9][0-9]{0,3}", text) and int(text) < COUNT:
        return seed_of(int(text))
    raise InputError(
        f"a seed must be 64 hexadecimal digits, with or without 0x, or a number from 0 to {COUNT - 1}, not {text!r:.80}"
    )


def pieces() -> Iterator[Piece]:
    """Return the pieces of the collection."""
    return (_piece(str(number), seed_of(number)) for number in range(COUNT))


def find(name: str) -> Piece | None:
    """Return the piece of a number or seed, as `parse_seed` reads it; None if it is neither."""
    try:
        seed = parse_seed(name)
    except InputError:
        return None
    return _piece(name if len(name) < 64 else seed.hex(), seed)


def _piece(label: str, seed: bytes) -> Piece:
    title = f"Genesis {label}" if len(label) < 64 else f"Genesis {label[:8]}"
    return Piece(f"genesis/{label}", "genesis", title, "MIT", lambda: generate(seed).scene())


def generate(seed: bytes) -> GenesisPiece:
    """Generate the piece of a seed with the contract. RenderError for the rare seeds without a piece."""
    from ._contract import generate_on_chain

    return generate_on_chain(seed)[0]
