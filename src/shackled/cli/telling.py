"""Printing of commands: results on stdout, anything else on stderr, both safe for a terminal."""

from __future__ import annotations

import sys

from ..untrusted import plain


def tell(text: str) -> None:
    """Print a line of the result on stdout."""
    print(plain(text), flush=True)


def say(text: str) -> None:
    """Print a line on stderr."""
    print(plain(text), file=sys.stderr, flush=True)
