"""Meshes from formulas, about the origin and about 2 across, with y up; faces are seen from outside."""

from __future__ import annotations

from collections.abc import Callable
from itertools import combinations, product

import numpy as np
from attrs import evolve
from numpy.typing import ArrayLike, NDArray

from ...base.checks import Floats, Ints
from ...base.checks import color as checked_color
from ...scene._mesh import Mesh, faces_of_all, vertex_normals, without_slivers

#: From u and v, each (n, m) from 0 to 1, to points (n, m, 3).
Surface = Callable[[Floats, Floats], Floats]

TURN = 2 * np.pi


# ---- surfaces over a grid of two parameters ----


def patch(surface: Surface, across: int, down: int) -> Mesh:
    """Return a surface of 2 * across * down triangles, seen from where d/du x d/dv points.

    Equal points are one vertex, so seams and poles are smooth. Triangles without area are left out.
    """
    return smooth(surface(*_parameters(across, down)).reshape(-1, 3), cells(across + 1, down + 1))


def smooth(points: Floats, faces: Ints) -> Mesh:
    """Return a mesh with normals, in which equal points are one vertex, without triangles that have no area."""
    positions, number = np.unique(np.round(points, 9) + 0.0, axis=0, return_inverse=True)
    merged = without_slivers(number.reshape(-1)[faces])
    return Mesh(positions, merged, normals=vertex_normals(positions, merged))


def cells(rows: int, columns: int) -> Ints:
    """Return two faces for each cell of a grid of vertices, counter-clockwise from row to column."""
    number = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]
    return np.stack([np.stack([a, b, c], axis=-1), np.stack([a, c, d], axis=-1)], axis=-2).reshape(-1, 3)


def around(angle: ArrayLike, height: ArrayLike, reach: ArrayLike) -> Floats:
    """Return points about the y axis, (..., 3)."""
    x, y, z = np.broadcast_arrays(reach * np.cos(angle), height, np.negative(reach) * np.sin(angle))
    return np.stack([x, y, z], axis=-1)


def one_sided(surface: Surface, across: int, down: int) -> Mesh:
    """Return a surface without inside and outside, as in `patch`, with faces on both sides.

    Each face is lit and seen from its own side. Vertices where the surface closes upon itself are not merged, because
    their normals may point opposite ways.
    """
    u, v = _parameters(across, down)
    step = 1e-5
    along = surface(u + step, v) - surface(u - step, v)
    beside = surface(u, v + step) - surface(u, v - step)
    normals = np.cross(along, beside).reshape(-1, 3)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    points, faces = surface(u, v).reshape(-1, 3), cells(across + 1, down + 1)
    return Mesh(
        np.concatenate([points, points]),
        np.concatenate([faces, faces[:, ::-1] + len(points)]),
        normals=np.concatenate([normals, -normals]),
    )


def sphere(across: int = 32, down: int = 16) -> Mesh:
    """Return a sphere of radius 1, divided by longitude and latitude."""
    return patch(lambda u, v: around(TURN * u, -np.cos(np.pi * v), np.sin(np.pi * v)), across, down)


def torus(radius: float = 0.72, thickness: float = 0.28, across: int = 36, down: int = 16) -> Mesh:
    """Return a ring about the y axis."""

    def surface(u: Floats, v: Floats) -> Floats:
        return around(TURN * u, -thickness * np.sin(TURN * v), radius + thickness * np.cos(TURN * v))

    return patch(lambda u, v: surface(u, -v), across, down)


def torus_knot(p: int = 2, q: int = 3, thickness: float = 0.17, across: int = 84, down: int = 7) -> Mesh:
    """Return a tube along a knot that winds p times about the axis of a torus (z), and q times about its ring."""

    def center(t: Floats) -> Floats:
        reach = 0.6 + 0.25 * np.cos(q * t)
        return np.stack([reach * np.cos(p * t), reach * np.sin(p * t), -0.25 * np.sin(q * t)], axis=-1)

    return patch(tube(lambda u: center(TURN * u), thickness), across, down)


