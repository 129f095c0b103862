"""A scene from a file of any kind."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ...errors import InputError
from ...json_text import read_json, read_toml
from ..scene import Scene
from ..staging import Look, stage
from .content import read_text
from .mesh_file import READERS, read_mesh
from .original import is_original, original_scene
from .scene_file import scene_of
from .table import about

SCENES = (".toml", ".json")


def load(path: str | os.PathLike[str], look: Look | None = None) -> Scene:
    """The scene of a mesh or scene file, by its extension.

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
    document = _document(path, extension)
    with about(str(path)):
        if extension == ".json" and is_original(document):
            return original_scene(document)
        return scene_of(document, path.parent)


def _document(path: Path, extension: str) -> Mapping[str, Any]:
    text = read_text(path)
    try:
        document = read_toml(text) if extension == ".toml" else read_json(text)
    except ValueError as error:
        raise InputError(f"{path} is not valid {extension[1:].upper()}: {' '.join(str(error).split())}") from None
    if not isinstance(document, Mapping):
        raise InputError(f"{path} must hold an object with the keys of a scene, not {document!r:.60}")
    return document
