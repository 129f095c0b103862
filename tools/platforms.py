"""Check on which platforms the package installs from binary wheels, without a compiler.

    python -m tools.platforms            prints the table
    python -m tools.platforms --write    writes it into docs/install.md, too

Nothing is installed: uv (`pip install uv`) resolves the requirements for each platform and version of Python, from the
index of packages.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tomllib
from concurrent.futures import ThreadPoolExecutor

from tools.pages import ROOT, update

PAGE = ROOT / "docs" / "install.md"

#: Names of platforms, and what uv calls them.
PLATFORMS = {
    "Linux, glibc, x86-64": "x86_64-unknown-linux-gnu",
    "Linux, glibc, ARM64": "aarch64-unknown-linux-gnu",
    "Linux, musl, x86-64": "x86_64-unknown-linux-musl",
    "Linux, musl, ARM64": "aarch64-unknown-linux-musl",
    "macOS, Apple silicon": "aarch64-apple-darwin",
    "macOS, Intel": "x86_64-apple-darwin",
    "Windows, x86-64": "x86_64-pc-windows-msvc",
    "Windows, ARM64": "aarch64-pc-windows-msvc",
}
#: Needed only where it has wheels.
SIMPLIFIER = "fast-simplification"
VERSIONS = ("3.11", "3.12", "3.13", "3.14")


def requirements() -> dict[str, list[str]]:
    """Return the requirements of the package but that which has not all wheels, and that one, anywhere."""
    needed = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]["dependencies"]
    return {
        "package": [each for each in needed if not each.startswith(SIMPLIFIER)],
        SIMPLIFIER: [each.partition(";")[0] for each in needed if each.startswith(SIMPLIFIER)],
    }


def resolves(wanted: list[str], platform: str, version: str) -> bool:
    """Return whether wheels of all requirements, and of what those need, exist for a platform."""
    command = [sys.executable, "-m", "uv", "pip", "compile", "--quiet", "--only-binary", ":all:"]
    options = ["--python-platform", platform, "--python-version", version, "-"]
    return subprocess.run([*command, *options], input="\n".join(wanted), capture_output=True, text=True).returncode == 0


def table() -> str:
    """Return the table, a row for each platform, with the versions of Python for which wheels exist."""
    wanted = requirements()
    lines = [f"| CPython on | {' | '.join(wanted)} |", f"|---|{'---|' * len(wanted)}"]
    with ThreadPoolExecutor(16) as pool:
        found = {
            (name, column): [pool.submit(resolves, needed, platform, version) for version in VERSIONS]
            for name, platform in PLATFORMS.items()
            for column, needed in wanted.items()
        }
    for name in PLATFORMS:
        answers = [[each.result() for each in found[name, column]] for column in wanted]
        cells = [brief([v for v, is_found in zip(VERSIONS, row, strict=True) if is_found]) for row in answers]
        lines.append(f"| {name} | {' | '.join(cells)} |")
    return "\n".join(lines)


def brief(versions: list[str]) -> str:
    """Return versions as a range."""
    if len(versions) < 2:
        return versions[0] if versions else "no"
    return f"{versions[0]} to {versions[-1]}"


def main() -> int:
    """Print the table."""
    parser = argparse.ArgumentParser(description="Check on which platforms the package installs from binary wheels.")
    parser.add_argument("--write", action="store_true", help="write the table into docs/install.md")
    options = parser.parse_args()
    text = table()
    print(text)
    return update({PAGE: lambda name: text}, "python -m tools.platforms --write") if options.write else 0


if __name__ == "__main__":
    sys.exit(main())
