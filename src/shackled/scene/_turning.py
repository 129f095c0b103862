"""Rotation of scenes about their centre."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from attrs import evolve
from numpy.typing import ArrayLike

from ..base.checks import Floats, whole
from ._arithmetic import dot, length, multiply, rotate, rotation_of
from ._camera import Camera
from ._scene import Scene

MOST_FRAMES = 720
#: The share of the half width and half height of the picture that may be filled.
FILLED = 0.92


def turn(scene: Scene, rotation: ArrayLike) -> Scene:
    """Return the scene with all objects turned together about their middle; camera and lights stay.

    rotation: degrees about x, then y, then z; a quaternion (x, y, z, w); or a (3, 3) matrix.
    The meshes do not change: the contract applies the rotations of the objects.
    """
    by, center = rotation_of(rotation), middle(scene)
    places = [(center + rotate(by, o.position - center), multiply(by, o.rotation)) for o in scene.objects]
    pairs = zip(scene.objects, places, strict=True)
    return evolve(scene, objects=[evolve(o, position=position, rotation=own) for o, (position, own) in pairs])


def full_turn(scene: Scene, frames: int) -> list[Scene]:
    """Return the scene in equal steps of a full turn about the vertical axis, counter-clockwise as seen from above.

    Background, lights and camera stand still. If a scene that is completely in the picture would leave it, the camera
    is moved back for all frames.
    """
    count = frame_count(frames, "a turntable")
    turned = [scene, *(turn(scene, (0, 360 * step / count, 0)) for step in range(1, count))]
    camera = _holding(scene.camera, [each.world_positions() for each in turned], scene.width / scene.height)
    return [evolve(each, camera=camera) for each in turned]


def frame_count(frames: float, whose: str) -> int:
    """Return the number of frames of something, 2..720. InputError if it is none."""
    return whole(frames, f"the number of frames of {whose}", 2, MOST_FRAMES)


def middle(scene: Scene) -> Floats:
    """Return the middle of the box around all objects."""
    return np.asarray(scene.bounds.mean(axis=0))


def _holding(camera: Camera, turned: Sequence[Floats], aspect: float) -> Camera:
    """Return the camera, so far back that all points are in the picture, with a margin unless the first have none."""
    forward = camera.target - camera.eye
    right = np.cross(forward, camera.up)
    if not len(turned[0]) or not forward.any() or not right.any():
        return camera
    forward = forward / length(forward)
    right = right / length(right)
    axes = right / aspect, np.cross(right, forward), forward
    perspective = camera.projection == "perspective"

    def reach(points: Floats) -> tuple[Floats, Floats]:
        """Return how far points are beside the line of sight, in halves of the picture at distance 1, and how deep."""
        x, y, z = (dot(points - camera.eye, axis) for axis in axes)
        return np.maximum(np.abs(x), np.abs(y)) / camera.half_height, z if perspective else np.ones_like(z)

    beside, distance = reach(turned[0])
    if (distance <= 0).any() or (beside > distance).any():
        return camera  # not wholly in the picture as it is
    share = max(float((beside / distance).max()), FILLED)
    if not perspective:
        most = max(float(reach(points)[0].max()) for points in turned)
        return evolve(camera, half_height=camera.half_height * max(1.0, most / share))
    back = max(float((a / share - z).max()) for a, z in map(reach, turned))
    if back <= 1e-9 * float(distance.max()):
        return camera
    return evolve(camera, eye=camera.eye - back * forward)
