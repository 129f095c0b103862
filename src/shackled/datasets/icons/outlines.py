"""Polygons in the plane: (n, 2) arrays of distinct corners, counter-clockwise, the last joined to the first."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...errors import InputError

Outline = NDArray[np.float64]


def regular(sides: int, radius: float = 1.0, start: float = 0.0) -> Outline:
    """Return a regular polygon, (sides, 2), about the origin, its first corner `start` degrees from the x axis."""
    angles = np.radians(start) + np.arange(sides) * 2 * np.pi / sides
    return np.stack([radius * np.cos(angles), radius * np.sin(angles)], axis=1)


def rectangle(width: float, height: float) -> Outline:
    """Return a rectangle, (4, 2), about the origin."""
    x, y = width / 2, height / 2
    return np.array([(-x, -y), (x, -y), (x, y), (-x, y)])


def chamfered(width: float, height: float, cut: float) -> Outline:
    """Return a rectangle, (8, 2), about the origin, with `cut` removed from both sides at each corner."""
    x, y = width / 2, height / 2
    a, b = x - cut, y - cut
    return np.array([(-a, -y), (a, -y), (x, -b), (x, b), (a, y), (-a, y), (-x, b), (-x, -b)])


def star(points: int, outer: float, inner: float, start: float = 90.0) -> Outline:
    """Return a star, (2 points, 2), about the origin, its first point `start` degrees from the x axis."""
    corners = regular(2 * points, 1.0, start)
    corners[::2] *= outer
    corners[1::2] *= inner
    return corners


def arc(radius: float, start: float, end: float, steps: int, center: tuple[float, float] = (0, 0)) -> Outline:
    """Return points of a circle from `start` to `end` degrees, (steps + 1, 2); a path, not a polygon."""
    angles = np.radians(np.linspace(start, end, steps + 1))
    return np.stack([center[0] + radius * np.cos(angles), center[1] + radius * np.sin(angles)], axis=1)


def stroke(path: ArrayLike, width: float) -> Outline:
    """Return the outline of an open path (n, 2) drawn with a width, (2 n, 2), with square ends and mitred corners."""
    points = np.asarray(path, dtype=np.float64)
    along = np.diff(points, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    left = np.stack([-along[:, 1], along[:, 0]], axis=1)
    aside = _mitres(np.vstack([left[:1], left]), np.vstack([left, left[-1:]]), width / 2)
    return counter_clockwise(np.vstack([points - aside, (points + aside)[::-1]]))


def inset(outline: ArrayLike, distance: float) -> Outline:
    """Return the polygon with each side moved inward, the corners mitred; no side may vanish."""
    points = counter_clockwise(outline)
    along = np.roll(points, -1, axis=0) - points
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    after = np.stack([-along[:, 1], along[:, 0]], axis=1)
    return points + _mitres(np.roll(after, 1, axis=0), after, distance)


def _mitres(before: Outline, after: Outline, distance: float) -> Outline:
    """Return how far corners move if the sides beside them move by a distance along these unit vectors."""
    return np.asarray(distance * (before + after) / (1 + (before * after).sum(axis=1, keepdims=True)))


def area(outline: ArrayLike) -> float:
    """Return the area of a polygon, negative if it runs clockwise."""
    points = np.asarray(outline, dtype=np.float64)
    x, y = (points - points[0]).T
    return float((x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2)


def counter_clockwise(outline: ArrayLike) -> Outline:
    """Return the polygon, reversed if it runs clockwise."""
    points = np.array(outline, dtype=np.float64)
    return points if area(points) > 0 else points[::-1]


def triangulate(outline: ArrayLike) -> list[tuple[int, int, int]]:
    """Return the n - 2 triangles of a polygon that does not cross itself, as corner numbers, in its orientation.

    Ears are cut; the ear that is farthest from a sliver goes first.
    """
    points = np.asarray(outline, dtype=np.float64)
    turn = 1.0 if area(points) > 0 else -1.0
    left = list(range(len(points)))
    triangles = []
    while len(left) > 2:
        corners = zip(left[-1:] + left[:-1], left, left[1:] + left[:1], strict=True)
        ears = [ear for ear in corners if _is_ear(points, left, ear, turn)]
        if not ears:
            raise InputError("the polygon crosses itself, or has corners in one line or twice")
        triangles.append(max(ears, key=lambda ear: (_sharpest(points[list(ear)]), ear)))
        left.remove(triangles[-1][1])
    return triangles


def _is_ear(points: Outline, left: Sequence[int], ear: tuple[int, int, int], turn: float) -> bool:
    a, b, c = points[list(ear)] * (1, turn)
    if _cross(b - a, c - a) <= 1e-12:
        return False
    others = points[[i for i in left if i not in ear]] * (1, turn)
    inside = np.all([_cross(q - p, others - p) >= -1e-12 for p, q in ((a, b), (b, c), (c, a))], axis=0)
    return not inside.any()


def _sharpest(corners: Outline) -> float:
    """Return the smallest height of a triangle as a share of its longest side."""
    sides = np.linalg.norm(np.roll(corners, -1, axis=0) - corners, axis=1)
    return float(abs(area(corners)) / sides.max() ** 2)


def _cross(a: Outline, b: Outline) -> NDArray[np.float64]:
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])
