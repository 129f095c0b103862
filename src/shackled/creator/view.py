"""Cameras and lights of a scene as a state has them, and back: in radii, seen from the middle of the source."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..scene import Camera, Light, Scene
from .checking import tidy
from .controls import control
from .state import Lamp, Orbit, Vector

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Bounds:
    """The box around all of a source: its middle, and the radius of the sphere about it that holds everything."""

    middle: Vector
    radius: float

    def inside(self, place: ArrayLike) -> Array:
        """A place of the world in radii from the middle."""
        return (np.asarray(place, dtype=np.float64) - self.middle) / self.radius

    def outside(self, place: ArrayLike) -> Array:
        """The place in the world."""
        return np.asarray(self.middle) + np.asarray(place, dtype=np.float64) * self.radius


def axes(azimuth: float, elevation: float, roll: float = 0.0) -> Array:
    """(3, 3): unit vectors to the right, upward, and toward the viewer, for a viewer who stands there."""
    a, e, r = np.radians([azimuth, elevation, roll])
    right = np.array([np.cos(a), 0.0, -np.sin(a)])
    back = np.array([np.sin(a) * np.cos(e), np.sin(e), np.cos(a) * np.cos(e)])
    up = np.cross(back, right)
    return np.stack([np.cos(r) * right - np.sin(r) * up, np.cos(r) * up + np.sin(r) * right, back])


def camera_axes(camera: Camera) -> Array:
    """(3, 3): the same of a camera."""
    back = _unit(camera.eye - camera.target)
    right = _unit(np.cross(_unit(camera.up), back))
    return np.stack([right, np.cross(back, right), back])


def direction(azimuth: float, elevation: float) -> Array:
    """The unit vector toward what stands to the right of the front (+z), and above the horizon, by so many degrees."""
    return np.asarray(axes(azimuth, elevation)[2])


def angles(vector: ArrayLike) -> tuple[float, float]:
    """Azimuth and elevation of a vector of any length but zero; the azimuth of what is straight above or below is 0."""
    x, y, z = _unit(np.asarray(vector, dtype=np.float64)).tolist()
    level = math.hypot(x, z)
    return math.degrees(math.atan2(x, z)) if level > 1e-9 else 0.0, math.degrees(math.atan2(y, level))


def orbit_of(camera: Camera, bounds: Bounds) -> Orbit:
    """The camera as it can be turned about what it looks at: the point of its line of sight that is as deep as the
    middle. Beyond the ranges of the controls, their nearest value.
    """
    own = camera_axes(camera)
    eye, back = camera.eye, own[2]
    depth = float((eye - np.asarray(bounds.middle)) @ back)
    if depth < 0.01 * bounds.radius:
        depth = float(np.linalg.norm(eye - camera.target))
    azimuth, elevation = angles(back)
    right, up, _ = axes(azimuth, elevation)
    slope = camera.half_height if camera.projection == "perspective" else camera.half_height / depth
    target = bounds.inside(eye - depth * back)
    x, y, z = (_within("camera.target.x", value) for value in target.tolist())
    return Orbit(
        (x, y, z),
        _within("camera.distance", depth / bounds.radius),
        tidy(azimuth),
        tidy(elevation),
        tidy(math.degrees(math.atan2(own[1] @ right, own[1] @ up))),
        camera.projection,
        _within("camera.fov", math.degrees(2 * math.atan(slope))),
    )


def camera_of(orbit: Orbit, bounds: Bounds, near: float | None = None) -> Camera:
    """The camera in the world."""
    _, up, back = axes(orbit.azimuth, orbit.elevation, orbit.roll)
    target = bounds.outside(orbit.target)
    distance = orbit.distance * bounds.radius
    half_height = math.tan(math.radians(orbit.fov) / 2)
    if orbit.projection == "orthographic":
        half_height *= distance
    return Camera(target + distance * back, target, up, orbit.projection, half_height, near)


def lamp_of(light: Light, bounds: Bounds) -> Lamp:
    """A light as it is seen from the middle."""
    color = "#{:02x}{:02x}{:02x}".format(*light.color)
    if light.kind == "directional":
        azimuth, elevation = angles(light.vector)
        return Lamp("directional", tidy(azimuth), tidy(elevation), color=color)
    place = bounds.inside(light.vector)
    distance = float(np.linalg.norm(place))
    azimuth, elevation = angles(place) if distance else (0.0, 0.0)
    return Lamp("point", tidy(azimuth), tidy(elevation), _within("lights.0.distance", distance), color)


def light_of(lamp: Lamp, bounds: Bounds) -> Light:
    """The light in the world."""
    toward = direction(lamp.azimuth, lamp.elevation)
    vector = toward if lamp.kind == "directional" else bounds.outside(lamp.distance * toward)
    return Light(lamp.kind, vector, lamp.color)


def carried(light: Light, before: Camera, after: Camera, bounds: Bounds) -> Light:
    """A light that goes with the viewer about the middle, from one camera to another."""
    turn = camera_axes(after).T @ camera_axes(before)
    if light.kind == "directional":
        return Light("directional", turn @ light.vector, light.color)
    return Light("point", bounds.outside(turn @ bounds.inside(light.vector)), light.color)


def bounds_of(scene: Scene) -> Bounds:
    """The bounds of a scene; a sphere of radius 1 about the origin where it holds nothing."""
    points = [o.world_positions() for o in scene.objects]
    if not points:
        return Bounds((0.0, 0.0, 0.0), 1.0)
    low, high = scene.bounds
    middle = low / 2 + high / 2
    radius = max(float(np.linalg.norm(each - middle, axis=1).max()) for each in points)
    x, y, z = middle.tolist()
    return Bounds((x, y, z), radius or 1.0)


def _within(path: str, value: float) -> float:
    of = control(path)
    return tidy(min(max(value, of.low), of.high))


def _unit(vector: Array) -> Array:
    largest = np.abs(vector).max()
    vector = vector / largest if largest else vector
    return np.asarray(vector / (np.linalg.norm(vector) or 1.0))
