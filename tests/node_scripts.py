"""Scripts for Node that answer a file of JSON lines with a file of byte strings."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Sequence
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any


def answers(script: Path, bundle: Traversable, lines: Sequence[dict[str, Any]], folder: Path) -> list[bytes]:
    """Run a script with a bundle; return what it writes, each with its length in four bytes before it."""
    asked, written = folder / "lines", folder / "answers"
    asked.write_text("".join(f"{json.dumps(line)}\n" for line in lines))
    subprocess.run(["node", script, str(bundle), asked, written], check=True)
    data, place, found = written.read_bytes(), 0, []
    while place < len(data):
        end = place + 4 + int.from_bytes(data[place : place + 4], "big")
        found.append(data[place + 4 : end])
        place = end
    return found
