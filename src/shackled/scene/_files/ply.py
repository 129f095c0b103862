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

from ...base.checks import Floats, Ints
from ...base.values import plural
from ...errors import InputError, warn
from .._mesh import DEFAULT_COLOR
from .._texture import to_bytes
from .beside import picture_beside
from .content import plain_text, read_content, with_points
from .images import Images
from .model import REPLACED, Look, MeshPart, Picture, finite_uvs, given_normals, replaced, split, under
from .polygons import cut, whole

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


@dataclass
class _Property:
    """A number of an element, or a list of them after its length, whose type is `length`."""

    name: str
    type: str
    length: str | None = None


@dataclass
class Element:
    """A table of a file. values: its rows by property, of a number or a list. used: properties that were read."""

    name: str
    count: int
    properties: list[_Property] = field(default_factory=list)
    values: dict[str, Any] = field(default_factory=dict)
    used: set[str] = field(default_factory=set)

    @property
    def rows(self) -> int:
        """How many rows of values it has."""
        return len(next(iter(self.values.values()), ()))

    def table(self, *names: str) -> Floats | None:
        """Return the scalar properties of these names side by side, or None if one is missing."""
        if not {p.name for p in self.properties if p.length is None}.issuperset(names):
            return None
        self.used.update(names)
        columns = [np.asarray(self.values.get(name, []), dtype=np.float64).reshape(-1) for name in names]
        return np.stack(columns, axis=1)

    def lists(self, *names: str) -> tuple[Ints, Floats] | None:
        """Return the first list property of one of these names, as lengths of its lists and all numbers; or None."""
        name = next((n for n in names if any(p.name == n and p.length is not None for p in self.properties)), None)
        if name is None:
            return None
        self.used.add(name)
        rows = self.values.get(name, [])
        if isinstance(rows, np.ndarray):
            return np.full(len(rows), rows.shape[1]), rows.reshape(-1).astype(np.float64)
        return np.array([len(row) for row in rows], dtype=np.int64), np.fromiter(chain.from_iterable(rows), np.float64)

    def colors(self) -> Floats | None:
        """Return (n, 4) colours with alpha, 0..255; None if there are none."""
        for *names, alpha in _COLORS:
            if (colors := self._levels(*names)) is not None:
                opacities = self._levels(alpha)
                return np.hstack([colors, np.full((len(colors), 1), 255.0) if opacities is None else opacities])
        return None

    def _levels(self, *names: str) -> Floats | None:
        table = self.table(*names)
        if table is None or not len(table):
            return None
        kind = next(p.type for p in self.properties if p.name == names[0])
        return to_bytes(table, _LARGEST.get(kind))


#: The elements of surfaces.
_FACES = ("face", "tristrips")


def read_elements(data: bytes, path: Path) -> tuple[dict[str, Element], list[str]]:
    """Return the elements of a PLY file by their names, and the textures that its comments name."""
    elements, textures, source = _open(data, path)
    for element in elements:
        if element.count and element.properties:
            element.values, broken = _values(element, source)
            if broken is None:
                continue
            if not any(each.rows for each in elements if each.name in _FACES):
                raise broken  # without all vertices and one face there is nothing to draw
            what = f"{element.count - element.rows:,} of its {element.count:,} elements {element.name} and all behind"
            warn(f"{path}: {what} left out: {broken}")
            return {each.name: each for each in elements}, textures
    if isinstance(source, _Text):
        source.finish()
    return {element.name: element for element in elements}, textures


