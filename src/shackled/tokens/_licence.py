"""Check of licences: minting publishes a changed copy permanently, and may sell it."""

from __future__ import annotations

import re
from pathlib import Path

from ..datasets import Piece
from ..errors import InputError
from ..scene import Link

#: Licences that allow it, in lower case, with single spaces between the words.
ALLOWED_LICENCES = re.compile(
    r"my own work|own work|public domain|cc ?0( 1\.0)?( universal)?|cc by( sa)?( [1-4]\.0)?( international)?"
    r"|(the )?mit( 0)?( licen[cs]e)?|apache( licen[cs]e)?( 2(\.0)?)|0 ?bsd|bsd [0-3] clause( licen[cs]e)?"
    r"|isc( licen[cs]e)?|zlib( licen[cs]e)?|(the )?unlicense|wtfpl"
)
EXAMPLES = "CC0-1.0, public domain, CC-BY-4.0, CC-BY-SA-4.0, MIT, BSD-3-Clause, Apache-2.0"


def licence_of(source: Path | Piece | Link, stated: str | None) -> str:
    """Return the licence of an object that is to be minted: that of a dataset piece, or `stated` for a file.

    Raises InputError if it is not known to allow minting, which cannot be undone.
    """
    if isinstance(source, Piece):
        if stated is not None:
            raise InputError(f"`licence` is for files: {source.name} has the licence {source.licence}")
        if not (source.commercial and allows(source.licence)):
            raise InputError(
                f"{source.name} must not be minted: its licence ({source.licence}) is not known to allow commercial "
                "use of changed copies, and nothing can be removed from a chain"
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
            f"changed copies, as {EXAMPLES} do; if you made it yourself, state 'my own work'"
        )
    return words


def allows(licence: str) -> bool:
    """Return whether a licence is known to allow minting."""
    return ALLOWED_LICENCES.fullmatch(re.sub(r"[\s_-]+", " ", licence.lower()).strip()) is not None
