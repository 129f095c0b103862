"""Meshes of other libraries, such as Open3D, PyVista and meshio, told by their attributes, without importing any."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError, warn
from ._files.polygons import cut
from ._mesh import Mesh

#: Attributes with the faces of a mesh, and, for PyVista, each after its number of corners in one row.
_FACES = ("triangles", "regular_faces", "faces")
#: The kinds of cells of meshio that are surfaces, and how many of their vertices are corners; None for all.
_CELLS = {"triangle": 3, "quad": 4, "polygon": None}


def mesh_of(thing: Any) -> Mesh | None:
    """Return the mesh of an object with `vertices` or `points`, and `triangles`, `faces`, `regular_faces` or `cells`.

    None for any other object. Its vertex colours and normals are taken, if it has any. InputError as in `Mesh`, and
    for cells that are no surface; an InputWarning tells of those that are left out beside others.
    """
    points = next((found for name in ("vertices", "points") if (found := getattr(thing, name, None)) is not None), None)
    polygons = None if points is None or isinstance(thing, type) else _polygons(thing)
    if polygons is None:
        return None
    positions = np.asarray(points, dtype=np.float64)
    if positions.ndim == 2 and positions.shape[1] == 2:
        positions = np.pad(positions, ((0, 0), (0, 1)))
    numbers = np.concatenate([np.ravel(rows) for rows in polygons])
    triangles = cut(positions, [len(row) for rows in polygons for row in rows], numbers)
    colors, normals = (_of_vertices(thing, name, len(positions)) for name in ("vertex_colors", "vertex_normals"))
    return Mesh(positions, numbers[triangles[:, :3]], colors, normals)


def _of_vertices(thing: Any, name: str, count: int) -> NDArray[Any] | None:
    values = np.asarray(getattr(thing, name, None))
    return values if values.ndim == 2 and len(values) == count else None


def _polygons(thing: Any) -> list[NDArray[Any]] | None:
    """Return tables of polygons, each with the vertices of those of one size; None if there are none."""
    for name in _FACES:
        try:
            rows = np.asarray(getattr(thing, name))
        except (AttributeError, TypeError, ValueError):  # PyVista has regular faces only if all are of one size
            continue
        if rows.ndim == 2 and rows.size:
            return [rows]
        if rows.ndim == 1 and rows.size and rows.dtype.kind in "iu":
            return _padded(rows)
    if hasattr(thing, "extract_surface"):
        raise InputError("the mesh has no faces: give its surface, mesh.extract_surface()")
    blocks = [(str(each.type), each.data) for each in getattr(thing, "cells", ()) if hasattr(each, "data")]
    kinds = {kind: next((each for each in _CELLS if kind.startswith(each)), None) for kind, _ in blocks}
    others = [kind for kind, each in kinds.items() if each is None]
    found = [np.asarray(data)[:, : _CELLS[each]] for kind, data in blocks if (each := kinds[kind]) is not None]
    if blocks and not found:
        raise InputError(f"the mesh has no triangles, quads or polygons, only cells of the kinds {', '.join(others)}")
    if others:
        warn(f"cells of the mesh are left out, for they are no surface: {', '.join(others)}")
    return found or None


def _padded(row: NDArray[Any]) -> list[NDArray[Any]]:
    """Return the polygons of a row in which each stands after its number of corners."""
    found, at = list[NDArray[Any]](), 0
    while at < len(row):
        size = int(row[at])
        if size < 1 or at + 1 + size > len(row):
            raise InputError(f"the faces of a mesh in one row must each follow their number of corners, not {size}")
        found.append(row[None, at + 1 : at + 1 + size])
        at += 1 + size
    return found
