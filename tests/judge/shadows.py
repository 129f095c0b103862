"""Which points a light does not reach: docs/explain.md.

A face shades what is behind it, in the pyramid or prism of its three sides and the light. Glass, wires and grounds cast
no shadows; of culled objects only the faces that the rule of the shadow names do. A face does not shade itself, and
nothing shades wires.
"""

from __future__ import annotations

import numpy as np

from picture import ALL_FACES, TURNED_AWAY, Array, Integers, toward

from .visibility import AROUND, TOLERANCE
from .world import Booleans, World

#: Points that are looked at together, in the order of the pixels.
TILE = 64
#: A face does not shade what is in its plane. Whether a point is before or behind it is not sure if its distance is a
#: smaller part of the extent of the scene.
IN_PLANE, NEAR_PLANE = 2.0**-42, 2.0**-24


class Shadows:
    """The shadows of a world.

    planes: (n, 4, 4) of each face that casts one, positive in the shadow. faces: (n,) their numbers. backs: for each
    face of the world whether the eye is on one side of it and the light on the other.
    """

    def __init__(self, world: World) -> None:
        lamp = world.scene.shadow_light
        planes, numbers, backs = [np.empty((0, 4, 4))], [np.empty(0, np.int64)], [np.empty(0, bool)]
        for first, solid in zip(world.firsts, world.objects, strict=True):
            corners = solid.points[solid.faces]
            begin = corners[:, 0]
            normal = np.cross(corners[:, 1] - begin, corners[:, 2] - begin)
            side = (normal * toward(lamp, begin)).sum(axis=1)
            backs.append(side * (normal * world.camera.toward(begin)).sum(axis=1) <= 0)
            if solid.is_wire or not solid.is_opaque:
                continue
            casts = side != 0
            if solid.culls and lamp.shadow != ALL_FACES:
                casts = side < 0 if lamp.shadow == TURNED_AWAY else side > 0
            corners, normal, side = corners[casts], normal[casts], side[casts]
            sides = np.cross(toward(lamp, corners), np.roll(corners, -1, 1) - corners)
            # inward, if the corners are counter-clockwise as the light sees them
            normals = np.concatenate([sides, -normal[:, None]], axis=1) * np.sign(side)[:, None, None]
            normals /= np.maximum(np.linalg.norm(normals, axis=2, keepdims=True), 1e-300)
            through = np.concatenate([corners, corners[:, :1]], axis=1)
            planes.append(np.concatenate([normals, -(normals * through).sum(axis=2, keepdims=True)], axis=2))
            numbers.append(first + np.flatnonzero(casts))
        self.planes, self.faces = np.concatenate(planes), np.concatenate(numbers)
        self.sizes = np.abs(self.planes[..., :3].reshape(-1, 3))
        self.backs = np.concatenate(backs)
        self.extent = max((np.abs(s.points).max(initial=0) for s in world.objects), default=1.0)

    def on(self, points: Array, across: Array, down: Array, face: Integers) -> tuple[Booleans, Booleans]:
        """Whether points (n, 3) may be lit, and whether they may be dark.

        across, down: how they change by TOLERANCE pixels to the right and down. face: the faces on which they are.
        """
        may_be_lit, may_be_dark = np.ones(len(points), bool), np.zeros(len(points), bool)
        firsts = np.arange(0, len(points), TILE)
        if not len(firsts) or not len(self.planes):
            return may_be_lit, may_be_dark
        reach = np.abs(across) + np.abs(down)
        low, high = np.minimum.reduceat(points - reach, firsts), np.maximum.reduceat(points + reach, firsts)
        normals, constant = self.planes[..., :3].reshape(-1, 3), self.planes[..., 3].ravel()
        for first, middle, half in zip(firsts, (low + high) / 2, (high - low) / 2, strict=True):
            most = normals @ middle + constant + self.sizes @ half
            near = np.flatnonzero((most.reshape(-1, 4) > -NEAR_PLANE * self.extent).all(axis=1))
            if len(near):
                part = slice(first, first + TILE)
                lit, dark = self._tile(points[part], across[part], down[part], face[part], near)
                may_be_lit[part], may_be_dark[part] = lit, dark
        return may_be_lit, may_be_dark

    def _tile(
        self, points: Array, across: Array, down: Array, face: Integers, near: Integers
    ) -> tuple[Booleans, Booleans]:
        normals, constant = self.planes[near, :, :3], self.planes[near, :, 3]
        value = (points @ normals.reshape(-1, 3).T + constant.ravel()).reshape(len(points), -1, 4)
        least = -(np.abs(across) + np.abs(down)).sum(axis=1).max() - NEAR_PLANE * self.extent
        close = (value > least).all(axis=2).any(axis=0)
        near, value, flat = near[close], value[:, close], normals[close].reshape(-1, 3)
        change = np.hypot(across @ flat.T, down @ flat.T).reshape(value.shape)
        change[..., 3] += NEAR_PLANE * self.extent
        other = (face[:, None] != self.faces[near]) & (np.abs(value[..., 3]) > IN_PLANE * self.extent)
        dark = ((value > -change).all(axis=2) & other).any(axis=1)
        unsure = np.flatnonzero(dark & ~((value > change).all(axis=2) & other).any(axis=1))
        lit = ~dark
        if len(unsure):
            steps = AROUND / TOLERANCE
            moved = across[unsure, None] * steps[:, :1] + down[unsure, None] * steps[:, 1:]
            value = value[unsure, None] + (moved @ flat.T).reshape(len(unsure), len(steps), -1, 4)
            value[..., 3] -= NEAR_PLANE * self.extent
            lit[unsure] = ~((value > 0).all(axis=3) & other[unsure, None]).any(axis=2).all(axis=1)
        return lit, dark
