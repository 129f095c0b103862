"""Cleaning and simplification of scanned or modelled meshes, so that a contract draws them for little gas."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ...base.checks import Ints
from ...errors import InputError
from ...scene._arithmetic import from_euler, rotate
from ...scene._mesh import Mesh, without_slivers
from ...scene._simplify import GENTLE, simplify

#: The number of triangles of the largest object of the Shackled paper.
MAX_TRIANGLES = 1198
#: Cells along the longest side of a mesh in which vertices are merged, and where simplification stops on its way then.
CELLS, STEPPING_STONE = 256, 4000


def prepare(
    mesh: Mesh,
    rotation: ArrayLike = (0, 0, 0),
    cap: bool = False,
    inside_out: bool = False,
    max_triangles: int = MAX_TRIANGLES,
) -> Mesh:
    """Return the mesh cleaned, turned, centred, scaled to a radius of 1, and simplified to `max_triangles`.

    rotation: degrees about x, then y, then z. cap: whether to close holes. inside_out: whether its faces are seen from
    inside. Colours are kept, normals are not.
    """
    mesh = clean(mesh)
    if cap:
        mesh = capped(mesh)
    if inside_out:
        mesh = Mesh(mesh.positions, mesh.faces[:, ::-1], mesh.colors)
    # simplified in a space of its own, so that the units of the file do not matter
    return placed(reduce(placed(mesh, rotation), max_triangles))


def clean(mesh: Mesh) -> Mesh:
    """Return the mesh with one vertex per position, without degenerate and duplicate triangles.

    Triangles back to back with each other are removed, too.
    """
    positions, first, number = np.unique(mesh.positions + 0.0, axis=0, return_index=True, return_inverse=True)
    faces = number.reshape(-1)[mesh.faces]
    # by their indices too, because the area of a sliver may be rounded to more than zero
    faces = without_slivers(_without_doubles(faces))
    a, b, c = positions[faces].transpose(1, 0, 2)
    used, faces = np.unique(faces[np.cross(b - a, c - a).any(axis=1)], return_inverse=True)
    return Mesh(positions[used], faces.reshape(-1, 3), mesh.colors[first][used])


def _without_doubles(faces: Ints) -> Ints:
    """Return the faces with one of all triangles with the same corners.

    None is kept if as many of them face one way as the other: they are a fold that bounds nothing.
    """
    corners = np.sort(faces, axis=1)
    # the sign of the permutation that sorts the corners
    a, b, c = faces.T
    way = np.where((a > b) ^ (b > c) ^ (a > c), -1, 1)
    _, first, number = np.unique(corners, axis=0, return_index=True, return_inverse=True)
    total = np.bincount(number.reshape(-1), weights=way)
    kept = np.sort(first[total != 0])
    turned = (np.sign(total)[number.reshape(-1)[kept]] != way[kept])[:, None]
    return np.asarray(np.where(turned, faces[kept][:, ::-1], faces[kept]))


def capped(mesh: Mesh) -> Mesh:
    """Return the mesh with each simple hole closed by a fan of triangles."""
    positions, faces = mesh.positions, mesh.faces
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    inner = set(map(tuple, edges[:, ::-1].tolist()))
    following: dict[int, int] = {}
    for a, b in edges.tolist():
        if (a, b) not in inner:
            following[b] = a  # a cap's edges run against those of the faces
    colors, points, caps = list(mesh.colors), list(positions), []
    while following:
        start, at = following.popitem()
        loop = [start]
        while at != start and at in following:
            loop.append(at)
            at = following.pop(at)
        if at == start and len(loop) >= 3:
            caps += [(a, b, len(points)) for a, b in zip(loop, loop[1:] + loop[:1], strict=True)]
            points.append(positions[loop].mean(axis=0))
            colors.append(colors[start])
    if not caps:
        return mesh
    return Mesh(np.array(points), np.concatenate([faces, caps]), np.array(colors))


def reduce(mesh: Mesh, max_triangles: int) -> Mesh:
    """Simplify a mesh. Where edge collapse fails, near vertices are merged first."""
    try:
        return clean(simplify(mesh, max_triangles))
    except InputError:
        fine = simplify(clean(_clustered(mesh)), max(STEPPING_STONE, max_triangles), GENTLE)
        return clean(simplify(fine, max_triangles, GENTLE))


def placed(mesh: Mesh, rotation: ArrayLike = (0, 0, 0)) -> Mesh:
    """Return the mesh turned, centred, and scaled such that its farthest vertex is at the distance 1."""
    positions = rotate(from_euler(rotation), mesh.positions)
    positions = positions - (positions.min(axis=0) + positions.max(axis=0)) / 2
    return Mesh(positions / np.linalg.norm(positions, axis=1).max(), mesh.faces, mesh.colors)


def _clustered(mesh: Mesh) -> Mesh:
    """Merge the vertices in each cell of a grid at their mean."""
    positions = mesh.positions
    cell = np.floor((positions - positions.min(axis=0)) / (np.ptp(positions, axis=0).max() / CELLS))
    _, first, number = np.unique(cell, axis=0, return_index=True, return_inverse=True)
    number = number.reshape(-1)
    sums = np.zeros((len(first), 3))
    np.add.at(sums, number, positions)
    means = sums / np.bincount(number)[:, None]
    return Mesh(means, number[mesh.faces], mesh.colors[first])
