"""OFF, the Object File Format of Geomview, as text or binary, with its colours (which trimesh drops)."""

from __future__ import annotations

import re
from itertools import chain
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ...errors import InputError, warn
from ...values import plural
from .._mesh import DEFAULT_COLOR, Mesh, weld
from .._texture import to_bytes
from .content import checked_text, read_bytes
from .model import given_normals
from .polygons import cut

_HEADER = re.compile(r"(?P<letters>(?:ST|C|N|4|n)*)OFF(?P<count>\d*)")
#: The first line of a binary file.
_BINARY = re.compile(rb"\s*\w*OFF[ \t]+BINARY[^\n]*\n")

_Line = tuple[int, list[str]]
_Rows = list[list[float]]
#: The rows of vertices, the corners of each face, and what stands behind these: a colour, or nothing.
_Content = tuple[_Rows, list[list[int]], _Rows]


def read_off(path: Path) -> Mesh:
    """Return the mesh of an OFF file, whose header may have the letters ST, C, N, 4 and n in any order.

    Colours are integers 0..255 or fractions 0..1, with or without alpha. A face with a colour of its own has that one,
    else those of its vertices, else light grey. An InputWarning tells what is left out, such as numbers into a table of
    colours, which the format leaves to the program.
    """
    data = read_bytes(path)
    binary = _BINARY.match(data)
    text = binary[0].decode("ascii", errors="replace") if binary else checked_text(path, data)
    lines = [(number, line.partition("#")[0].split()) for number, line in enumerate(text.splitlines(), 1)]
    lines = [(number, words) for number, words in lines if words]
    header = _HEADER.fullmatch(lines[0][1][0]) if lines else None
    if header is None:
        raise InputError("an OFF file begins with OFF, or with letters before it, as in COFF, NOFF, NCOFF or STOFF")
    letters = header["letters"]
    size = 4 if "4" in letters else 3
    least = size + 3 * ("N" in letters) + 2 * ("ST" in letters)
    if binary:
        found = _read_binary(path, data[binary.end() :], "n" in letters, least + 4 * ("C" in letters))
    else:
        # the counts may follow at once
        lines[0] = (lines[0][0], [*([header["count"]] if header["count"] else []), *lines[0][1][1:]])
        found = _read_text(path, [line for line in lines if line[1]], "n" in letters, least)
    vertices, polygons, face_colors = found
    positions = np.array([vertex[:size] for vertex in vertices]).reshape(-1, size)
    if size == 4:
        with np.errstate(all="ignore"):
            positions = positions[:, :3] / positions[:, 3:]
    behind = [vertex[size:] for vertex in vertices]
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
    return weld(positions, corners, colors, given_normals(normals, positions, corners, str(path)))


def _read_text(path: Path, lines: list[_Line], has_dimension: bool, least: int) -> _Content:
    if has_dimension and lines:
        number, (dimension, *words) = lines[0]
        _check_dimension(dimension)
        lines = [*([(number, words)] if words else []), *lines[1:]]
    if not lines:
        raise InputError("the counts of vertices and faces are missing")
    vertex_count, face_count = _counts(lines[0])
    end = 1 + vertex_count + face_count
    if len(lines) < end:
        raise InputError(
            f"line {lines[0][0]} promises {vertex_count} vertices and {face_count} faces, "
            f"but only {len(lines) - 1} lines follow"
        )
    if len(lines) > end:
        warn(f"{path}: the lines behind its faces are left out: {len(lines) - end:,}")
    return _numbers(lines[1 : 1 + vertex_count], least), *_faces(lines[1 + vertex_count : end])


def _read_binary(path: Path, data: bytes, has_dimension: bool, width: int) -> _Content:
    """Return the content of integers and floats of four bytes each. width: of the rows of vertices."""
    integers = np.frombuffer(data[: len(data) // 4 * 4], ">i4")
    floats = integers.view(">f4")
    if has_dimension:
        _check_dimension(integers[0] if len(integers) else None)
        integers, floats = integers[1:], floats[1:]
    if len(integers) < 3:
        raise InputError("the counts of vertices and faces are missing")
    vertex_count, face_count, _ = integers[:3].tolist()
    ended = InputError(f"it ends before its {vertex_count} vertices and {face_count} faces are complete")
    at = 3 + vertex_count * width
    if not 3 <= at <= len(integers):
        raise ended
    polygons, colors = [], []
    for _ in range(face_count):
        size = int(integers[at]) if at < len(integers) else 0
        channels = int(integers[at + 1 + size]) if 0 < size < len(integers) - at - 1 else -1
        polygons.append(integers[at + 1 : at + 1 + size].tolist())
        at += 2 + size
        colors.append(floats[at : at + max(channels, 0)].tolist())
        at += channels
        if channels < 0 or at > len(integers):
            raise ended
    if at < len(integers):
        warn(f"{path}: what is behind its faces is left out: {plural(4 * (len(integers) - at), 'byte')}")
    return floats[3 : 3 + vertex_count * width].reshape(-1, width).tolist(), polygons, colors


def _check_dimension(found: object) -> None:
    if str(found) != "3":
        raise InputError(f"its vertices have {found} dimensions; those of a mesh have 3")


def _counts(line: _Line) -> tuple[int, int]:
    try:
        vertices, faces = (int(word) for word in line[1][:2])
        if vertices < 0 or faces < 0:
            raise ValueError
    except ValueError:
        raise InputError(
            f"line {line[0]} should hold the counts of vertices and faces, not {' '.join(line[1])[:60]!r}"
        ) from None
    return vertices, faces


def _numbers(lines: list[_Line], least: int) -> _Rows:
    rows = []
    for number, words in lines:
        try:
            row = [float(word) for word in words]
        except ValueError:
            row = []
        if len(row) < least:
            raise InputError(f"line {number} should hold the {least} numbers of a vertex, not {' '.join(words)[:60]!r}")
        rows.append(row)
    return rows


def _faces(lines: list[_Line]) -> tuple[list[list[int]], _Rows]:
    polygons, colors = [], []
    for number, words in lines:
        try:
            size = int(words[0])
            polygon = [int(word) for word in words[1 : 1 + size]]
            color = [float(word) for word in words[1 + size :]]
            if size < 1 or len(polygon) < size:
                raise ValueError
        except ValueError:
            raise InputError(
                f"line {number} should hold the vertices of a face, not {' '.join(words)[:60]!r}"
            ) from None
        polygons.append(polygon)
        colors.append(color)
    return polygons, colors


def _colors(path: Path, rows: _Rows, what: str) -> NDArray[np.float64]:
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
