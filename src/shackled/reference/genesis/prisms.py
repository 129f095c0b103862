"""Make prisms of triangles: scaled, turned, tilted and centred.

As contracts/src/genesis/Prisms.sol.
"""

from __future__ import annotations

from collections.abc import Sequence

from .layout import PlaneTriangle
from .random import Random
from .trigonometry import Point, Point3, quotient, rotate, rotate_x, rotate_y

#: The width or height of a piece before it is turned, whichever is larger.
EXTENT = 2000
TILT = 12
#: Of one prism, whose vertices are three at the far end and three at the near one. There is no far cap.
FACES = ((3, 4, 5), (4, 3, 0), (0, 1, 4), (5, 4, 1), (1, 2, 5), (2, 0, 3), (3, 5, 2))


class Prisms:
    """The prisms over the triangles of a layout.

    flat: the triangles, scaled and turned in their plane. far, near: the ends of the prisms, tilted: three points each.
    half: half of the mean extent of both ends along x and y. vertices: six a prism, centred, +z toward the viewer.
    """

    def __init__(self, random: Random, triangles: Sequence[PlaneTriangle]) -> None:
        """Take the triangles, at least one."""
        points = [corner for triangle in triangles for corner in triangle.corners]
        size = max(max(values) - min(values) for values in zip(*points, strict=True))
        self.is_turned = random.draw("rotZ", low=0, high=1) == 1
        self.tilt_x = -TILT if random.draw("rotX", low=0, high=1) else TILT
        self.tilt_y = -TILT if random.draw("rotY", low=0, high=1) else TILT
        self.flat = [PlaneTriangle([self.flatten(corner, size) for corner in each.corners]) for each in triangles]
        self.far, self.near = (
            [
                [self.tilt((*corner, height)) for corner in each.corners]
                for each, height in zip(self.flat, heights, strict=True)
            ]
            for heights in ([each.far for each in triangles], [each.near for each in triangles])
        )
        extents = [self.mean_extent(axis) for axis in (0, 1)]
        self.half = [quotient(high - low, 2) for low, high in extents]
        (cx, cy) = (quotient(low + high, 2) for low, high in extents)
        self.vertices = [
            (x - cx, y - cy, -z) for far, near in zip(self.far, self.near, strict=True) for x, y, z in (*far, *near)
        ]
        self.faces = [(6 * k + a, 6 * k + b, 6 * k + c) for k in range(len(triangles)) for a, b, c in FACES]

    def flatten(self, corner: Point, size: int) -> Point:
        """Scale a corner and turn it in the plane."""
        x, y = (quotient(value * EXTENT, size) for value in corner)
        return rotate(x, y, 30) if self.is_turned else (x, y)

    def tilt(self, point: Point3) -> Point3:
        """Tilt a point about both axes."""
        if self.is_turned:
            return rotate_x(rotate_y(point, self.tilt_y), self.tilt_x)
        return rotate_y(rotate_x(point, self.tilt_x), self.tilt_y)

    def mean_extent(self, axis: int) -> tuple[int, int]:
        """Return the lowest and the highest coordinate, each the mean of the far ends and the near ends."""
        sides = [[point[axis] for end in ends for point in end] for ends in (self.near, self.far)]
        low, high = (quotient(sum(bound(side) for side in sides), 2) for bound in (min, max))
        return low, high
