"""Primitives of meshes: their triangles, posed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from ....base.checks import Floats, Ints
from ....errors import InputError
from ..._arithmetic import units
from ..model import Picture, tinted
from ..table import Table, about
from .document import Document, Vertices, numbers
from .draco import decompress
from .materials import Surface, colors_of, picture_on, surface_of
from .nodes import Node, morphed, skinned

_POINTS_OR_LINES, _TRIANGLES, _STRIP, _FAN = range(4), 4, 5, 6


@dataclass(frozen=True)
class Piece:
    """A primitive with triangles.

    colors: (n, 4), with alpha. normals: zeros if there are none. picture, uvs: of its texture, or None.
    matrices: (n, 4, 4), that put skinned vertices into the world. turn: (m,), when a triangle has its turn.
    """

    positions: Floats
    faces: Ints
    colors: Floats
    normals: Floats
    surface: Surface
    picture: Picture | None
    uvs: Floats
    matrices: Floats | None
    turn: Ints

    @property
    def group(self) -> tuple[object, ...]:
        """What pieces of one object have in common: the texture, light, and how they hide what is behind them."""
        surface, has_alpha = self.surface, bool((self.colors[:, 3] < 255).any())
        name = self.picture.name if self.picture else ""
        return name, surface.opacity, has_alpha, surface.emission, surface.is_unlit, surface.is_two_sided


def pieces_of(gltf: Document, node: Node, nodes: Mapping[int, Node]) -> Iterator[Piece]:
    """Return the primitives of the mesh of a node that have triangles, in its coordinates."""
    mesh = gltf.item(node.keys, "mesh", "meshes")
    weights = (node.keys if "weights" in node.keys else mesh).series("weights")
    for keys in mesh.tables("primitives"):
        where, attributes = keys.where, keys.table("attributes")
        mode = keys.whole("mode", _TRIANGLES)
        if mode in _POINTS_OR_LINES:
            gltf.leave_out("primitive", where, "{} of points or lines")
            continue
        if "POSITION" not in attributes:
            gltf.leave_out("primitive", where, "{} without positions")
            continue
        if decompress(gltf, keys):
            mode = _TRIANGLES
        positions = numbers(gltf, attributes, "POSITION", "VEC3")
        order = np.arange(len(positions))
        place, last = keys.place("indices"), len(positions) - 1
        if "indices" in keys:
            order = numbers(gltf, keys, "indices", "SCALAR")[:, 0]
            if order.dtype.kind != "u":
                raise InputError(f"{place} must be of whole numbers without a sign")
        triangles = order[_corners(gltf, keys, mode, len(order))]
        there = (triangles <= last).all(axis=1)
        if not there.all():
            gltf.leave_out("triangle", place, "{} with vertices that do not exist", int((~there).sum()))
        used, corners = np.unique(triangles[there], return_inverse=True)
        if not len(used):
            continue
        faces = corners.reshape(-1, 3)
        vertices = Vertices(gltf, attributes, used, len(positions))
        with about(where):
            surface = surface_of(gltf, keys)
            # textures and colours of vertices only lower the alpha
            if surface.cutoff is not None and surface.factor[3] < surface.cutoff:
                continue
            normals = np.zeros((len(used), 3))
            if (given := vertices.values("NORMAL", "VEC3")) is not None:
                normals = morphed(vertices, keys, weights, "NORMAL", given.astype(np.float64))
            colors = colors_of(vertices, surface, where)
            picture, uvs = picture_on(vertices, surface, where)
            points = morphed(vertices, keys, weights, "POSITION", positions[used].astype(np.float64))
            matrices = skinned(vertices, node.keys, nodes)
        if picture is not None and not picture.image.is_varied:
            colors, picture = tinted(colors, picture, uvs), None
        yield Piece(points, faces, colors, normals, surface, picture, uvs, matrices, np.zeros(len(faces), int))


def _corners(gltf: Document, primitive: Table, mode: int, count: int) -> Ints:
    """Return the triangles of a mode, (m, 3), as numbers of so many corners."""
    if mode == _TRIANGLES:
        if count % 3:
            gltf.leave_out("triangle", primitive.place("mode"), "{} without its last corners")
        return np.arange(count - count % 3).reshape(-1, 3)
    first = np.arange(max(count - 2, 0))
    if mode == _STRIP:
        return np.stack([first, first + 1 + first % 2, first + 2 - first % 2], axis=1)
    if mode == _FAN:
        return np.stack([first + 1, first + 2, np.zeros_like(first)], axis=1)
    raise InputError(f"{primitive.place('mode')} must be from 0 to 6, not {mode}")


def in_place(piece: Piece, matrices: Floats, turn: int) -> Piece:
    """Return a piece where each of some matrices, (k, 4, 4), puts it, from a turn on; or its joints, if skinned."""
    count, points = len(matrices), len(piece.positions)
    matrix = matrices[:, None] if piece.matrices is None else piece.matrices
    linear = matrix[..., :3, :3]
    rows = [linear[..., row, :] for row in range(3)]
    # the matrix of the cofactors turns normals right under any scale; its sign follows that of a mirror
    cofactors = np.stack([np.cross(rows[1], rows[2]), np.cross(rows[2], rows[0]), np.cross(rows[0], rows[1])], axis=-2)
    signs = np.where(np.linalg.det(linear) < 0, -1.0, 1.0)
    mirrored = np.broadcast_to(signs, (count, points))[:, piece.faces].sum(axis=2) < 0
    faces = np.where(mirrored[..., None], piece.faces[:, ::-1], piece.faces) + points * np.arange(count)[:, None, None]
    normals = _times(cofactors * signs[..., None, None], piece.normals, count)
    positions = _times(linear, piece.positions, count) + matrix[..., :3, 3]
    return replace(
        piece,
        positions=positions.reshape(-1, 3),
        faces=faces.reshape(-1, 3),
        colors=np.tile(piece.colors, (count, 1)),
        normals=units(normals).reshape(-1, 3),
        uvs=np.tile(piece.uvs, (count, 1)),
        turn=np.repeat(turn + np.arange(count), len(piece.faces)),
    )


def _times(matrices: Floats, vectors: Floats, count: int) -> Floats:
    """Return vectors, (n, 3), times each of (count, 1, 3, 3) matrices, or as often times their own, (n, 3, 3)."""
    if matrices.ndim == 4:
        return np.asarray(vectors @ matrices[:, 0].transpose(0, 2, 1))
    return np.tile(np.einsum("nij,nj->ni", matrices, vectors), (count, 1, 1))
