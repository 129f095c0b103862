"""A plain reader of glTF 2.0, written from its specification for comparison: shapes, base colours and normals only.

It shares no code with the package: numbers are taken from the bytes one by one, and NumPy multiplies matrices only.
"""

from __future__ import annotations

import base64
import json
import struct
from typing import Any

import numpy as np
from numpy.typing import NDArray

Vector = tuple[float, ...]
Matrix = NDArray[np.float64]
#: Positions, colours 0..1 (None for none) and normals (likewise) of three corners.
Triangle = tuple[list[Vector], list[Vector | None], list[Vector | None]]

FORMATS = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", 5126: "f"}
LARGEST = {5120: 127.0, 5121: 255.0, 5122: 32767.0, 5123: 65535.0}
COUNTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


def read(data: bytes) -> list[Triangle]:
    """The triangles of the scene, in world coordinates, counter-clockwise as seen from the front."""
    document, binary = split(data)
    buffers = [binary if "uri" not in b else base64.b64decode(b["uri"].partition(",")[2]) for b in document["buffers"]]
    triangles: list[Triangle] = []

    def visit(number: int, above: Matrix) -> None:
        node = document["nodes"][number]
        world = above @ local_matrix(node)
        if "mesh" in node:
            for primitive in document["meshes"][node["mesh"]]["primitives"]:
                triangles.extend(placed(t, world) for t in primitive_triangles(document, buffers, primitive))
        for child in node.get("children", []):
            visit(child, world)

    for root in document["scenes"][document["scene"]]["nodes"]:
        visit(root, np.eye(4))
    return triangles


def split(data: bytes) -> tuple[dict[str, Any], bytes]:
    if data[:4] != b"glTF":
        return json.loads(data), b""
    (length,) = struct.unpack_from("<I", data, 12)
    return json.loads(data[20 : 20 + length]), data[20 + length + 8 :]


def elements(document: dict[str, Any], buffers: list[bytes], number: int) -> list[Vector]:
    """3.6.2: accessors, with sparse ones and normalized integers."""
    accessor = document["accessors"][number]
    kind, width, count = accessor["componentType"], COUNTS[accessor["type"]], accessor["count"]
    values = [(0.0,) * width] * count
    if "bufferView" in accessor:
        values = raw(document, buffers, accessor, kind, width, count)
    if "sparse" in accessor:
        sparse = accessor["sparse"]
        where = raw(document, buffers, sparse["indices"], sparse["indices"]["componentType"], 1, sparse["count"])
        other = raw(document, buffers, sparse["values"], kind, width, sparse["count"])
        for (place,), value in zip(where, other, strict=True):
            values[int(place)] = value
    if accessor.get("normalized"):
        values = [tuple(max(v / LARGEST[kind], -1.0) for v in value) for value in values]
    return values


def raw(
    document: dict[str, Any], buffers: list[bytes], place: dict[str, Any], kind: int, width: int, count: int
) -> list[Vector]:
    view = document["bufferViews"][place["bufferView"]]
    layout = f"<{width}{FORMATS[kind]}"
    start = view.get("byteOffset", 0) + place.get("byteOffset", 0)
    stride = view.get("byteStride", struct.calcsize(layout))
    return [struct.unpack_from(layout, buffers[view["buffer"]], start + stride * i) for i in range(count)]


def primitive_triangles(document: dict[str, Any], buffers: list[bytes], primitive: dict[str, Any]) -> list[Triangle]:
    """3.7.2.1: the topologies."""
    attributes = {name: elements(document, buffers, n) for name, n in primitive["attributes"].items()}
    positions = attributes["POSITION"]
    order = list(range(len(positions)))
    if "indices" in primitive:
        order = [int(index) for (index,) in elements(document, buffers, primitive["indices"])]
    mode = primitive.get("mode", 4)
    corners: list[tuple[int, int, int]] = []
    if mode == 4:
        corners = [(3 * i, 3 * i + 1, 3 * i + 2) for i in range(len(order) // 3)]
    if mode == 5:
        corners = [(i, i + (1 + i % 2), i + (2 - i % 2)) for i in range(len(order) - 2)]
    if mode == 6:
        corners = [(i + 1, i + 2, 0) for i in range(len(order) - 2)]
    factor: Vector | None = None
    if "material" in primitive:
        material = document["materials"][primitive["material"]]
        factor = tuple(material.get("pbrMetallicRoughness", {}).get("baseColorFactor", (1.0,) * 4))[:3]

    def color(vertex: int) -> Vector | None:
        own = attributes["COLOR_0"][vertex][:3] if "COLOR_0" in attributes else None
        if own is None or factor is None:
            return own or factor
        return tuple(a * b for a, b in zip(own, factor, strict=True))

    return [
        (
            [positions[order[c]] for c in corner],
            [color(order[c]) for c in corner],
            [attributes["NORMAL"][order[c]] if "NORMAL" in attributes else None for c in corner],
        )
        for corner in corners
    ]


def placed(triangle: Triangle, world: Matrix) -> Triangle:
    """3.7.4: a negative determinant turns the winding; normals go by the inverse of the transpose."""
    positions = [tuple(world[:3, :3] @ position + world[:3, 3]) for position in triangle[0]]
    turned = [None if normal is None else np.linalg.inv(world[:3, :3]).T @ normal for normal in triangle[2]]
    normals = [None if normal is None else tuple(normal / np.linalg.norm(normal)) for normal in turned]
    if np.linalg.det(world[:3, :3]) < 0:
        return positions[::-1], triangle[1][::-1], normals[::-1]
    return positions, triangle[1], normals


def local_matrix(node: dict[str, Any]) -> Matrix:
    """3.5.3: T * R * S, or a matrix in columns."""
    if "matrix" in node:
        return np.array(node["matrix"], dtype=float).reshape(4, 4).T
    x, y, z, w = node.get("rotation", (0, 0, 0, 1))
    rotation = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    matrix = np.eye(4)
    matrix[:3, :3] = np.array(rotation) * node.get("scale", (1, 1, 1))
    matrix[:3, 3] = node.get("translation", (0, 0, 0))
    return matrix
