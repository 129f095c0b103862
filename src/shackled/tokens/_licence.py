"""Whether a licence allows what minting does: to publish a changed copy for ever, and to sell it."""

from __future__ import annotations

import re
from pathlib import Path

from ..datasets import Piece
from ..errors import InputError

#: The licences that surely allow it, as people write them: in small letters, with single spaces between the words.
ALLOWED = re.compile(
    r"my own work|own work|public domain|cc ?0( 1\.0)?( universal)?|cc by( sa)?( [1-4]\.0)?( international)?"
    r"|(the )?mit( 0)?( licen[cs]e)?|apache( licen[cs]e)?( 2(\.0)?)|0 ?bsd|bsd [0-3] clause( licen[cs]e)?"
    r"|isc( licen[cs]e)?|zlib( licen[cs]e)?|(the )?unlicense|wtfpl"
)
EXAMPLES = "CC0-1.0, public domain, CC-BY-4.0, CC-BY-SA-4.0, MIT, BSD-3-Clause, Apache-2.0"


def licence_of(source: Path | Piece, stated: str | None) -> str:
    """Return the licence under which an object is minted; nobody can take it back from a chain.

    Pieces of datasets bring theirs along; of a file its user states it. InputError where it may forbid minting.
    """
    if isinstance(source, Piece):
        if stated is not None:
            raise InputError(f"`licence` is for files: that of {source.name} is known, {source.licence}")
        if not (source.commercial and allows(source.licence)):
            raise InputError(
                f"{source.name} must not be minted: its licence ({source.licence}) is not known to allow commercial "
                "use of changed copies, and what is on a chain can never be taken back"
            )
        return source.licence
    if stated is None:
        raise InputError(
            f"check the licence of {source} yourself, and state it with `licence`, for instance CC0-1.0 or "
            "'my own work'"
        )
    words = " ".join(stated.split())
    if not words:
        raise InputError("`licence` is empty: state it, for instance CC0-1.0 or 'my own work'")
    if not allows(words):
        raise InputError(
            f"{source} must not be minted under the licence {words!r}: it is not known to allow commercial use of "
            f"changed copies, as {EXAMPLES} do; of what you made yourself, state 'my own work'"
        )
    return words


def allows(licence: str) -> bool:
    """Return whether a licence is one of those that surely allow it."""
    return ALLOWED.fullmatch(re.sub(r"[\s_-]+", " ", licence.lower()).strip()) is not None
