"""The command `shackled`."""

from __future__ import annotations

import os
import sys
from typing import NoReturn


def main() -> NoReturn:
    """Run the command and exit."""
    for name in ("stdout", "stderr"):
        # it may have been closed before the start
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115
    try:
        # imports take a moment, in which Ctrl-C must work
        from .app import run

        code = run()
    except KeyboardInterrupt:
        print("shackled: stopped", file=sys.stderr)
        code = 1
    sys.exit(code)


__all__ = ["main"]
