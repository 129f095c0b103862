"""Meshes and scenes of the library trimesh, without importing it."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
from attrs import evolve
from numpy.typing import NDArray

from ..errors import InputError, InputWarning
from ._files.colors import to_srgb
from ._files.model import MeshPart, Picture, finite_uvs
from ._files.weld import weld
from ._material import Material
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


def part_of(value: Any) -> MeshPart:
    """Return the mesh of a trimesh.Trimesh, and its texture as a field of a `Material`, if it has one. Errors as in
    `mesh_of`.
    """
    visual: Any = getattr(value, "visual", None)
    uvs = getattr(visual, "uv", None)
    if not is_trimesh(value) or getattr(visual, "kind", None) != "texture" or uvs is None:
        return MeshPart(mesh_of(value), {})
    material = visual.material
    image, color = getattr(material, "baseColorTexture", None), np.full(3, 255.0)
    if image is None:
        image = getattr(material, "image", None)
    elif (factor := getattr(material, "baseColorFactor", None)) is not None:
        # trimesh keeps the linear factor as bytes
        color = to_srgb(np.asarray(factor, dtype=np.float64)[:3] / 255)
    faces = np.asarray(value.faces)
    if image is None or len(uvs) != len(value.vertices):
        return MeshPart(mesh_of(value), {})
    picture = Picture(image.convert("RGB"), "the texture of the mesh")
    corners = finite_uvs(uvs, picture.name)[faces] * (1, -1) + (0, 1)
    texture, coordinates = picture.texture(corners, 1)
    colors = np.broadcast_to(np.asarray(color, dtype=np.float64), (*faces.shape, 3))
    return MeshPart(weld(value.vertices, faces, colors, uvs=coordinates), {"texture": texture})


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
        objects.append(_placed(part_of(whole), np.asarray(matrix, dtype=np.float64)))
    return objects


def _placed(part: MeshPart, matrix: NDArray[np.float64]) -> Object:
    mesh, material = part.mesh, Material(**part.material)
    try:
        return Object.from_matrix(mesh, matrix, material=material)
    except InputError:
        positions = mesh.positions @ matrix[:3, :3].T + matrix[:3, 3]
        mirrored = np.linalg.det(matrix[:3, :3]) < 0
        faces = mesh.faces[:, ::-1] if mirrored else mesh.faces
        return Object(evolve(mesh, positions=positions, faces=faces, normals=None), material=material)


def _opaque(colors: Any) -> NDArray[np.uint8]:
    """Return red, green and blue, (n, 3), of colours with alpha."""
    rows = np.asarray(colors, dtype=np.uint8)
    if rows.shape[1] > 3 and (rows[:, 3] != 255).any():
        warnings.warn("colours of the mesh are not opaque; their alpha is left out", InputWarning, stacklevel=3)
    return rows[:, :3]
