"""Scenes in the Studio: the items of the library, which are kept in the user's cache, and the author's own."""

from __future__ import annotations

import hashlib
import json
from functools import cache
from pathlib import Path

from platformdirs import user_cache_path

from .._load import load, locate
from ..datasets import Piece
from ..deploy import deployments
from ..scene import READERS
from ..studio import STUDIO, storage_address, store_scene
from ..tokens import token_scene
from ..whole_file import write_whole

#: Bytes of the digest in front of a file.
DIGEST = 32


def stored_scene(input: str) -> dict[bytes, bytes]:
    """Return the code of the contracts in which the Studio stores a scene, by address; the last is the scene itself.

    input: a piece of a dataset, a mesh or a scene file. The scene is that of `shackled store`.
    """
    source = locate(input)
    is_mesh = not isinstance(source, Piece) and source.suffix.lower() in READERS
    thing = token_scene(source) if isinstance(source, Piece) else source
    scene = load(thing, antialias=False if is_mesh else None)
    return {each.pointer: each.code for each in store_scene(scene, deployments([STUDIO])[-1].address)}


@cache
def library_codes(library: bytes, studio: bytes) -> dict[bytes, bytes]:
    """Return the code of the contracts in which the Studio stores the items of the library, by address.

    library: its address, another one whenever its items change. The first call on a machine takes seconds.
    """
    path = user_cache_path("shackled", appauthor=False) / f"library-{library.hex()[:16]}.bin"
    codes = _load(path)
    if codes is None:
        from ..library import items

        codes = [part.code for item in items() for part in item.transactions]
        _save(path, codes)
    return {storage_address(code[1:], studio): code for code in codes}


def _load(path: Path) -> list[bytes] | None:
    """Return what `_save` wrote; None if there is no such file, or it is damaged."""
    try:
        content = path.read_bytes()
    except OSError:
        return None
    if hashlib.sha256(content[DIGEST:]).digest() != content[:DIGEST]:
        return None
    return [bytes.fromhex(code) for code in json.loads(content[DIGEST:])]


def _save(path: Path, codes: list[bytes]) -> None:
    """Write a cache file; where that fails, the next process computes the items again."""
    content = json.dumps([code.hex() for code in codes]).encode()
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_whole(path, hashlib.sha256(content).digest() + content)
    except OSError:
        pass
