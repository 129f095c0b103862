"""Polygons as files have them, cut into triangles."""

from __future__ import annotations

from pathlib import Path

import mapbox_earcut
import numpy as np
from numpy.typing import ArrayLike

from ...base.checks import Flags, Floats, Ints
from ...base.values import plural
from ...errors import InputError, warn
from .._mesh import Mesh

#: How many corners a polygon may have that no fan fills: the time that its cutting takes grows with their square.
MAX_CORNERS = 1 << 13

#: A fan may leave its polygon by this part of the polygon's area, as it does by rounding.
_ROUNDING = 1e-9


def cut(positions: ArrayLike, sizes: ArrayLike, vertices: ArrayLike) -> Ints:
    """Cut polygons into triangles, (k, 4) int: the numbers of three corners, and of the polygon.

    positions: (n, 3) float. sizes: (m,) the number of corners of each polygon. vertices: (sum of sizes,) the number of
    the position of each corner. A polygon is cut as a fan about its first corner where that fills it, as it does for a
    convex one, and otherwise by ear clipping. InputError as in `Mesh`.
    """
    triangles, vertices = fans(sizes), np.asarray(vertices)
    points = Mesh(positions, vertices[triangles[:, :3]]).positions
    sizes = np.asarray(sizes, dtype=np.int64)
    polygon = triangles[:, 3]
    if not (sizes > 3).any():
        return triangles
    with np.errstate(all="ignore"):
        a, b, c = np.moveaxis(points[vertices[triangles[:, :3]]], 1, 0)
        extent = np.zeros(len(sizes))
        np.maximum.at(extent, polygon, np.maximum(np.abs(b - a), np.abs(c - a)).max(axis=1))
        unit = np.where(extent > 0, extent, 1)[polygon, None]
        areas = np.cross((b - a) / unit, (c - a) / unit)
        normals = np.zeros((len(sizes), 3))
        np.add.at(normals, polygon, areas)
        along = np.einsum("ij,ij->i", areas, normals[polygon])
        wrong = np.unique(polygon[along < -_ROUNDING * np.einsum("ij,ij->i", normals, normals)[polygon]])
    if not len(wrong):
        return triangles
    if sizes[wrong].max() > MAX_CORNERS:
        number = wrong[sizes[wrong].argmax()]
        raise InputError(f"face {number} is not convex and has {sizes[number]} corners; up to {MAX_CORNERS} are cut")
    starts = np.cumsum(sizes) - sizes
    owner = np.repeat(wrong, sizes[wrong])
    corners = np.flatnonzero(np.isin(np.repeat(np.arange(len(sizes)), sizes), wrong))
    outlines = (points[vertices[corners]] - points[vertices[starts[owner]]]) / extent[owner, None]
    flat = _flat(outlines, normals[owner])
    clipped, start = [], 0
    for size in sizes[wrong].tolist():
        ears = mapbox_earcut.triangulate_float64(flat[start : start + size], np.array([size], dtype=np.uint32))
        clipped.append(start + ears.astype(np.int64))
        start += size
    found = np.concatenate(clipped).reshape(-1, 3)
    (ax, ay), (bx, by), (cx, cy) = np.moveaxis(flat[found], (0, 1, 2), (2, 0, 1))
    backward = (bx - ax) * (cy - ay) < (by - ay) * (cx - ax)
    found[backward] = found[backward, ::-1]
    others = triangles[~np.isin(polygon, wrong)]
    together = np.concatenate([others, np.concatenate([corners[found], owner[found[:, :1]]], axis=1)])
    return together[np.argsort(together[:, 3], kind="stable")]


def whole(path: Path, sizes: Ints, vertices: Ints, count: int) -> Flags:
    """Return which polygons have vertices that are all among so many, (m,), or all if none has; an InputWarning tells.

    sizes, vertices: as in `cut`.
    """
    kept = np.ones(len(sizes), dtype=bool)
    kept[np.repeat(np.arange(len(sizes)), sizes)[(vertices < 0) | (vertices >= count)]] = False
    if kept.all() or not kept.any():  # where none is right, an error tells what is wrong
        return np.ones_like(kept)
    warn(f"{path}: {plural(int((~kept).sum()), 'face')} left out, with vertices that do not exist")
    return kept


def fans(sizes: ArrayLike) -> Ints:
    """Cut polygons of so many corners as fans about their first corner; (k, 4) int as in `cut`."""
    corners = np.asarray(sizes, dtype=np.int64)
    triangles = np.maximum(corners - 2, 0)
    polygon = np.repeat(np.arange(len(corners)), triangles)
    first = (np.cumsum(corners) - corners)[polygon]
    second = first + 1 + np.arange(len(polygon)) - np.repeat(np.cumsum(triangles) - triangles, triangles)
    return np.stack([first, second, second + 1, polygon], axis=1)


def _flat(points: Floats, normals: Floats) -> Floats:
    """Return points, (n, 2), seen along the axis nearest to their normal, such that outlines run counter-clockwise."""
    rows = np.arange(len(points))
    axis = np.abs(normals).argmax(axis=1)
    forward = normals[rows, axis] > 0
    across, up = (axis + np.where(forward, 1, 2)) % 3, (axis + np.where(forward, 2, 1)) % 3
    return np.stack([points[rows, across], points[rows, up]], axis=1)
