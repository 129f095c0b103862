"""Solids: closed surfaces of coloured triangles, made by lofting rings of points, combined without booleans.

+x is right, +y up, +z toward the viewer. Lengths are in units of the model (icons are about 2 units large), angles in
degrees. Colours are "#rrggbb" or red, green, blue, 0..255. Triangles are counter-clockwise seen from outside. Parts of
a solid may overlap: the depth buffer hides what is inside.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base import checks
from ...base.checks import Flags, Floats
from ...scene._arithmetic import from_euler, rotate
from ...scene._mesh import Mesh
from ..common import shapes
from .outlines import arc, chamfered, inset, rectangle, regular, triangulate

Where = Callable[[Floats], Flags]

#: The meshes have whole coordinates, so many to a unit.
STEPS = 10_000

#: Points nearer than this are one.
SAME = 1e-9


@dataclass(frozen=True)
class Solid:
    """Triangles with their own corners and colours; edges are shared where corners are equal.

    corners: (m, 3, 3), three points for each triangle.
    colors: (m, 3, 3), red, green, blue, 0..255 for each corner.
    """

    corners: Floats
    colors: NDArray[np.uint8]

    def __add__(self, other: Solid) -> Solid:
        return union(self, other)

    def moved(self, x: float = 0, y: float = 0, z: float = 0) -> Solid:
        """Return the solid moved."""
        return replace(self, corners=self.corners + np.array((x, y, z)))

    def turned(self, x: float = 0, y: float = 0, z: float = 0) -> Solid:
        """Return the solid turned about the x, then the y, then the z axis, by degrees, counter-clockwise."""
        return replace(self, corners=rotate(from_euler((x, y, z)), self.corners.reshape(-1, 3)).reshape(-1, 3, 3))

    def scaled(self, x: float = 1, y: float = 1, z: float = 1) -> Solid:
        """Return the solid scaled about the origin; a negative factor mirrors it, and faces still point outward."""
        return _outward(replace(self, corners=self.corners * (x, y, z)))

    def mirrored(self) -> Solid:
        """Return the mirror image, left and right exchanged."""
        return self.scaled(x=-1)

    def painted(self, color: ArrayLike, where: Where | None = None) -> Solid:
        """Return the solid in one colour, or only the triangles whose centres, (m, 3), `where` selects."""
        mask = np.ones(len(self.corners), dtype=bool) if where is None else where(self.corners.mean(axis=1))
        channels = np.array(checks.color(color, "the colour of a solid"), dtype=np.uint8)
        return replace(self, colors=np.where(mask[:, None, None], channels, self.colors))

    def shaded(self, low: ArrayLike, high: ArrayLike, axis: ArrayLike = (0, 1, 0)) -> Solid:
        """Return the solid in a gradient along an axis, from its lowest to its highest point."""
        return replace(self, colors=shapes.gradient(self.corners @ np.asarray(axis, dtype=np.float64), low, high))

    def volume(self) -> float:
        """Return the sum of the volumes of the parts."""
        a, b, c = (self.corners - self.corners.mean(axis=(0, 1))).transpose(1, 0, 2)
        return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)

    def mesh(self, crease: float | None = None) -> Mesh:
        """Return the mesh in whole coordinates, `STEPS` per unit, for flat shading, or with normals for smooth shading.

        crease: the angle in degrees up to which edges look round; None for no normals. Vertices are shared where
        position, colour and normal are the same.
        """
        corners = np.rint(self.corners * STEPS)
        kept = _distinct(corners)
        corners, colors = corners[kept], self.colors[kept]
        return shared(corners, colors, *([] if crease is None else [_normals(corners, crease)]))


def shared(*parts: NDArray[Any]) -> Mesh:
    """Return the mesh of the positions, colours and perhaps normals of corners, (m, 3, 3), equal ones as one vertex."""
    table = np.concatenate(parts, axis=2).reshape(-1, 3 * len(parts))
    vertices, numbers = np.unique(table, axis=0, return_inverse=True)
    positions, colors, *normals = np.split(vertices, len(parts), axis=1)
    return Mesh(positions, numbers.reshape(-1, 3), colors.astype(np.uint8), *normals)


def union(*solids: Solid) -> Solid:
    """Return all solids as one; where they overlap, nothing is cut away."""
    return Solid(np.concatenate([s.corners for s in solids]), np.concatenate([s.colors for s in solids]))


def above(y: float) -> Where:
    """Select what is higher, for `painted`."""
    return lambda at: at[:, 1] > y


def below(y: float) -> Where:
    """Select what is lower, for `painted`."""
    return lambda at: at[:, 1] < y


def from_axis(at: Floats) -> Floats:
    """Return the distances of points (n, 3) from the y axis, (n,)."""
    return np.asarray(np.hypot(at[:, 0], at[:, 2]))


def both(solid: Solid) -> Solid:
    """Return the solid and its mirror image on the other side of x = 0."""
    return solid + solid.mirrored()


def around(solid: Solid, count: int, start: float = 0) -> Solid:
    """Return copies of a solid around the y axis, the first turned by `start` degrees."""
    return union(*(solid.turned(y=start + 360 * i / count) for i in range(count)))


# ---- what everything is made by ----


def loft(rings: ArrayLike, closed: bool = False) -> Solid:
    """Return a skin over rings of points, (k, n, 3), with flat ends; if `closed`, back to the first ring.

    The points of a ring go around the solid; equal points are merged, and a ring of equal points is a tip.
    """
    points = np.asarray(rings, dtype=np.float64)
    here = points if closed else points[:-1]
    there = np.roll(points, -1, axis=0) if closed else points[1:]
    a, b, c, d = (p.reshape(-1, 3) for p in (here, np.roll(here, -1, axis=1), np.roll(there, -1, axis=1), there))
    triangles = [np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)]
    if not closed:
        triangles += [_cap(points[0])[:, ::-1], _cap(points[-1])]
    corners = np.concatenate(triangles)
    corners = corners[_distinct(corners)]
    return _outward(_grey(corners))


def prism(outline: ArrayLike, depth: float, bevel: float = 0) -> Solid:
    """Return a polygon (n, 2) of the x-y plane, `depth` thick, half of it on either side of the plane.

    bevel: the width by which the rims of both faces are cut off at 45 degrees.
    """
    points, z = np.asarray(outline, dtype=np.float64), depth / 2
    if bevel == 0:
        return loft([_at(points, -z), _at(points, z)])
    small = inset(points, bevel)
    return loft([_at(small, -z), _at(points, bevel - z), _at(points, z - bevel), _at(small, z)])


def revolve(profile: ArrayLike, segments: int, closed: bool = False) -> Solid:
    """Return a profile of (radius, y) points, (k, 2), turned about the y axis.

    Its ends are flat where it does not begin or end on the axis. closed: whether the profile is the section of a ring.
    """
    circle = regular(segments, 1.0, 180 / segments)
    radius, y = np.asarray(profile, dtype=np.float64).T
    x, z = radius[:, None] * circle[:, 0], radius[:, None] * circle[:, 1]
    return loft(np.stack(np.broadcast_arrays(x, y[:, None], z), axis=-1), closed)


def sweep(outline: ArrayLike, path: ArrayLike, closed: bool = False, scales: Sequence[float] | None = None) -> Solid:
    """Return a polygon (n, 2) swept along a path (k, 3), perpendicular to it, and scaled by (k,) factors.

    closed: whether the path, then in a plane, returns to its first point; otherwise the ends are flat.
    """
    points, section = np.asarray(path, dtype=np.float64), np.asarray(outline, dtype=np.float64)
    factors = np.ones(len(points)) if scales is None else np.asarray(scales, dtype=np.float64)
    along = np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0)
    if not closed:
        along[0], along[-1] = points[1] - points[0], points[-1] - points[-2]
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    across = np.eye(3)[np.abs(along[0]).argmin()]
    rings = []
    for point, tangent, factor in zip(points, along, factors, strict=True):
        # the direction before, upright on the path again: the section does not twist
        across = across - (across @ tangent) * tangent
        across /= np.linalg.norm(across)
        rings.append(point + factor * section @ np.stack([across, np.cross(tangent, across)]))
    return loft(rings, closed)


# ---- shapes ----


def box(width: float, height: float, depth: float) -> Solid:
    """Return a box about the origin, 12 triangles."""
    return prism(rectangle(width, height), depth)


def bevelled_box(width: float, height: float, depth: float, bevel: float) -> Solid:
    """Return a box about the origin with its edges cut off by `bevel`, 44 triangles."""
    z = depth / 2
    # each corner twice, for the two corners of the ring beside it
    small = np.repeat(rectangle(width - 2 * bevel, height - 2 * bevel), 2, axis=0)
    full = np.roll(chamfered(width, height, bevel), 1, axis=0)
    return loft([_at(small, -z), _at(full, bevel - z), _at(full, z - bevel), _at(small, z)])


def cylinder(radius: float, height: float, segments: int, top: float | None = None) -> Solid:
    """Return a cylinder about the origin along y, or, with another radius at the top, a truncated cone."""
    return revolve([(radius, -height / 2), (radius if top is None else top, height / 2)], segments)


def cone(radius: float, height: float, segments: int) -> Solid:
    """Return a cone that stands on the origin, with its tip at y = height."""
    return revolve([(radius, 0), (0, height)], segments)


def sphere(radius: float, segments: int, rings: int) -> Solid:
    """Return a sphere about the origin of 2 * segments * (rings - 1) triangles."""
    profile = arc(radius, -90, 90, rings)
    profile[[0, -1], 0] = 0
    return revolve(profile, segments)


def icosphere(radius: float, divisions: int) -> Solid:
    """Return a sphere about the origin of 20 * 4^divisions nearly equal triangles."""
    golden = (1 + 5**0.5) / 2
    pairs = [(s, t * golden) for s in (-1, 1) for t in (-1, 1)]
    points = np.array([np.roll((0, *pair), axis) for axis in range(3) for pair in pairs])
    near = np.isclose(np.linalg.norm(points[:, None] - points, axis=2), 2)
    numbers = [each for each in combinations(range(11, -1, -1), 3) if near[np.ix_(each, each)].sum() == 6]
    corners = points[sorted(numbers)]
    inward = np.linalg.det(corners) < 0
    corners[inward] = corners[inward][:, ::-1]
    for _ in range(divisions):
        a, b, c = corners.transpose(1, 0, 2)
        d, e, f = a + b, b + c, c + a
        corners = np.concatenate([np.stack(part, axis=1) for part in ((a, d, f), (d, b, e), (f, e, c), (d, e, f))])
        corners /= np.linalg.norm(corners, axis=2, keepdims=True)
    return _grey(radius * corners / np.linalg.norm(corners, axis=2, keepdims=True))


def torus(radius: float, thickness: float, segments: int, sides: int) -> Solid:
    """Return a ring about the y axis of 2 * segments * sides triangles. thickness: the radius of its section."""
    return revolve(regular(sides, thickness) + np.array((radius, 0)), segments, closed=True)


def tube(
    path: ArrayLike, radius: float, sides: int, closed: bool = False, scales: Sequence[float] | None = None
) -> Solid:
    """Return a round rod along a path (k, 3): `sweep` of a regular polygon."""
    return sweep(regular(sides, radius), path, closed, scales)


def link(length: float, width: float, thickness: float, steps: int, sides: int) -> Solid:
    """Return a chain link in the x-y plane, along x: two half circles of `steps` parts, joined by straight rods.

    length, width: between the centres of opposite rods. thickness: the radius of the rod.
    """
    half = _at(arc(width / 2, -90, 90, steps, ((length - width) / 2, 0)), 0)
    return tube(np.vstack([half, half * (-1, -1, 1)]), thickness, sides, closed=True)


def pixels(rows: Sequence[str], palette: dict[str, str], depth: float) -> Solid:
    """Return a relief of boxes, one unit per character, about the origin; " " is empty.

    Neighbours of the same colour in a row, and equal runs in consecutive rows, become one box.
    """
    height, width = len(rows), max(map(len, rows))
    runs: dict[tuple[int, int, str], tuple[int, int]] = {}
    boxes: list[tuple[int, int, int, int, str]] = []
    for y, row in enumerate([*rows, ""]):
        found: dict[tuple[int, int, str], tuple[int, int]] = {}
        start = 0
        for x in range(1, len(row) + 1):
            if x == len(row) or row[x] != row[start]:
                if row[start] != " ":
                    key = (start, x, row[start])
                    found[key] = (runs[key][0] if key in runs else y, y + 1)
                start = x
        boxes += [(*key[:2], *runs[key], key[2]) for key in runs if key not in found]
        runs = found
    return union(
        *(
            box(right - left, bottom - top, depth)
            .moved((left + right - width) / 2, (height - top - bottom) / 2)
            .painted(palette[name])
            for left, right, top, bottom, name in boxes
        )
    )


# ---- within ----


def _at(outline: Floats, z: float) -> Floats:
    return np.column_stack([outline, np.full(len(outline), z)])


def _grey(corners: Floats) -> Solid:
    return Solid(corners, np.full(corners.shape, 200, dtype=np.uint8))


def _distinct(corners: Floats) -> Flags:
    """Return which triangles have three different corners, (m,) bool."""
    sides = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
    return np.asarray(sides.min(axis=1) > SAME)


def _outward(solid: Solid) -> Solid:
    if solid.volume() >= 0:
        return solid
    return Solid(solid.corners[:, ::-1], solid.colors[:, ::-1])


def _cap(ring: Floats) -> Floats:
    """Return the triangles of a flat ring, (m, 3, 3), in its orientation; none for a tip or a line."""
    points = ring[np.linalg.norm(ring - np.roll(ring, 1, axis=0), axis=1) > SAME]
    if len(points) < 3:
        return np.empty((0, 3, 3))
    around = points - points.mean(axis=0)
    normal = np.cross(around, np.roll(around, -1, axis=0)).sum(axis=0)
    # seen along the axis that is nearest to the normal
    axis = int(np.abs(normal).argmax())
    return np.asarray(points[triangulate(np.delete(around, axis, axis=1))])


def _normals(corners: Floats, crease: float) -> Floats:
    """Return unit normals of the corners, (m, 3, 3), rounded.

    Each is the mean, weighted by angle, of the faces that meet there and differ by less than `crease` degrees.
    """
    sides = np.roll(corners, -1, axis=1) - corners
    faces = np.cross(sides[:, 0], sides[:, 1])
    faces /= np.linalg.norm(faces, axis=1, keepdims=True)
    sides /= np.linalg.norm(sides, axis=2, keepdims=True)
    angles = np.arccos(np.clip(-(sides * np.roll(sides, 1, axis=1)).sum(axis=2), -1, 1))
    _, places = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    places = places.reshape(-1)
    weighted = (faces[:, None] * angles[..., None]).reshape(-1, 3)
    normals = np.empty((3 * len(corners), 3))
    for place in range(places.max() + 1):
        here = np.flatnonzero(places == place)
        near = faces[here // 3] @ faces[here // 3].T > np.cos(np.radians(crease))
        normals[here] = (near | np.eye(len(here), dtype=bool)) @ weighted[here]
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return np.rint(normals * 2**20).reshape(-1, 3, 3) / 2**20
