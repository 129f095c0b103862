"""The scene of a call, as contracts/picture.py reads it, with faces that are counted through all objects."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from picture import Array, Camera, Integers, read

Booleans = NDArray[np.bool_]


class World:
    """What the calldata of `render(Scene)` says. scene: see `picture.read`. firsts: of each object, the number of its
    first face. antialias: whether pixels have four samples. exact: whether the light of each fragment is computed by
    itself.
    """

    def __init__(self, data: bytes) -> None:
        self.scene = read(data)
        self.camera: Camera = self.scene.camera
        self.objects: list[Any] = self.scene.objects
        self.firsts = np.cumsum([0, *(len(each.faces) for each in self.objects)])[:-1]
        self.antialias, self.exact = len(self.scene.samples) > 1, bool(self.scene.has_effects)

    def object_of(self, face: Integers) -> Integers:
        """Return the numbers of the objects of faces."""
        return np.searchsorted(self.firsts, face, side="right") - 1

    def are(self, holds: Callable[[Any], bool]) -> Booleans:
        """Return for which objects something holds."""
        return np.array([holds(each) for each in self.objects], bool)


def divisor(camera: Camera, seen: Array) -> Array:
    """Return by what a projection divides points in the space of the camera."""
    return np.asarray(seen[..., 2] if camera.is_perspective else np.ones(seen.shape[:-1]))


def unproject(camera: Camera, places: Array, distance: Array) -> Array:
    """Return the points of the world (n, 3) that are seen at places (n, 2) in pixels, at distances (n, 1)."""
    beside = (places - camera.center) / camera.focal * (distance if camera.is_perspective else 1)
    return np.asarray(camera.eye + np.concatenate([beside, distance], axis=1) @ camera.axes)
