"""Mesh files of any format."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ...errors import InputError, InputWarning
from .._mesh import Mesh
from .gltf import read_gltf
from .obj import read_obj
from .off import read_off
from .ply import read_ply
from .stl import read_stl

#: A mesh, and fields of a `Material` that the file gives, by their names.
_Model = tuple[Mesh, dict[str, Any]]


def _without_material(read: Callable[[Path], Mesh]) -> Callable[[Path], _Model]:
    return lambda path: (read(path), {})


READERS: dict[str, Callable[[Path], _Model]] = {
    ".obj": _without_material(read_obj),
    ".ply": _without_material(read_ply),
    ".stl": _without_material(read_stl),
    ".glb": read_gltf,
    ".gltf": read_gltf,
    ".off": _without_material(read_off),
}


def read_mesh(path: str | os.PathLike[str]) -> Mesh:
    """Return the mesh of a file; see `read_model`."""
    return read_model(path)[0]


def read_model(path: str | os.PathLike[str]) -> _Model:
    """Return the mesh of a file, by its extension, and fields of a `Material` that the file gives, by their names.

    Vertices that are equal in position, colour and normal are one. An InputWarning tells what of the file is left out.
    InputError, one line that begins with the path, for anything that is wrong with the file.
    """
    path = Path(path)
    extension = path.suffix.lower()
    if extension not in READERS:
        raise InputError(f"{path} is not a mesh file that is known by its extension; known are {', '.join(READERS)}")
    try:
        return READERS[extension](path)
    except InputError as error:
        message = str(error)
        raise InputError(message if message.startswith(str(path)) else f"{path}: {message}") from None
    except InputWarning:  # where warnings are errors
        raise
    except Exception as error:  # what a library makes of a broken file may be of any class
        reason = " ".join(str(error).split())[:120] or type(error).__name__
        raise InputError(f"{path} is not a {extension[1:].upper()} file that can be read: {reason}") from None
