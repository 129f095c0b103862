"""STL, and glTF as text or binary (GLB), through trimesh."""

from __future__ import annotations

import io
import logging
import warnings
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import InputError
from ..mesh import DEFAULT_COLOR, Mesh
from .colors import to_bytes
from .content import read_bytes
from .texture import sample
from .weld import weld

# whoever wants the messages of trimesh gives its logger a handler; without one they would go to stderr
logging.getLogger("trimesh").addHandler(logging.NullHandler())

#: Positions, faces, colours and normals (of no rows if there are none).
_Part = tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.float64], NDArray[np.float64]]

_COMPRESSIONS = ("KHR_draco_mesh_compression", "EXT_meshopt_compression")


def read_stl(path: Path) -> Mesh:
    """The mesh of an STL file, text or binary, in light grey. The normals of its faces follow from their vertices."""
    from trimesh.exchange.stl import load_stl

    data = read_bytes(path)
    with warnings.catch_warnings(action="ignore"):
        # NumPy stops at what is no number with a warning only, and the triangles after it would be missing
        warnings.filterwarnings("error", message="string or file could not be read")
        content = load_stl(io.BytesIO(data))
    solids = list(content["geometry"].values()) if "geometry" in content else [content]
    solids = [solid for solid in solids if len(solid.get("vertices", ()))]
    if not solids:
        if data.lstrip().startswith(b"solid") or not any(data[80:84]):
            raise InputError("it has no triangles")
        raise InputError("it is neither text nor as long as a binary STL file of so many triangles would be")
    triangles = np.concatenate([np.asarray(solid["vertices"])[np.asarray(solid["faces"])] for solid in solids])
    return weld(triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3))


def read_gltf(path: Path) -> Mesh:
    """The mesh of a glTF or GLB file, all its nodes in their places.

    The colour of a vertex is the product of the base colour of its material, the base colour texture there, and the
    colour of the vertex, as far as they are given; light grey if none is. Colours are taken as they are written,
    without gamma.
    """
    from trimesh.exchange.gltf import load_glb, load_gltf
    from trimesh.resolvers import FilePathResolver
    from trimesh.scene.transforms import SceneGraph

    data = read_bytes(path)
    for name in _COMPRESSIONS:
        if name.encode() in data:
            raise InputError(f"it is compressed with {name}, which is not read; export it without compression")
    load = load_glb if data.startswith(b"glTF") else load_gltf
    with warnings.catch_warnings(action="ignore"):
        content = load(io.BytesIO(data), resolver=FilePathResolver(str(path)))
    graph = SceneGraph(base_frame=content.get("base_frame", "world"))
    for edge in content["graph"]:
        graph.update(**edge)  # type: ignore[no-untyped-call]
    parts: list[_Part] = []
    for edge in content["graph"]:
        if "geometry" in edge:
            part, matrix = content["geometry"][edge["geometry"]], graph[edge["frame_to"]][0]
            if len(part.get("faces", ())):
                parts.append(_place(part, matrix))
    if not parts:
        raise InputError("it has no triangles")
    return _join(parts)


def _place(part: dict[str, Any], matrix: NDArray[np.float64]) -> _Part:
    """A part where its node puts it."""
    linear = matrix[:3, :3]
    positions = np.asarray(part["vertices"], dtype=np.float64)
    faces = np.asarray(part["faces"], dtype=np.int64)
    colors = _colors(part, len(positions))
    # the matrix of the cofactors turns normals right under any scale; its sign follows that of a mirror
    cofactors = np.stack(
        [np.cross(linear[1], linear[2]), np.cross(linear[2], linear[0]), np.cross(linear[0], linear[1])]
    )
    if np.linalg.det(linear) < 0:
        faces, cofactors = faces[:, ::-1], -cofactors
    normals = np.asarray(part.get("vertex_normals", np.empty((0, 3))), dtype=np.float64) @ cofactors.T
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.asarray(np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0))
    return positions @ linear.T + matrix[:3, 3], faces, colors, normals


def _colors(part: dict[str, Any], count: int) -> NDArray[np.float64]:
    """(count, 3) colours 0..255."""
    visual = part.get("visual")
    vertex_colors = part.get("vertex_colors")
    colors = np.full((count, 3), 255.0)
    if visual is not None:
        if vertex_colors is None:
            vertex_colors = visual.vertex_attributes.get("color")
        factor, texture = visual.material.baseColorFactor, visual.material.baseColorTexture
        if factor is not None:
            colors *= to_bytes(factor, _largest(np.asarray(factor))) / 255
        if texture is not None and visual.uv is not None:
            colors *= sample(texture, visual.uv) / 255
    elif vertex_colors is None:
        colors[:] = DEFAULT_COLOR
    if vertex_colors is not None:
        values = np.asarray(vertex_colors)
        colors *= to_bytes(values, _largest(values)) / 255
    return np.asarray(np.rint(colors))


def _largest(colors: NDArray[Any]) -> float:
    return float(np.iinfo(colors.dtype).max) if colors.dtype.kind in "iu" else 1.0


def _join(parts: list[_Part]) -> Mesh:
    has_normals = all(len(normals) == len(positions) for positions, _, _, normals in parts)
    faces, count = [], 0
    for positions, part_faces, _, _ in parts:
        Mesh(positions, part_faces)  # the numbers of one part must not reach into the next
        faces.append(part_faces + count)
        count += len(positions)
    corners = np.concatenate(faces).astype(np.int64)
    colors = np.concatenate([part[2] for part in parts])
    normals = np.concatenate([part[3] for part in parts])[corners] if has_normals else None
    return weld(np.concatenate([part[0] for part in parts]), corners, colors[corners], normals)
