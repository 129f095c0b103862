"""The project of docs/token-tutorial.md, and its preview."""

from __future__ import annotations

import json
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Self
from urllib.request import urlopen

from tools import build_package
from tools.pages import ROOT

PAGE = ROOT / "docs" / "token-tutorial.md"
MODULES = ROOT / "contracts" / "node_modules"
SOURCE = "src/Totems.sol"
#: The number of its tokens.
TOKENS = 256


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
