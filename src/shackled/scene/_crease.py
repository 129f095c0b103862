"""Normals for meshes that have none: smooth, except across creases.

At which angle between faces an edge is a crease depends on the shape of the connected part that it belongs to, since no
angle suits all: the edge of a chamfer is a trait of the shape, one of the same angle in a coarse scan is not.
"""

from __future__ import annotations

import numpy as np
from attrs import evolve

from ..base.checks import Flags, Floats, Ints
from . import _constants as constant
from ._arithmetic import cosine, dot, length, units
from ._fields import Shading
from ._mesh import Mesh, components, face_normals, weld
from ._object import Object
from ._winding import against

#: Where edges are smooth, by shape.
_ANGLES = (constant.SOLID, constant.FIGURE, constant.FACETS)


def creased(mesh: Mesh, degrees: float | None = None) -> Mesh:
    """Return the mesh with normals, instead of its own, that are smooth except across edges at which faces differ by
    more than `degrees`, or, if None, than suits the shape; without any where flat shading looks the same.
    """
    normals = corner_normals(mesh.positions, mesh.faces, degrees)
    return with_normals(mesh, None if is_flat(mesh.positions, mesh.faces, normals) else normals)


def shaded(o: Object, shading: Shading, degrees: float | None = None, anew: bool = False) -> Object:
    """Return the object in another shading: `smoothed`, if it becomes smooth and has no normals, or gets them anew."""
    is_given = o.mesh.normals is not None or o.material.shading == "smooth"
    if shading == "smooth" and (anew or not is_given):
        return smoothed(o, degrees)
    return evolve(o, material=evolve(o.material, shading=shading))


def smoothed(o: Object, degrees: float | None) -> Object:
    """Return the object with the normals of `creased`, in flat shading if there are none."""
    mesh = creased(o.mesh, degrees)
    return evolve(o, mesh=mesh, material=evolve(o.material, shading="flat" if mesh.normals is None else "smooth"))


def with_normals(mesh: Mesh, normals: Floats | None) -> Mesh:
    """Return the mesh with normals of corners, (m, 3, 3), or with none, and without vertices that are alike."""
    if normals is None and mesh.normals is None:
        return mesh
    uvs = None if mesh.uvs is None else mesh.uvs[mesh.faces]
    return weld(mesh.positions, mesh.faces, mesh.rgba[mesh.faces], normals, uvs)


def corner_normals(positions: Floats, faces: Ints, degrees: float | None = None, groups: Ints | None = None) -> Floats:
    """Return a unit normal for each corner of each face, (m, 3, 3): the mean of the faces around it, up to the next
    creases, weighted by area and angle. It points to the front of its face, however its neighbours are wound.

    degrees: as in `creased`. groups: (m,) the smoothing group of each face, in place of `degrees`: edges within a group
    are smooth; none are in group 0.
    """
    unique, number = np.unique(positions + 0.0, axis=0, return_inverse=True)
    corners = number.reshape(-1)[faces]
    # as if all faces were wound alike
    is_against = against(corners)
    corners = np.where(is_against[:, None], corners[:, ::-1], corners)
    areas, angles = _areas_and_angles(unique, corners)
    sizes, directions = length(areas), units(areas)
    proper = np.flatnonzero(sizes > 0)
    here, there, links = _neighbours(corners, proper, len(unique))
    if groups is None:
        angles_of: tuple[tuple[float, float], ...] = _ANGLES
        if degrees is None:
            shape, ways = _by_shape(unique, corners, directions, here, there, links)
        else:
            shape, ways, angles_of = np.zeros(1, np.int64), directions, ((degrees, constant.SOLID[1]),)
        limits = np.array([[cosine(each) for each in row] for row in angles_of])[shape]
        cosines = dot(ways[here], ways[there])
        hard = cosines < limits[:, 0] - constant.ROUNDING
        hard = _without_dead_ends(hard, cosines > limits[:, 1], corners, proper, links)
    else:
        hard = (groups[here] != groups[there]) | (groups[here] == 0)
    patch = components(links[np.repeat(~hard, 2)], corners.size).reshape(-1, 3)
    # triangles without an area go with any other at the same place
    owner = np.full(len(unique), -1)
    owner[corners[proper]] = patch[proper]
    flat = np.flatnonzero(sizes == 0)
    patch[flat] = np.where(owner[corners[flat]] < 0, patch[flat], owner[corners[flat]])
    weighted = areas[:, None] * angles[:, :, None]
    sums = np.zeros((corners.size, 3))
    np.add.at(sums, patch.ravel(), weighted.reshape(-1, 3))
    normals = units(sums)[patch]
    normals = np.where(normals.any(axis=2, keepdims=True), normals, directions[:, None])
    normals[is_against] = -normals[is_against, ::-1]
    return np.asarray(np.round(normals, constant.DIGITS) + 0.0)


def filled(positions: Floats, faces: Ints, normals: Floats) -> Floats:
    """Return normals of corners, (m, 3, 3), with those of `corner_normals` in place of zeros."""
    absent = ~normals.any(axis=2, keepdims=True)
    return np.where(absent, corner_normals(positions, faces), normals) if absent.any() else normals


