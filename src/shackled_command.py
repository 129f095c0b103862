"""The entry point of the command `shackled`, beside the package: loading that takes a moment, which Ctrl-C may end."""

from __future__ import annotations

import sys
from typing import NoReturn


def main() -> NoReturn:
    """Loads the command and runs it."""
    try:
        from shackled.cli import main as command
    except KeyboardInterrupt:
        print("shackled: stopped", file=sys.stderr)
        sys.exit(1)
    command()
