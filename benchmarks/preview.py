"""Measure how long `shackled preview` takes from a save until tokens are shown.

    python -m benchmarks.preview

makes the project of docs/token-tutorial.md, starts its preview, saves another version of the contract, and prints the
seconds until the first 16 tokens and until all 256 are there. Needs Node and the compiler: npm ci in contracts/.
"""

from __future__ import annotations

import json
import re
import shlex
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Self
from urllib.request import urlopen

from tools import build_package
from tools.pages import ROOT

from . import run_main

PAGE = ROOT / "docs" / "token-tutorial.md"
MODULES = ROOT / "contracts" / "node_modules"
SOURCE = "src/Totems.sol"
FIRST, ALL = 16, 256
SAVES = 3


def make_project(folder: Path) -> None:
    """Write the files of the tutorial beside the packages that it installs."""
    text = PAGE.read_text("utf-8")
    for name, content in re.findall(r"^([\w./]+):\n\n```\w*\n(.*?)^```$", text, re.M | re.S):
        path = folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(content, "utf-8")
    modules = folder / "node_modules"
    modules.mkdir()
    for name in ("erc721a", "solady", "solc", ".bin"):
        (modules / name).symlink_to(MODULES / name)
    build_package.build(modules / "shackled-contracts")


def command() -> list[str]:
    """Return the arguments of the tutorial's preview."""
    match = re.search(rf"^shackled (preview {SOURCE} .*)$", PAGE.read_text("utf-8"), re.M)
    if match is None:
        raise SystemExit(f"{PAGE} has no command that previews {SOURCE}")
    return shlex.split(match[1])


class Server:
    """A preview of the project in a folder, which runs while the context is open."""

    def __init__(self, folder: Path) -> None:
        """Take the folder of the project."""
        self.folder = folder

    def __enter__(self) -> Self:
        program = [sys.executable, "-u", "-m", "shackled", *command(), "--port", "0", "--no-browser"]
        self.process = subprocess.Popen(
            program, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
        )
        lines = iter(self.process.stdout or ())
        self.url = next(filter(None, (re.search(r"http://[\d.:]+", line) for line in lines)))[0]
        return self

    def __exit__(self, *_: object) -> None:
        self.process.terminate()
        self.process.communicate()

    def messages(self) -> Iterator[dict[str, Any]]:
        """Yield what the server tells its pages."""
        with urlopen(f"{self.url}/events") as stream:
            for line in stream:
                if line.startswith(b"data: "):
                    yield json.loads(line[6:])


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
            if count in (FIRST, ALL):
                seconds[f"{count} tokens"] = passed
            if count == ALL:
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
