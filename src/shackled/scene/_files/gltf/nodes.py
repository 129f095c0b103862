"""The nodes of a glTF document: where they are, which of them are shown, and how often; morph targets and skins."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ....base.checks import Floats
from ....errors import InputError
from ..._arithmetic import rotation_of, units
from ..table import Table, about
from .document import Document, Vertices, numbers

#: The parts of a place, by their names as attributes, where they are not told.
_RESTS: dict[str, tuple[float, ...]] = {"TRANSLATION": (0, 0, 0), "ROTATION": (0, 0, 0, 1), "SCALE": (1, 1, 1)}


@dataclass(frozen=True)
class Node:
    """A node in its place: the matrix, (4, 4) for columns, puts it into the world. is_shown: in the scene, visible."""

    keys: Table
    matrix: Floats
    is_shown: bool


def placed(gltf: Document, nodes: Sequence[Table]) -> dict[int, Node]:
    """Return all nodes by their numbers; first those of the scene, the default one or the first, in its order."""
    matrices = _matrices(nodes)
    children = [_links(node, "children", len(nodes)) for node in nodes]
    heads = sorted(set(range(len(nodes))).difference(*children))
    roots, scenes = heads, gltf.keys.rows("scenes")
    if "scene" in gltf.keys or scenes:
        scene = gltf.item(gltf.keys, "scene", "scenes", 0)
        roots = _links(scene, "nodes", len(nodes))
        for where, _ in scenes:
            if where != scene.where:
                gltf.leave_out("other scene", where)
    found: dict[int, Node] = {}
    # first the scene; joints may be elsewhere
    waiting = [(n, np.eye(4), False) for n in reversed(heads)] + [(n, np.eye(4), True) for n in reversed(roots)]
    while waiting:
        number, above, is_shown = waiting.pop()
        node = nodes[number]
        if number in found:
            if not is_shown:
                continue
            raise InputError(f"{node.where} hangs on several nodes, or on itself, which glTF does not allow")
        visibility = node.table("extensions").table("KHR_node_visibility")
        here = Node(node, above @ matrices[number], is_shown and visibility.flag("visible", True))
        found[number] = here
        waiting += [(child, here.matrix, here.is_shown) for child in reversed(children[number])]
    return found


def _links(keys: Table, key: str, count: int) -> list[int]:
    for place, number in keys.rows(key):
        if type(number) is not int or not 0 <= number < count:
            raise InputError(f"{place} is {number!r:.20}, but there are {count} nodes, numbered from 0")
    return list(keys.get(key) or [])


def _matrices(nodes: Sequence[Table]) -> Floats:
    """Return the matrices of nodes, (n, 4, 4), each for what hangs on it."""
    columns = []
    for name, rest in _RESTS.items():
        key = name.lower()
        values = [node.numbers(key, rest) if key in node and "matrix" not in node else rest for node in nodes]
        columns.append(np.array(values, dtype=np.float64).reshape(-1, len(rest)))
    found = _composed([node.where for node in nodes], *columns)
    for number, node in enumerate(nodes):
        if "matrix" in node:
            found[number] = np.array(node.numbers("matrix", tuple(np.eye(4).flat))).reshape(4, 4).T
    return found


def _composed(places: Sequence[str], translations: Floats, rotations: Floats, scales: Floats) -> Floats:
    """Return the matrices, (n, 4, 4), of so many translations, rotations and scales. places: of each, for messages."""
    largest = np.abs(rotations).max(axis=1, keepdims=True, initial=0)
    bad = np.flatnonzero(~np.isfinite(largest[:, 0]) | (largest[:, 0] == 0))
    if len(bad):
        with about(places[bad[0]]):
            rotation_of(rotations[bad[0]])
    axis, cosine = np.split(units(rotations / largest)[:, None], [3], axis=2)
    across = 2 * np.cross(axis, np.eye(3))
    turned = np.eye(3) + cosine * across + np.cross(axis, across)
    matrices = np.tile(np.eye(4), (len(rotations), 1, 1))
    matrices[:, :3, :3] = turned.transpose(0, 2, 1) * scales[:, None, :]
    matrices[:, :3, 3] = translations
    return matrices


def instances(gltf: Document, node: Node, triangles: int) -> Floats:
    """Return the matrices, (n, 4, 4), that put the mesh of a node, of so many triangles, into the world.

    One, or one for each instance, of which the triangles are counted before anything is made.
    """
    extensions = node.keys.table("extensions")
    if "EXT_mesh_gpu_instancing" not in extensions:
        gltf.show(triangles)
        return node.matrix[None]
    attributes = extensions.table("EXT_mesh_gpu_instancing").table("attributes")
    given = {
        name: numbers(gltf, attributes, name, f"VEC{len(rest)}") for name, rest in _RESTS.items() if name in attributes
    }
    counts = {len(values) for values in given.values()}
    if len(counts) != 1:
        raise InputError(f"{attributes.where} must have as many elements in each, not {sorted(counts)}")
    (count,) = counts
    gltf.show(count * triangles)
    columns = [np.asarray(given.get(name, np.tile(rest, (count, 1))), np.float64) for name, rest in _RESTS.items()]
    placed: Floats = node.matrix @ _composed([attributes.where] * count, *columns)
    return placed


#: Other attributes of morph targets are not read; tangents are for normal textures, which are not, either.
_MORPHED = {"POSITION", "NORMAL", "TANGENT"}


def morphed(vertices: Vertices, primitive: Table, weights: Floats, name: str, values: Floats) -> Floats:
    """Return values of vertices, (n, 3), of the attribute POSITION or NORMAL, moved by the morph targets."""
    for keys, weight in zip(primitive.tables("targets"), weights, strict=False):
        if weight == 0:
            continue
        if not keys.values.keys() <= _MORPHED:
            vertices.gltf.leave_out("morph target", keys.where, "what {} would change besides positions and normals")
        if name in keys:
            values = values + weight * vertices.of(keys, name, "VEC3")
    return values


def skinned(vertices: Vertices, node: Table, nodes: Mapping[int, Node]) -> Floats | None:
    """Return the mean of the matrices of joints, (n, 4, 4), that puts vertices into the world; None without a skin."""
    if "skin" not in node or "JOINTS_0" not in vertices.attributes:
        return None
    gltf = vertices.gltf
    skin = gltf.item(node, "skin", "skins")
    matrices = _joints(gltf, skin, nodes)
    sets = sum(f"JOINTS_{number}" in vertices.attributes for number in range(len(vertices.attributes.values)))
    joints, weights = (
        np.hstack([vertices.of(vertices.attributes, f"{name}_{number}", "VEC4") for number in range(sets)])
        for name in ("JOINTS", "WEIGHTS")
    )
    weights = np.nan_to_num(weights.astype(np.float64))
    total = weights.sum(axis=1, keepdims=True)
    # a vertex without weights hangs on its first joint
    weights = np.where(total > 0, weights / np.where(total > 0, total, 1), np.eye(1, weights.shape[1]))
    joints = np.where(weights != 0, joints, 0).astype(np.int64)
    if joints.size and not 0 <= joints.min() <= joints.max() < len(matrices):
        raise InputError(f"a vertex hangs on joint {joints.max()}, but {skin.where} has {len(matrices)}")
    found = np.zeros((len(joints), 4, 4))
    for weight, joint in zip(weights.T, joints.T, strict=True):
        found += weight[:, None, None] * matrices[joint]
    return found


def _joints(gltf: Document, skin: Table, nodes: Mapping[int, Node]) -> Floats:
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
    product: Floats = found @ bound[: len(found)].reshape(-1, 4, 4).transpose(0, 2, 1)
    return product
