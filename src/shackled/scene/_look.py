"""Scenes with a look: what settings make of a mesh, the parts of a model, or a scene."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, Unpack

import numpy as np
from attrs import evolve, frozen

from ..base.checks import Color, Floats
from ..errors import InputError
from . import _constants as constant
from ._arithmetic import IDENTITY, dot, length, multiply, rotate
from ._camera import DEFAULT_HALF_HEIGHT, Camera, half_height_in
from ._crease import is_flat, shaded, with_normals
from ._effects import Fog, Tone
from ._fields import Projection
from ._mesh import Mesh
from ._object import Material, Object
from ._presets import preset_of
from ._scene import Scene
from ._settings import ALL, LookOptions, ScenePart, checked_look, settings_of, size_of
from ._simplify import simplify_scene
from ._staging import (
    MESH_STAGING,
    PLAIN,
    Staging,
    Viewpoint,
    contrasting,
    frame,
    is_closed,
    painted_object,
    toward_viewer,
)
from ._strays import without_strays
from ._turning import middle, turn
from ._upright import turned_up
from ._winding import wound

#: Models of more vertices have one side by default: the second records of vertices would take much memory, whose gas is
#: quadratic.
MOST_TWO_SIDED = 16384
#: Shadows are in the picture up to where the ground has faded by this part.
_FADED = 0.5
#: The radius about the origin within which a staged model is, but for its strays; a little above 1 for rounding.
_MODEL = 1 + 1e-6
_NONE = np.zeros((0, 3))


def stage(
    mesh: Mesh,
    size: int | tuple[int, int] | None = None,
    *,
    material: Material | None = None,
    **look: Unpack[LookOptions],
) -> Scene:
    """Return a plain scene of one mesh, scaled to a bounding sphere of radius 1 about the origin; it fills the picture.

    material: of the surface, before the settings of the look. look: as in `load`.
    """
    return look_at(mesh, checked_look({"size": size, **look}), evolve(PLAIN, material=material or PLAIN.material))


@frozen(eq=False)
class _Staged:
    """A scene on its way through the steps of `look_at`.

    look: its settings. is_model: whether it is staged, and shaded as its normals say. view: from where a scene that is
    staged is seen. is_framed: whether its camera stays. has_strays: whether some points are not to be seen. points: of
    the shaded scene, (n, 3), that the camera shows.
    """

    scene: Scene
    look: Mapping[str, Any]
    is_model: bool = False
    view: Viewpoint | None = None
    is_framed: bool = False
    has_strays: bool = False
    points: Floats = _NONE

    def camera(self) -> Camera:
        """Return the camera that the look asks for; it shows the shadows of the lights, too."""
        scene, look, camera = self.scene, self.look, self.scene.camera
        orthographic = look.get("orthographic", camera.projection == "orthographic")
        projection: Projection = "orthographic" if orthographic else "perspective"
        chosen = half_height_in(look, orthographic)
        view = None if self.is_framed else self.view
        if self.view is None and scene.objects and {"azimuth", "elevation", "margin"} & look.keys():
            view = view_of(look, scene.width, scene.height, orthographic)
            if not orthographic and chosen is None:
                own = camera.half_height if camera.projection == projection else DEFAULT_HALF_HEIGHT
                view = evolve(view, half_height=own)
        if view is not None:
            camera = frame(_to_be_seen(scene, self.points), view)
        camera = evolve(camera, **{name: look[name] for name in ("eye", "target", "up") if name in look})
        half_height, near = camera.half_height, camera.near
        if projection != camera.projection:
            # what the camera looks at keeps its size
            near = None
            forward = camera.target - camera.eye
            distance = float(dot(middle(scene) - camera.eye, forward) / length(forward)) if forward.any() else 0.0
            if distance > 0:
                half_height *= distance if orthographic else 1 / distance
        half_height = half_height if chosen is None else chosen
        return evolve(camera, projection=projection, half_height=half_height, near=look.get("near", near))


def look_at(
    thing: Mesh | Sequence[Object] | Scene,
    look: Mapping[str, Any],
    staging: Staging = MESH_STAGING,
    name: str = "the mesh",
    around: Floats | None = None,
) -> Scene:
    """Return the scene with a look, of `checked_look`; a mesh is staged, so that it fills the picture.

    thing: also the parts of a model, as objects in its own coordinates. name: of the model, in warnings. around:
    points, (n, 3), of a model that are to fill the picture in place of its own.
    """
    if of_file := _given(look, "file"):
        raise InputError(f"`{next(iter(of_file))}` is for what is read of one glTF file")
    if isinstance(thing, Scene):
        if not look:
            return thing
        scene = turn(thing, look["rotate"]) if "rotate" in look else thing
        placed = _Staged(resize(scene, look.get("size", (scene.width, scene.height))), look)
    else:
        placed = _place(thing, look, staging, name, around)
    scene = _frame(_light(_shade(placed))).scene
    most = look.get("max_triangles", ALL)
    return scene if most == ALL else simplify_scene(scene, most, look.get("crease"))


def _place(
    thing: Mesh | Sequence[Object], look: Mapping[str, Any], staging: Staging, name: str, around: Floats | None
) -> _Staged:
    """Return the scene of a model, which has a bounding sphere of radius 1 about the origin."""
    parts = [Object(thing, material=staging.material)] if isinstance(thing, Mesh) else list(thing)
    points = around
    if staging.by_normals and around is None:
        parts, points = without_strays(parts, name)
    has_strays = points is not None and around is None
    if staging.by_normals:
        parts = wound(parts, name, split=not {"cull", "max_triangles"} & look.keys())
    else:
        parts = [evolve(each, cull=is_closed(each.mesh)) for each in parts]
    width, height = look.get("size", (staging.side, staging.side))
    Scene([], width=width, height=height)  # refuses a wrong size before anything is divided by it
    rotation = look.get("rotate", IDENTITY)
    if "up" in look and not {"eye", "target"} & look.keys():
        # without a camera that it could tilt, it is a direction of the model
        rotation = multiply(turned_up(look["up"]), rotation)
        look = {name: value for name, value in look.items() if name != "up"}
    if points is None:
        points = np.concatenate([each.world_positions() for each in parts])
    view = view_of(look, width, height, look.get("orthographic", False), staging.view_of(rotate(rotation, points)))
    scene = _in_unit_sphere(parts, points, rotation, view, staging, width, height)
    return _Staged(scene, look, staging.by_normals, view, around is not None, has_strays)


def _shade(placed: _Staged) -> _Staged:
    """Return the scene with surfaces, tone and background as the look says, or as they suit the model."""
    scene, look = placed.scene, placed.look
    objects = [_object(*(_shading(each, look) if placed.is_model else (each, look))) for each in scene.objects]
    if placed.is_model and "two_sided" not in look:
        is_small = sum(len(each.mesh.positions) for each in objects if not each.cull) <= MOST_TWO_SIDED
        objects = [evolve(each, two_sided=not each.cull and (each.two_sided or is_small)) for each in objects]
    tone = scene.tone
    if of_tone := _given(look, "tone"):
        changed = evolve(tone or Tone(), **of_tone)
        tone = None if changed == Tone() else changed
    chosen = {name: value for name, value in _given(look, "scene").items() if name != "fog"}
    if placed.is_model and "background" not in look:
        chosen["background"] = contrasting(objects)
    scene = evolve(scene, objects=objects, tone=tone, **chosen)
    points = scene.world_positions()
    if placed.has_strays:
        points = points[length(points) <= _MODEL]
        if scene.ground is not None:
            scene = evolve(scene, ground=scene.ground.settled(points))
    return evolve(placed, scene=scene, points=points)


def _light(shaded: _Staged) -> _Staged:
    """Return the scene with the lights of the preset, and with their shadow."""
    look, lights = shaded.look, shaded.scene.lights
    if "preset" in look and "lights" not in look:
        seen = shaded.camera()  # beside which they stand
        x, _, z = (seen.eye - seen.target).tolist()
        casts = any(each.shadow for each in lights)
        lights = tuple(preset_of(look["preset"]).lights(math.degrees(math.atan2(x, z)), casts))
    if "shadow" in look:
        lights = tuple(evolve(light, shadow=look["shadow"] and number == 0) for number, light in enumerate(lights))
    return evolve(shaded, scene=evolve(shaded.scene, lights=lights))


def _frame(lit: _Staged) -> _Staged:
    """Return the scene with its camera, and with fog between the nearest and the farthest point that this shows."""
    camera, fog = lit.camera(), lit.look.get("fog", lit.scene.fog)
    if lit.has_strays and camera.near is None and camera.projection == "perspective":
        camera = evolve(camera, near=constant.NEAR_PART * (float(length(camera.eye)) + 1))
    if isinstance(fog, tuple):
        fog = _fog_between(camera, lit.points, fog)
    return evolve(lit, scene=evolve(lit.scene, camera=camera, fog=fog))


def _in_unit_sphere(
    objects: Sequence[Object], points: Floats, rotation: Floats, view: Viewpoint, staging: Staging, *size: int
) -> Scene:
    """Return a scene of the parts of a model; their places scale points, (n, 3), to a bounding sphere of radius 1."""
    with np.errstate(over="ignore"):
        center = (points.min(axis=0) + points.max(axis=0)) / 2
        radius = float(length(points - center).max())
    scale = 1 / radius if radius > 0 else 1.0
    if not np.isfinite(center).all() or not np.isfinite(radius) or not np.isfinite(scale):
        raise InputError("the coordinates of the mesh are too large or too small to be scaled")
    turned = rotate(rotation, (points - center) * scale)
    position = -rotate(rotation, center * scale)
    return Scene(
        [evolve(each, position=position, rotation=multiply(rotation, each.rotation), scale=scale) for each in objects],
        frame(turned, view),
        toward_viewer(view, *staging.light),
        width=size[0],
        height=size[1],
        **staging.fields,
    )


def _shading(o: Object, look: Mapping[str, Any]) -> tuple[Object, Mapping[str, Any]]:
    """Return object and look with the shading that suits the normals, unless the look or the file says which."""
    mesh = o.mesh
    if o.material.shading == "unlit" or "crease" in look or look.get("shading", "smooth") != "smooth":
        return o, look
    if mesh.normals is None:
        return o, {**look, "crease": None}
    if "shading" not in look and is_flat(mesh.positions, mesh.faces, mesh.normals[mesh.faces]):
        return evolve(o, mesh=with_normals(mesh, None)), {**look, "shading": "flat"}
    return o, {**look, "shading": "smooth"}


def view_of(
    look: Mapping[str, Any], width: int, height: int, orthographic: bool, own: Viewpoint | None = None
) -> Viewpoint:
    """Return the view that a look asks for, in a picture of this size. own: what it changes; None for a plain one."""
    chosen = {name: look[name] for name in ("azimuth", "elevation", "margin") if name in look}
    half_height = half_height_in(look, orthographic)
    if half_height is not None and not orthographic:
        chosen["half_height"] = half_height
    projection: Projection = "orthographic" if orthographic else "perspective"
    return evolve(own or Viewpoint(), projection=projection, aspect=width / height, **chosen)


def resize(scene: Scene, size: int | tuple[int, int]) -> Scene:
    """Return the scene on a canvas of another size; the camera keeps its vertical field of view."""
    width, height = size_of(size)
    return evolve(scene, width=width, height=height)


def _object(o: Object, look: Mapping[str, Any]) -> Object:
    changes = _given(look, "object")
    if "color" in changes:
        o = painted_object(o, changes.pop("color"))
    material = _given(look, "material")
    shading = material.pop("shading", "smooth" if "crease" in look else o.material.shading)
    o = evolve(o, material=evolve(o.material, **material), **changes)
    return shaded(o, shading, look.get("crease"), anew="crease" in look)


def _fog_between(camera: Camera, points: Floats, color: Color) -> Fog:
    """Return fog that begins at the nearest of the points, (n, 3), and hides the farthest one."""
    forward = camera.target - camera.eye
    if not forward.any() or not len(points):
        return Fog(color, 0, 1)
    depths = dot(points - camera.eye, forward / length(forward))
    near, far = max(float(depths.min()), 0.0), float(depths.max())
    # a scene without depth is clear
    return Fog(color, near, far if far > near else 2 * near + 1)


def _to_be_seen(scene: Scene, points: Floats) -> Floats:
    """Return points, (n, 3), that are in the picture if points of objects are: these, and their shadow on a ground."""
    if scene.ground is None:
        return points
    ground = scene.ground.under(points)
    assert ground.fade is not None
    inner, outer = ground.fade
    center, seen = ground.position, [points]
    reach = inner + _FADED * (outer - inner)
    for light in (each for each in scene.lights if each.shadow):
        # from each point away from the light, down to the ground
        away = np.broadcast_to(-light.vector, points.shape) if light.kind == "directional" else points - light.vector
        drop, height = away[:, 1], points[:, 1] - center[1]
        falls = (drop < 0) & (height > 0)
        fallen = points[falls] + away[falls] * (height[falls] / -drop[falls])[:, None]
        far = fallen - center
        distances = length(far)
        seen.append(center + far * (np.minimum(distances, reach) / np.maximum(distances, reach / 2**20))[:, None])
    return np.concatenate(seen)


def _given(look: Mapping[str, Any], part: ScenePart) -> dict[str, Any]:
    return {setting.name: look[setting.name] for setting in settings_of(part) if setting.name in look}
