"""The folder in which downloaded models and rendered pictures are cached."""

from __future__ import annotations

import os
from pathlib import Path

from ..whole_file import write_whole

#: Names the folder, where it is set.
VARIABLE = "SHACKLED_CACHE"


def cache_folder() -> Path:
    """Return the folder given by SHACKLED_CACHE, else the system's cache folder; it may not exist yet."""
    chosen = os.environ.get(VARIABLE)
    if chosen:
        return Path(chosen)
    import pooch

    return Path(pooch.os_cache("shackled"))


def keep(path: Path, data: bytes) -> None:
    """Write a file of the cache, and create its folder if necessary. OSError if it cannot be written."""
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path, data)
