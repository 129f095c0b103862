"""From a state and the scene of its source to the scene that is rendered, and back: cameras and lights of a scene in
radii, relative to the middle of the source.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from attrs import evolve
from numpy.typing import ArrayLike

from ..checks import Color, Floats
from ..scene import (
    Background,
    Camera,
    Fog,
    Hemisphere,
    Light,
    Object,
    Rim,
    Scene,
    Tone,
    from_euler,
    half_height_of,
    is_closed,
    multiply,
    painted_object,
    rotate,
    shaded,
    simplify_scene,
)
from ._controls import tidy, within
from ._state import Backdrop, Curve, Haze, Lamp, Orbit, Outline, Pose, Size, Sky, Source, State, Surface, Vector

#: The fields that a surface has in common with a material.
MATERIAL = ("shading", "ambient", "diffuse", "specular", "shininess", "emission")
#: The fields of a state that are those of every object.
OBJECT = ("cull", "wireframe")
#: The flags of a state that are those of the scene.
FLAGS = ("invert", "antialias")
#: The parts of a state that are effects of the scene.
EFFECTS = ("hemisphere", "rim", "fog", "tone")


@dataclass(frozen=True)
class Bounds:
    """The bounding sphere of a source: middle of its bounding box, and radius of the sphere about it."""

    middle: Vector
    radius: float

    def inside(self, place: ArrayLike) -> Floats:
        """Return a position of the world in radii from the middle."""
        return (np.asarray(place, dtype=np.float64) - self.middle) / self.radius

    def outside(self, place: ArrayLike) -> Floats:
        """Return the position in the world of a position in radii from the middle."""
        return np.asarray(self.middle) + np.asarray(place, dtype=np.float64) * self.radius


@dataclass(frozen=True)
class Facts:
    """The facts about a source, small enough to be passed between processes.

    title: any characters; it must be escaped where it is shown. notice: attribution and conditions of use, or "".
    licence: of the model as stated by its source, or "" if unknown. triangles, vertices, objects: their numbers.
    closed: whether back faces can be culled. defaults: a state with all values of the source; its own colours and all
    triangles stay None. mixed: paths of controls in which the objects differ.
    """

    source: Source
    title: str
    notice: str
    triangles: int
    vertices: int
    objects: int
    bounds: Bounds
    closed: bool
    defaults: State
    mixed: frozenset[str] = frozenset()
    licence: str = ""


def describe(source: Source, scene: Scene, title: str, notice: str = "", licence: str = "") -> Facts:
    """Return the facts of a source. scene: of the source."""
    bounds = bounds_of(scene)
    objects = scene.objects
    first = objects[0] if objects else None
    mixed = {f"surface.{name}" for name in MATERIAL if len({getattr(o.material, name) for o in objects}) > 1}
    mixed |= {name for name in OBJECT if len({getattr(o, name) for o in objects}) > 1}
    if len({o.opacity for o in objects}) > 1:
        mixed.add("surface.opacity")
    own: dict[str, Any] = {}
    if first:
        own = {name: getattr(first.material, name) for name in MATERIAL}
        own |= {"emission": _hex(first.material.emission), "opacity": first.opacity}
    flags: dict[str, Any] = {name: getattr(first, name) if first else False for name in OBJECT}
    defaults = State(
        source,
        camera=orbit_of(scene.camera, bounds),
        lights=tuple(lamp_of(light, bounds) for light in scene.lights),
        ambient_light=_hex(scene.ambient_light),
        **_effects_of(scene, bounds),
        surface=Surface(**own),
        background=Backdrop(_hex(scene.background.top), _hex(scene.background.bottom)),
        invert=scene.invert,
        antialias=scene.antialias,
        size=Size(scene.width, scene.height),
        **flags,
    )
    return Facts(
        source=source,
        title=title,
        notice=notice,
        triangles=sum(o.mesh.triangles for o in objects),
        vertices=sum(len(o.mesh.positions) for o in objects),
        objects=len(objects),
        bounds=bounds,
        closed=all(is_closed(o.mesh) for o in objects),
        defaults=defaults,
        mixed=frozenset(mixed),
        licence=licence,
    )


def filled(state: State, facts: Facts) -> State:
    """Return the state with the values of the source in place of each None."""
    changes: dict[str, Any] = {}
    for name in ("camera", "lights", "ambient_light", *EFFECTS, "background", *OBJECT, *FLAGS, "size"):
        if getattr(state, name) is None:
            changes[name] = getattr(facts.defaults, name)
    own = facts.defaults.surface
    missing = {name: getattr(own, name) for name in (*MATERIAL, "opacity") if getattr(state.surface, name) is None}
    return replace(state, surface=replace(state.surface, **missing), **changes)


def to_scene(state: State, scene: Scene, bounds: Bounds | None = None) -> Scene:
    """Return the scene that is rendered; an untouched state leaves the scene as it is.

    scene: of the state's source. bounds: of the scene, if they are known.
    """
    bounds = bounds or bounds_of(scene)
    if state.max_triangles is not None:
        scene = simplify_scene(scene, state.max_triangles)
    return arranged(state, scene, bounds)


def arranged(state: State, scene: Scene, bounds: Bounds) -> Scene:
    """Do the same as `to_scene` for a scene whose meshes have been simplified already."""
    camera = scene.camera
    if state.camera is not None:
        near = camera.near if camera.projection == state.camera.projection else None
        camera = camera_of(state.camera, bounds, near)
    changes: dict[str, Any] = {
        "objects": [_object(o, state, bounds, number) for number, o in enumerate(scene.objects)],
        "camera": camera,
        "lights": _lights(state.lights, scene, bounds),
    }
    if state.lights_follow and state.camera is not None:
        changes["lights"] = [carried(light, scene.camera, camera, bounds) for light in changes["lights"]]
    if state.ambient_light is not None:
        changes["ambient_light"] = state.ambient_light
    changes |= _effects(state, bounds)
    if state.background is not None:
        changes["background"] = Background(state.background.top, state.background.bottom)
    changes |= {name: value for name in FLAGS if (value := getattr(state, name)) is not None}
    if state.size is not None:
        changes |= {"width": state.size.width, "height": state.size.height}
    return evolve(scene, **changes)


def _effects_of(scene: Scene, bounds: Bounds) -> dict[str, Any]:
    """Return the effects of a scene as parts of a state; those that it does not have suit it, but are not on."""
    back = camera_axes(scene.camera)[2]
    depth = max(float((scene.camera.eye - bounds.middle) @ back) / bounds.radius, 1.0)
    parts: dict[str, Any] = {
        "hemisphere": Sky(),
        "rim": Outline(),
        "fog": Haze(False, _hex(scene.background.bottom), _distance(depth - 1), _distance(depth + 1)),
        "tone": Curve(),
    }
    hemisphere, rim, fog, tone = scene.hemisphere, scene.rim, scene.fog, scene.tone
    if hemisphere is not None:
        parts["hemisphere"] = Sky(True, _hex(hemisphere.sky), _hex(hemisphere.ground))
    if rim is not None:
        parts["rim"] = Outline(True, _hex(rim.color), rim.power)
    if fog is not None:
        near, far = (_distance(each / bounds.radius) for each in (fog.near, fog.far))
        parts["fog"] = Haze(True, _hex(fog.color), near, far)
    if tone is not None:
        parts["tone"] = Curve(tidy(tone.exposure), tone.filmic, tone.gamma)
    return parts


def _distance(radii: float) -> float:
    return within("fog.near", radii)


def _effects(state: State, bounds: Bounds) -> dict[str, Any]:
    """Return the fields of a scene that the effects of a state replace."""
    fields: dict[str, Any] = {}
    if (sky := state.hemisphere) is not None:
        fields["hemisphere"] = Hemisphere(sky.sky, sky.ground) if sky.on else None
    if (rim := state.rim) is not None:
        fields["rim"] = Rim(rim.color, rim.power) if rim.on else None
    if (fog := state.fog) is not None:
        # fog that ends before it begins is a wall
        near, far = fog.near * bounds.radius, max(fog.far, fog.near + 0.01) * bounds.radius
        fields["fog"] = Fog(fog.color, near, far) if fog.on else None
    if (tone := state.tone) is not None:
        fields["tone"] = None if tone == Curve() else Tone(tone.exposure, tone.filmic, tone.gamma)
    return fields


def _lights(lamps: Sequence[Lamp] | None, scene: Scene, bounds: Bounds) -> Sequence[Light]:
    return scene.lights if lamps is None else [light_of(lamp, bounds) for lamp in lamps]


def _object(o: Object, state: State, bounds: Bounds, number: int) -> Object:
    surface = state.surface
    given = {name: value for name in MATERIAL if (value := getattr(surface, name)) is not None}
    changes: dict[str, Any] = {name: value for name in OBJECT if (value := getattr(state, name)) is not None}
    if surface.color is not None:
        o = painted_object(o, surface.color)
    shading = given.pop("shading", o.material.shading)
    if given:
        changes["material"] = evolve(o.material, **given)
    opacity = state.opacities[number] if number < len(state.opacities) else None
    opacity = surface.opacity if opacity is None else opacity
    if opacity is not None:
        changes["opacity"] = opacity
    if state.pose != Pose():
        changes |= _posed(o, state.pose, bounds)
    o = evolve(o, **changes) if changes else o
    return o if shading == o.material.shading else shaded(o, shading)


def _posed(o: Object, pose: Pose, bounds: Bounds) -> dict[str, Any]:
    rotation = from_euler(pose.rotation)
    from_middle = o.position - bounds.middle
    return {
        "position": bounds.outside(pose.position) + pose.scale * rotate(rotation, from_middle),
        "rotation": multiply(rotation, o.rotation),
        "scale": pose.scale * o.scale,
    }


def _hex(color: Color) -> str:
    red, green, blue = color
    return f"#{red:02x}{green:02x}{blue:02x}"


def bounds_of(scene: Scene) -> Bounds:
    """Return the bounds of a scene; those of an empty one are the unit sphere about the origin."""
    points = [o.world_positions() for o in scene.objects]
    if not points:
        return Bounds((0.0, 0.0, 0.0), 1.0)
    low, high = scene.bounds
    middle = low / 2 + high / 2
    radius = max(float(np.linalg.norm(each - middle, axis=1).max()) for each in points)
    x, y, z = middle.tolist()
    return Bounds((x, y, z), radius or 1.0)


# ---- directions ----


def axes(azimuth: float, elevation: float, roll: float = 0.0) -> Floats:
    """Return (3, 3): unit vectors to the right, up and toward the viewer, for a viewer at these angles in degrees."""
    a, e, r = np.radians([azimuth, elevation, roll])
    right = np.array([np.cos(a), 0.0, -np.sin(a)])
    back = np.array([np.sin(a) * np.cos(e), np.sin(e), np.cos(a) * np.cos(e)])
    up = np.cross(back, right)
    return np.stack([np.cos(r) * right - np.sin(r) * up, np.cos(r) * up + np.sin(r) * right, back])


def camera_axes(camera: Camera) -> Floats:
    """Return (3, 3): unit vectors to the right, up and toward the viewer of a camera."""
    back = _unit(camera.eye - camera.target)
    right = _unit(np.cross(_unit(camera.up), back))
    return np.stack([right, np.cross(back, right), back])


def direction(azimuth: float, elevation: float) -> Floats:
    """Return the unit vector toward a point to the right of the front (+z) and above the horizon, in degrees."""
    return np.asarray(axes(azimuth, elevation)[2])


def angles(vector: ArrayLike) -> tuple[float, float]:
    """Return azimuth and elevation of a vector that is not zero; the azimuth of a vertical vector is 0."""
    x, y, z = _unit(np.asarray(vector, dtype=np.float64)).tolist()
    level = math.hypot(x, z)
    return math.degrees(math.atan2(x, z)) if level > 1e-9 else 0.0, math.degrees(math.atan2(y, level))


# ---- cameras ----


def orbit_of(camera: Camera, bounds: Bounds) -> Orbit:
    """Return a camera as an orbit about the point of its line of sight that is as deep as the middle.

    Values beyond the ranges of the controls are clamped.
    """
    own = camera_axes(camera)
    eye, back = camera.eye, own[2]
    depth = float((eye - np.asarray(bounds.middle)) @ back)
    if depth < 0.01 * bounds.radius:
        depth = float(np.linalg.norm(eye - camera.target))
    azimuth, elevation = angles(back)
    right, up, _ = axes(azimuth, elevation)
    slope = camera.half_height if camera.projection == "perspective" else camera.half_height / depth
    return Orbit(
        _place(bounds.inside(eye - depth * back), "camera.target"),
        within("camera.distance", depth / bounds.radius),
        tidy(azimuth),
        tidy(elevation),
        tidy(math.degrees(math.atan2(own[1] @ right, own[1] @ up))),
        camera.projection,
        within("camera.fov", math.degrees(2 * math.atan(slope))),
    )


def camera_of(orbit: Orbit, bounds: Bounds, near: float | None = None) -> Camera:
    """Return the camera in the world. near: distance of its near plane, None for the default."""
    _, up, back = axes(orbit.azimuth, orbit.elevation, orbit.roll)
    target = bounds.outside(orbit.target)
    distance = orbit.distance * bounds.radius
    half_height = half_height_of(orbit.fov)
    if orbit.projection == "orthographic":
        half_height *= distance
    return Camera(target + distance * back, target, up, orbit.projection, half_height, near)


# ---- lights ----


def lamp_of(light: Light, bounds: Bounds) -> Lamp:
    """Return a light relative to the middle."""
    color = _hex(light.color)
    if light.kind == "directional":
        azimuth, elevation = angles(light.vector)
        return Lamp("directional", tidy(azimuth), tidy(elevation), color=color)
    place = bounds.inside(light.vector)
    distance = float(np.linalg.norm(place))
    azimuth, elevation = angles(place) if distance else (0.0, 0.0)
    lamp = Lamp(light.kind, tidy(azimuth), tidy(elevation), within("lights.0.distance", distance), color)
    if light.direction is None:
        return lamp
    # the point of its axis nearest to the middle, or one before it where the light points away
    toward = _unit(light.direction)
    ahead = float(-place @ toward)
    return replace(
        lamp,
        target=_place(place + (ahead if ahead > 0 else 1.0) * toward, "lights.0.target"),
        inner_angle=light.inner_angle,
        outer_angle=light.outer_angle,
    )


def light_of(lamp: Lamp, bounds: Bounds) -> Light:
    """Return the light in the world."""
    toward = direction(lamp.azimuth, lamp.elevation)
    if lamp.kind == "directional":
        return Light.directional(toward, lamp.color)
    place = lamp.distance * toward
    if lamp.kind == "point":
        return Light.point(bounds.outside(place), lamp.color)
    # a light that stands at its target points at the middle
    beam = lamp.target - place
    beam = beam if np.abs(beam).max() > 1e-9 else -toward
    inner = min(lamp.inner_angle, lamp.outer_angle)
    return Light.spot(bounds.outside(place), beam, lamp.color, inner, lamp.outer_angle)


def carried(light: Light, before: Camera, after: Camera, bounds: Bounds) -> Light:
    """Return a light that was moved with the viewer about the middle, from one camera to another."""
    turn = camera_axes(after).T @ camera_axes(before)
    if light.kind == "directional":
        return evolve(light, vector=turn @ light.vector)
    moved = evolve(light, vector=bounds.outside(turn @ bounds.inside(light.vector)))
    return moved if light.direction is None else evolve(moved, direction=turn @ light.direction)


def _place(place: Floats, path: str) -> Vector:
    """Return a position in radii, within the range of a control."""
    x, y, z = (within(f"{path}.x", value) for value in place.tolist())
    return x, y, z


def _unit(vector: Floats) -> Floats:
    largest = np.abs(vector).max()
    vector = vector / largest if largest else vector
    return np.asarray(vector / (np.linalg.norm(vector) or 1.0))
