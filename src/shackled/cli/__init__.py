"""The command `shackled`."""

from __future__ import annotations

import sys
from typing import NoReturn


def main() -> NoReturn:
    """The entry point."""
    try:
        # to read all of it in takes a moment, in which people may think again
        from .app import run

        code = run()
    except KeyboardInterrupt:
        print("shackled: stopped", file=sys.stderr)
        code = 1
    sys.exit(code)


__all__ = ["main"]
