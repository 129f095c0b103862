"""A scene from a file, or from a dataset."""

from __future__ import annotations

import os
from pathlib import Path

from .checks import instance
from .datasets import Piece, find, require
from .errors import InputError
from .scene.files.load import SCENES
from .scene.files.load import load as load_file
from .scene.files.mesh_file import READERS
from .scene.scene import Scene
from .scene.staging import Look


def load(input: str | os.PathLike[str], look: Look | None = None) -> Scene:
    """The scene of a mesh file, a scene file, or a piece of a dataset, such as "teapot" or "genesis/12".

    A file wins over a piece of the same name. A mesh is staged as `look` says; scene files and pieces say themselves
    how they look, and take none. InputError, one line, if there is no such thing or anything is wrong with it.
    """
    source = locate(input)
    if look is not None:
        instance(look, "the look of a mesh", Look)
        if isinstance(source, Piece) or source.suffix.lower() in SCENES:
            raise InputError(f"{input} says itself how it looks: leave out the look, which is for mesh files")
    return source.make() if isinstance(source, Piece) else load_file(source, look)


def locate(input: str | os.PathLike[str]) -> Path | Piece:
    """The file, or else the piece, that is meant."""
    if not isinstance(input, str | os.PathLike):
        raise InputError(
            f"a Scene, the path of a file or the name of a piece is needed, not {input!r:.60}; "
            "stage(mesh), of shackled.scene.staging, makes the Scene of a Mesh"
        )
    path = Path(input)
    name = input if isinstance(input, str) else path.as_posix()
    if path.suffix.lower() in (*READERS, *SCENES) or os.path.isfile(path):
        return path
    piece = find(name)
    if piece is not None:
        return piece
    if path.suffix or os.path.exists(path):
        return path  # whose extension or kind is the mistake
    try:
        return require(name)
    except InputError as error:
        raise InputError(f"{name} does not exist, and {error}") from None
