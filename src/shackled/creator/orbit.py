"""What dragging, wheel and fingers do to a camera and to a light.

Ways on the picture are in parts of its height, x to the right and y downward, whatever the size at which it is shown.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from .checking import tidy
from .controls import control
from .scene import Facts
from .state import Lamp, Orbit, Pose, State, Vector
from .view import angles, axes, direction

#: Degrees that a drag over the whole height turns.
TURN = 180.0
#: What one notch of a wheel does to the distance.
NOTCH = 1.1
#: The part of the picture that stays free about an object that is fitted.
MARGIN = 0.06


def drag(camera: Orbit, dx: float, dy: float) -> Orbit:
    """The object follows the finger: the camera goes round it the other way."""
    turned = math.radians(camera.roll)
    dx, dy = dx * math.cos(turned) + dy * math.sin(turned), dy * math.cos(turned) - dx * math.sin(turned)
    elevation = min(max(camera.elevation + TURN * dy, -90.0), 90.0)
    return replace(camera, azimuth=tidy(around(camera.azimuth - TURN * dx)), elevation=tidy(elevation))


def zoom(camera: Orbit, notches: float) -> Orbit:
    """Nearer by so many notches of a wheel; farther where they are negative."""
    of = control("camera.distance")
    # more notches than there is way only lead to its end
    distance = camera.distance * NOTCH ** -min(max(notches, -200.0), 200.0)
    return replace(camera, distance=tidy(min(max(distance, of.low), of.high)))


def pan(camera: Orbit, dx: float, dy: float) -> Orbit:
    """What the camera looks at follows the finger."""
    right, up, _ = axes(camera.azimuth, camera.elevation, camera.roll)
    height = 2 * camera.distance * math.tan(math.radians(camera.fov) / 2)
    return replace(camera, target=_target(camera.target + height * (dy * up - dx * right)))


def fit(camera: Orbit, pose: Pose | None = None, aspect: float = 1.0) -> Orbit:
    """The same direction, so near that the sphere about the object just fills the picture.

    aspect: width over height of the picture.
    """
    pose = pose or Pose()
    half = math.radians(camera.fov) / 2
    if aspect < 1:
        half = math.atan(math.tan(half) * aspect)
    needed = 1 / math.sin(half) if camera.projection == "perspective" else 1 / math.tan(half)
    of = control("camera.distance")
    distance = min(max(pose.scale * needed * (1 + MARGIN), of.low), of.high)
    return replace(camera, target=_target(np.asarray(pose.position)), distance=tidy(distance))


def front(facts: Facts) -> Orbit:
    """The camera with which the source comes."""
    camera = facts.defaults.camera
    assert camera is not None
    return camera


def around(degrees: float) -> float:
    """An angle from -180 to 180."""
    return degrees if -180 <= degrees <= 180 else (degrees + 180) % 360 - 180


# ---- lights on a sphere ----


def lamp_camera(state: State, facts: Facts) -> Orbit:
    """The camera by which lights are placed: those that follow the camera are placed by the source's own."""
    camera = None if state.lights_follow else state.camera
    return front(facts) if camera is None else camera


def lamp_on_disc(lamp: Lamp, camera: Orbit) -> tuple[float, float, bool]:
    """Where the light stands on a sphere that the viewer sees as a disc of radius 1: x to the right, y downward, and
    whether on the near side.
    """
    x, y, z = (axes(camera.azimuth, camera.elevation, camera.roll) @ direction(lamp.azimuth, lamp.elevation)).tolist()
    return x, -y, z >= 0


def lamp_from_disc(lamp: Lamp, camera: Orbit, x: float, y: float) -> Lamp:
    """The light put at a place of that disc. Beyond the rim it goes on round the far side: at two radii, and farther
    out, it stands right behind.
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
    of = control("camera.target.x")
    x, y, z = (tidy(min(max(value, of.low), of.high)) for value in place.tolist())
    return x, y, z
