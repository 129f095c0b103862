"""What commands print: results on stdout, anything else on stderr, both in lines that are safe for a terminal."""

from __future__ import annotations

import re
import sys

from ..plain import plain


def tell(text: str) -> None:
    """Prints a line of the result."""
    print(plain(text), flush=True)


def say(text: str) -> None:
    """Prints a line that is no result."""
    print(plain(text), file=sys.stderr, flush=True)


def with_options(message: str) -> str:
    """Return a message of the library with options in place of its keywords, which it writes as `max_triangles=`."""
    return re.sub(r"\b([a-z]+(?:_[a-z]+)*)=(?=[\s,:;)]|$)", lambda match: f"--{match[1].replace('_', '-')}", message)
