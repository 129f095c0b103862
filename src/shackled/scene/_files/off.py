"""OFF, the Object File Format of Geomview, as text, with its colours (which trimesh drops)."""

from __future__ import annotations

import re
from itertools import chain
from pathlib import Path

import numpy as np

from ...base.checks import Floats
from ...errors import InputError, warn
from .._mesh import DEFAULT_COLOR, weld
from .._texture import to_bytes
from .content import read_text, with_points
from .model import MeshPart, given_normals
from .polygons import cut

_HEADER = re.compile(r"(?P<letters>(?:ST|C|N)*)OFF(?P<count>\d*)")

#: The number of a line, and its words.
_Line = tuple[int, list[str]]
_Rows = list[list[float]]


def read_off(path: Path) -> list[MeshPart]:
    """Return the mesh of an OFF file, whose header may have the letters ST, C and N in any order.

    Colours, of a face, else of its vertices, else light grey, are integers 0..255 or fractions 0..1. An InputWarning
    tells what is left out, such as numbers into a table of colours, which the format leaves to the program.
    """
    text = with_points(path, read_text(path))
    lines = [(number, line.partition("#")[0].split()) for number, line in enumerate(text.splitlines(), 1)]
    lines = [(number, words) for number, words in lines if words]
    header = _HEADER.fullmatch(lines[0][1][0]) if lines else None
    if header is None:
        raise InputError("an OFF file begins with OFF, or with letters before it, as in COFF, NOFF, NCOFF or STOFF")
    letters = header["letters"]
    (number, words), *lines = lines
    counts = [*filter(None, [header["count"]]), *words[1:]]
    if not counts and lines:
        (number, counts), *lines = lines
    if len(counts) < 2 or not all(map(str.isdecimal, counts[:2])):
        raise _wrong((number, counts), "the counts of vertices and faces")
    vertex_count, face_count = map(int, counts[:2])
    end = vertex_count + face_count
    if len(lines) < end:
        raise InputError(f"line {number} promises {end} vertices and faces, but {len(lines)} lines follow")
    if len(lines) > end:
        warn(f"{path}: the lines behind its faces are left out: {len(lines) - end:,}")
    vertices = _numbers(lines[:vertex_count], 3 + 3 * ("N" in letters) + 2 * ("ST" in letters))
    polygons, face_colors = _faces(lines[vertex_count:end])
    positions, behind = np.array([vertex[:3] for vertex in vertices]).reshape(-1, 3), [row[3:] for row in vertices]
    if "ST" in letters:
        warn(f"{path}: its texture coordinates are left out, for an OFF file names no texture")
        behind = [row[:-2] for row in behind]
    normals = None
    if "N" in letters:
        # in Geomview's CNOFF the normal comes before the colour, in MeshLab's NCOFF behind it
        last = letters.find("N") < letters.find("C")
        normals = np.array([row[-3:] if last else row[:3] for row in behind])
        behind = [row[:-3] if last else row[3:] for row in behind]
    numbers = np.fromiter(chain.from_iterable(polygons), dtype=np.int64)
    triangles = cut(positions, [len(polygon) for polygon in polygons], numbers)
    corners = numbers[triangles[:, :3]]
    colors = _colors(path, behind, "vertices")[corners]
    own = np.array([len(face_colors[polygon]) in (3, 4) for polygon in triangles[:, 3]], dtype=bool)
    colors[own] = _colors(path, face_colors, "faces")[triangles[own, 3]][:, None, :]
    return [MeshPart(weld(positions, corners, colors, given_normals(normals, positions, corners, str(path))))]


def _wrong(line: _Line, what: str) -> InputError:
    return InputError(f"line {line[0]} should hold {what}, not {' '.join(line[1])[:60]!r}")


def _numbers(lines: list[_Line], least: int) -> _Rows:
    rows = []
    for line in lines:
        try:
            rows.append([float(word) for word in line[1]])
            if len(rows[-1]) < least:
                raise ValueError
        except ValueError:
            raise _wrong(line, f"the {least} numbers of a vertex") from None
    return rows


def _faces(lines: list[_Line]) -> tuple[list[list[int]], _Rows]:
    """Return the corners of each face, and the numbers behind these: a colour, or nothing."""
    polygons, colors = [], []
    for line in lines:
        try:
            size = int(line[1][0])
            polygons.append([int(word) for word in line[1][1 : 1 + size]])
            colors.append([float(word) for word in line[1][1 + size :]])
            if size < 1 or len(polygons[-1]) < size:
                raise ValueError
        except ValueError:
            raise _wrong(line, "the vertices of a face") from None
    return polygons, colors


def _colors(path: Path, rows: _Rows, what: str) -> Floats:
    """Return colours with alpha, (n, 4), 0..255; light grey for rows that are not of three or four numbers."""
    table = np.full((len(rows), 4), (*DEFAULT_COLOR, 255.0))
    given = [number for number, row in enumerate(rows) if len(row) in (3, 4)]
    if given:
        largest = 1 if max(max(rows[number]) for number in given) <= 1 else 255
        table[given] = to_bytes([[*rows[number], largest][:4] for number in given], largest)
        if not table[given, 3].any():  # writers without transparency leave 0
            table[:, 3] = 255
    if unknown := sum(len(row) not in (0, 3, 4) for row in rows):
        warn(f"{path}: numbers behind {what} that are no colours are left out: {unknown:,}")
    return table
