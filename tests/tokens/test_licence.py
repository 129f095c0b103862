from __future__ import annotations

from pathlib import Path

import pytest

from shackled.datasets import pieces, require
from shackled.errors import InputError
from shackled.tokens.licence import licence_of

FILE = Path("model.obj")


@pytest.mark.parametrize(
    "stated", ["CC0-1.0", "MIT", "CC BY 4.0", "CC-BY-SA-4.0", "my own  work", "Unlicense", "public domain"]
)
def test_what_allows_everything_is_taken(stated: str) -> None:
    assert licence_of(FILE, stated) == " ".join(stated.split())


@pytest.mark.parametrize(
    ("stated", "reason"),
    [
        ("CC BY-NC 4.0", "commercial"),
        ("CC-BY-NC-SA-3.0", "commercial"),
        ("free for non-commercial use", "commercial"),
        ("NonCommercial", "commercial"),
        ("research only", "commercial"),
        ("CC BY-ND 4.0", "changed copies"),
        ("no derivatives", "changed copies"),
        ("All rights reserved", "allows nothing"),
        ("none", "allows nothing"),
        ("unknown", "allows nothing"),
        (" ", "empty"),
        (None, "is for you to know"),
    ],
)
def test_what_forbids_it_is_refused(stated: str | None, reason: str) -> None:
    with pytest.raises(InputError, match=reason):
        licence_of(FILE, stated)


def test_pieces_bring_their_licence_along() -> None:
    assert licence_of(require("icons/glasses"), None) == "CC0"
    for piece in pieces("common"):
        if piece.commercial:
            assert licence_of(piece, None) == piece.licence
        else:
            with pytest.raises(InputError, match=f"{piece.name} must not be minted"):
                licence_of(piece, None)
