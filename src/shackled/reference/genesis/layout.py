"""Lay triangles in the plane, of which prisms are made: each beside another one, or point to point with it, wherever it
fits.

As contracts/src/genesis/Layout.sol, which does the same with fewer operations.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import isqrt

from .random import Random
from .structures import EXTRUDED, UNIFORM, Structure
from .trigonometry import Point, quotient, rotate

ATTEMPTS = 150


@dataclass(frozen=True)
class PlaneTriangle:
    """A triangle: three corners, and the heights of the two ends of the prism over them."""

    corners: Sequence[Point]
    far: int = 0
    near: int = 0

    @property
    def center(self) -> Point:
        """Return the centroid."""
        x, y = (quotient(sum(values), 3) for values in zip(*self.corners, strict=True))
        return x, y

    @property
    def radius(self) -> int:
        """Return the distance from the centroid to the first corner."""
        return distance(self.center, self.corners[0])

    @property
    def is_up(self) -> bool:
        """Return whether one corner points upward, not two."""
        return sum(y > self.center[1] for _, y in self.corners) == 1

    @property
    def edges(self) -> list[tuple[Point, Point]]:
        """Return three pairs of corners."""
        a, b, c = self.corners
        return [(a, b), (b, c), (c, a)]


def distance(a: Point, b: Point) -> int:
    """Cut off to a whole number."""
    return isqrt((a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2)


def equilateral(center: Point, radius: int, angle: int) -> list[Point]:
    """Return the corners of a triangle, the first of them in the direction `angle` (degrees)."""
    turned = (rotate(radius, 0, angle + 120 * k) for k in range(3))
    return [(center[0] + x, center[1] + y) for x, y in turned]


def contains(triangle: PlaneTriangle, point: Point) -> bool:
    """Return whether a point lies inside."""
    (x1, y1), (x2, y2), (x3, y3) = triangle.corners
    x, y = point
    area = (y2 - y3) * (x1 - x3) + (x3 - x2) * (y1 - y3)
    a = quotient(((y2 - y3) * (x - x3) + (x3 - x2) * (y - y3)) * 10**6, area)
    b = quotient(((y3 - y1) * (x - x3) + (x1 - x3) * (y - y3)) * 10**6, area)
    return a > 0 and b > 0 and 10**6 - a - b > 0


def is_near_line(point: Point, start: Point, end: Point) -> bool:
    """Return whether a point is less than 8 away from an infinite line."""
    (px, py), (ax, ay), (bx, by) = point, start, end
    return abs((bx - ax) * (ay - py) - (ax - px) * (by - ay)) // distance(start, end) < 8


class Layout:
    """The triangles of a piece.

    `slots` may hold one triangle more than `count`: the first triangle of a piece that is mirrored at the x axis is no
    part of it, only the reference for the next.
    """

    def __init__(self, random: Random, structure: Structure) -> None:
        """Lay all triangles."""
        self.random = random
        self.structure = structure
        self.unit = random.draw("depthMult", low=80, high=120)
        self.mirror_x = random.draw("symmX", low=0, high=2) > 0
        self.mirror_y = random.draw("symmY", low=0, high=2) > 0
        radius = structure.first_radius
        if radius is None:
            radius = random.draw("size", low=structure.min_radius, high=structure.max_radius)
        angle = 210 if random.draw("rot", low=0, high=1) else 30
        self.slots = [PlaneTriangle(equilateral((0, 0), radius, angle), *self.heights(0))]
        self.count = 0 if self.mirror_y else 1
        for i in range(ATTEMPTS):
            if self.count >= structure.max_prisms:
                break
            reference = random.draw("refIdx", i, low=0, high=self.count - 1)
            if random.chance(structure.opposite, "adj", i, self.count):
                self.lay_opposite(i, reference)
            else:
                self.lay_adjacent(i, reference)

    @property
    def triangles(self) -> list[PlaneTriangle]:
        """Return the triangles that are kept."""
        return self.slots[: self.count]

    def heights(self, index: int) -> tuple[int, int]:
        """Return the heights of a triangle for slot `index`: far and near."""
        unit = self.unit
        if self.structure.index == UNIFORM:
            return unit, -unit
        value = self.random.draw("calcZ", index, low=0, high=10)
        factor = 10 if value == 10 else 8 if value >= 6 else 1
        if self.structure.index == EXTRUDED:
            return (factor + 10) * unit, (10 - self.random.draw("calcZ", index, low=2, high=20)) * unit
        return factor * unit, -2 * unit

    def lay_adjacent(self, i: int, reference: int) -> None:
        """Lay a triangle beside a side of the reference, then one beside that side of the new one, and so on, ever
        smaller.
        """
        random, structure = self.random, self.structure
        side = random.draw("sideIdx", i, 0, low=0, high=2)
        scale = random.draw("scaleAdj", i, 0, low=333, high=800) if structure.sizes_vary else 1000
        depth = 0
        while True:
            base = self.slots[reference]
            (x, y), radius = base.center, base.radius
            sign = 2 * random.draw("lateralOffset", i, depth, low=0, high=1) - 1
            lateral = quotient(sign * (1000 - scale) * (radius * 8660 // 10000), 1000)
            away = radius // 2 * (1000 + scale) // 1000 + 6000
            angle = 120 * side + 60 * base.is_up
            dx, dy = rotate(lateral, away, angle)
            size = min(structure.max_radius, scale * radius // 1000)
            corners = equilateral((x + dx, y + dy), size, angle - 30)
            if not self.add(PlaneTriangle(corners, *self.heights(self.count))):
                return
            if not random.chance(structure.adjacent_again, "addAdjRecursive", i, depth):
                return
            reference = self.count - 1
            scale = 666 if structure.sizes_vary else 1000
            depth += 1

    def lay_opposite(self, i: int, reference: int) -> None:
        """Lay triangles point to point with the reference, smaller or larger."""
        random, structure = self.random, self.structure
        side = random.draw("vertOppSideIdx", i, 0, low=0, high=2)
        scale = 1000
        if structure.sizes_vary:
            if random.draw("vertOppScale1", i, 0, low=0, high=100) <= 33:
                scale = 2000
            elif random.draw("vertOppScale2", i, 0, low=0, high=100) <= 50:
                scale = 500
        depth = 0
        while True:
            # read anew each time: it may be the slot that was filled last
            base = self.slots[reference]
            (x, y), radius = base.center, base.radius
            angle = 120 * side + 60 + 60 * base.is_up
            dx, dy = rotate(0, radius * (1000 + scale) // 1000 + 64, angle)
            size = min(structure.max_radius, scale * radius // 1000)
            corners = equilateral((x + dx, y + dy), size, angle - 210)
            if not self.add(PlaneTriangle(corners, base.far, self.heights(self.count)[1])):
                return
            if not random.chance(structure.opposite_again, "recursiveVertOpp", i, depth):
                return
            scale = 666 if structure.sizes_vary else 1000
            depth += 1

    def add(self, triangle: PlaneTriangle) -> bool:
        """Keep a triangle if it fits, then its mirror image if that fits; return whether the first was kept."""
        if not self.fits(triangle):
            return False
        self.store(triangle)
        if self.mirror_x or self.mirror_y:
            image = self.mirrored(triangle)
            if self.fits(image):
                self.store(image)
        return True

    def store(self, triangle: PlaneTriangle) -> None:
        """Put a triangle into the next slot."""
        self.slots[self.count :] = [triangle]
        self.count += 1

    def mirrored(self, triangle: PlaneTriangle) -> PlaneTriangle:
        """Return the mirror image, with the order of its corners reversed, so that it has the same winding."""
        corners = [(-x if self.mirror_x else x, -y if self.mirror_y else y) for x, y in triangle.corners]
        if self.mirror_x != self.mirror_y:
            corners.reverse()
        return PlaneTriangle(corners, triangle.far, triangle.near)

    def fits(self, new: PlaneTriangle) -> bool:
        """Return whether a triangle may be added."""
        if self.count >= self.structure.max_prisms or new.radius < self.structure.min_radius:
            return False
        return all(self.is_apart(new, old) for old in self.triangles)

    def is_apart(self, new: PlaneTriangle, old: PlaneTriangle) -> bool:
        """Return whether a new triangle keeps the required distance from another one."""
        return (
            distance(new.center, old.center) >= new.radius // 2 + old.radius // 2
            and not any(contains(old, corner) for corner in new.corners)
            and not any(contains(new, corner) for corner in old.corners)
            and not any(is_near_line(corner, *edge) for edge in old.edges for corner in new.corners)
        )
