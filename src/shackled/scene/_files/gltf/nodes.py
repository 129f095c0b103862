"""The nodes of a glTF document: where they are, which of them are shown, and how often; morph targets and skins."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ....errors import InputError
from ..._arithmetic import rotate
from ..table import Table, about
from .document import Document, Vertices, numbers

Array = NDArray[np.float64]

_IDENTITY = (1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0)


@dataclass(frozen=True)
class Node:
    """A node in its place: the matrix, (4, 4) for columns, puts it into the world. is_shown: in the scene, visible."""

    keys: Table
    matrix: Array
    is_shown: bool


def placed(gltf: Document, nodes: Sequence[Table]) -> dict[int, Node]:
    """Return all nodes by their numbers; first those of the scene, the default one or the first, in its order."""
    children = [_links(node, "children", len(nodes)) for node in nodes]
    heads = sorted(set(range(len(nodes))).difference(*children))
    scenes = gltf.keys.rows("scenes")
    roots = heads
    if "scene" in gltf.keys or scenes:
        scene = gltf.numbered(gltf.keys.whole("scene", 0), "scenes", "scene")
        roots = _links(scene, "nodes", len(nodes))
        for where, _ in scenes:
            if where != scene.where:
                gltf.leave_out("other scene", where)
    found: dict[int, Node] = {}
    _walk(nodes, children, roots, True, found)
    # joints may be elsewhere
    _walk(nodes, children, [head for head in heads if head not in found], False, found)
    return found


def _walk(
    nodes: Sequence[Table], children: Sequence[list[int]], roots: list[int], are_shown: bool, found: dict[int, Node]
) -> None:
    waiting = [(number, np.eye(4), are_shown) for number in reversed(roots)]
    while waiting:
        number, above, is_shown = waiting.pop()
        node = nodes[number]
        if number in found:
            if not are_shown:
                continue
            raise InputError(f"{node.where} hangs on several nodes, or on itself, which glTF does not allow")
        visibility = node.table("extensions").table("KHR_node_visibility")
        here = Node(node, above @ _matrix(node), is_shown and visibility.flag("visible", True))
        found[number] = here
        waiting += [(child, here.matrix, here.is_shown) for child in reversed(children[number])]


def _links(keys: Table, key: str, count: int) -> list[int]:
    """Return the numbers of nodes."""
    for place, number in keys.rows(key):
        if type(number) is not int or not 0 <= number < count:
            raise InputError(f"{place} is {number!r:.20}, but there are {count} nodes, numbered from 0")
    return [int(number) for number in keys.get(key) or []]


def _matrix(node: Table) -> Array:
    if "matrix" in node:
        return np.array(node.numbers("matrix", _IDENTITY)).reshape(4, 4).T
    with about(node.where):
        return _composed(
            node.numbers("translation", (0, 0, 0)),
            node.numbers("rotation", (0, 0, 0, 1)),
            node.numbers("scale", (1, 1, 1)),
        )


def _composed(translation: Sequence[float], rotation: Sequence[float], scale: Sequence[float]) -> Array:
    matrix = np.eye(4)
    matrix[:3, :3] = rotate(rotation, np.eye(3)).T * scale
    matrix[:3, 3] = translation
    return matrix


def instances(gltf: Document, node: Node) -> list[Array]:
    """Return the matrices that put the mesh of a node into the world: one, or one for each of its instances."""
    extensions = node.keys.table("extensions")
    if "EXT_mesh_gpu_instancing" not in extensions:
        return [node.matrix]
    attributes = extensions.table("EXT_mesh_gpu_instancing").table("attributes")
    rests = {"TRANSLATION": [0, 0, 0], "ROTATION": [0, 0, 0, 1], "SCALE": [1, 1, 1]}
    given = {
        name: numbers(gltf, attributes, name, f"VEC{len(rest)}").astype(np.float64)
        for name, rest in rests.items()
        if name in attributes
    }
    counts = {len(values) for values in given.values()}
    if len(counts) != 1:
        raise InputError(f"{attributes.where} must have as many elements in each, not {sorted(counts)}")
    (count,) = counts
    columns = [given.get(name, np.tile(rest, (count, 1))) for name, rest in rests.items()]
    with about(attributes.where):
        return [node.matrix @ _composed(*row) for row in zip(*columns, strict=True)]


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
