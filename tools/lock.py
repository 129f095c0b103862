"""Write tools/locked: the exact version of each package with which the project is built and tested, and its hashes.

    python tools/lock.py              keeps the versions that are there, where pyproject.toml still allows them
    python tools/lock.py --upgrade    takes the newest ones; try them with `make clean test`

package.txt has what the package needs, and what builds it; dev.txt has also all extras and the dependency group "dev".
Both hold for each version of Python and each platform that the project supports: uv (`pip install uv`) resolves for all
of them at once. tools/prepare.py installs what the files list, and no more.
"""

from __future__ import annotations

import subprocess
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PROJECT = ROOT / "pyproject.toml"
LOCKED = ROOT / "tools" / "locked"
OLDEST_PYTHON = "3.11"
HEAD = "# Written by tools/lock.py.\n"


def main() -> None:
    """Write both files."""
    build = "\n".join(tomllib.loads(PROJECT.read_text("utf-8"))["build-system"]["requires"])
    # what both have is the same in both
    for name, more in (
        ("dev", ["--all-extras", "--group", f"{PROJECT}:dev"]),
        ("package", ["--constraints", LOCKED / "dev.txt"]),
    ):
        path = LOCKED / f"{name}.txt"
        options = ["--universal", "--python-version", OLDEST_PYTHON, "--generate-hashes", "--no-annotate"]
        written = ["--no-header", "--quiet", "--output-file", path, *sys.argv[1:]]
        command = [sys.executable, "-m", "uv", "pip", "compile", PROJECT, "-", *options, *more, *written]
        subprocess.run(command, input=build, text=True, check=True, stdout=subprocess.DEVNULL)
        path.write_text(HEAD + one_line_each(path.read_text("utf-8")), "utf-8")


def one_line_each(text: str) -> str:
    """Return requirements with their hashes in the same line."""
    return text.replace(" \\\n    ", " ")


if __name__ == "__main__":
    main()
