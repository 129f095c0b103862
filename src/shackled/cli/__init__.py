"""The command `shackled`."""

from __future__ import annotations

import os
import sys
from typing import NoReturn


def main() -> NoReturn:
    """The entry point."""
    for name in ("stdout", "stderr"):
        # one that was closed before the start
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115
    try:
        # to read all of it in takes a moment, in which people may think again
        from .app import run

        code = run()
    except KeyboardInterrupt:
        print("shackled: stopped", file=sys.stderr)
        code = 1
    sys.exit(code)


__all__ = ["main"]
