"""Normals for meshes that have none: smooth, except across creases."""

from __future__ import annotations

import numpy as np
from attrs import evolve
from numpy.typing import NDArray

from ._arithmetic import cosine, dot, length
from ._files.weld import weld
from ._material import Shading
from ._mesh import Mesh, components
from ._object import Object

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Flags = NDArray[np.bool_]

#: The largest angle between faces, in degrees, at which the edge between them is smooth. Chamfers and octagons, 45
#: degrees, stay hard; coarse round shapes, such as a cylinder of 9 sides, do not.
CREASE = 40.0
#: That of meshes that were simplified, whose faces are large for the shape.
SIMPLIFIED_CREASE = 60.0
CREASES = (0, 180)
#: An edge of exactly the crease angle is smooth, however its cosine is rounded.
_ROUNDING = 1e-6
#: Normals are rounded to so many digits, so that they are the same on all machines.
_DIGITS = 6
#: The cosine of the angle, 1 degree, by which normals may differ from those of the faces in a mesh without curves.
_STRAIGHT = 0.99985
#: An edge of more pairs of faces is a crease.
_MOST_PAIRS = 16


def creased(mesh: Mesh, degrees: float = CREASE) -> Mesh:
    """Return the mesh with smooth normals, except across edges at which faces differ by more than `degrees`.

    Normals that the mesh has are replaced. Vertices are split at creases only. The mesh is returned without normals,
    for flat shading, where that looks the same.
    """
    normals = corner_normals(mesh.positions, mesh.faces, degrees)
    if is_flat(mesh.positions, mesh.faces, normals):
        return without_normals(mesh)
    return weld(mesh.positions, mesh.faces, mesh.rgba[mesh.faces], normals, corner_uvs(mesh))


def shaded(o: Object, shading: Shading, degrees: float = CREASE, anew: bool = False) -> Object:
    """Return the object in another shading. One that becomes smooth, and has no normals, gets those of `smoothed`.

    anew: whether smooth shading replaces normals, too.
    """
    is_given = o.mesh.normals is not None or o.material.shading == "smooth"
    if shading == "smooth" and (anew or not is_given):
        return smoothed(o, degrees)
    return evolve(o, material=evolve(o.material, shading=shading))


def smoothed(o: Object, degrees: float) -> Object:
    """Return the object with the normals of `creased`, in flat shading if there are none."""
    mesh = creased(o.mesh, degrees)
    return evolve(o, mesh=mesh, material=evolve(o.material, shading="flat" if mesh.normals is None else "smooth"))


def without_normals(mesh: Mesh) -> Mesh:
    """Return the mesh without normals, nor vertices that differ in these only."""
    if mesh.normals is None:
        return mesh
    return weld(mesh.positions, mesh.faces, mesh.rgba[mesh.faces], uvs=corner_uvs(mesh))


def corner_uvs(mesh: Mesh) -> Floats | None:
    """Return the texture coordinates of the corners of faces, (m, 3, 2); None if there are none."""
    return None if mesh.uvs is None else mesh.uvs[mesh.faces]


def corner_normals(positions: Floats, faces: Ints, degrees: float = CREASE, groups: Ints | None = None) -> Floats:
    """Return a unit normal for each corner of each face, (m, 3, 3).

    It is the mean of the faces around the corner, up to the next creases, weighted by area and angle.
    groups: (m,) the smoothing group of each face, in place of `degrees`: edges within a group are smooth; none are in
    group 0.
    """
    unique, number = np.unique(positions + 0.0, axis=0, return_inverse=True)
    corners = number.reshape(-1)[faces]
    areas, angles = _areas_and_angles(unique, corners)
    sizes = length(areas)[:, None]
    units = np.divide(areas, sizes, out=np.zeros_like(areas), where=sizes > 0)
    proper = np.flatnonzero(sizes[:, 0] > 0)
    here, there, links = _neighbours(corners, proper, len(unique))
    if groups is None:
        turns = dot(units[here], units[there])
        hard = turns < cosine(degrees) - _ROUNDING
        hard = _without_dead_ends(hard, turns > cosine(SIMPLIFIED_CREASE), corners, proper, links)
    else:
        hard = (groups[here] != groups[there]) | (groups[here] == 0)
    patch = components(links[np.repeat(~hard, 2)], corners.size).reshape(-1, 3)
    # triangles without an area go with any other at the same place
    owner = np.full(len(unique), -1)
    owner[corners[proper]] = patch[proper]
    flat = np.flatnonzero(sizes[:, 0] == 0)
    patch[flat] = np.where(owner[corners[flat]] < 0, patch[flat], owner[corners[flat]])
    weighted = areas[:, None] * angles[:, :, None]
    sums = np.zeros((corners.size, 3))
    np.add.at(sums, patch.ravel(), weighted.reshape(-1, 3))
    lengths = length(sums)[:, None]
    normals = np.divide(sums, lengths, out=np.zeros_like(sums), where=lengths > 0)[patch]
    return np.asarray(np.round(np.where(normals.any(axis=2, keepdims=True), normals, units[:, None]), _DIGITS) + 0.0)


