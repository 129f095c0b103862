from __future__ import annotations

from pathlib import Path

import pytest

from shackled.datasets import pieces
from shackled.datasets._pieces import require
from shackled.errors import InputError
from shackled.tokens._icons import licence_of

FILE = Path("model.obj")


ALLOWED = "CC0-1.0; CC0; MIT; the MIT License; CC BY 4.0; CC-BY-SA-4.0; my own  work; Unlicense; public domain"
#: The last ones only sound as if they did, or ask for more than can be done on a chain.
NOT_ALLOWED = """CC BY-NC 4.0; CC-BY-NC-SA-3.0; free for non-commercial use; NonCommercial; research only; CC BY-ND 4.0;
no derivatives; All rights reserved; none; unknown; GPL-3.0; Stanford; editorial use only; not for sale; not MIT;
MIT, but not for sale; public domain, as claimed; CC0 since 2025, according to the press; CC; free"""


@pytest.mark.parametrize("stated", [*ALLOWED.split("; "), "Apache-2.0", "BSD-3-Clause", "0BSD"])
def test_what_allows_everything_is_taken(stated: str) -> None:
    assert licence_of(FILE, stated) == " ".join(stated.split())


@pytest.mark.parametrize("stated", [each.strip() for each in NOT_ALLOWED.split(";")])
def test_what_is_not_known_to_allow_it_is_refused(stated: str) -> None:
    with pytest.raises(InputError, match=r"must not be stored .* not known to allow commercial use of changed copies"):
        licence_of(FILE, stated)


@pytest.mark.parametrize("stated", [" ", None])
def test_a_licence_must_be_stated(stated: str | None) -> None:
    with pytest.raises(InputError, match="yourself, and state it with `licence`"):
        licence_of(FILE, stated)


def test_pieces_bring_their_licence_along() -> None:
    """Models whose licence is in dispute are refused."""
    assert licence_of(require("icons/glasses"), None) == "CC0"
    assert not any(require(name).commercial for name in ("nefertiti", "3dbenchy"))
    for piece in pieces("common"):
        if piece.commercial:
            assert licence_of(piece, None) == piece.licence
        else:
            words = f"^{piece.name} must not be stored: its licence .* is not known to allow"
            with pytest.raises(InputError, match=words):
                licence_of(piece, None)
