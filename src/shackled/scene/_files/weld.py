"""From what files hold to a mesh: what belongs to the corners of faces there belongs to vertices here."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .._mesh import Mesh

#: How many corners are taken at once, so that not all of a large mesh are Python objects at the same time.
_AT_ONCE = 1 << 16


def weld(
    positions: ArrayLike,
    faces: ArrayLike,
    colors: ArrayLike | None = None,
    normals: ArrayLike | None = None,
    uvs: ArrayLike | None = None,
) -> Mesh:
    """Return a mesh with one vertex for each distinct position, colour, normal and texture coordinate that a face uses.

    positions: (n, 3) float. faces: (m, 3) int, numbers of positions. colors: (m, 3, 3), the colour 0..255 of each
    corner of each face, or (m, 3, 4) with alpha; None for light grey. normals: (m, 3, 3) float likewise, or None. uvs:
    (m, 3, 2) float likewise. InputError as in `Mesh`.
    """
    checked = Mesh(positions, faces)
    points, corners = checked.positions, checked.faces
    parts = [
        points[corners],
        *(np.asarray(each, dtype=np.float64) for each in (colors, normals, uvs) if each is not None),
    ]
    # + 0.0: no -0.0
    rows = np.ascontiguousarray(np.concatenate(parts, axis=2).reshape(3 * len(corners), -1) + 0.0)
    keys = rows.view(np.dtype((np.void, rows.itemsize * rows.shape[1]))).ravel()
    numbers: dict[Any, int] = {}
    welded = np.empty(len(rows), dtype=np.int64)
    for start in range(0, len(rows), _AT_ONCE):
        part = [numbers.setdefault(key, len(numbers)) for key in keys[start : start + _AT_ONCE].tolist()]
        welded[start : start + _AT_ONCE] = part
    unique = rows[np.unique(welded, return_index=True)[1]]
    columns = iter(np.split(unique, np.cumsum([each.shape[2] for each in parts])[:-1], axis=1))
    return Mesh(
        next(columns),
        welded.reshape(-1, 3),
        None if colors is None else next(columns).astype(np.uint8),
        None if normals is None else next(columns),
        None if uvs is None else next(columns),
    )