def is_flat(positions: Floats, faces: Ints, normals: Floats) -> bool:
    """Return whether normals of corners, (m, 3, 3), are those of the faces."""
    areas, _ = _areas_and_angles(positions, faces)
    along = dot(normals, np.broadcast_to(areas[:, None], normals.shape))
    return bool((along >= constant.STRAIGHT * length(normals) * length(areas)[:, None]).all())


def _by_shape(
    points: Floats, corners: Ints, normals: Floats, here: Ints, there: Ints, links: Ints
) -> tuple[Ints, Floats]:
    """Return which of `_ANGLES` decide at each edge, (k,), and the directions of faces, (m, 3), given unit normals."""
    part = np.unique(components(corners, len(points))[corners[:, 0]], return_inverse=True)[1].reshape(-1)
    places = (points - points[0]) / (np.abs(points - points[0]).max() or 1.0)
    lengths = length(np.diff(places[corners.ravel()[links[:, 0].reshape(-1, 2)]], axis=1)[:, 0])
    a, b = normals[here], normals[there]
    turns = np.degrees(np.arctan2(length(np.cross(a, b)), dot(a, b)))
    each = part[here]

    def mean(values: Floats | Flags, among: Flags) -> Floats:
        """Return the mean of values of edges, weighted by length, in each part."""
        totals, sums = (np.bincount(each, lengths * among * v, part.max() + 1) for v in (np.ones(len(turns)), values))
        return np.divide(sums, totals, out=np.zeros(len(sums)), where=totals > 0)

    all_edges, seen = turns >= 0, turns > constant.FACETS[0]
    is_flat_faced = mean(turns <= constant.FLAT, all_edges) >= constant.FLAT_SHARE
    average = mean(turns, seen)
    blunt = seen & (turns <= constant.GAP[1])
    middle = mean(turns, blunt)
    is_uneven = np.sqrt(mean((turns - middle[each]) ** 2, blunt)) >= constant.UNEVEN * middle
    is_all_corners = ~is_flat_faced & (np.bincount(part) <= constant.FEW_FACES)
    is_all_corners &= average > np.where(is_uneven, *constant.COARSE)
    sharp = mean(turns > constant.GAP[1], all_edges)
    middling = mean((turns > constant.GAP[0]) & (turns <= constant.GAP[1]), all_edges)
    is_solid = is_flat_faced | ((sharp >= constant.GAP_TIMES * middling) & (sharp >= constant.GAP_SHARE))
    is_figure = ~is_solid & ~is_all_corners
    shape = np.where(is_all_corners & ~is_figure.any(), 2, np.where(is_solid, 0, 1))
    longest = length(np.diff(places[corners[:, [0, 1, 2, 0]]], axis=1)).max(axis=1)
    areas = length(_areas_and_angles(points, corners)[0])
    is_needle = (shape == 1)[part] & (areas < constant.NEEDLE * longest**2)
    directions = normals.copy()
    for one, other in ((here, there), (there, here)):
        found = is_needle[one] & (lengths >= (1 - 1e-9) * longest[one]) & (2 * areas[one] < areas[other])
        directions[one[found]] = normals[other[found]]
    return shape[each], directions


def _without_dead_ends(hard: Flags, weak: Flags, corners: Ints, proper: Ints, links: Ints) -> Flags:
    """Return the creases, (k,), without the weak ones that end within a surface, which look like scars."""
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
    areas, (a, b, c) = face_normals(points[faces]), points[faces].transpose(1, 0, 2)
    angles = [np.arctan2(length(areas), dot(q - p, r - p)) for p, q, r in ((a, b, c), (b, c, a), (c, a, b))]
    return areas, np.stack(angles, axis=1)


def _neighbours(corners: Ints, proper: Ints, count: int) -> tuple[Ints, Ints, Ints]:
    """Return the pairs of faces, among `proper`, that share an edge and are wound alike, (k,) and (k,), and the two
    pairs of corners that each shares, (2 k, 2). corners: (m, 3) numbers of positions, of which there are `count`.
    """
    tails = (3 * proper[:, None] + np.arange(3)).ravel()
    heads = (3 * proper[:, None] + np.array([1, 2, 0])).ravel()
    begin, end = corners.ravel()[tails], corners.ravel()[heads]
    keys = np.minimum(begin, end) * count + np.maximum(begin, end)
    upward, downward = np.flatnonzero(begin < end), np.flatnonzero(begin > end)
    downward = downward[np.argsort(keys[downward], kind="stable")]
    first = np.searchsorted(keys[downward], keys[upward], "left")
    pairs = np.searchsorted(keys[downward], keys[upward], "right") - first
    pairs[pairs > constant.MOST_PAIRS] = 0
    one = np.repeat(upward, pairs)
    other = downward[np.repeat(first - np.cumsum(pairs) + pairs, pairs) + np.arange(len(one))]
    links = np.stack([tails[one], heads[other], heads[one], tails[other]], axis=1).reshape(-1, 2)
    return tails[one] // 3, tails[other] // 3, links