def filled(positions: Floats, faces: Ints, normals: Floats) -> Floats:
    """Return normals of corners, (m, 3, 3), with those of `corner_normals` in place of zeros."""
    absent = ~normals.any(axis=2, keepdims=True)
    return np.where(absent, corner_normals(positions, faces), normals) if absent.any() else normals


def is_flat(positions: Floats, faces: Ints, normals: Floats) -> bool:
    """Return whether normals of corners, (m, 3, 3), are those of the faces."""
    areas, _ = _areas_and_angles(positions, faces)
    along = dot(normals, np.broadcast_to(areas[:, None], normals.shape))
    return bool((along >= _STRAIGHT * length(normals) * length(areas)[:, None]).all())


def _without_dead_ends(hard: Flags, weak: Flags, corners: Ints, proper: Ints, links: Ints) -> Flags:
    """Return the creases, (k,), without the weak ones that end within a surface, which look like scars.

    hard, weak: (k,) of the edges of `links`, which are those of `_neighbours`.
    """
    count = int(corners.max()) + 1
    ends = corners.ravel()[links[:, 0]].reshape(-1, 2)
    # each vertex of a border is an end of no crease
    inner = np.bincount(ends.ravel(), minlength=count)
    around = np.bincount(corners[proper].ravel(), minlength=count)
    degree = np.bincount(ends[hard].ravel(), minlength=count) + 2 * (inner != around)
    # the sum of the creases at each vertex: where one is left, that one
    sums = np.zeros(count, np.int64)
    np.add.at(sums, ends[hard], np.flatnonzero(hard)[:, None])
    left, degrees, only, pairs, is_weak = hard.copy(), degree.tolist(), sums.tolist(), ends.tolist(), weak.tolist()
    waiting = np.flatnonzero(degree == 1).tolist()
    while waiting:
        vertex = waiting.pop()
        edge = only[vertex]
        if degrees[vertex] != 1 or not is_weak[edge]:
            continue
        left[edge] = False
        for end in pairs[edge]:
            degrees[end] -= 1
            only[end] -= edge
            if degrees[end] == 1:
                waiting.append(end)
    return left


@np.errstate(over="ignore", invalid="ignore")
def _areas_and_angles(positions: Floats, faces: Ints) -> tuple[Floats, Floats]:
    """Return the normals of faces, of their size, (m, 3), and the angles at their corners in radians, (m, 3)."""
    # of any size: products of lengths stay within floats
    points = (positions - positions[0]) / (np.abs(positions - positions[0]).max() or 1.0)
    a, b, c = points[faces].transpose(1, 0, 2)
    areas = np.cross(b - a, c - a)
    sizes = length(areas)
    angles = [np.arctan2(sizes, dot(q - p, r - p)) for p, q, r in ((a, b, c), (b, c, a), (c, a, b))]
    return areas, np.stack(angles, axis=1)


def _neighbours(corners: Ints, proper: Ints, count: int) -> tuple[Ints, Ints, Ints]:
    """Return the pairs of faces, among `proper`, that share an edge and are wound alike, and the corners they share.

    corners: (m, 3) numbers of positions, of which there are `count`. Returns (k,), (k,) faces, and (2 k, 2) corners,
    numbered 0 to 3 m - 1: two pairs for each pair of faces.
    """
    tails = (3 * proper[:, None] + np.arange(3)).ravel()
    heads = (3 * proper[:, None] + np.array([1, 2, 0])).ravel()
    begin, end = corners.ravel()[tails], corners.ravel()[heads]
    keys = np.minimum(begin, end) * count + np.maximum(begin, end)
    upward, downward = np.flatnonzero(begin < end), np.flatnonzero(begin > end)
    downward = downward[np.argsort(keys[downward], kind="stable")]
    first = np.searchsorted(keys[downward], keys[upward], "left")
    pairs = np.searchsorted(keys[downward], keys[upward], "right") - first
    pairs[pairs > _MOST_PAIRS] = 0
    one = np.repeat(upward, pairs)
    other = downward[np.repeat(first - np.cumsum(pairs) + pairs, pairs) + np.arange(len(one))]
    links = np.stack([tails[one], heads[other], heads[one], tails[other]], axis=1).reshape(-1, 2)
    return tails[one] // 3, tails[other] // 3, links
