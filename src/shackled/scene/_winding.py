"""Which side of faces is the front: closed parts that are wound inside out are turned, and closed parts are culled."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from attrs import evolve

from ..base.checks import Flags, Floats, Ints
from ..base.values import plural
from ..errors import warn
from . import _constants as constant
from ._arithmetic import dot
from ._mesh import Mesh, components, face_normals, faces_of_all, part_of_faces
from ._object import Object


def wound(objects: Sequence[Object], name: str, split: bool) -> list[Object]:
    """Return the objects of a model with closed parts wound outward, and with `cull` for those of closed parts only.

    A connected part is closed if each edge is as often in one direction as in the other. split: whether objects that
    are partly closed may become two. An InputWarning, which begins with the name, counts the parts that are turned.
    """
    meshes = [each.mesh for each in objects]
    positions = np.concatenate([mesh.positions for mesh in meshes])
    number = np.unique(positions + 0.0, axis=0, return_inverse=True)[1].reshape(-1)
    faces = faces_of_all(meshes)
    with np.errstate(over="ignore", invalid="ignore"):
        points = (positions - positions[0]) / (np.abs(positions - positions[0]).max() or 1.0)
        part, are_closed, are_inverted = _parts(points[faces], number[faces])
    if are_inverted.any():
        warn(f"{name}: {plural(int(are_inverted.sum()), 'closed part')} wound inside out, now turned")
    made = []
    for each, own in zip(objects, np.split(part, np.cumsum([len(mesh.faces) for mesh in meshes])[:-1]), strict=True):
        closed, mesh = are_closed[own], _turned(each.mesh, are_inverted[own])
        if split and each.is_opaque and constant.SPLIT_FACES <= closed.sum() < len(closed):
            halves = [(part_of_faces(mesh, mesh.faces[closed == cull]), cull) for cull in (True, False)]
        else:
            halves = [(mesh, bool(closed.all()))]
        made += [evolve(each, mesh=half, cull=cull) for half, cull in halves]
    return made


def _parts(points: Floats, corners: Ints) -> tuple[Ints, Flags, Flags]:
    """Return the part of each face, (m,), of those that edges connect, and which are closed, and which inside out."""
    face, edge, direction = _edges(corners)
    along = np.flatnonzero(edge[1:] == edge[:-1])
    labels = components(np.stack([face[along], face[along + 1]], axis=1), len(corners))
    first, part = np.unique(labels, return_index=True, return_inverse=True)[1:]
    is_uneven = np.bincount(edge, direction)[edge] != 0
    is_closed = np.bincount(part, np.bincount(face, is_uneven, len(corners))) == 0
    # from a point of the part: volumes of far ones are exact, too
    local = points - points[first[part], :1]
    pyramids = dot(local[:, 0], np.cross(local[:, 1], local[:, 2]))
    volume, most = np.bincount(part, pyramids), np.bincount(part, np.abs(pyramids))
    is_inverted = is_closed & (volume < -constant.NO_VOLUME * most)
    if is_inverted.any():
        outer = np.argsort(np.where(is_closed, -volume, 0))[: constant.MOST_OUTER]
        is_inverted[is_inverted] = ~_are_within(points, part, is_inverted, outer[volume[outer] > 0])
    return part, is_closed, is_inverted


def against(corners: Ints) -> Flags:
    """Return which faces, (m,), are wound against the first of their part; none in a Moebius strip. corners: (m, 3)."""
    count = len(corners)
    face, edge, direction = _edges(corners)
    around = np.bincount(edge)
    one = (np.cumsum(around) - around)[around == 2]
    here, there, odd = face[one], face[one + 1], direction[one] == direction[one + 1]
    if not odd.any():
        return np.zeros(count, dtype=bool)
    # both sides of a face are two vertices of a graph: those that belong together have one label
    links = [np.stack([2 * here + side, 2 * there + (odd ^ side)], axis=1) for side in (False, True)]
    front, back = components(np.concatenate(links), 2 * count).reshape(-1, 2).T
    return np.asarray(front > back)


def _edges(corners: Ints) -> tuple[Ints, Ints, Ints]:
    """Return face, number and direction, 1 or -1, of each side of the faces, (m, 3), sorted by the edge's number."""
    face, begin, end = np.repeat(np.arange(len(corners)), 3), corners.ravel(), np.roll(corners, -1, axis=1).ravel()
    keys = np.minimum(begin, end) * (int(corners.max()) + 1) + np.maximum(begin, end)
    order = np.flatnonzero(begin != end)
    order = order[np.argsort(keys[order], kind="stable")]
    edge = np.unique(keys[order], return_inverse=True)[1].reshape(-1)
    return face[order], edge, np.sign(end - begin)[order]


def _are_within(points: Floats, part: Ints, inner: Flags, outer: Ints) -> Flags:
    """Return which of the inner parts are in the box about an outer one, so that they may be the walls of hollows."""
    low, high = np.full((len(inner), 3), np.inf), np.full((len(inner), 3), -np.inf)
    np.minimum.at(low, part, points.min(axis=1))
    np.maximum.at(high, part, points.max(axis=1))
    lowest, highest = low[inner], high[inner]
    within = np.zeros(len(lowest), dtype=bool)
    for bottom, top in zip(low[outer], high[outer], strict=True):
        within |= ((lowest >= bottom) & (highest <= top)).all(axis=1)
    return within


def _turned(mesh: Mesh, turned: Flags) -> Mesh:
    """Return the mesh with some faces, (m,), wound the other way, and normals that point to their front."""
    if not turned.any():
        return mesh
    faces = np.where(turned[:, None], mesh.faces[:, ::-1], mesh.faces)
    if mesh.normals is None:
        return evolve(mesh, faces=faces)
    normals = mesh.normals.copy()
    if dot(normals[faces[turned]].sum(axis=1), face_normals(mesh.positions[faces[turned]])).sum() < 0:
        normals[np.unique(faces[turned])] *= -1
    return evolve(mesh, faces=faces, normals=normals)
