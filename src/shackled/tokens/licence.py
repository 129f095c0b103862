"""Whether a licence allows what minting does: to publish a changed copy for ever, and to sell it."""

from __future__ import annotations

import re
from pathlib import Path

from ..datasets import Piece
from ..errors import InputError

#: What licences forbid, as they word it, and what that means here.
FORBIDDEN = {
    r"\bnc\b|non-?\s?commercial|not for commercial|research (use )?only|personal use|educational use": (
        "it does not allow commercial use"
    ),
    r"\bnd\b|no-?\s?deriv": "it does not allow changed copies, and what is kept on chain is one",
    r"all rights reserved|proprietary|\bnone\b|unknown|unlicen[sc]ed\b(?!.*public domain)": "it allows nothing",
}


def licence_of(source: Path | Piece, stated: str | None) -> str:
    """The licence under which an object is minted; nobody can take it back from a chain.

    Pieces of datasets bring theirs along; of a file its user states it. InputError where it forbids minting.
    """
    if isinstance(source, Piece):
        if stated is not None:
            raise InputError(f"--licence is for files: that of {source.name} is known, {source.licence}")
        if not source.commercial:
            raise InputError(
                f"{source.name} must not be minted: its licence ({source.licence}) does not allow commercial use, and "
                "what is on a chain can never be taken back"
            )
        return source.licence
    if stated is None:
        raise InputError(
            f"the licence of {source} is for you to know: state it, for instance --licence CC0-1.0, "
            "or --licence 'my own work'"
        )
    words = " ".join(stated.split())
    if not words:
        raise InputError("--licence is empty: state the licence, for instance CC0-1.0, or 'my own work'")
    for pattern, reason in FORBIDDEN.items():
        if words.lower() not in ("unlicense", "the unlicense") and re.search(pattern, words.lower()):
            raise InputError(f"{source} must not be minted under the licence {words!r}: {reason}")
    return words
