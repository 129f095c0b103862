"""The lines of Wavefront OBJ files, as exporters write them rather than as they are specified."""

from __future__ import annotations

import io
import math
import re
from array import array
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ...errors import InputError, warn
from ...values import plural
from .content import read_text
from .mtl import ObjMaterial, material_name, read_materials

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

ABSENT = -1

#: A comment behind numbers, of which one may be -1.#IND.
_COMMENT = re.compile(r"#(?!IND|INF|[QS]NAN)")
#: What C libraries of Windows write in place of a number, and Python does not read.
_NO_NUMBER = re.compile(r"[-+]?(?:1\.#\w+|nan\(\w*\))", re.IGNORECASE)
#: Lines whose backslash at the end belongs to a comment or a name.
_OF_NAMES = re.compile(r"\s*(?:#|(?:usemtl|mtllib|g|o)\s.*\S\\\s*$)")
#: ZBrush's colours of vertices, in comments: mask, red, green and blue, two hexadecimal digits each.
_POLYPAINT = "#MRGB"
#: Statements with nothing to draw.
_SILENT = frozenset(("g", "o", "mg", "bevel", "c_interp", "d_interp", "lod", "shadow_obj", "trace_obj"))
#: What of the shape is left out, by its statement.
_SHAPES = {
    "p": ("point", "points"),
    "l": ("line", "lines"),
    "f": ("face of fewer than 3 corners", "faces of fewer than 3 corners"),
    "curv": ("curve", "curves"),
    "surf": ("curved surface", "curved surfaces"),
}
#: So many kinds of other statements are named.
_MOST_NAMED = 8


