"""A scene from a file of any kind."""

from __future__ import annotations

import os
from pathlib import Path

from ...errors import InputError
from .._scene import Scene
from .._staging import Look, stage
from .content import parse, read_text
from .mesh_file import READERS, read_mesh
from .original import is_original, original_scene
from .scene_file import scene_of
from .table import about

SCENES = (".toml", ".json")


def load(path: str | os.PathLike[str], look: Look | None = None) -> Scene:
    """Return the scene of a mesh or scene file, by its extension.

    A mesh is staged as `look` says; a scene file says itself how it looks. A JSON file with the key `canvasDim` is a
    scene of the original contracts, any other one of our own. InputError, one line that begins with the path, if
    anything is wrong.
    """
    path = Path(path)
    extension = path.suffix.lower()
    if extension in READERS:
        mesh = read_mesh(path)
        with about(str(path)):
            return stage(mesh, look)
    if extension not in SCENES:
        known = ", ".join((*READERS, *SCENES))
        if path.is_dir():
            raise InputError(f"{path} is a directory; a mesh or scene file is needed: {known}")
        raise InputError(f"{path} is neither a mesh nor a scene file by its extension; known are {known}")
    document = parse(path, read_text(path), extension)
    with about(str(path)):
        if extension == ".json" and is_original(document):
            return original_scene(document)
        return scene_of(document, path.parent)
