"""Meshes and scenes of the library trimesh, without importing it."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
from attrs import evolve
from numpy.typing import NDArray

from ..errors import InputError, InputWarning
from ._files.weld import weld
from ._mesh import Mesh
from ._object import Object


def is_trimesh(value: object) -> bool:
    """Return whether a value is an object of trimesh."""
    return type(value).__module__.partition(".")[0] == "trimesh"


def mesh_of(value: Any) -> Mesh:
    """Return the mesh of a trimesh.Trimesh, with the colours of its vertices, faces or texture.

    InputWarning if colours are not opaque. InputError if it is not a mesh, or empty.
    """
    if not is_trimesh(value) or not hasattr(value, "faces") or not hasattr(value, "vertices"):
        raise InputError(f"a trimesh.Trimesh is needed, not {value!r:.60}")
    visual: Any = getattr(value, "visual", None)
    kind = getattr(visual, "kind", None)
    if kind == "texture":
        visual = visual.to_color()
        kind = visual.kind
    if kind == "face":
        colors = np.repeat(_opaque(visual.face_colors)[:, None], 3, axis=1)
        return weld(value.vertices, value.faces, colors)
    return Mesh(value.vertices, value.faces, _opaque(visual.vertex_colors) if kind == "vertex" else None)


def objects_of(scene: Any) -> list[Object]:
    """Return the objects of a trimesh.Scene, one for each place in which a mesh stands.

    A matrix that is more than a scale, a rotation and a translation is applied to the vertices.
    """
    objects = []
    for name in scene.graph.nodes_geometry:
        matrix, geometry = scene.graph[name]
        whole = scene.geometry[geometry]
        if not hasattr(whole, "faces"):
            warnings.warn(f"{geometry} of the scene has no faces and is left out", InputWarning, stacklevel=2)
            continue
        objects.append(_placed(mesh_of(whole), np.asarray(matrix, dtype=np.float64)))
    return objects


def _placed(mesh: Mesh, matrix: NDArray[np.float64]) -> Object:
    try:
        return Object.from_matrix(mesh, matrix)
    except InputError:
        positions = mesh.positions @ matrix[:3, :3].T + matrix[:3, 3]
        mirrored = np.linalg.det(matrix[:3, :3]) < 0
        faces = mesh.faces[:, ::-1] if mirrored else mesh.faces
        return Object(evolve(mesh, positions=positions, faces=faces, normals=None))


def _opaque(colors: Any) -> NDArray[np.uint8]:
    """Return red, green and blue, (n, 3), of colours with alpha."""
    rows = np.asarray(colors, dtype=np.uint8)
    if rows.shape[1] > 3 and (rows[:, 3] != 255).any():
        warnings.warn("colours of the mesh are not opaque; their alpha is left out", InputWarning, stacklevel=3)
    return rows[:, :3]
