"""STL, as text or binary."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from ...errors import InputError
from .._mesh import Mesh
from .content import read_bytes, unix_lines
from .weld import weld

_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_HEADER = 80 + 4


def read_stl(path: Path) -> Mesh:
    """Return the mesh of an STL file in light grey. The normals of its faces follow from their vertices."""
    data = read_bytes(path)
    count = int.from_bytes(data[80:_HEADER], "little")
    if len(data) >= _HEADER and len(data) == _HEADER + count * _TRIANGLE.itemsize:
        corners = np.frombuffer(data, _TRIANGLE, count, _HEADER)["corners"].reshape(-1, 3)
    elif b"\0" in data:
        raise InputError("it is neither text nor as long as a binary STL file of so many triangles would be")
    else:
        corners = _vertices(unix_lines(data.decode("utf-8", errors="replace")))
    if not len(corners):
        raise InputError("it has no triangles")
    return weld(corners, np.arange(len(corners)).reshape(-1, 3))


def _vertices(text: str) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    """Return the vertices of all solids of a text, (n, 3), three for each facet."""
    # names may be of any words
    text = re.sub(r"(?im)^[ \t]*(end)?solid\b.*", "", text)
    rows = []
    for number, facet in enumerate(re.split(r"(?i)\bendfacet\b", text), 1):
        vertices = [words.split()[:3] for words in re.split(r"(?i)\bvertex\b", facet)[1:]]
        if vertices and len(vertices) != 3:
            raise InputError(f"facet {number} has {len(vertices)} vertices, not 3")
        try:
            rows += [[float(x), float(y), float(z)] for x, y, z in vertices]
        except ValueError:
            raise InputError(f"facet {number} has a vertex that is not three numbers: {vertices}") from None
    return np.array(rows).reshape(-1, 3)
