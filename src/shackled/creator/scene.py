"""From a state and the scene of its source to the scene that is drawn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from attrs import evolve

from ..checks import Color
from ..scene import Background, Light, Object, Scene, from_euler, is_closed, multiply, painted, rotate, simplify_scene
from .state import Backdrop, Lamp, Pose, Size, Source, State, Surface
from .view import Bounds, bounds_of, camera_of, carried, lamp_of, light_of, orbit_of

#: The coefficients that a surface has in common with a material.
MATERIAL = ("shading", "ambient", "diffuse", "specular", "shininess")


@dataclass(frozen=True)
class Facts:
    """What is known of a source, small enough to be handed around.

    title: for people, of any characters; it must be escaped where it is shown. notice: whom to name and what is not
    allowed, or "". licence: of the model, as its source states it, or "" where nobody does. triangles, vertices,
    objects: how many. bounds: where it stands and how large it is. closed: whether its back faces can be left out.
    defaults: the state in which all is said that the source says; colours of its own and all triangles stay None.
    mixed: the paths of what its objects do not have in common.
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
    """The facts of a source that makes this scene."""
    bounds = bounds_of(scene)
    objects = scene.objects
    first = objects[0] if objects else None
    mixed = {f"surface.{name}" for name in MATERIAL if len({getattr(o.material, name) for o in objects}) > 1}
    mixed |= {name for name in ("cull", "wireframe") if len({getattr(o, name) for o in objects}) > 1}
    own = {name: getattr(first.material, name) for name in MATERIAL} if first else {}
    defaults = State(
        source,
        camera=orbit_of(scene.camera, bounds),
        lights=tuple(lamp_of(light, bounds) for light in scene.lights),
        ambient_light=_hex(scene.ambient_light),
        surface=Surface(**own),
        background=Backdrop(_hex(scene.background.top), _hex(scene.background.bottom)),
        cull=first.cull if first else False,
        wireframe=first.wireframe if first else False,
        invert=scene.invert,
        size=Size(scene.width, scene.height),
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
    """The state with what the source says in place of each None."""
    changes: dict[str, Any] = {}
    for name in ("camera", "lights", "ambient_light", "background", "cull", "wireframe", "invert", "size"):
        if getattr(state, name) is None:
            changes[name] = getattr(facts.defaults, name)
    own = facts.defaults.surface
    missing = {name: getattr(own, name) for name in MATERIAL if getattr(state.surface, name) is None}
    return replace(state, surface=replace(state.surface, **missing), **changes)


def to_scene(state: State, scene: Scene, bounds: Bounds | None = None) -> Scene:
    """What is drawn, of the scene of the state's source. `bounds`: those of the scene, if they are known.

    A state that nobody has touched leaves the scene as it is.
    """
    bounds = bounds or bounds_of(scene)
    if state.max_triangles is not None:
        scene = simplify_scene(scene, state.max_triangles)
    return arranged(state, scene, bounds)


def arranged(state: State, scene: Scene, bounds: Bounds) -> Scene:
    """`to_scene` of a scene whose meshes are simplified already."""
    camera = scene.camera
    if state.camera is not None:
        near = camera.near if camera.projection == state.camera.projection else None
        camera = camera_of(state.camera, bounds, near)
    changes: dict[str, Any] = {
        "objects": [_object(o, state, bounds) for o in scene.objects],
        "camera": camera,
        "lights": _lights(state.lights, scene, bounds),
    }
    if state.lights_follow and state.camera is not None:
        changes["lights"] = [carried(light, scene.camera, camera, bounds) for light in changes["lights"]]
    if state.ambient_light is not None:
        changes["ambient_light"] = state.ambient_light
    if state.background is not None:
        changes["background"] = Background(state.background.top, state.background.bottom)
    if state.invert is not None:
        changes["invert"] = state.invert
    if state.size is not None:
        changes |= {"width": state.size.width, "height": state.size.height}
    return evolve(scene, **changes)


def _lights(lamps: Sequence[Lamp] | None, scene: Scene, bounds: Bounds) -> Sequence[Light]:
    return scene.lights if lamps is None else [light_of(lamp, bounds) for lamp in lamps]


def _object(o: Object, state: State, bounds: Bounds) -> Object:
    surface = state.surface
    given = {name: value for name in MATERIAL if (value := getattr(surface, name)) is not None}
    changes: dict[str, Any] = {"material": evolve(o.material, **given)} if given else {}
    if surface.color is not None:
        changes["mesh"] = painted(o.mesh, surface.color)
    if state.cull is not None:
        changes["cull"] = state.cull
    if state.wireframe is not None:
        changes["wireframe"] = state.wireframe
    if state.pose != Pose():
        changes |= _posed(o, state.pose, bounds)
    return evolve(o, **changes) if changes else o


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
