"""Which side of each face is the front: faces that are wound wrongly are turned, and closed parts are culled."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from attrs import evolve
from numpy.typing import NDArray

from ..errors import warn
from ..values import plural
from ._arithmetic import dot, length
from ._files.weld import weld
from ._mesh import Mesh, components
from ._object import Object

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Flags = NDArray[np.bool_]

#: An object is divided into its closed parts and its open ones if there are so many faces of the former at least: what
#: culling saves, up to half of the gas, is then more than another object costs.
SPLIT_FACES = 32
#: Parts whose volume is a smaller share of that of the pyramids of their faces bound none.
_NO_VOLUME = 1e-6


def wound(objects: Sequence[Object], name: str, split: bool) -> list[Object]:
    """Return the objects of a model with faces that are wound alike, outward where they are closed, and culled there.

    split: whether objects that are partly closed may become two. An InputWarning, which begins with the name, tells
    what is turned. What cannot be wound alike, such as a Moebius strip, stays as it is.
    """
    meshes = [each.mesh for each in objects]
    positions = np.concatenate([mesh.positions for mesh in meshes])
    starts = np.cumsum([0, *(len(mesh.positions) for mesh in meshes)])
    number = np.unique(positions + 0.0, axis=0, return_inverse=True)[1].reshape(-1)
    faces = np.concatenate([mesh.faces + start for mesh, start in zip(meshes, starts, strict=False)])
    with np.errstate(over="ignore", invalid="ignore"):
        points = (positions - positions[0]) / (np.abs(positions - positions[0]).max() or 1.0)
        turned, is_closed, against, inside_out = _sides(points[faces], number[faces])
    if against:
        warn(f"{name}: {plural(against, 'face')} wound against the neighbours, now turned")
    if inside_out:
        warn(f"{name}: {plural(inside_out, 'closed part')} wound inside out, now turned")
    ends = np.cumsum([len(mesh.faces) for mesh in meshes])[:-1]
    made = []
    for each, is_turned, closed in zip(objects, np.split(turned, ends), np.split(is_closed, ends), strict=True):
        mesh = _turned(each.mesh, is_turned) if is_turned.any() else each.mesh
        count = int(closed.sum())
        if split and each.is_opaque and SPLIT_FACES <= count < len(closed):
            made += [
                evolve(each, mesh=_part(mesh, kept), cull=cull) for kept, cull in ((closed, True), (~closed, False))
            ]
        else:
            made.append(evolve(each, mesh=mesh, cull=bool(closed.all())))
    return made


def _sides(points: Floats, corners: Ints) -> tuple[Flags, Flags, int, int]:
    """Return which faces are to be turned, which are then of closed parts, and how many faces are turned because others
    of their part are wound otherwise, and how many parts because they are inside out.

    points: (m, 3, 3). corners: (m, 3), numbers of points.
    """
    count = len(corners)
    face, begin, end = np.repeat(np.arange(count), 3), corners.ravel(), np.roll(corners, -1, axis=1).ravel()
    is_edge = begin != end
    face, begin, end = face[is_edge], begin[is_edge], end[is_edge]
    keys = np.minimum(begin, end) * (int(corners.max()) + 1) + np.maximum(begin, end)
    order = np.argsort(keys, kind="stable")
    face, is_up = face[order], (begin < end)[order]
    first, edge, around = np.unique(keys[order], return_index=True, return_inverse=True, return_counts=True)[1:]
    # each face and its other side are two vertices of a graph: those that belong together have one label
    one = first[around == 2]
    # two faces of the same corners are the sides of a sheet, or one of them twice
    one = one[(np.sort(corners[face[one]], axis=1) != np.sort(corners[face[one + 1]], axis=1)).any(axis=1)]
    f, g, odd = face[one], face[one + 1], is_up[one] == is_up[one + 1]
    links = np.concatenate([np.stack([2 * f, 2 * g + odd], axis=1), np.stack([2 * f + 1, 2 * g + 1 - odd], axis=1)])
    label = components(links, 2 * count).reshape(-1, 2)
    turned = label[:, 0] > label[:, 1]
    sheet = label.min(axis=1) // 2
    areas = length(np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]))
    # of both ways, the one that turns less of it
    turned ^= np.bincount(sheet, areas * turned, count)[sheet] > np.bincount(sheet, areas * ~turned, count)[sheet]
    against = int(turned.sum())
    # parts that are connected by edges
    along = np.flatnonzero(edge[1:] == edge[:-1])
    part = components(np.stack([face[along], face[along + 1]], axis=1), count)
    balance = np.bincount(edge, np.where(is_up ^ turned[face], 1, -1))
    is_open = np.bincount(part[face], balance[edge] != 0, count) > 0
    local = points - points[part, :1]
    pyramids = dot(local[:, 0], np.cross(local[:, 1], local[:, 2])) * np.where(turned, -1, 1)
    volume, whole = np.bincount(part, pyramids, count), np.bincount(part, np.abs(pyramids), count)
    is_closed = ~is_open & (np.abs(volume) > _NO_VOLUME * whole)
    is_inverted = is_closed & (volume < 0) & ~_is_within(points, part, is_closed & (volume > 0))
    turned ^= is_inverted[part]
    return turned, is_closed[part], against, int(is_inverted.sum())


def _is_within(points: Floats, part: Ints, outer: Flags) -> Flags:
    """Return which parts are in the box about another, of those that are outer, and so may be hollows: these are wound
    the other way.
    """
    low, high = np.full((len(outer), 3), np.inf), np.full((len(outer), 3), -np.inf)
    np.minimum.at(low, part, points.min(axis=1))
    np.maximum.at(high, part, points.max(axis=1))
    within = np.zeros(len(outer), dtype=bool)
    for number in np.flatnonzero(outer):
        within |= ((low >= low[number]) & (high <= high[number])).all(axis=1)
    return within


def _turned(mesh: Mesh, turned: Flags) -> Mesh:
    """Return the mesh with some faces, (m,), wound the other way, and normals of these that point to their front."""
    faces = np.where(turned[:, None], mesh.faces[:, [0, 2, 1]], mesh.faces)
    normals = None
    if mesh.normals is not None:
        a, b, c = (mesh.positions[faces[:, corner]] for corner in range(3))
        normals = mesh.normals[faces]
        is_behind = dot(normals, np.cross(b - a, c - a)[:, None]) < 0
        normals = np.where((turned[:, None] & is_behind)[:, :, None], -normals, normals)
    if normals is None:
        return evolve(mesh, faces=faces)
    return weld(mesh.positions, faces, mesh.rgba[faces], normals, None if mesh.uvs is None else mesh.uvs[faces])


def _part(mesh: Mesh, kept: Flags) -> Mesh:
    """Return the mesh with some of its faces, (m,)."""
    used, faces = np.unique(mesh.faces[kept], return_inverse=True)
    fields = {
        name: values[used]
        for name in ("positions", "colors", "normals", "uvs", "opacities")
        if (values := getattr(mesh, name)) is not None
    }
    return evolve(mesh, faces=faces.reshape(-1, 3), **fields)
