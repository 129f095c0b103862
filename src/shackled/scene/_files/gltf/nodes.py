"""The nodes of a glTF document: where they are, which of them are shown, and how often."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ....errors import InputError
from ..._rotation import rotate
from ..table import Table, about
from .accessors import numbers
from .document import Document

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
