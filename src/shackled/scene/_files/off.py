"""OFF, the Object File Format of Geomview, with its colours (which trimesh drops)."""

from __future__ import annotations

import re
from itertools import chain
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ...errors import InputError
from .._crease import filled
from .._mesh import DEFAULT_COLOR, Mesh
from .colors import to_bytes
from .content import read_text
from .polygons import cut
from .weld import weld

_HEADER = re.compile(r"(?P<texture>ST)?(?P<color>C)?(?P<normal>N)?(?P<other>4?n?)OFF(?P<count>\d*)")

_Line = tuple[int, list[str]]


def read_off(path: Path) -> Mesh:
    """Return the mesh of an OFF file (also COFF, NOFF, STOFF and their mixtures).

    Colours are integers 0..255 or fractions 0..1. A face with a colour of its own has that one, else those of its
    vertices, else light grey. Numbers into a table of colours, which the format leaves to the program, are not read.
    """
    lines = [(number, line.partition("#")[0].split()) for number, line in enumerate(read_text(path).splitlines(), 1)]
    lines = [(number, words) for number, words in lines if words]
    header = _HEADER.fullmatch(lines[0][1][0]) if lines else None
    if header is None or header["other"] or "BINARY" in lines[0][1]:
        raise InputError(
            "an OFF file begins with OFF, COFF, NOFF or STOFF, and is text with three coordinates a vertex"
        )
    # the counts may follow at once
    lines[0] = (lines[0][0], [*([header["count"]] if header["count"] else []), *lines[0][1][1:]])
    lines = [line for line in lines if line[1]]
    if not lines:
        raise InputError("the counts of vertices and faces are missing")
    vertex_count, face_count = _counts(lines[0])
    if len(lines) < 1 + vertex_count + face_count:
        raise InputError(
            f"line {lines[0][0]} promises {vertex_count} vertices and {face_count} faces, "
            f"but only {len(lines) - 1} lines follow"
        )
    vertices = _numbers(lines[1 : 1 + vertex_count], 6 if header["normal"] else 3)
    polygons, face_colors = _faces(lines[1 + vertex_count : 1 + vertex_count + face_count])
    positions = [vertex[:3] for vertex in vertices]
    numbers = np.fromiter(chain.from_iterable(polygons), dtype=np.int64)
    triangles = cut(positions, [len(polygon) for polygon in polygons], numbers)
    corners = numbers[triangles[:, :3]]
    normals = None
    if header["normal"]:
        normals = filled(np.array(positions), corners, np.array([vertex[3:6] for vertex in vertices])[corners])
    behind = [vertex[6 if header["normal"] else 3 :] for vertex in vertices]
    if header["texture"]:
        behind = [values[:-2] for values in behind]
    colors = _table(behind)[corners]
    own = np.array([len(face_colors[polygon]) >= 3 for polygon in triangles[:, 3]], dtype=bool)
    colors[own] = _table(face_colors)[triangles[own, 3]][:, None, :]
    return weld(positions, corners, colors, normals)


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


def _numbers(lines: list[_Line], least: int) -> list[list[float]]:
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


def _faces(lines: list[_Line]) -> tuple[list[list[int]], list[list[float]]]:
    """Return the corners of each face, and what stands behind them: its colour, or nothing."""
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
        colors.append(color[:3] if len(color) in (3, 4) else [])
    return polygons, colors


def _table(rows: list[list[float]]) -> NDArray[np.float64]:
    """Return colours, (n, 3), 0..255; light grey for rows of fewer than three numbers."""
    table = np.empty((len(rows), 3))
    table[:] = DEFAULT_COLOR
    colored = [number for number, row in enumerate(rows) if len(row) >= 3]
    if colored:
        table[colored] = to_bytes([rows[number][:3] for number in colored])
    return table