def _open(data: bytes, path: Path) -> tuple[list[Element], list[str], _Text | _Binary]:
    """Return what the header says: elements that have no values yet, and textures; and where the values are."""
    elements, textures, encoding = list[Element](), list[str](), ""
    if not data.startswith((b"ply", b"PLY")):
        raise InputError("a PLY file begins with the line ply")
    line_end = b"\r" if data[3:4] == b"\r" and data[4:5] != b"\n" else b"\n"
    line, start, number = "", 0, 0
    while line != "end_header":
        end = data.find(line_end, start)
        if end < 0:
            raise InputError("its header has no line end_header")
        line = data[start:end].decode("ascii", errors="replace").strip()
        start, number = end + 1, number + 1
        try:
            match line.split():
                case ["format", "ascii" | "binary_little_endian" | "binary_big_endian" as encoding, _]:
                    pass
                case ["element", name, count] if int(count) >= 0:
                    elements.append(Element(name, int(count)))
                case ["property", "list", length, kind, name]:
                    elements[-1].properties.append(_Property(name, _TYPES[kind], _TYPES[length]))
                case ["property", kind, name]:
                    elements[-1].properties.append(_Property(name, _TYPES[kind]))
                case ["comment", "TextureFile", *words]:
                    textures.append(" ".join(words))
                case ["ply" | "PLY"] | ["end_header"] | ["comment" | "obj_info", *_] | []:
                    pass
                case _:
                    raise ValueError
        except (ValueError, KeyError, IndexError):
            raise InputError(
                f"line {number} of its header is {line[:60]!r}; known are format, element and its count, then property "
                "and its type, and comment, obj_info, end_header"
            ) from None
    if not encoding:
        raise InputError("its header has no line format")
    if encoding == "ascii":
        return elements, textures, _Text(with_points(path, plain_text(data[start:])), number)
    return elements, textures, _Binary(data[start:], "<" if "little" in encoding else ">")


#: Name, type, and count of numbers.
_Field = tuple[str, str, int]


class _Text:
    """Lines of numbers, a line for each row of an element."""

    def __init__(self, text: str, before: int) -> None:
        """Take the lines after the header. before: the number of lines of the header."""
        self.lines = text.split("\n")
        self.before = before
        self.at = 0

    def table(self, fields: list[_Field], count: int) -> dict[str, NDArray[Any]] | None:
        """Return `count` rows of these fields, or None if the data has another form."""
        self._skip_blank()
        try:
            table = np.loadtxt(self.lines[self.at : self.at + count], ndmin=2, comments=None)
        except ValueError:
            return None
        ends = np.cumsum([size for _, _, size in fields])
        if table.shape != (count, ends[-1]):
            return None
        self.at += count
        return dict(zip((name for name, _, _ in fields), np.split(table, ends[:-1], axis=1), strict=True))

    def row(self, element: Element) -> dict[str, list[float]]:
        """Return the values of a line, by property."""
        self._skip_blank()
        if self.at == len(self.lines):
            raise _ended(element)
        line = self.lines[self.at]
        self.at += 1
        words = iter(line.split())
        try:
            row = {}
            for p in element.properties:
                size = 1 if p.length is None else int(next(words))
                row[p.name] = [float(next(words)) for _ in range(size)]
                if size < 0:
                    raise ValueError
            if next(words, None) is not None:
                raise ValueError
        except (ValueError, StopIteration):
            form = ", ".join(f"a list {p.name} after its length" if p.length else p.name for p in element.properties)
            raise InputError(
                f"line {self.before + self.at} should hold an element {element.name} ({form}) and nothing else, not "
                f"{line.strip()[:60]!r}"
            ) from None
        return row

    def _skip_blank(self) -> None:
        while self.at < len(self.lines) and not self.lines[self.at].strip():
            self.at += 1

    def finish(self) -> None:
        """Refuse what is left over."""
        self._skip_blank()
        if self.at < len(self.lines):
            raise InputError(
                f"line {self.before + self.at + 1} is left over behind the elements of its header: "
                f"{self.lines[self.at].strip()[:60]!r}"
            )


class _Binary:
    """Numbers one after the other, each in the bytes of its type."""

    def __init__(self, data: bytes, order: str) -> None:
        self.data = data
        self.order = order
        self.at = 0

    def table(self, fields: list[_Field], count: int) -> dict[str, NDArray[Any]] | None:
        """Return `count` rows of these fields, or None if the data is too short."""
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


