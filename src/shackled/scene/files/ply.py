"""PLY, the Stanford polygon format, as text or binary.

An own reader: trimesh refuses binary files that mix triangles with other polygons, and drops colours beside texture
coordinates.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import InputError
from ..mesh import Mesh
from .colors import to_bytes
from .content import read_bytes
from .weld import fans, weld

_TYPES = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1",
    "short": "i2", "int16": "i2", "ushort": "u2", "uint16": "u2",
    "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4",
    "float": "f4", "float32": "f4", "double": "f8", "float64": "f8",
}  # fmt: skip

#: How many bits of a larger integer a colour has: 0..65535 becomes 0..255.
_LARGEST = {"u1": 255, "i1": 255, "u2": 65535, "i2": 255, "u4": 255, "i4": 255}


def read_ply(path: Path) -> Mesh:
    """The mesh of a PLY file.

    A corner has the colour of its face if faces have colours, else that of its vertex, else light grey.
    """
    elements = {element.name: element for element in _read(read_bytes(path))}
    if "vertex" not in elements or "face" not in elements:
        raise InputError("a mesh needs the elements vertex and face; this file has " + (", ".join(elements) or "none"))
    vertex, face = elements["vertex"], elements["face"]
    positions = vertex.table("x", "y", "z")
    polygons = face.lists("vertex_indices", "vertex_index")
    if positions is None or polygons is None:
        raise InputError("the element vertex needs x, y and z, the element face a list vertex_indices")
    sizes, numbers = polygons
    triangles = fans(sizes)
    corners = np.asarray(Mesh(positions, numbers[triangles[:, :3]]).faces)
    face_colors, vertex_colors = face.colors(), vertex.colors()
    colors = None
    if face_colors is not None:
        colors = np.repeat(face_colors[triangles[:, 3]][:, None, :], 3, axis=1)
    elif vertex_colors is not None:
        colors = vertex_colors[corners]
    normals = vertex.table("nx", "ny", "nz")
    return weld(positions, corners, colors, None if normals is None else normals[corners])


@dataclass
class _Property:
    name: str
    type: str
    #: the type of the length if this is a list
    length: str | None = None


@dataclass
class _Element:
    name: str
    count: int
    properties: list[_Property] = field(default_factory=list)
    #: by property: (count,) numbers; of lists (count, length), or a list of lists if their lengths differ
    values: dict[str, Any] = field(default_factory=dict)

    def table(self, *names: str) -> NDArray[np.float64] | None:
        """The scalar properties of these names side by side, or None if one is missing."""
        scalars = {p.name for p in self.properties if p.length is None}
        if not scalars.issuperset(names):
            return None
        return np.stack([np.asarray(self.values[name], dtype=np.float64) for name in names], axis=1)

    def lists(self, *names: str) -> tuple[NDArray[np.int64], NDArray[np.int64]] | None:
        """The first list property of one of these names: how long its lists are, and all their numbers; or None."""
        for name in names:
            if any(p.name == name and p.length is not None for p in self.properties):
                rows = self.values[name]
                if isinstance(rows, np.ndarray):
                    return np.full(len(rows), rows.shape[1]), rows.reshape(-1).astype(np.int64)
                sizes = np.array([len(row) for row in rows], dtype=np.int64)
                return sizes, np.fromiter(chain.from_iterable(rows), dtype=np.int64)
        return None

    def colors(self) -> NDArray[np.float64] | None:
        for names in (("red", "green", "blue"), ("diffuse_red", "diffuse_green", "diffuse_blue"), ("r", "g", "b")):
            table = self.table(*names)
            if table is not None and len(table):
                kind = next(p.type for p in self.properties if p.name == names[0])
                return to_bytes(table, _LARGEST.get(kind))
        return None


def _read(data: bytes) -> list[_Element]:
    encoding, elements, start = _header(data)
    source = _Text(data[start:]) if encoding == "ascii" else _Binary(data[start:], "<" if "little" in encoding else ">")
    for element in elements:
        _read_element(element, source)
    return elements


def _header(data: bytes) -> tuple[str, list[_Element], int]:
    """The encoding, the elements without their values, and where the values begin."""
    encoding, elements, start = "", list[_Element](), 0
    if not data.startswith(b"ply"):
        raise InputError("a PLY file begins with the line ply")
    while True:
        end = data.find(b"\n", start)
        if end < 0:
            raise InputError("its header has no line end_header")
        line = data[start:end].decode("ascii", errors="replace").strip()
        start = end + 1
        try:
            match line.split():
                case ["format", name, _] if name in ("ascii", "binary_little_endian", "binary_big_endian"):
                    encoding = name
                case ["element", name, count] if int(count) >= 0:
                    elements.append(_Element(name, int(count)))
                case ["property", "list", length, kind, name]:
                    elements[-1].properties.append(_Property(name, _TYPES[kind], _TYPES[length]))
                case ["property", kind, name]:
                    elements[-1].properties.append(_Property(name, _TYPES[kind]))
                case ["end_header"]:
                    break
                case ["ply"] | ["comment" | "obj_info", *_] | []:
                    pass
                case _:
                    raise ValueError
        except (ValueError, KeyError, IndexError):
            raise InputError(f"its header has a line that means nothing: {line[:60]!r}") from None
    if not encoding:
        raise InputError("its header has no line format")
    return encoding, elements, start


class _Text:
    """Numbers one after the other, divided by white space."""

    def __init__(self, data: bytes) -> None:
        self.words = data.split()
        self.at = 0

    def rows(self, fields: list[tuple[str, str, int]], count: int) -> dict[str, NDArray[Any]] | None:
        """`count` rows of these fields (name, type, how many numbers), or None if so many are not there."""
        width = sum(size for _, _, size in fields)
        words = self.words[self.at : self.at + width * count]
        if len(words) < width * count:
            return None
        try:
            table = np.array([float(word) for word in words]).reshape(count, width)
        except ValueError:
            raise InputError("a value in it is not a number") from None
        self.at += width * count
        result, column = {}, 0
        for name, _, size in fields:
            result[name] = table[:, column : column + size]
            column += size
        return result


class _Binary:
    """Numbers one after the other, each in the bytes of its type."""

    def __init__(self, data: bytes, order: str) -> None:
        self.data = data
        self.order = order
        self.at = 0

    def rows(self, fields: list[tuple[str, str, int]], count: int) -> dict[str, NDArray[Any]] | None:
        row = np.dtype([(name, self.order + kind, (size,)) for name, kind, size in fields])
        if self.at + row.itemsize * count > len(self.data):
            return None
        table = np.frombuffer(self.data, row, count, self.at)
        self.at += row.itemsize * count
        return {name: table[name] for name, _, _ in fields}


def _read_element(element: _Element, source: _Text | _Binary) -> None:
    lists = [p for p in element.properties if p.length is not None]
    if not element.count or not element.properties:
        element.values = {p.name: [] for p in element.properties}
        return
    start = source.at
    first = _read_row(element, source)
    source.at = start
    # nearly always all lists of an element are of one length: then it is read as one table
    table = source.rows(
        [
            part
            for p in element.properties
            for part in (
                [(p.name, p.type, 1)]
                if p.length is None
                else [(f"length of {p.name}", p.length, 1), (p.name, p.type, len(first[p.name]))]
            )
        ],
        element.count,
    )
    if table is not None and all((table[f"length of {p.name}"] == len(first[p.name])).all() for p in lists):
        element.values = {
            p.name: table[p.name][:, 0] if p.length is None else table[p.name] for p in element.properties
        }
        return
    if not lists:
        raise InputError(f"it ends before its {element.count} elements {element.name} are complete")
    source.at = start
    rows = [_read_row(element, source) for _ in range(element.count)]
    element.values = {
        p.name: [row[p.name][0] if p.length is None else row[p.name] for row in rows] for p in element.properties
    }


def _read_row(element: _Element, source: _Text | _Binary) -> dict[str, list[float]]:
    row = {}
    for p in element.properties:
        size = 1
        if p.length is not None:
            size = int(_one(element, source, p.length, 1)[0])
        row[p.name] = _one(element, source, p.type, size)
    return row


def _one(element: _Element, source: _Text | _Binary, kind: str, size: int) -> list[float]:
    values = source.rows([("value", kind, size)], 1) if size >= 0 else None
    if values is None:
        raise InputError(f"it ends before its {element.count} elements {element.name} are complete")
    result: list[float] = values["value"][0].tolist()
    return result
