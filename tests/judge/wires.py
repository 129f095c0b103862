"""Wires of plain pictures: in each column, or row of steep lines, the pixel nearest to the line (docs/explain.md)."""

from __future__ import annotations

import numpy as np

from picture import SUBPIXELS, Camera

from .pieces import Pieces
from .visibility import SAME_DEPTH, TOLERANCE, Seen

#: Lines that are this near to 45 degrees, in pixels between their ends, may be steep or not.
STEEP = 2 / SUBPIXELS


def seen_wires(pieces: Pieces, camera: Camera) -> Seen:
    """Find what wires show at the centres of pixels; pieces begin with the ends of the lines."""
    size = np.array([camera.width, camera.height])
    floor = np.full((size.prod(), 1, 9), -np.inf)
    rows = []
    p, q = pieces.corners[:, 0] / SUBPIXELS, pieces.corners[:, 1] / SUBPIXELS
    near_p, near_q = pieces.nearness[:, 0], pieces.nearness[:, 1]
    way = q - p
    for axis in (0, 1):
        lead = np.abs(way[:, axis]) - np.abs(way[:, 1 - axis])
        low, high = np.minimum(p[:, axis], q[:, axis]), np.maximum(p[:, axis], q[:, axis])
        first = np.clip(np.ceil(low - 0.5 - TOLERANCE), 0, size[axis]).astype(np.int64)
        end = np.clip(np.floor(high - 0.5 + TOLERANCE) + 1, 0, size[axis]).astype(np.int64)
        count = np.where(lead >= -STEEP, np.maximum(end - first, 0), 0)
        number = np.repeat(np.arange(len(p)), count)
        along = first[number] + np.arange(len(number)) - np.repeat(np.cumsum(count) - count, count)
        step = way[number, axis]
        part = np.clip((along + 0.5 - p[number, axis]) / np.where(step == 0, 1, step), 0, 1)
        across = p[number, 1 - axis] + part * way[number, 1 - axis]
        certain = (along + 0.5 > low[number] + TOLERANCE) & (along + 0.5 < high[number] - TOLERANCE)
        certain &= (lead[number] > STEEP) & ~pieces.doubtful[number]
        nearness = near_p[number] + part * (near_q - near_p)[number]
        shift = TOLERANCE * np.abs((near_q - near_p)[number]) / np.maximum(np.linalg.norm(way[number], axis=1), 1e-9)
        shift += SAME_DEPTH * np.abs(nearness)
        one, other = np.floor(across - TOLERANCE), np.floor(across + TOLERANCE)
        for place in (one, other):
            known = (place >= 0) & (place < size[1 - axis]) & ((place is one) | (one != other))
            cell = np.stack([along, place.astype(np.int64)], axis=1)[:, :: 1 - 2 * axis]
            pixel = cell @ [1, camera.width]
            sure = known & certain & (one == other)
            np.maximum.at(floor, pixel[sure], (nearness - shift)[sure, None, None])
            center = np.stack([along + 0.5, across], axis=1)[:, :: 1 - 2 * axis]
            covers = np.floor(across) == place
            row = (number, pixel, np.zeros_like(pixel), nearness, nearness + shift, covers, center)
            rows.append([each[known] for each in row])
    return Seen(floor, *(np.concatenate(each) for each in zip(*rows, strict=True)))
