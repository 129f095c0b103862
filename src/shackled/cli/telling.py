"""What commands print: results on stdout, anything else on stderr, both in lines that are safe for a terminal."""

from __future__ import annotations

import sys

from ..plain import plain


def tell(text: str) -> None:
    """Prints a line of the result."""
    print(plain(text), flush=True)


def say(text: str) -> None:
    """Prints a line that is no result."""
    print(plain(text), file=sys.stderr, flush=True)
