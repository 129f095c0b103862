"""Mesh files of any format."""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from ...base.checks import Flags
from ...base.values import plural
from ...errors import InputError, InputWarning, warn
from .._mesh import Mesh
from .content import format_of
from .gltf.read import read_gltf
from .model import TEXTURED, MeshPart, merged, seen
from .obj import read_obj
from .off import read_off
from .ply import read_ply
from .stl import read_stl

#: A triangle that is thinner than this part of its length has no area but by rounding.
_THIN = 1e-6

#: Where a message quotes numbers with commas.
_COMMAS = re.compile(r"'[^']*\d,[^']*'")

#: The extensions of glTF files.
GLTF = (".glb", ".gltf")

READERS: dict[str, Callable[..., list[MeshPart]]] = {
    ".obj": read_obj,
    ".ply": read_ply,
    ".stl": read_stl,
    **dict.fromkeys(GLTF, read_gltf),
    ".off": read_off,
}


def read_mesh(path: str | os.PathLike[str]) -> Mesh:
    """Return all of a mesh file as one mesh, with the colours of textures at its vertices; see `read_model`."""
    mesh, loses = merged(read_model(path))
    if loses:
        warn(f"{path}: {TEXTURED}")
    return mesh


def read_model(path: str | os.PathLike[str], **pose: Any) -> list[MeshPart]:
    """Return the meshes of a file, by its format: one for each texture, and one for all that has none.

    Vertices that are equal in position, colour, normal and texture coordinates are one. An InputWarning tells what of
    the file is left out. pose: settings of `read_gltf`, for glTF files only. InputError, one line that
    begins with the path, for anything that is wrong with the file.
    """
    path = Path(path)
    extension = format_of(path, with_note=True)
    if extension not in READERS:
        raise InputError(f"{path} is not a mesh file that is known by its extension; known are {', '.join(READERS)}")
    try:
        parts = READERS[extension](path, **pose)
        _check_areas([part.mesh for part in parts])
        return seen(parts, str(path))
    except InputError as error:
        message = str(error)
        if _COMMAS.search(message):
            message += "; numbers must be separated by spaces, and have a decimal point or none, no commas"
        raise InputError(message if message.startswith(str(path)) else f"{path}: {message}") from None
    except InputWarning:  # where warnings are errors
        raise
    except Exception as error:  # what a library makes of a broken file may be of any class
        reason = " ".join(str(error).split())[:120] or type(error).__name__
        raise InputError(f"{path} is not a {extension[1:].upper()} file that can be read: {reason}") from None


def _check_areas(meshes: list[Mesh]) -> None:
    """Refuse a file of which no triangle has an area."""
    if all(_is_thin(mesh).all() for mesh in meshes):
        count = sum(mesh.triangles for mesh in meshes)
        raise InputError(f"there is nothing to see: its {plural(count, 'triangle has', 'triangles have')} no area")


@np.errstate(all="ignore")
def _is_thin(mesh: Mesh) -> Flags:
    # halved, for the difference of two numbers may be beyond the largest
    a, b, c = (mesh.positions / 2)[mesh.faces].transpose(1, 0, 2)
    edges = np.stack([b - a, c - b, a - c])
    edges /= np.abs(edges).max(axis=(0, 2))[None, :, None]
    # a triangle whose corners are one point has none, which is not above the bound
    return np.asarray(~(np.linalg.norm(np.cross(edges[0], edges[1]), axis=1) > _THIN))
