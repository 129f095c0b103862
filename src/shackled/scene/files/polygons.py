"""Polygons as files have them, cut into triangles."""

from __future__ import annotations

import mapbox_earcut
import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...errors import InputError
from ..mesh import Mesh

#: How many corners a polygon may have that no fan fills: the time that its cutting takes grows with their square.
MAX_CORNERS = 1 << 14

#: A fan may leave its polygon by this part of the polygon's area, as it does by rounding.
_ROUNDING = 1e-9


def cut(positions: ArrayLike, sizes: ArrayLike, vertices: ArrayLike) -> NDArray[np.int64]:
    """(k, 4) int: the triangles of polygons, each as the numbers of three corners and of its polygon.

    positions: (n, 3) float. sizes: (m,) how many corners each polygon has. vertices: (sum of sizes,) the number of the
    position of each corner; the corners of all polygons are numbered one after the other. A polygon is cut as a fan
    about its first corner where that fills it, as it does a convex one, else by ear clipping. InputError as in `Mesh`.
    """
    triangles, vertices = fans(sizes), np.asarray(vertices)
    points = np.asarray(Mesh(positions, vertices[triangles[:, :3]]).positions)
    sizes = np.asarray(sizes, dtype=np.int64)
    polygon = triangles[:, 3]
    if not (sizes > 3).any():
        return triangles
    starts = np.cumsum(sizes) - sizes
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
    parts = [triangles[~np.isin(polygon, wrong)]]
    for number in wrong.tolist():
        start, size = starts[number], sizes[number]
        if size > MAX_CORNERS:
            raise InputError(f"face {number} is no convex polygon and has {size} corners; up to {MAX_CORNERS} are cut")
        outline = points[vertices[start : start + size]]
        clipped = _clip((outline - outline[0]) / extent[number], normals[number])
        if len(clipped):
            parts.append(np.insert(start + clipped, 3, number, axis=1))
    together = np.concatenate(parts)
    return together[np.argsort(together[:, 3], kind="stable")]


def fans(sizes: ArrayLike) -> NDArray[np.int64]:
    """(k, 4) int as in `cut`: polygons of so many corners, cut as fans about their first corner."""
    corners = np.asarray(sizes, dtype=np.int64)
    triangles = np.maximum(corners - 2, 0)
    polygon = np.repeat(np.arange(len(corners)), triangles)
    first = (np.cumsum(corners) - corners)[polygon]
    second = first + 1 + np.arange(len(polygon)) - np.repeat(np.cumsum(triangles) - triangles, triangles)
    return np.stack([first, second, second + 1, polygon], axis=1)


def _clip(outline: NDArray[np.float64], normal: NDArray[np.float64]) -> NDArray[np.int64]:
    """(k, 3) int: the triangles of one polygon, turned as it is."""
    # along the axis in which the polygon is seen largest, and from the side from which it runs counter-clockwise
    axis = int(np.abs(normal).argmax())
    across, up = ((axis + 1) % 3, (axis + 2) % 3) if normal[axis] > 0 else ((axis + 2) % 3, (axis + 1) % 3)
    flat = np.ascontiguousarray(outline[:, [across, up]])
    triangles = mapbox_earcut.triangulate_float64(flat, np.array([len(flat)], dtype=np.uint32))
    result = triangles.astype(np.int64).reshape(-1, 3)
    (ax, ay), (bx, by), (cx, cy) = np.moveaxis(flat[result], (0, 1, 2), (2, 0, 1))
    backward = (bx - ax) * (cy - ay) < (by - ay) * (cx - ax)
    result[backward] = result[backward, ::-1]
    return result
