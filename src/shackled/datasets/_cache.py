"""The folder in which fetched models and finished drawings are kept from run to run."""

from __future__ import annotations

import os
from pathlib import Path

from ..whole_file import write_whole

#: Names the folder, where it is set.
VARIABLE = "SHACKLED_CACHE"


def cache_folder() -> Path:
    """That of the variable SHACKLED_CACHE, or else the one that the system has for such files; it may not exist yet."""
    chosen = os.environ.get(VARIABLE)
    if chosen:
        return Path(chosen)
    import pooch

    return Path(pooch.os_cache("shackled"))


def keep(path: Path, data: bytes) -> None:
    """Writes a file of the cache, and its folder if need be. OSError if it cannot be written."""
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path, data)
