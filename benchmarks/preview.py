"""Measure how long `shackled preview` takes from a save until tokens are shown.

    python -m benchmarks.preview

makes the project of docs/token-tutorial.md, starts its preview, saves another version of the contract, and prints the
seconds until the first 16 tokens and until all 256 are there. Needs Node and the compiler: npm ci in contracts/.
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from tools.tokens.tutorial import SOURCE, TOKENS, Server, make_project

from . import run_main

FIRST, SAVES = 16, 3


def seconds_of_a_save(told: Iterator[dict[str, Any]], source: Path) -> dict[str, float]:
    """Save the source, and return the seconds until it is compiled and until tokens are there."""
    version = 0
    source.write_text(f"{source.read_text('utf-8')}// saved\n", "utf-8")
    started, seconds, count = time.monotonic(), {}, 0
    for message in told:
        passed = time.monotonic() - started
        if message.get("status") == "compiling":
            version, count = message["version"], 0
        if message["version"] != version:
            continue
        if message.get("status") == "failed":
            raise SystemExit(message["error"])
        if message.get("status") == "drawing":
            seconds["compiled and deployed"] = passed
        if "token" in message:
            count += 1
            if count in (FIRST, TOKENS):
                seconds[f"{count} tokens"] = passed
            if count == TOKENS:
                break
    return seconds


def main() -> int:
    """Measure, and print each save."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        make_project(folder)
        with Server(folder) as server:
            told = server.messages()
            for message in told:
                if message.get("status") == "done":
                    break
            for number in range(1, SAVES + 1):
                found = seconds_of_a_save(told, folder / SOURCE)
                print(f"save {number}: " + ", ".join(f"{what} after {each:.1f} s" for what, each in found.items()))
    return 0


if __name__ == "__main__":
    run_main(main)
