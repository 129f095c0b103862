"""Meshes and scenes of the library trimesh, without importing it."""

from __future__ import annotations

from typing import Any

import numpy as np
from attrs import evolve

from ..errors import InputError, warn
from ._files.images import Images
from ._files.model import MeshPart, Picture, finite_uvs, seen
from ._mesh import Mesh, is_trimesh, weld
from ._object import Material, Object
from ._texture import as_rgb, cutoff_of, to_srgb, with_alpha


def part_of(value: Any) -> MeshPart:
    """Return the mesh of a trimesh.Trimesh with what its material says, as `seen`. Errors as in `Mesh.from_trimesh`."""
    return seen([_part_of(value)], "the mesh")[0]


def _part_of(value: Any) -> MeshPart:
    visual: Any = getattr(value, "visual", None)
    uvs = getattr(visual, "uv", None)
    if not is_trimesh(value) or getattr(visual, "kind", None) != "texture":
        return MeshPart(Mesh.from_trimesh(value))

    def of_material(name: str) -> Any:
        return getattr(visual.material, name, None)

    factor = of_material("baseColorFactor")
    # trimesh keeps the linear factor as bytes
    *color, alpha = np.ones(4) if factor is None else np.asarray(factor, dtype=np.float64) / 255
    mode = of_material("alphaMode")
    opacity = float(alpha) if mode == "BLEND" else 1.0
    two_sided = bool(of_material("doubleSided"))
    emitted, fields = of_material("emissiveFactor"), dict[str, Any]()
    if emitted is not None and np.any(emitted) and of_material("emissiveTexture") is None:
        fields["emission"] = to_srgb(emitted).astype(int).tolist()
    image = of_material("baseColorTexture")
    if image is None:
        image, color = of_material("image"), [1.0, 1.0, 1.0]
    faces = np.asarray(value.faces)
    if image is None or uvs is None or len(uvs) != len(value.vertices):
        return MeshPart(Mesh.from_trimesh(value), fields, opacity, two_sided)
    cutoff = of_material("alphaCutoff")
    cutoff = 0.5 if cutoff is None else float(cutoff)
    has_alpha = mode == "BLEND" or (mode == "MASK" and cutoff > 0)
    image = (with_alpha if has_alpha else as_rgb)(image)
    cutoff = cutoff_of(cutoff) if mode == "MASK" else 0
    picture = Picture(Images().image("", lambda: image), "the texture of the mesh", cutoff=cutoff)
    corners = finite_uvs(uvs, picture.name)[faces] * (1, -1) + (0, 1)
    texture, coordinates = picture.texture(corners, 1)
    colors = np.broadcast_to(to_srgb(color), (*faces.shape, 3))
    mesh = weld(value.vertices, faces, colors, uvs=coordinates)
    return MeshPart(mesh, fields | {"texture": texture}, opacity, two_sided)


def objects_of(scene: Any) -> list[Object]:
    """Return the objects of a trimesh.Scene, one for each place in which a mesh stands."""
    placed = []
    for name in scene.graph.nodes_geometry:
        matrix, geometry = scene.graph[name]
        whole = scene.geometry[geometry]
        if not hasattr(whole, "faces"):
            warn(f"{geometry} of the scene has no faces and is left out")
            continue
        placed.append((matrix, _part_of(whole)))
    objects = []
    for part, (matrix, _) in zip(seen([part for _, part in placed], "the scene"), placed, strict=True):
        fields: dict[str, Any] = {"material": Material(**part.material), "opacity": part.opacity}
        try:
            objects.append(Object.from_matrix(part.mesh, matrix, **fields))
        except InputError:  # it shears, mirrors, or scales the axes differently
            linear, mesh = np.asarray(matrix, dtype=np.float64)[:3, :3], part.mesh
            faces = mesh.faces[:, ::-1] if np.linalg.det(linear) < 0 else mesh.faces
            positions = mesh.positions @ linear.T + np.asarray(matrix)[:3, 3]
            objects.append(Object(evolve(mesh, positions=positions, faces=faces), **fields))
    return objects
