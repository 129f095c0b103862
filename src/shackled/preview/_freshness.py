"""Whether a compiler made an artifact of the sources as they are now."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ..ethereum import keccak256


def changed_source(root: Path, hashes: Mapping[str, str], artifact: Path, source: str) -> str | None:
    """Return the name of a source that an artifact was not made of as it is now; None if there is none.

    root: folder of the project, below which sources are named. hashes: Keccak-256 of each source as it was compiled, by
    its name; they decide. Where that of `source`, the file of the contract, is missing, the times of the files decide.
    Sources that are not below the project are not compared.
    """
    for name, expected in hashes.items():
        path = root / name
        if path.is_file():
            content = path.read_bytes()
            # forge compiles with the ends of lines of Unix
            if expected not in {f"0x{keccak256(each).hex()}" for each in (content, content.replace(b"\r\n", b"\n"))}:
                return name
    is_older = source not in hashes and artifact.stat().st_mtime_ns < (root / source).stat().st_mtime_ns
    return source if is_older else None