def _values(element: Element, source: _Text | _Binary) -> tuple[dict[str, Any], InputError | None]:
    """Return the rows of each property up to one that is wrong, and what is wrong with that.

    Nearly always all lists are of one length, and all rows are one table.
    """
    start, rows, broken = source.at, list[dict[str, list[float]]](), None
    try:
        sizes = {name: len(row) for name, row in source.row(element).items()}
        source.at = start
        fields, lengths = list[_Field](), dict[str, int]()
        for p in element.properties:
            if p.length is not None:
                fields.append((f"length of {p.name}", p.length, 1))
                lengths[fields[-1][0]] = sizes[p.name]
            fields.append((p.name, p.type, sizes[p.name]))
        table = source.table(fields, element.count)
        if table is not None and all((table[name] == size).all() for name, size in lengths.items()):
            return table, None
        if not lengths and isinstance(source, _Binary):
            raise _ended(element)
        source.at = start
        rows.extend(source.row(element) for _ in range(element.count))
    except InputError as error:
        broken = error
    return {p.name: [row[p.name] for row in rows] for p in element.properties}, broken


#: The names of texture coordinates, which go to the right and up.
_COORDINATES = (("s", "t"), ("u", "v"), ("texture_u", "texture_v"))
#: What ends a strip of triangles.
_END = -1
#: The number of a texture that there is not.
_NONE = -1