def spring(turns: float = 4, thickness: float = 0.13, across: int = 72, down: int = 8) -> Mesh:
    """Return a tube along a helix about the y axis, its ends closed."""

    def center(u: Floats) -> Floats:
        return np.stack([0.6 * np.cos(TURN * turns * u), 1.6 * u - 0.8, -0.6 * np.sin(TURN * turns * u)], axis=-1)

    def surface(u: Floats, v: Floats) -> Floats:
        # the first and the last step go from the middle of the end to its edge
        along = np.clip((u * across - 1) / (across - 2), 0, 1)
        return tube(center, thickness, np.where((u <= 0) | (u >= 1), 0.0, 1.0))(along, v)

    return patch(surface, across, down)


def tube(center: Callable[[Floats], Floats], thickness: float, width: ArrayLike = 1.0) -> Surface:
    """Return the surface at the distance thickness * width of a curve that is never straight."""

    def surface(u: Floats, v: Floats) -> Floats:
        step = 1e-4
        before, here, after = center(u - step), center(u), center(u + step)
        forward = _unit(after - before)
        inward = after - 2 * here + before
        inward = _unit(inward - (inward * forward).sum(axis=-1, keepdims=True) * forward)
        beside = np.cross(forward, inward)
        angle = TURN * v[..., None]
        offset = thickness * (np.cos(angle) * inward + np.sin(angle) * beside)
        return np.asarray(here + np.asarray(width)[..., None] * offset)

    return lambda u, v: surface(u, -v)


def moebius_strip(across: int = 60, down: int = 5, width: float = 0.38) -> Mesh:
    """Return a band that is half a turn twisted: one side, one edge."""

    def surface(u: Floats, v: Floats) -> Floats:
        angle, offset = TURN * u, width * (2 * v - 1)
        reach = 0.72 + offset * np.cos(angle / 2)
        return around(angle, offset * np.sin(angle / 2), reach)

    return one_sided(surface, across, down)


def klein_bottle(across: int = 24, down: int = 12) -> Mesh:
    """Return a closed surface with one side, a bottle whose neck goes through its wall to its bottom."""

    def surface(u: Floats, v: Floats) -> Floats:
        # the middle line goes up inside the belly, over the top, down through the neck: a closed curve in x and y, with
        # the radius of the tube about it
        a, b = TURN * u, TURN * v
        r = 4 * (1 - np.cos(a) / 2)
        in_belly = a < np.pi
        x = 6 * np.cos(a) * (1 + np.sin(a)) + r * np.cos(b) * np.where(in_belly, np.cos(a), -1.0)
        y = 16 * np.sin(a) + np.where(in_belly, r * np.sin(a) * np.cos(b), 0.0)
        z = r * np.sin(b)
        return np.stack([x, y, z], axis=-1) / 20

    return one_sided(surface, across, down)


def superellipsoid(squareness: float = 0.35, roundness: float = 0.35, across: int = 36, down: int = 16) -> Mesh:
    """Return a shape between a cube (0, 0), a sphere (1, 1) and an octahedron (2, 2)."""

    def power(x: Floats, exponent: float) -> Floats:
        return np.asarray(np.sign(x) * np.abs(np.where(np.abs(x) < 1e-12, 0, x)) ** exponent)

    def surface(u: Floats, v: Floats) -> Floats:
        a, b = TURN * u, np.pi * (v - 0.5)
        reach = power(np.cos(b), roundness)
        return np.stack(
            [reach * power(np.cos(a), squareness), power(np.sin(b), roundness), -reach * power(np.sin(a), squareness)],
            axis=-1,
        )

    return patch(surface, across, down)


def seashell(across: int = 66, down: int = 9, turns: float = 4) -> Mesh:
    """Return a tube that grows as it winds down about the y axis, open at its end."""

    def surface(u: Floats, v: Floats) -> Floats:
        angle, growth = TURN * turns * u, np.exp(0.62 * turns * (u - 1))
        radius, turn = 0.46 * growth, -TURN * v
        reach = 0.44 * growth + radius * np.cos(turn)
        return around(angle, 0.95 - 1.55 * growth - 1.1 * radius * np.sin(turn), reach)

    return patch(surface, across, down)


# ---- what has edges ----


