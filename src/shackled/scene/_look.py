"""The look of a picture: what can be set, once, for Python and the command line alike."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from difflib import get_close_matches
from typing import Any, Literal, TypedDict, cast

import numpy as np
from attrs import evolve, frozen
from numpy.typing import ArrayLike

from ..checks import choice, color, flag, integer, number, vector
from ..errors import InputError
from ._background import Background, background_of
from ._camera import DEFAULT_HALF_HEIGHT, Camera, Projection, half_height_of
from ._light import Light
from ._material import SHADINGS, Shading
from ._mesh import Mesh
from ._object import Object
from ._rotation import rotation_of
from ._scene import MAX_SIDE, Scene, lights_of
from ._staging import AZIMUTH, ELEVATION, MARGIN, Look, frame, painted, stage
from ._turning import middle, turn

Kind = Literal["size", "whole", "number", "vector", "rotation", "flag", "color", "background", "choice", "lights"]


@frozen
class Setting:
    """Something of the look of a picture that can be set.

    name: of the keyword; the option is --name with dashes, unless `option` is another. low, high: of a number. unit:
    what a value is measured in. default: in words, where nothing else in the table says it.
    """

    name: str
    kind: Kind
    group: str
    text: str
    low: float = -np.inf
    high: float = np.inf
    unit: str = ""
    default: str = ""
    choices: tuple[str, ...] = ()
    option: str = ""

    @property
    def help(self) -> str:
        """The sentence, with what values may be, and the default."""
        limits = self.range or ", ".join(self.choices) or self.unit
        more = "; ".join(filter(None, [limits, f"default: {self.default}" if self.default else ""]))
        return f"{self.text[:-1]} ({more})." if more else self.text

    @property
    def values(self) -> str:
        """What values may be, such as "0.2 to 179.8 degrees" or "a colour"."""
        words = _WORDS[self.kind]
        return self.range or ", ".join(self.choices) or (f"{words}, {self.unit}" if self.unit else words)

    @property
    def range(self) -> str:
        """Such as "0.2 to 179.8 degrees"; "" where a number may be any, and for what is none."""
        if not np.isfinite(self.high):
            return ""
        return f"{self.low:g} to {self.high:g}{f' {self.unit}' if self.unit else ''}"


#: What values of a kind are.
_WORDS: dict[Kind, str] = {
    "size": "pixels",
    "whole": "a whole number",
    "number": "a number",
    "vector": "x, y, z",
    "rotation": "x, y, z",
    "flag": "true or false",
    "color": "a colour",
    "background": "one colour or two",
    "choice": "a word",
    "lights": "lights",
}

#: All settings, in the order in which they are shown.
SETTINGS = (
    Setting("size", "size", "Canvas", "Width and height of the picture.", 1, MAX_SIDE, "pixels", "the scene's, or 128"),
    Setting("max_triangles", "whole", "Canvas", "Number of triangles to which larger meshes are simplified.", 1),
    Setting("background", "background", "Canvas", "Colour of the background, or those of its top and bottom."),
    Setting("invert", "flag", "Canvas", "Replace each value v by 255 - v.", option="--invert/--no-invert"),
    Setting(
        "rotate", "rotation", "Camera", "Rotate the scene about x, then y, then z, through its middle.", unit="degrees"
    ),
    Setting("eye", "vector", "Camera", "Position of the eye."),
    Setting("target", "vector", "Camera", "Point at which the eye looks."),
    Setting("up", "vector", "Camera", "Direction that is upward in the picture."),
    Setting(
        "azimuth",
        "number",
        "Camera",
        "Angle at which the camera stands to the right of the front.",
        unit="degrees",
        default=f"{AZIMUTH:g} for mesh files",
    ),
    Setting(
        "elevation",
        "number",
        "Camera",
        "Angle at which the camera stands above the horizon.",
        -90,
        90,
        "degrees",
        f"{ELEVATION:g} for mesh files",
    ),
    Setting(
        "margin",
        "number",
        "Camera",
        "Part of half the picture that stays free around the objects.",
        0,
        0.9,
        default=f"{MARGIN:g} for mesh files",
    ),
    Setting(
        "fov", "number", "Camera", "Vertical field of view of a perspective camera.", 0.2, 179.8, "degrees", "about 50"
    ),
    Setting("half_height", "number", "Camera", "Half the height of the view, in perspective at distance 1.", 0),
    Setting("near", "number", "Camera", "Distance of the near plane, before which all is clipped."),
    Setting(
        "orthographic",
        "flag",
        "Camera",
        "Use the orthographic projection, or the perspective one.",
        option="--orthographic/--perspective",
    ),
    Setting("lights", "lights", "Light", "Lights that replace those of the scene, up to four.", option="--light"),
    Setting("ambient_light", "color", "Light", "Colour of the light that comes from everywhere.", default="white"),
    Setting("shading", "choice", "Light", "Kind of shading.", choices=SHADINGS),
    Setting("smooth", "flag", "Light", "Short for shading smooth.", option="--smooth"),
    Setting("unlit", "flag", "Light", "Short for shading unlit.", option="--unlit"),
    Setting("ambient", "number", "Light", "Share of ambient light.", 0, 4),
    Setting("diffuse", "number", "Light", "Share of diffuse light.", 0, 4),
    Setting("specular", "number", "Light", "Strength of highlights.", 0, 4),
    Setting("shininess", "whole", "Light", "Exponent of highlights, from wide to small.", 1, 128),
    Setting("color", "color", "Surface", "One colour for all meshes.", default="their own"),
    Setting(
        "cull",
        "flag",
        "Surface",
        "Leave out faces that turn away.",
        default="true for closed mesh files",
        option="--cull/--no-cull",
    ),
    Setting("wireframe", "flag", "Surface", "Draw edges only.", option="--wireframe/--filled"),
    Setting("opacity", "number", "Surface", "Share of what is behind objects that they hide.", 0, 1),
)

#: A colour as it is given.
AnyColor = ArrayLike | str


class LookOptions(TypedDict, total=False):
    """The keywords of a look, but for `size`; what they mean says the table `SETTINGS`. None leaves what there is."""

    max_triangles: int | None
    background: Background | AnyColor | tuple[AnyColor, AnyColor] | None
    invert: bool | None
    rotate: ArrayLike | None
    eye: ArrayLike | None
    target: ArrayLike | None
    up: ArrayLike | None
    azimuth: float | None
    elevation: float | None
    margin: float | None
    fov: float | None
    half_height: float | None
    near: float | None
    orthographic: bool | None
    lights: Light | Sequence[Light] | None
    ambient_light: AnyColor | None
    shading: Shading | None
    smooth: bool | None
    unlit: bool | None
    ambient: float | None
    diffuse: float | None
    specular: float | None
    shininess: int | None
    color: AnyColor | None
    cull: bool | None
    wireframe: bool | None
    opacity: float | None


def checked_look(options: Mapping[str, Any]) -> dict[str, Any]:
    """Return what is set, each converted by its kind; without what is None.

    InputError names the keyword that is wrong, or two that exclude each other, each in `backticks`.
    """
    known = {setting.name: setting for setting in SETTINGS}
    for name in options:
        if name not in known:
            close = get_close_matches(name, known, 1)
            meant = f"did you mean {close[0]}?" if close else f"known are {', '.join(known)}"
            raise TypeError(f"{name!r} is not a keyword of a look; {meant}")
    look = {name: _CHECKS[known[name].kind](value, known[name]) for name, value in options.items() if value is not None}
    shadings = {name for name in ("smooth", "unlit") if look.pop(name, False)} | {*filter(None, [look.get("shading")])}
    if len(shadings) > 1:
        raise InputError(f"the shading cannot be {' and '.join(sorted(shadings))} at once")
    if shadings:
        look["shading"] = shadings.pop()
    _exclude(look, ("fov",), ("half_height",))
    _exclude(look, ("azimuth", "elevation", "margin"), ("eye", "target", "up"))
    return look


def look_at(thing: Mesh | Scene, look: Mapping[str, Any]) -> Scene:
    """Return the scene with a look, of `checked_look`; a mesh is staged, so that it fills the picture."""
    if isinstance(thing, Scene) and not look:
        return thing
    if isinstance(thing, Mesh):
        scene = stage(thing, _staging(look, look.get("orthographic", False), thing_turned=True))
    else:
        scene = turn(thing, look["rotate"]) if "rotate" in look else thing
        width, height = look.get("size", (scene.width, scene.height))
        scene = evolve(scene, width=width, height=height)
    scene = evolve(
        scene,
        objects=[_object(each, look) for each in scene.objects],
        camera=_camera(scene, look, isinstance(thing, Mesh)),
        **{name: look[name] for name in ("lights", "background", "ambient_light", "invert") if name in look},
    )
    if "max_triangles" not in look:
        return scene
    from ._simplify import simplify_scene

    return simplify_scene(scene, look["max_triangles"])


def resize(scene: Scene, size: int | tuple[int, int]) -> Scene:
    """Return the scene on a canvas of another size; the camera keeps its vertical field of view."""
    width, height = size_of(size)
    return evolve(scene, width=width, height=height)


def size_of(value: int | tuple[int, int], name: str = "`size`") -> tuple[int, int]:
    """Return width and height, of one number or two. InputError for anything else."""
    try:
        side = integer(value)
        width, height = value if side is None else (side, side)  # type: ignore[misc]
    except (TypeError, ValueError):
        raise InputError(f"{name} must be one number or (width, height), not {value!r:.60}") from None
    sides = integer(width), integer(height)
    if None in sides:
        raise InputError(f"{name} must be whole numbers, not {value!r:.60}")
    return cast(tuple[int, int], sides)


def _exclude(look: Mapping[str, Any], one: Sequence[str], other: Sequence[str]) -> None:
    pair = [next((name for name in names if name in look), None) for names in (one, other)]
    if None not in pair:
        raise InputError(f"`{pair[0]}` and `{pair[1]}` exclude each other: give one of them")


def _staging(look: Mapping[str, Any], orthographic: bool, thing_turned: bool) -> Look:
    """Return how a mesh, or a scene of such a size, is framed."""
    chosen = {name: look[name] for name in ("azimuth", "elevation", "margin") if name in look}
    if "size" in look:
        chosen["width"], chosen["height"] = look["size"]
    if thing_turned and "rotate" in look:
        chosen["rotation"] = look["rotate"]
    half_height = _half_height(look, orthographic)
    if half_height is not None and not orthographic:
        chosen["half_height"] = half_height
    return Look(projection="orthographic" if orthographic else "perspective", **chosen)


def _object(o: Object, look: Mapping[str, Any]) -> Object:
    material = evolve(o.material, **_given(look, "shading", "ambient", "diffuse", "specular", "shininess"))
    mesh = painted(o.mesh, look["color"]) if "color" in look else o.mesh
    return evolve(o, mesh=mesh, material=material, **_given(look, "cull", "wireframe", "opacity"))


def _camera(scene: Scene, look: Mapping[str, Any], is_staged: bool) -> Camera:
    camera = scene.camera
    orthographic = look.get("orthographic", camera.projection == "orthographic")
    projection: Projection = "orthographic" if orthographic else "perspective"
    chosen = _half_height(look, orthographic)
    if not is_staged and scene.objects and _given(look, "azimuth", "elevation", "margin"):
        staging = evolve(_staging(look, orthographic, False), width=scene.width, height=scene.height)
        if not orthographic and chosen is None:
            own = camera.half_height if camera.projection == projection else DEFAULT_HALF_HEIGHT
            staging = evolve(staging, half_height=own)
        camera = frame(np.concatenate([each.world_positions() for each in scene.objects]), staging)
    camera = evolve(camera, **_given(look, "eye", "target", "up"))
    half_height, near = camera.half_height, camera.near
    if projection != camera.projection:
        # what the camera looks at keeps its size
        near = None
        forward = camera.target - camera.eye
        length = np.linalg.norm(forward)
        distance = float((middle(scene) - camera.eye) @ forward / length) if length else 0.0
        if distance > 0:
            half_height *= distance if orthographic else 1 / distance
    return evolve(
        camera,
        projection=projection,
        half_height=half_height if chosen is None else chosen,
        near=look.get("near", near),
    )


def _half_height(look: Mapping[str, Any], orthographic: bool) -> float | None:
    if "fov" not in look:
        return look.get("half_height")
    if orthographic:
        raise InputError("an orthographic camera has no field of view: give `half_height` instead of `fov`")
    return half_height_of(look["fov"])


def _given(look: Mapping[str, Any], *names: str) -> dict[str, Any]:
    return {name: look[name] for name in names if name in look}


def _whole(value: object, setting: Setting) -> int:
    found = integer(value)
    if found is None or not setting.low <= found <= setting.high:
        limits = f"from {setting.range}" if setting.range else f"at least {setting.low:g}"
        raise InputError(f"`{setting.name}` must be a whole number, {limits}, not {value!r:.60}")
    return found


_CHECKS: dict[Kind, Callable[[Any, Setting], Any]] = {
    "size": lambda value, setting: size_of(value),
    "whole": _whole,
    "number": lambda value, setting: number(value, f"`{setting.name}`", setting.low, setting.high),
    "vector": lambda value, setting: vector(value, f"`{setting.name}`"),
    "rotation": lambda value, setting: rotation_of(value, f"`{setting.name}`"),
    "flag": lambda value, setting: flag(value, f"`{setting.name}`"),
    "color": lambda value, setting: color(value, f"`{setting.name}`"),
    "background": lambda value, setting: background_of(value),
    "choice": lambda value, setting: choice(value, f"`{setting.name}`", setting.choices),
    "lights": lambda value, setting: lights_of(value),
}
