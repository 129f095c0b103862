"""Triangles of a model that lie so far away that they must not decide what fills the picture."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from attrs import evolve

from ..base.checks import Floats
from ..base.values import plural
from ..errors import warn
from ._mesh import face_normals, faces_of_all, part_of_faces
from ._object import Object

#: Strays have at most this part of the area of a model, and the rest at most this part of its extent.
_AREA, _EXTENT = 1e-3, 0.02


@np.errstate(all="ignore")
def without_strays(objects: Sequence[Object], name: str) -> tuple[list[Object], Floats | None]:
    """Return the objects of a model with its strays as objects of their own, and the points, (n, 3), of all others.

    None in place of the points if it has no strays; otherwise an InputWarning, which begins with the name, tells.
    """
    positions = np.concatenate([each.world_positions() for each in objects])
    corners = positions[faces_of_all(each.mesh for each in objects)]
    areas = np.linalg.norm(face_normals(corners), axis=1)
    shares, middles = areas / areas.sum(), corners.mean(axis=1)
    order = middles.argsort(axis=0)
    summed = shares[order].cumsum(axis=0)
    ends = [[np.searchsorted(column, part) for column in summed.T] for part in (_AREA / 2, 1 - _AREA / 2)]
    low, high = (middles[order[rows, range(3)], range(3)] for rows in ends)
    core = corners[((middles >= low) & (middles <= high)).all(axis=1)].reshape(-1, 3)
    if not len(core):
        return list(objects), None
    low, high = core.min(axis=0), core.max(axis=0)
    size = (high - low).max()
    far = ((corners < low - size) | (corners > high + size)).any(axis=(1, 2))
    near, extent = corners[~far].reshape(-1, 3), np.ptp(corners.reshape(-1, 3), axis=0).max()
    is_small = len(near) > 0 and np.isfinite(extent) and np.ptp(near, axis=0).max() < _EXTENT * extent
    if not far.any() or not is_small or shares[far].sum() > _AREA:
        return list(objects), None
    times = round(extent / np.ptp(near, axis=0).max())
    warn(
        f"{name}: {plural(int(far.sum()), 'triangle')} so far away that the model is {times:,} times as large with"
        " them; the picture is filled by the others"
    )
    cuts = np.cumsum([each.mesh.triangles for each in objects])[:-1]
    parts = [
        evolve(each, mesh=part_of_faces(each.mesh, each.mesh.faces[own == is_far]))
        for is_far in (False, True)
        for each, own in zip(objects, np.split(far, cuts), strict=True)
        if (own == is_far).any()
    ]
    return parts, near