def cylinder(count: int = 40) -> Mesh:
    """Return a cylinder of radius 0.75 and height 1.8 along the y axis."""
    return _turned([0, 0.75, 0.75, 0], [-0.9, -0.9, 0.9, 0.9], count)


def cone(count: int = 40) -> Mesh:
    """Return a cone of radius 0.85 and height 1.8 that points upward."""
    return _turned([0, 0.85, 0], [-0.9, -0.9, 0.9], count)


def _turned(radii: list[float], heights: list[float], count: int) -> Mesh:
    """Return the surface of a polyline turned about the y axis, smooth around, with edges between its parts."""
    parts = []
    k, top = np.arange(count), count + 1
    angle = TURN * np.arange(count + 1) / count
    up = np.array([0.0, 1.0, 0.0])
    for r0, h0, r1, h1 in zip(radii, heights, radii[1:], heights[1:], strict=False):
        ring = around(angle, 0, 1)
        points = np.concatenate([around(angle, h0, r0), around(angle, h1, r1)])
        # at a tip each face has the normal of its own middle
        middle = around(angle + TURN / count / 2, 0, 1)
        outward = np.concatenate([ring if r0 else middle, ring if r1 else middle])
        lower = np.stack([k, k + 1, top + (k + 1 if r1 else k)], axis=-1)
        upper = np.stack([k, top + k + 1, top + k], axis=-1)
        faces = np.concatenate([lower[: count if r0 else 0], upper[: count if r1 else 0]])
        points = np.round(points, 9) + 0.0  # so that the last edge is the first one, and parts meet
        parts.append(Mesh(points, faces, normals=_unit((h1 - h0) * outward + (r0 - r1) * up)))
    return joined(*parts)


def cube() -> Mesh:
    """Return a cube of side 1.2 with its position as colour: red along x, green along y, blue along z."""
    corners = np.array(list(product((0, 1), repeat=3)))
    return Mesh(1.2 * corners - 0.6, _faces_of(corners), colors=255 * corners)


def tetrahedron() -> Mesh:
    """Return a regular tetrahedron, 4 triangles."""
    return hull([(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)])


def octahedron() -> Mesh:
    """Return a regular octahedron, 8 triangles."""
    return hull(np.concatenate([np.eye(3), -np.eye(3)]))


def icosahedron() -> Mesh:
    """Return a regular icosahedron, 20 triangles."""
    phi = (1 + 5**0.5) / 2
    return hull([np.roll((0, s, t * phi), turn) for turn in range(3) for s in (1, -1) for t in (1, -1)])


def dodecahedron() -> Mesh:
    """Return a regular dodecahedron, 12 pentagons."""
    phi = (1 + 5**0.5) / 2
    corners = [np.roll((0, s / phi, t * phi), turn) for turn in range(3) for s in (1, -1) for t in (1, -1)]
    return hull(np.array([*corners, *product((-1, 1), repeat=3)]))


def icosphere(halvings: int = 2) -> Mesh:
    """Return a sphere of radius 1: an icosahedron, subdivided into 20 * 4^halvings triangles."""
    start = icosahedron()
    positions, faces = start.positions, start.faces
    for _ in range(halvings):
        a, b, c = positions[faces].transpose(1, 0, 2)
        ab, bc, ca = _unit(a + b), _unit(b + c), _unit(c + a)
        soup = np.stack([a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca], axis=1).reshape(-1, 3)
        positions, number = np.unique(np.round(soup, 9) + 0.0, axis=0, return_inverse=True)
        faces = number.reshape(-1, 3)
    positions = _unit(positions)
    return Mesh(positions, faces, normals=vertex_normals(positions, faces))


def hull(points: ArrayLike) -> Mesh:
    """Return the convex polyhedron of corners that all lie on it, normalized to the unit sphere."""
    corners = _unit(np.asarray(points, dtype=np.float64))
    return Mesh(corners, _faces_of(corners))


