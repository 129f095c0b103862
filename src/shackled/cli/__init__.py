"""The command `shackled`."""

from __future__ import annotations

import os
import sys
from typing import NoReturn


def main() -> NoReturn:
    """Run the command and exit with its code."""
    for name in ("stdout", "stderr"):
        # None if it was closed before the start
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115
    try:
        # imports take a moment, during which Ctrl-C must work
        from .app import run

        code = run()
    except KeyboardInterrupt:
        print("shackled: stopped", file=sys.stderr)
        code = 1
    sys.exit(code)


__all__ = ["main"]
