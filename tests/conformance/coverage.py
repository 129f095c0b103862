"""Which triangles a pixel may show: for every pixel, from the edges and depths of all triangles, in float64.

It may show any that comes to within TOLERANCE pixels of its centre, unless others are nearer everywhere around there.
Depths count as equal if a shift by TOLERANCE of either surface makes them so.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .world import Array, World

#: In pixels.
TOLERANCE = 0.04
#: Depths that differ by less than this part of them are equal to a depth buffer of 32-bit floats.
SAME_DEPTH = 2.0**-21
#: The middle of a circle, and eight places on it.
AROUND = np.array([(0.0, 0.0), *((np.cos(t), np.sin(t)) for t in np.arange(8) * np.pi / 4)])


@dataclass(frozen=True)
class Judge:
    """outlines: (n, 4, 2) columns and rows of the corners of what is before the near plane of each triangle; the last
    is repeated where there are three, and all are NaN where nothing is left. planes: (n, 3) how near it is at a column
    and row: planes @ (column, row, 1). culled: (n,) whether it may not be seen.
    """

    outlines: Array
    planes: Array
    culled: NDArray[np.bool_]

    def may_show(self, column: int, row: int) -> NDArray[np.int64]:
        """The numbers of the triangles that a pixel may show, and -1 if it may show none."""
        center = np.array([column + 0.5, row + 0.5])
        near = _within(self.outlines, center)
        outlines, planes, culled = self.outlines[near], self.planes[near], self.culled[near]
        inside, distance = _position(outlines, center)
        depth = planes @ [*center, 1.0]
        thin = _thickness(outlines) <= TOLERANCE
        # what is seen from its edge may have any depth
        shift = TOLERANCE * np.linalg.norm(planes[:, :2], axis=1)
        shift[thin] = np.inf
        inside, distance = _position(outlines, center)
        # and rounding can turn it round
        possible = (inside | (distance <= TOLERANCE)) & (~culled | thin)
        farthest = np.inf
        for point in center + TOLERANCE * AROUND:
            depth = planes @ [*point, 1.0]
            depth -= shift + SAME_DEPTH * np.abs(depth)
            farthest = min(farthest, depth[_position(outlines, point)[0] & ~culled].max(initial=-np.inf))
        depth = planes @ [*center, 1.0]
        possible &= depth + shift + SAME_DEPTH * np.abs(depth) >= farthest
        numbers = near[possible]
        return numbers if farthest > -np.inf else np.append(numbers, -1)


def judge(world: World) -> Judge:
    """The judge of a world."""
    corners = world.corners
    outlines = np.full((len(corners), 4, 2), np.nan)
    cut = (-corners[..., 2] < world.near).any(axis=1)
    outlines[~cut] = project(world, corners[~cut][:, [0, 1, 2, 2]])
    for number in np.flatnonzero(cut):
        polygon = _clip(corners[number], world.near)
        if len(polygon):
            outlines[number] = project(world, np.array([*polygon, polygon[-1]])[:4])
    return Judge(outlines, _planes(world, corners), world.culled & (_area(outlines) >= 0))


def project(world: World, points: Array) -> Array:
    """Columns and rows of (..., 3) points."""
    divisor = -points[..., 2] if world.perspective else 1.0
    column = world.width / 2 + world.focal * points[..., 0] / divisor
    row = world.height / 2 - world.focal * points[..., 1] / divisor
    return np.stack([column, row], axis=-1)


def _clip(corners: Array, near: float) -> list[Array]:
    """What of a triangle is not nearer than the near plane: up to four corners."""
    beyond = -corners[:, 2] - near
    polygon = []
    for i in range(3):
        j = (i + 1) % 3
        if beyond[i] >= 0:
            polygon.append(corners[i])
        if (beyond[i] >= 0) != (beyond[j] >= 0):
            polygon.append(corners[i] + (corners[j] - corners[i]) * (beyond[i] / (beyond[i] - beyond[j])))
    return polygon


def _planes(world: World, corners: Array) -> Array:
    """(n, 3): 1 / distance, or -distance of an orthographic camera, as a function of column and row."""
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    along = (normal * corners[:, 0]).sum(axis=1)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        if world.perspective:
            # the point distance * (x, y, -1) is on the plane
            x, y, rest = normal[:, 0] / along, normal[:, 1] / along, -normal[:, 2] / along
        else:
            x, y, rest = -normal[:, 0] / normal[:, 2], -normal[:, 1] / normal[:, 2], along / normal[:, 2]
        middle = world.focal * rest - x * world.width / 2 + y * world.height / 2
    planes = np.stack([x, -y, middle], axis=1) / world.focal
    planes[~np.isfinite(planes).all(axis=1)] = 0.0
    return planes


def _within(outlines: Array, center: Array) -> NDArray[np.int64]:
    """The numbers of the outlines whose bounding boxes come near."""
    low, high = outlines.min(axis=1) - TOLERANCE, outlines.max(axis=1) + TOLERANCE
    return np.flatnonzero(((low <= center) & (center <= high)).all(axis=1))


def _position(outlines: Array, center: Array) -> tuple[NDArray[np.bool_], Array]:
    """(n,) whether the centre is inside, and its distance from the nearest edge."""
    start = outlines - center
    edge = np.roll(start, -1, axis=1) - start
    cross = edge[..., 1] * start[..., 0] - edge[..., 0] * start[..., 1]
    square = (edge**2).sum(axis=2)
    part = np.divide(-(start * edge).sum(axis=2), square, out=np.zeros_like(square), where=square > 0)
    distance = np.linalg.norm(start + np.clip(part, 0, 1)[..., None] * edge, axis=2).min(axis=1)
    real = square > 0
    inside = (real.any(axis=1)) & (((cross >= 0) | ~real).all(axis=1) | ((cross <= 0) | ~real).all(axis=1))
    return inside, distance


def _area(outlines: Array) -> Array:
    """(n,) twice the area; negative where the corners go counter-clockwise as they are seen, rows running down."""
    following = np.roll(outlines, -1, axis=1)
    area: Array = (outlines[..., 0] * following[..., 1] - outlines[..., 1] * following[..., 0]).sum(axis=1)
    return area


def _thickness(outlines: Array) -> Array:
    """(n,) the least height, or less."""
    longest = np.linalg.norm(np.roll(outlines, -1, axis=1) - outlines, axis=2).max(axis=1)
    out: Array = np.divide(np.abs(_area(outlines)), longest, out=np.zeros_like(longest), where=longest > 0)
    return out