def read_ply(path: Path) -> list[MeshPart]:
    """Return the meshes of a PLY file: one for each texture, and one for what has none.

    A corner has the colour of its texture, else of its face, else of its vertex, else light grey. Where all faces have
    the same colour, those of vertices come first. An InputWarning tells what is left out.
    """
    elements, textures = read_elements(read_content(path), path)
    vertex = elements.get("vertex", Element("vertex", 0))
    face = next((elements[name] for name in _FACES if name in elements and elements[name].count), None)
    positions = vertex.table("x", "y", "z")
    if face is None and positions is not None:
        raise InputError(
            f"it has {plural(vertex.count, 'point')} and no faces, so there is no surface to draw; a program such as"
            " MeshLab makes one of points"
        )
    polygons = None if face is None else face.lists("vertex_indices", "vertex_index")
    if face is None or positions is None or polygons is None:
        raise InputError(
            "a mesh needs an element vertex with x, y and z, and an element face with a list vertex_indices; this file"
            f" has the elements {', '.join(elements) or 'none'}"
        )
    bad = np.flatnonzero(polygons[1] % 1 != 0)
    if len(bad):
        raise InputError(f"the numbers of vertices must be whole, not {polygons[1][bad[0]]}")
    sizes, numbers = polygons[0], polygons[1].astype(np.int64)
    is_strips = face.name == "tristrips"
    if is_strips:
        numbers = _strips(sizes, numbers)
        sizes = np.full(len(numbers) // 3, 3)
    kept = whole(path, sizes, numbers, len(positions))
    triangles = cut(positions, sizes, np.where(kept.repeat(sizes), numbers, 0))
    triangles = triangles[kept[triangles[:, 3]]]
    corners, polygon = numbers[triangles[:, :3]], triangles[:, 3]
    colors = _colors(path, vertex, Element("face", 0) if is_strips else face, corners, polygon)
    normals = given_normals(vertex.table("nx", "ny", "nz"), positions, corners, str(path))
    images = Images()
    opened = [picture_beside(path, [path.parent], name, images) for name in textures]
    pictures = {number: each for number, each in enumerate(opened) if each is not None}
    picture, uvs = np.full(len(corners), _NONE), np.zeros((len(corners), 3, 2))
    if pictures:
        picture, uvs = _textured(path, vertex, face, sizes, triangles, corners)
        _paint(path, pictures, picture, uvs, colors)
    _tell_what_is_left(path, elements)
    # the last one is that of _NONE
    return split(positions, corners, colors, normals, uvs, picture, [*map(Look, opened), Look()])


def _strips(sizes: Ints, numbers: Ints) -> Ints:
    """Return the corners of the triangles of strips, three for each, without those of no area that join strips."""
    numbers = np.insert(numbers, np.cumsum(sizes), _END)
    place = np.arange(len(numbers))
    start = np.maximum.accumulate(np.where(numbers == _END, place, -1)) + 1
    triangles = np.stack([numbers[:-2], numbers[1:-1], numbers[2:]], axis=1)
    odd = (place - start)[:-2] % 2 == 1
    triangles[odd] = triangles[odd][:, [1, 0, 2]]
    a, b, c = triangles.T
    kept: Ints = triangles[(triangles != _END).all(axis=1) & (a != b) & (b != c) & (c != a)]
    return kept.reshape(-1)


def _colors(path: Path, vertex: Element, face: Element, corners: Ints, polygon: Ints) -> Floats:
    """Return the colours of corners with alpha, (m, 3, 4). polygon: (m,) the row of `face` for each triangle."""
    of_faces, of_vertices = face.colors(), vertex.colors()
    if of_faces is not None and (of_vertices is None or (of_faces != of_faces[0]).any()):
        if of_vertices is not None:
            warn(f"{path}: the colours of its vertices are left out, for its faces have colours")
        return np.repeat(of_faces[polygon][:, None], 3, axis=1)
    if of_vertices is not None:
        return of_vertices[corners]
    return np.full((*corners.shape, 4), (*DEFAULT_COLOR, 255.0))


def _textured(
    path: Path, vertex: Element, face: Element, sizes: Ints, triangles: Ints, corners: Ints
) -> tuple[Ints, Floats]:
    """Return the texture of each triangle, (m,), and its place there, (m, 3, 2): of its corners, else its vertices."""
    polygon = triangles[:, 3]
    numbers = face.table("texnumber")
    picture = np.zeros(len(triangles), np.int64) if numbers is None else numbers[polygon, 0].astype(np.int64)
    uvs = np.zeros((*corners.shape, 2))
    of_corners = face.lists("texcoord")
    of_vertices = next((found for names in _COORDINATES if (found := vertex.table(*names)) is not None), None)
    if of_corners is not None:
        whole = of_corners[0] == 2 * sizes
        flat = np.zeros((sizes.sum(), 2))
        flat[np.repeat(whole, sizes)] = of_corners[1][np.repeat(whole, of_corners[0])].reshape(-1, 2)
        uvs = flat[triangles[:, :3]]
        picture[~whole[polygon]] = _NONE
    elif of_vertices is not None:
        uvs = of_vertices[corners]
    else:
        warn(f"{path}: its texture is left out, for it has no texture coordinates")
        picture[:] = _NONE
    return picture, finite_uvs(uvs, str(path)) * (1, -1) + (0, 1)


def _paint(path: Path, pictures: dict[int, Picture], picture: Ints, uvs: Floats, colors: Floats) -> None:
    """Give the triangles with a texture its colours; those that do not need it then have none."""
    picture[~np.isin(picture, list(pictures))] = _NONE
    if count := replaced(colors[picture != _NONE]):
        warn(f"{path}: {plural(count, 'triangle')} {REPLACED}")
    for number, opened in pictures.items():
        faces = np.flatnonzero(picture == number)
        colors[faces], needs_it = under(opened, uvs[faces], colors[faces])
        if not needs_it:
            picture[faces] = _NONE


def _tell_what_is_left(path: Path, elements: dict[str, Element]) -> None:
    left = [f"{each.name} ({each.count:,})" for each in elements.values() if each.count and not each.used]
    used = [each for each in elements.values() if each.used]
    left += [f"{p.name} of {each.name}" for each in used for p in each.properties if p.name not in each.used]
    if left:
        warn(f"{path}: of its elements are left out: {', '.join(left)}")
