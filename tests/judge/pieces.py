"""The triangles of a scene on the canvas: cut at the near plane, their corners on a grid of 1/256 pixel.

An edge of an antialiased wireframe is a rectangle, one pixel wide, as two triangles.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np

from picture import SUBPIXELS, Array, Integers, clipped

from .world import Booleans, World, divisor

#: Triangles of less height, in pixels, can be turned round by rounding.
TURNABLE = 0.01
#: Pixels by which the corners of the rectangle of a wire may be rounded.
ROUNDED = 0.02


@dataclass(frozen=True)
class Pieces:
    """Triangles, front or back, with their corners counter-clockwise as they are seen.

    face: (n,) counted through all objects. corners: (n, 3, 2) columns and rows in sub-pixels. nearness: (n, 3), see
    `picture.Camera`. divisor: (n, 3) of the projection. weights: (n, 3, 3) of the corners of the face, for each corner.
    front: (n,) whether it is turned to the eye. doubtful: (n,) whether it may be culled, or not. height: (n,) the
    least, in pixels. is_cut: (n,) whether the near plane cuts its face. is_wire: (n,). slack: (n, 3) how far inside of
    the edges across from the corners a place must be to be covered for sure, in sub-pixels.
    """

    face: Integers
    corners: Array
    nearness: Array
    divisor: Array
    weights: Array
    front: Booleans
    doubtful: Booleans
    height: Array
    is_cut: Booleans
    is_wire: Booleans
    slack: Array

    def __getitem__(self, chosen: Integers | Booleans) -> Pieces:
        return Pieces(*(getattr(self, each.name)[chosen] for each in fields(self)))

    def weights_at(self, numbers: Integers, places: Array, inside: Booleans) -> Array:
        """Weights (n, 3) of the corners of the faces of some pieces at places (n, 2) in pixels, right in perspective.

        inside: where the nearest point of the piece is meant if the place is not in it.
        """
        corners = self.corners[numbers]
        x, y = (corners - SUBPIXELS * places[:, None]).transpose(2, 0, 1)
        edges = np.roll(x, -1, 1) * np.roll(y, 1, 1) - np.roll(x, 1, 1) * np.roll(y, -1, 1)
        edges /= -self.area(numbers)[:, None]
        edges = np.where(inside[:, None], np.clip(edges, 0, None), edges)
        correct = edges / edges.sum(axis=1, keepdims=True) / self.divisor[numbers]
        # far outside of a sliver a place can be behind the eye
        total = np.maximum(correct.sum(axis=1), 1e-3 / self.divisor[numbers].max(axis=1))
        return np.asarray(np.einsum("ni,nij->nj", correct / total[:, None], self.weights[numbers]))

    def area(self, numbers: Integers | slice = slice(None)) -> Array:
        """Twice the areas (n,) of some pieces, in square sub-pixels."""
        return area(self.corners[numbers])


def area(corners: Array) -> Array:
    """Twice the area, positive if corners are counter-clockwise as they are seen; rows run down."""
    x, y = (corners - corners[..., :1, :]).transpose(2, 0, 1)
    return np.asarray(x[:, 2] * y[:, 1] - x[:, 1] * y[:, 2])


def pieces_of(world: World, number: int) -> Pieces:
    """Return what of an object may be seen."""
    solid = world.objects[number]
    corners = world.camera.seen(solid.points)[solid.faces]
    beyond = corners[..., 2] - world.camera.near
    cut = np.asarray((beyond < 0).any(axis=1))
    faces, weights = [np.flatnonzero(~cut)], [np.broadcast_to(np.eye(3), ((~cut).sum(), 3, 3))]
    for face in np.flatnonzero(cut & (beyond >= 0).any(axis=1)):
        for part in clipped(beyond[face]):
            faces.append(np.array([face]))
            weights.append(part[None])
    made = _made(world, number, corners, np.concatenate(faces), np.concatenate(weights), cut)
    return _wires(made, world.antialias) if solid.is_wire else made


def _made(world: World, number: int, corners: Array, face: Integers, weights: Array, cut: Booleans) -> Pieces:
    solid, camera, points = world.objects[number], world.camera, weights @ corners[face]
    on_screen = SUBPIXELS * camera.project(points)
    areas = area(on_screen)
    front = areas > 0
    height = np.abs(areas) / np.maximum(np.linalg.norm(np.roll(on_screen, 1, 1) - on_screen, axis=2).max(1), 1)
    height /= SUBPIXELS
    doubtful = solid.culls & (height < TURNABLE)
    kept = (areas != 0) & (front | doubtful | (not solid.culls))
    back = ~front[:, None] & np.array([False, True, True])
    order = np.where(back, [0, 2, 1], [0, 1, 2])[:, :, None]
    return Pieces(
        world.firsts[number] + face,
        np.take_along_axis(on_screen, order, 1),
        np.take_along_axis(camera.nearness(points), order[..., 0], 1),
        np.take_along_axis(divisor(camera, points), order[..., 0], 1),
        np.take_along_axis(weights, order, 1),
        front,
        doubtful,
        height,
        cut[face],
        np.full(len(face), solid.is_wire),
        np.where(doubtful[:, None], np.inf, np.zeros(3)),
    )[kept]


def _wires(made: Pieces, antialias: bool) -> Pieces:
    """The edges of faces, from p to q, without those of the cut: rectangles, or triangles that begin with p, q."""
    found = []
    for i in range(3):
        j = (i + 1) % 3
        # along an edge of the face, the weight of one of its corners is zero
        way = made.corners[:, j] - made.corners[:, i]
        length = np.linalg.norm(way, axis=1, keepdims=True)
        is_edge = ((made.weights[:, i] == 0) & (made.weights[:, j] == 0)).any(axis=1) & (length[:, 0] > 0)
        edges, length = made[is_edge], length[is_edge]
        aside = way[is_edge][:, ::-1] * [-1, 1] / length * SUBPIXELS / 2
        p, q = edges.corners[:, i], edges.corners[:, j]
        # the triangles of a rectangle share an edge; the others can be rounded otherwise than those of other wires
        parts = (
            ((i, j, j), (p - aside, q + aside, q - aside), (1, 1, 0)),
            ((i, i, j), (p - aside, p + aside, q + aside), (1, 0, 1)),
        )
        for ends, corners, own in parts if antialias else (((i, j, j), (p, q, q + aside), (0, 0, 0)),):
            changes = {
                "corners": np.stack(corners, axis=1),
                "nearness": edges.nearness[:, ends],
                "divisor": edges.divisor[:, ends],
                "weights": edges.weights[:, ends],
                "height": np.minimum(1.0, length[:, 0] / SUBPIXELS),
                "slack": np.maximum(edges.slack, ROUNDED * SUBPIXELS * np.array(own)),
            }
            found.append(replace(edges, **changes))
    return joined(found)


def joined(parts: list[Pieces]) -> Pieces:
    """Put pieces together."""
    return Pieces(*(np.concatenate([getattr(part, each.name) for part in parts]) for each in fields(Pieces)))
