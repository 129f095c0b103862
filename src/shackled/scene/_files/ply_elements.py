"""The elements of PLY files, as text or binary: tables whose columns are numbers or lists of numbers.

An own reader: trimesh refuses binary files that mix triangles with other polygons, and drops colours beside texture
coordinates.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import chain
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import InputError
from .colors import to_bytes
from .content import plain_text

_TYPES = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1",
    "short": "i2", "int16": "i2", "ushort": "u2", "uint16": "u2",
    "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4",
    "float": "f4", "float32": "f4", "double": "f8", "float64": "f8",
}  # fmt: skip

#: How many bits of a larger integer a colour has: 0..65535 becomes 0..255.
_LARGEST = {"u1": 255, "i1": 255, "u2": 65535, "i2": 255, "u4": 255, "i4": 255}

#: The names of red, green, blue and alpha.
_COLORS = (
    ("red", "green", "blue", "alpha"),
    ("diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha"),
    ("r", "g", "b", "a"),
)


def read_elements(data: bytes) -> tuple[dict[str, Element], list[str]]:
    """Return the elements of a PLY file by their names, and the textures that its comments name."""
    header, source = _open(data)
    for element in header.elements:
        _read_element(element, source)
    if isinstance(source, _Text):
        source.finish()
    return {element.name: element for element in header.elements}, header.textures


@dataclass
class _Property:
    name: str
    type: str
    #: the type of the length if this is a list
    length: str | None = None


@dataclass
class Element:
    """A table of a file. used: the names of its properties that were asked for and found."""

    name: str
    count: int
    properties: list[_Property] = field(default_factory=list)
    #: by property: (count,) numbers; of lists (count, length), or a list of lists if their lengths differ
    values: dict[str, Any] = field(default_factory=dict)
    used: set[str] = field(default_factory=set)

    def table(self, *names: str) -> NDArray[np.float64] | None:
        """Return the scalar properties of these names side by side, or None if one is missing."""
        scalars = {p.name for p in self.properties if p.length is None}
        if not scalars.issuperset(names):
            return None
        self.used.update(names)
        return np.stack([np.asarray(self.values[name], dtype=np.float64) for name in names], axis=1)

    def lists(self, *names: str) -> tuple[NDArray[np.int64], NDArray[np.float64]] | None:
        """Return the first list property of one of these names, as lengths of its lists and all numbers; or None."""
        for name in names:
            if any(p.name == name and p.length is not None for p in self.properties):
                self.used.add(name)
                rows = self.values[name]
                if isinstance(rows, np.ndarray):
                    return np.full(len(rows), rows.shape[1]), rows.reshape(-1).astype(np.float64)
                sizes = np.array([len(row) for row in rows], dtype=np.int64)
                return sizes, np.fromiter(chain.from_iterable(rows), dtype=np.float64)
        return None

    def colors(self) -> NDArray[np.float64] | None:
        """Return (n, 4) colours with alpha, 0..255; None if there are none."""
        for *names, alpha in _COLORS:
            if (colors := self._levels(*names)) is not None:
                opacities = self._levels(alpha)
                return np.hstack([colors, np.full((len(colors), 1), 255.0) if opacities is None else opacities])
        return None

    def _levels(self, *names: str) -> NDArray[np.float64] | None:
        table = self.table(*names)
        if table is None or not len(table):
            return None
        kind = next(p.type for p in self.properties if p.name == names[0])
        return to_bytes(table, _LARGEST.get(kind))


@dataclass
class _Header:
    encoding: str = ""
    elements: list[Element] = field(default_factory=list)
    textures: list[str] = field(default_factory=list)


def _open(data: bytes) -> tuple[_Header, _Text | _Binary]:
    """Return the header, with elements that have no values yet, and where these are."""
    header, start, number = _Header(), 0, 0
    if not data.startswith((b"ply", b"PLY")):
        raise InputError("a PLY file begins with the line ply")
    line_end = b"\r" if data[3:4] == b"\r" and data[4:5] != b"\n" else b"\n"
    line = ""
    while line != "end_header":
        end = data.find(line_end, start)
        if end < 0:
            raise InputError("its header has no line end_header")
        line = data[start:end].decode("ascii", errors="replace").strip()
        start, number = end + 1, number + 1
        try:
            _read_header_line(header, line)
        except (ValueError, KeyError, IndexError):
            raise InputError(
                f"line {number} of its header is {line[:60]!r}; known are format, element and its count, then property "
                "and its type, and comment, obj_info, end_header"
            ) from None
    if not header.encoding:
        raise InputError("its header has no line format")
    if header.encoding == "ascii":
        return header, _Text(data[start:], number)
    return header, _Binary(data[start:], "<" if "little" in header.encoding else ">")


def _read_header_line(header: _Header, line: str) -> None:
    match line.split():
        case ["format", name, _] if name in ("ascii", "binary_little_endian", "binary_big_endian"):
            header.encoding = name
        case ["element", name, count] if int(count) >= 0:
            header.elements.append(Element(name, int(count)))
        case ["property", "list", length, kind, name]:
            header.elements[-1].properties.append(_Property(name, _TYPES[kind], _TYPES[length]))
        case ["property", kind, name]:
            header.elements[-1].properties.append(_Property(name, _TYPES[kind]))
        case ["comment", "TextureFile", *words]:
            header.textures.append(" ".join(words))
        case ["ply" | "PLY"] | ["end_header"] | ["comment" | "obj_info", *_] | []:
            pass
        case _:
            raise ValueError


_Field = tuple[str, str, int]


class _Text:
    """Lines of numbers, a line for each row of an element."""

    def __init__(self, data: bytes, before: int) -> None:
        """Take the lines after the header. before: the number of lines of the header."""
        self.lines = plain_text(data).split("\n")
        self.before = before
        self.at = 0

    def table(self, fields: list[_Field], count: int) -> dict[str, NDArray[Any]] | None:
        """Return `count` rows of these fields (name, type, count of numbers), or None if the data has another form."""
        self._skip_blank()
        try:
            table = np.loadtxt(self.lines[self.at : self.at + count], ndmin=2, comments=None)
        except ValueError:
            return None
        if table.shape != (count, sum(size for _, _, size in fields)):
            return None
        self.at += count
        starts = np.cumsum([0, *(size for _, _, size in fields)]).tolist()
        return {name: table[:, at : at + size] for (name, _, size), at in zip(fields, starts, strict=False)}

    def row(self, element: Element) -> dict[str, list[float]]:
        """Return the values of a line, by property."""
        self._skip_blank()
        if self.at == len(self.lines):
            raise _ended(element)
        line, place = self.lines[self.at], f"line {self.before + self.at + 1}"
        self.at += 1
        words = line.split()
        row, used = {}, 0
        try:
            for p in element.properties:
                size = 1
                if p.length is not None:
                    size, used = int(words[used]), used + 1
                row[p.name] = [float(word) for word in words[used : used + size]]
                if len(row[p.name]) != size:
                    raise ValueError
                used += size
            if used < len(words):
                raise ValueError
        except (ValueError, IndexError):
            form = ", ".join(f"a list {p.name} after its length" if p.length else p.name for p in element.properties)
            raise InputError(
                f"{place} should hold an element {element.name} ({form}) and nothing else, not {line.strip()[:60]!r}"
            ) from None
        return row

    def _skip_blank(self) -> None:
        while self.at < len(self.lines) and not self.lines[self.at].strip():
            self.at += 1

    def finish(self) -> None:
        """Refuse what is left over."""
        for number, line in enumerate(self.lines[self.at :], self.before + self.at + 1):
            if line.strip():
                raise InputError(f"line {number} is left over behind the elements of its header: {line.strip()[:60]!r}")


class _Binary:
    """Numbers one after the other, each in the bytes of its type."""

    def __init__(self, data: bytes, order: str) -> None:
        self.data = data
        self.order = order
        self.at = 0

    def table(self, fields: list[_Field], count: int) -> dict[str, NDArray[Any]] | None:
        """Return `count` rows of these fields (name, type, count of numbers), or None if the data is too short."""
        row = np.dtype([(name, self.order + kind, (size,)) for name, kind, size in fields])
        if self.at + row.itemsize * count > len(self.data):
            return None
        table = np.frombuffer(self.data, row, count, self.at)
        self.at += row.itemsize * count
        return {name: table[name] for name, _, _ in fields}

    def row(self, element: Element) -> dict[str, list[float]]:
        """Return the values of a row, by property."""
        row = {}
        for p in element.properties:
            size = 1 if p.length is None else int(self._numbers(element, p.length, 1)[0])
            row[p.name] = self._numbers(element, p.type, size)
        return row

    def _numbers(self, element: Element, kind: str, size: int) -> list[float]:
        found = self.table([("numbers", kind, size)], 1) if size >= 0 else None
        if found is None:
            raise _ended(element)
        numbers: list[float] = found["numbers"][0].tolist()
        return numbers


def _ended(element: Element) -> InputError:
    return InputError(f"it ends before its {element.count} elements {element.name} are complete")


def _read_element(element: Element, source: _Text | _Binary) -> None:
    lists = [p for p in element.properties if p.length is not None]
    if not element.count or not element.properties:
        element.values = {p.name: [] for p in element.properties}
        return
    start = source.at
    first = source.row(element)
    source.at = start
    # nearly always all lists of an element are of one length: then it is read as one table
    table = source.table(
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
    if not lists and isinstance(source, _Binary):
        raise _ended(element)
    source.at = start
    rows = [source.row(element) for _ in range(element.count)]
    element.values = {
        p.name: [row[p.name][0] if p.length is None else row[p.name] for row in rows] for p in element.properties
    }
