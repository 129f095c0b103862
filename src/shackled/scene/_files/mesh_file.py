"""Mesh files of any format."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ...errors import InputError, InputWarning, warn
from .._mesh import Mesh
from .gltf.read import read_gltf
from .model import TEXTURED, MeshPart, baked
from .obj import read_obj
from .off import read_off
from .ply import read_ply
from .stl import read_stl


def _alone(read: Callable[[Path], Mesh]) -> Callable[[Path], list[MeshPart]]:
    return lambda path: [MeshPart(read(path), {})]


#: The extensions of glTF files.
GLTF = (".glb", ".gltf")

READERS: dict[str, Callable[..., list[MeshPart]]] = {
    ".obj": read_obj,
    ".ply": _alone(read_ply),
    ".stl": _alone(read_stl),
    **dict.fromkeys(GLTF, read_gltf),
    ".off": _alone(read_off),
}


def read_mesh(path: str | os.PathLike[str]) -> Mesh:
    """Return all of a mesh file as one mesh, with the colours of textures at its vertices; see `read_model`."""
    mesh, loses = baked(read_model(path))
    if loses:
        warn(f"{path}: {TEXTURED}")
    return mesh


def read_model(path: str | os.PathLike[str], **pose: Any) -> list[MeshPart]:
    """Return the meshes of a file, by its extension: one for each texture, and one for all that has none.

    Vertices that are equal in position, colour, normal and texture coordinates are one. An InputWarning tells what of
    the file is left out. pose: settings of `read_gltf`, for glTF files only. InputError, one line that
    begins with the path, for anything that is wrong with the file.
    """
    path = Path(path)
    extension = path.suffix.lower()
    if extension not in READERS:
        raise InputError(f"{path} is not a mesh file that is known by its extension; known are {', '.join(READERS)}")
    try:
        return READERS[extension](path, **pose)
    except InputError as error:
        message = str(error)
        raise InputError(message if message.startswith(str(path)) else f"{path}: {message}") from None
    except InputWarning:  # where warnings are errors
        raise
    except Exception as error:  # what a library makes of a broken file may be of any class
        reason = " ".join(str(error).split())[:120] or type(error).__name__
        raise InputError(f"{path} is not a {extension[1:].upper()} file that can be read: {reason}") from None
