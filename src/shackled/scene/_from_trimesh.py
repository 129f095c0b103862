"""Meshes and scenes of the library trimesh, without importing it."""

from __future__ import annotations

from typing import Any

import numpy as np
from attrs import evolve
from numpy.typing import NDArray

from ..errors import InputError, warn
from ._files.model import MeshPart, Picture, finite_uvs, is_transparent
from ._mesh import is_trimesh, mesh_of, weld
from ._object import Material, Object
from ._texture import as_rgb, as_rgba, cutoff_of, to_srgb


def part_of(value: Any) -> MeshPart:
    """Return the mesh of a trimesh.Trimesh, texture and emission of its material as fields of a `Material`, if it has
    any, its opacity, if it is blended, and whether it has two sides. Errors as in `mesh_of`.
    """
    visual: Any = getattr(value, "visual", None)
    uvs = getattr(visual, "uv", None)
    if not is_trimesh(value) or getattr(visual, "kind", None) != "texture":
        return MeshPart(mesh_of(value), {})
    material = visual.material
    factor = getattr(material, "baseColorFactor", None)
    # trimesh keeps the linear factor as bytes
    *color, alpha = np.ones(4) if factor is None else np.asarray(factor, dtype=np.float64) / 255
    mode = getattr(material, "alphaMode", None)
    opacity = float(alpha) if mode == "BLEND" else 1.0
    two_sided = bool(getattr(material, "doubleSided", False))
    emitted, fields = getattr(material, "emissiveFactor", None), dict[str, Any]()
    if emitted is not None and np.any(emitted) and getattr(material, "emissiveTexture", None) is None:
        fields["emission"] = to_srgb(emitted).astype(int).tolist()
    image = getattr(material, "baseColorTexture", None)
    if image is None:
        image, color = getattr(material, "image", None), [1.0, 1.0, 1.0]
    faces = np.asarray(value.faces)
    if image is None or uvs is None or len(uvs) != len(value.vertices):
        return MeshPart(mesh_of(value), fields, opacity, two_sided)
    cutoff = getattr(material, "alphaCutoff", None)
    cutoff = 0.5 if cutoff is None else float(cutoff)
    has_alpha = mode == "BLEND" or (mode == "MASK" and cutoff > 0)
    image = (as_rgba if has_alpha and is_transparent(image) else as_rgb)(image)
    picture = Picture(image, "the texture of the mesh", cutoff=cutoff_of(cutoff) if mode == "MASK" else 0)
    corners = finite_uvs(uvs, picture.name)[faces] * (1, -1) + (0, 1)
    texture, coordinates = picture.texture(corners, 1)
    colors = np.broadcast_to(to_srgb(color), (*faces.shape, 3))
    mesh = weld(value.vertices, faces, colors, uvs=coordinates)
    return MeshPart(mesh, fields | {"texture": texture}, opacity, two_sided)


def objects_of(scene: Any) -> list[Object]:
    """Return the objects of a trimesh.Scene, one for each place in which a mesh stands.

    A matrix that is more than a scale, a rotation and a translation is applied to the vertices.
    """
    objects = []
    for name in scene.graph.nodes_geometry:
        matrix, geometry = scene.graph[name]
        whole = scene.geometry[geometry]
        if not hasattr(whole, "faces"):
            warn(f"{geometry} of the scene has no faces and is left out")
            continue
        objects.append(_placed(part_of(whole), np.asarray(matrix, dtype=np.float64)))
    return objects


def _placed(part: MeshPart, matrix: NDArray[np.float64]) -> Object:
    mesh, material = part.mesh, Material(**part.material)
    try:
        return Object.from_matrix(mesh, matrix, material=material, opacity=part.opacity)
    except InputError:
        positions = mesh.positions @ matrix[:3, :3].T + matrix[:3, 3]
        mirrored = np.linalg.det(matrix[:3, :3]) < 0
        faces = mesh.faces[:, ::-1] if mirrored else mesh.faces
        moved = evolve(mesh, positions=positions, faces=faces, normals=None)
        return Object(moved, material=material, opacity=part.opacity)
