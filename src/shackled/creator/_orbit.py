"""Changes of a camera or a light by dragging, the wheel and touch.

Distances on the picture are parts of its height, x to the right and y down.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from ._controls import around, tidy, within
from ._scene import Facts, angles, axes, direction
from ._state import Lamp, Orbit, Pose, State, Vector

#: Degrees of a drag over the whole height.
TURN = 180.0
#: Factor of the distance for one notch of the wheel.
NOTCH = 1.1
#: Free border around a fitted object, as a fraction of half the picture.
MARGIN = 0.06


def drag(camera: Orbit, dx: float, dy: float) -> Orbit:
    """Turn the camera about its target so that the object follows the pointer."""
    turned = math.radians(camera.roll)
    dx, dy = dx * math.cos(turned) + dy * math.sin(turned), dy * math.cos(turned) - dx * math.sin(turned)
    elevation = within("camera.elevation", camera.elevation + TURN * dy)
    return replace(camera, azimuth=tidy(around(camera.azimuth - TURN * dx)), elevation=elevation)


def zoom(camera: Orbit, notches: float) -> Orbit:
    """Move the camera nearer by a number of notches of the wheel, or away where it is negative."""
    # more notches would overflow
    distance = camera.distance * NOTCH ** -min(max(notches, -200.0), 200.0)
    return replace(camera, distance=within("camera.distance", distance))


def pan(camera: Orbit, dx: float, dy: float) -> Orbit:
    """Move the target of the camera so that the object follows the pointer."""
    right, up, _ = axes(camera.azimuth, camera.elevation, camera.roll)
    height = 2 * camera.distance * math.tan(math.radians(camera.fov) / 2)
    return replace(camera, target=_target(camera.target + height * (dy * up - dx * right)))


def moved(camera: Orbit, azimuth: float, elevation: float, distance: float, target: Vector) -> Orbit:
    """Return the camera at another place, within the ranges of the controls."""
    return replace(
        camera,
        azimuth=tidy(around(azimuth)),
        elevation=within("camera.elevation", elevation),
        distance=within("camera.distance", distance),
        target=_target(np.asarray(target)),
    )


def fit(camera: Orbit, pose: Pose | None = None, aspect: float = 1.0) -> Orbit:
    """Move the camera so that the bounding sphere of the object just fills the picture; keep its direction.

    aspect: width over height of the picture.
    """
    pose = pose or Pose()
    half = math.radians(camera.fov) / 2
    if aspect < 1:
        half = math.atan(math.tan(half) * aspect)
    needed = 1 / math.sin(half) if camera.projection == "perspective" else 1 / math.tan(half)
    distance = within("camera.distance", pose.scale * needed * (1 + MARGIN))
    return replace(camera, target=_target(np.asarray(pose.position)), distance=distance)


def front(facts: Facts) -> Orbit:
    """Return the camera of the source."""
    camera = facts.defaults.camera
    assert camera is not None
    return camera


# ---- lights on a sphere ----


def lamp_camera(state: State, facts: Facts) -> Orbit:
    """Return the camera by which lights are placed: the source's own one if the lights follow the camera."""
    camera = None if state.lights_follow else state.camera
    return front(facts) if camera is None else camera


def lamp_on_disc(lamp: Lamp, camera: Orbit) -> tuple[float, float, bool]:
    """Return the place of a light on a sphere that the viewer sees as a disc of radius 1.

    That is x to the right, y down, and whether it is on the near side.
    """
    x, y, z = (axes(camera.azimuth, camera.elevation, camera.roll) @ direction(lamp.azimuth, lamp.elevation)).tolist()
    return x, -y, z >= 0


def lamp_from_disc(lamp: Lamp, camera: Orbit, x: float, y: float) -> Lamp:
    """Return the light at a place of that disc.

    A place beyond the rim is on the far side of the sphere; at two radii and more the light is right behind it.
    """
    length = math.hypot(x, y)
    near, radius = length <= 1, length if length <= 1 else max(2 - length, 0.0)
    if length:
        x, y = x * radius / length, y * radius / length
    depth = math.sqrt(max(0.0, 1 - radius * radius))
    toward = np.array([x, -y, depth if near else -depth]) @ axes(camera.azimuth, camera.elevation, camera.roll)
    azimuth, elevation = angles(toward)
    return replace(lamp, azimuth=tidy(azimuth), elevation=tidy(elevation))


def _target(place: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> Vector:
    x, y, z = (within("camera.target.x", value) for value in place.tolist())
    return x, y, z