class ObjLines:
    """What the lines of a file say, in flat arrays, for there may be millions.

    The corners of all faces are numbered one after the other; vertex, texcoord and normal have an entry for each.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.positions = array("d")
        self.vertex_colors: dict[int, list[float]] = {}
        self.polypaint = bytearray()
        self.texcoords = array("d")
        self.normals = array("d")
        self.vertex = array("q")
        self.texcoord = array("q")
        self.normal = array("q")
        self.sizes = array("q")
        self.face_lines = array("q")
        self.face_materials = array("q")
        self.face_groups = array("q")
        self.material_numbers: dict[str, int] = {"": 0}
        self.materials: dict[str, ObjMaterial] = {}
        self.has_library = False
        #: how many statements of a kind are not read
        self.left_out: Counter[str] = Counter()

    def line_of(self, corner: int) -> int:
        """Return the line of the face that a corner belongs to."""
        return self.face_lines[int(np.searchsorted(np.cumsum(self.sizes), corner, side="right"))]


@dataclass(frozen=True)
class ObjFaces:
    """The faces of a file that can be drawn. vertex, texcoord, normal: of each corner, or ABSENT."""

    positions: Floats
    texcoords: Floats
    normals: Floats
    vertex: Ints
    texcoord: Ints
    normal: Ints
    sizes: Ints
    material: Ints
    group: Ints


def read_lines(path: Path) -> ObjLines:
    """Return the lines of a file. InputError for one that is of no OBJ file."""
    obj = ObjLines(path)
    material, group = 0, 0
    lines = enumerate(io.StringIO(read_text(path) + "\n"), 1)
    for number, line in lines:
        while "\\" in line and line.rstrip().endswith("\\") and not _OF_NAMES.match(line):
            line = line.rstrip()[:-1] + " " + next(lines, (0, ""))[1]
        words = (_COMMENT.split(line)[0] if "#" in line else line).split()
        if not words:
            if line.startswith(_POLYPAINT):
                _add_polypaint(obj, line)
            continue
        keyword = words[0]
        try:
            if keyword == "v":
                values = _numbers(words, 3)
                if len(values) >= 6:
                    obj.vertex_colors[len(obj.positions) // 3] = values[3:6]
                obj.positions.extend(values[:3])
            elif keyword == "vt":
                obj.texcoords.extend([*_numbers(words, 1), 0.0][:2])
            elif keyword == "vn":
                obj.normals.extend(_numbers(words, 3)[:3])
            elif keyword == "f" and len(words) > 3:
                _add_face(obj, words[1:])
                obj.face_lines.append(number)
                obj.face_materials.append(material)
                obj.face_groups.append(group)
            elif keyword == "usemtl":
                material = obj.material_numbers.setdefault(material_name(line), len(obj.material_numbers))
            elif keyword == "s":
                group = int(words[1]) if words[1:] and words[1].isdecimal() else 0
            elif keyword == "mtllib":
                obj.has_library = True
                obj.materials.update(read_materials(path, line))
            elif keyword not in _SILENT:
                obj.left_out[keyword] += len(words) - 1 if keyword == "p" else 1
        except ValueError:
            raise InputError(f"line {number} is not one of an OBJ file: {line.strip()[:60]!r}") from None
    return obj


def _numbers(words: list[str], least: int) -> list[float]:
    """Return the numbers behind a keyword, NaN for those that are none. ValueError for other words, or too few."""
    try:
        values = [float(word) for word in words[1:]]
    except ValueError:
        values = [math.nan if _NO_NUMBER.fullmatch(word) else float(word) for word in words[1:]]
    if len(values) < least:
        raise ValueError
    return values


def _add_polypaint(obj: ObjLines, line: str) -> None:
    try:
        levels = bytes.fromhex(line[len(_POLYPAINT) :])
    except ValueError:  # a comment after all
        return
    obj.polypaint += levels[: len(levels) // 4 * 4]


def _add_face(obj: ObjLines, corners: list[str]) -> None:
    vertices, texcoords, normals = len(obj.positions) // 3, len(obj.texcoords) // 2, len(obj.normals) // 3
    for corner in corners:
        vertex, _, rest = corner.partition("/")
        texcoord, _, normal = rest.partition("/")
        obj.vertex.append(_number(vertex, vertices))
        obj.texcoord.append(_number(texcoord, texcoords) if texcoord else ABSENT)
        obj.normal.append(_number(normal, normals) if normal else ABSENT)
    obj.sizes.append(len(corners))


def _number(word: str, count: int) -> int:
    """Return the number of a vertex from 0; files count from 1, or back from the latest with -1.

    A number out of range becomes `count` or more.
    """
    number = int(word)
    if number > 0:
        return number - 1
    return count + number if -count <= number < 0 else 1 << 40


def drawn_faces(obj: ObjLines) -> ObjFaces:
    """Return the faces with finite coordinates. InputError if there are none, or one names a vertex that is not there.

    InputWarnings tell of what is left out.
    """
    _tell_of_statements(obj)
    positions, texcoords, normals = (
        np.array(column, dtype=np.float64).reshape(-1, width)
        for column, width in ((obj.positions, 3), (obj.texcoords, 2), (obj.normals, 3))
    )
    vertex, sizes, material, group = (
        np.array(column, dtype=np.int64) for column in (obj.vertex, obj.sizes, obj.face_materials, obj.face_groups)
    )
    bad = np.flatnonzero(vertex >= len(positions))
    if len(bad):
        raise InputError(
            f"the face in line {obj.line_of(bad[0])} names a vertex that does not exist; "
            + (f"there are v lines 1 to {len(positions)}" if len(positions) else "there are no v lines")
        )
    texcoord = _present(obj, obj.texcoord, texcoords, "texture coordinates (vt)", "has no texture")
    normal = _present(obj, obj.normal, normals, "normals (vn)", "has computed ones")
    finite = np.asarray(np.isfinite(positions).all(axis=1), dtype=bool)
    owner = np.repeat(np.arange(len(sizes)), sizes)
    kept = np.ones(len(sizes), dtype=bool)
    kept[owner[np.flatnonzero(~finite[vertex])]] = False
    if kept.any():  # otherwise the mesh tells what is wrong
        positions[~finite] = 0
        corners = kept[owner]
        vertex, texcoord, normal = vertex[corners], texcoord[corners], normal[corners]
        sizes, material, group = sizes[kept], material[kept], group[kept]
        lost = len(kept) - len(sizes)
        if lost:
            warn(f"{obj.path}: {plural(lost, 'face')} left out, with coordinates that are not finite numbers")
    return ObjFaces(positions, texcoords, normals, vertex, texcoord, normal, sizes, material, group)


def _tell_of_statements(obj: ObjLines) -> None:
    """Warn of statements that are left out. InputError if there are no faces."""
    shapes = [plural(obj.left_out[keyword], *names) for keyword, names in _SHAPES.items() if obj.left_out[keyword]]
    if not obj.sizes and shapes:
        raise InputError(
            f"it has no faces, only {', '.join(shapes)}; only faces are drawn, such as those of thin tubes in place of"
            " lines and of small balls in place of points"
        )
    if not obj.sizes:
        raise InputError(f"it has no faces ({len(obj.positions) // 3} vertices)")
    others = [
        plural(count, f"statement {keyword[:20]!r}", f"statements {keyword[:20]!r}")
        for keyword, count in obj.left_out.most_common(_MOST_NAMED)
        if keyword not in _SHAPES
    ]
    for left_out in (shapes, others):
        if left_out:
            warn(f"{obj.path}: {', '.join(left_out)} left out; only faces are drawn")


def _present(obj: ObjLines, column: array[int], values: Floats, what: str, instead: str) -> Ints:
    """Return the numbers of values of corners, ABSENT for a value that does not exist or is not finite."""
    numbers = np.array(column, dtype=np.int64)
    if not len(values):  # some exporters number coordinates and normals that they leave out
        return np.full_like(numbers, ABSENT)
    usable = np.append(np.isfinite(values).all(axis=1), False)
    bad = (numbers != ABSENT) & ~usable[np.minimum(numbers, len(values))]
    if bad.any():
        warn(
            f"{obj.path}: {plural(int(bad.sum()), 'corner')} with {what} that do not exist or are not finite, first in"
            f" line {obj.line_of(int(bad.argmax()))}; the face {instead}"
        )
    return np.where(bad, ABSENT, numbers)