def menger_sponge(depth: int = 2) -> Mesh:
    """Return a Menger sponge: a cube with square tunnels, recursively. Only visible faces are included.

    It has 12, 144, 2,112 triangles for depth 0, 1, 2.
    """
    side = 3**depth
    place = np.indices((side,) * 3)
    solid = np.ones((side,) * 3, dtype=bool)
    for level in range(depth):
        solid &= ((place // 3**level % 3 == 1).sum(axis=0)) < 2
    padded = np.pad(solid, 1)
    quads = []
    for axis, sign in product(range(3), (-1, 1)):
        shown = solid & ~np.roll(padded, -sign, axis=axis)[1:-1, 1:-1, 1:-1]
        cells = np.argwhere(shown)
        along, first, second = np.eye(3)[[axis, (axis + 1) % 3, (axis + 2) % 3]]
        corner = cells + (along if sign > 0 else 0 * along)
        if sign < 0:
            first, second = second, first
        quads.append(np.stack([corner, corner + first, corner + first + second, corner + second], axis=1))
    soup = np.concatenate(quads)
    positions, number = np.unique(soup.reshape(-1, 3), axis=0, return_inverse=True)
    four = number.reshape(-1, 4)
    faces = np.concatenate([four[:, [0, 1, 2]], four[:, [0, 2, 3]]])
    return Mesh(positions * (1.3 / side) - 0.65, faces)


# ---- colours ----


def shaded(mesh: Mesh, low: ArrayLike, high: ArrayLike, axis: ArrayLike = (0, 1, 0)) -> Mesh:
    """Return the mesh in colours from `low` to `high` along an axis."""
    return evolve(mesh, colors=gradient(mesh.positions @ np.asarray(axis, dtype=np.float64), low, high))


def gradient(heights: Floats, low: ArrayLike, high: ArrayLike) -> NDArray[np.uint8]:
    """Return colours, (..., 3), from `low` at the least of the heights, (...), to `high` at the greatest."""
    share = ((heights - heights.min()) / (np.ptp(heights) or 1))[..., None]
    start, end = (np.array(checked_color(color, "a colour"), dtype=np.float64) for color in (low, high))
    colors: NDArray[np.uint8] = np.rint((1 - share) * start + share * end).astype(np.uint8)
    return colors


def joined(*meshes: Mesh) -> Mesh:
    """Return several meshes as one, with their opacities, and with normals if all have some."""
    normals = [mesh.normals for mesh in meshes if mesh.normals is not None]
    return Mesh(
        np.concatenate([mesh.positions for mesh in meshes]),
        faces_of_all(meshes),
        np.concatenate([mesh.rgba for mesh in meshes]),
        np.concatenate(normals) if len(normals) == len(meshes) else None,
    )


# ---- parts of the above ----


def _unit(vectors: Floats) -> Floats:
    return np.asarray(vectors / np.linalg.norm(vectors, axis=-1, keepdims=True))


def _parameters(across: int, down: int) -> tuple[Floats, Floats]:
    u, v = np.meshgrid(np.linspace(0, 1, across + 1), np.linspace(0, 1, down + 1), indexing="ij")
    return u, v


def _faces_of(points: ArrayLike) -> Ints:
    """Return the faces of the convex polyhedron with these corners, (m, 3), seen from outside."""
    corners = np.asarray(points, dtype=np.float64)
    corners = corners - corners.mean(axis=0)
    a, b, c = np.moveaxis(corners[[*combinations(range(len(corners)), 3)]], 1, 0)
    normals = np.cross(b - a, c - a)
    distances = (normals * a).sum(axis=1, keepdims=True)
    aside = np.abs(distances[:, 0]) >= 1e-9  # those through the middle are not faces
    normals = _unit(normals[aside]) * np.sign(distances[aside])
    heights = normals @ corners.T - (normals * a[aside]).sum(axis=1, keepdims=True)
    planes: dict[tuple[int, ...], Floats] = {}
    for normal, above in zip(normals, heights, strict=True):
        if above.max() <= 1e-9:
            planes[tuple(np.flatnonzero(above > -1e-9))] = normal
    faces = []
    for numbers, normal in planes.items():
        around = corners[list(numbers)] - corners[list(numbers)].mean(axis=0)
        first = _unit(around[0])
        angle = np.arctan2(around @ np.cross(normal, first), around @ first)
        ordered = np.array(numbers)[np.argsort(angle)]
        faces += [(ordered[0], ordered[k], ordered[k + 1]) for k in range(1, len(ordered) - 1)]
    return np.array(faces)
