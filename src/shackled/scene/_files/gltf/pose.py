"""Poses of meshes: morph targets and skins."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from ....errors import InputError
from ..table import Table
from .accessors import numbers
from .document import Document
from .nodes import Node
from .vertices import Vertices

Array = NDArray[np.float64]

#: Other attributes of morph targets are not read; tangents are for normal textures, which are not, either.
_MORPHED = ("POSITION", "NORMAL", "TANGENT")


def weights_of(node: Table, mesh: Table) -> Array:
    """Return the weights of morph targets: those of the node, or else of the mesh."""
    return node.series("weights") if "weights" in node else mesh.series("weights")


def morphed(vertices: Vertices, primitive: Table, weights: Array, name: str, values: Array) -> Array:
    """Return values of vertices, (n, 3), of the attribute POSITION or NORMAL, moved by the morph targets."""
    for (where, target), weight in zip(primitive.rows("targets"), weights, strict=False):
        keys = Table(target, where)
        if weight == 0:
            continue
        for other in keys.values:
            if other not in _MORPHED:
                vertices.gltf.leave_out("morph target", where, "what {} would change besides positions and normals")
        if name in keys:
            values = values + weight * vertices.of(keys, name, "VEC3")
    return values


def skinned(vertices: Vertices, node: Table, nodes: Mapping[int, Node]) -> Array | None:
    """Return the matrix, (n, 4, 4), that puts each vertex into the world; None without a skin.

    It is the mean of those of the joints. The place of the node itself has no effect then, says glTF.
    """
    if "skin" not in node or "JOINTS_0" not in vertices.attributes:
        return None
    gltf = vertices.gltf
    skin = gltf.item(node, "skin", "skins")
    matrices = _joints(gltf, skin, nodes)
    sets = sum(f"JOINTS_{number}" in vertices.attributes for number in range(len(vertices.attributes.values)))
    joints = np.hstack([vertices.of(vertices.attributes, f"JOINTS_{number}", "VEC4") for number in range(sets)])
    weights = np.hstack(
        [vertices.of(vertices.attributes, f"WEIGHTS_{number}", "VEC4") for number in range(sets)]
    ).astype(np.float64)
    weights = np.nan_to_num(weights)
    total = weights.sum(axis=1, keepdims=True)
    # a vertex without weights hangs on its first joint
    weights = np.where(total > 0, weights / np.where(total > 0, total, 1), np.eye(1, weights.shape[1]))
    joints = np.where(weights != 0, joints, 0).astype(np.int64)
    if joints.size and not 0 <= joints.min() <= joints.max() < len(matrices):
        raise InputError(f"a vertex hangs on joint {joints.max()}, but {skin.where} has {len(matrices)}")
    found = np.zeros((len(joints), 4, 4))
    for column in range(joints.shape[1]):
        found += weights[:, column, None, None] * matrices[joints[:, column]]
    return found


def _joints(gltf: Document, skin: Table, nodes: Mapping[int, Node]) -> Array:
    """Return the matrices of the joints of a skin, (n, 4, 4), from where the mesh was bound to them into the world."""
    worlds = []
    for place, number in skin.rows("joints"):
        if type(number) is not int or number not in nodes:
            raise InputError(f"{place} is {number!r:.20}, which is no node in a tree of nodes")
        worlds.append(nodes[number].matrix)
    found = np.array(worlds, dtype=np.float64).reshape(-1, 4, 4)
    if "inverseBindMatrices" not in skin:
        return found
    bound = numbers(gltf, skin, "inverseBindMatrices", "MAT4").astype(np.float64)
    if len(bound) < len(found):
        raise InputError(f"{skin.where} has {len(found)} joints, but {len(bound)} inverseBindMatrices")
    product: Array = found @ bound[: len(found)].reshape(-1, 4, 4).transpose(0, 2, 1)
    return product
