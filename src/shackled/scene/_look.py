"""The look of a picture: one table of what can be set, for Python, the command line and scene files."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from difflib import get_close_matches
from typing import Any, Final, Literal, TypedDict, Unpack, cast

import numpy as np
from attrs import evolve, frozen
from numpy.typing import ArrayLike

from ..checks import Color, Floats, choice, color, flag, integer, number, vector, whole
from ..errors import InputError
from ._arithmetic import dot, length
from ._background import Background, background_of
from ._camera import DEFAULT_HALF_HEIGHT, FIELDS_OF_VIEW, Camera, Projection, half_height_of
from ._crease import CREASES, is_flat, shaded, without_normals
from ._effects import EXPOSURES, NONE, Fog, Hemisphere, Rim, Tone, fog_or_color, hemisphere_of, rim_of
from ._ground import Ground, ground_of
from ._light import Light
from ._material import COEFFICIENTS, EXPONENTS, SHADINGS, Material, Shading
from ._mesh import Mesh
from ._object import OPACITIES, Object
from ._presets import PRESETS, preset_of
from ._rotation import IDENTITY, multiply, rotate, rotation_of
from ._scene import MAX_SIDE, Scene, lights_of
from ._staging import (
    ELEVATIONS,
    MARGINS,
    MESH_STAGING,
    PLAIN,
    Staging,
    Viewpoint,
    contrasting,
    frame,
    is_closed,
    painted_object,
    placed,
    to_be_seen,
)
from ._turning import middle, turn
from ._upright import AXES, Axis, turned_up, upright
from ._winding import wound

#: What a setting is a field of; "camera" also has settings from which a camera is made, "file" those that say what is
#: read of a glTF file.
Part = Literal["scene", "camera", "object", "material", "tone", "file"]
Kind = Literal[
    "size",
    "whole",
    "count",
    "number",
    "vector",
    "rotation",
    "flag",
    "color",
    "background",
    "choice",
    "lights",
    "hemisphere",
    "rim",
    "fog",
    "ground",
    "entry",
]


@frozen
class Setting:
    """A setting of the look of a picture.

    name: the keyword; the option is --name with dashes, unless `option` is another. low, high: the range of a number.
    unit: of a number. default: in words, where nothing else in the table says it. part: what it is a field of, in
    Python and in scene files; None for what only `load` and the command line take.
    """

    name: str
    kind: Kind
    part: Part | None
    group: str
    text: str
    low: float = -np.inf
    high: float = np.inf
    unit: str = ""
    default: str = ""
    choices: tuple[str, ...] = ()
    option: str = ""

    def check(self, value: object, name: str) -> Any:
        """Return the value, converted by the kind of the setting. InputError, with the name, if it cannot be one."""
        return _CHECKS[self.kind](value, self, name)

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
    "count": "a whole number, or all",
    "number": "a number",
    "vector": "x, y, z",
    "rotation": "x, y, z",
    "flag": "true or false",
    "color": "a colour",
    "background": "one colour or two",
    "choice": "a word",
    "lights": "lights",
    "hemisphere": "one colour or two, or none",
    "rim": "a colour, with an exponent from 1 to 16 or without, or none",
    "fog": "a colour, with two distances or without, or none",
    "ground": "a colour, or none",
    "entry": "a name, or a number from 0",
}

#: Models of more vertices have one side by default: the second records of vertices would take much memory, whose gas is
#: quadratic.
MOST_TWO_SIDED = 16384

#: The value of `max_triangles` that leaves meshes as they are.
ALL: Final = "all"

#: The material of mesh files.
_SURFACE = MESH_STAGING.material

#: All settings, in the order in which they are shown.
SETTINGS = (
    Setting(
        "size",
        "size",
        None,
        "Canvas",
        "Width and height of the picture.",
        1,
        MAX_SIDE,
        "pixels",
        f"the scene's, or {MESH_STAGING.side} for mesh files and pieces of datasets",
    ),
    Setting(
        "max_triangles",
        "count",
        None,
        "Canvas",
        "Number of triangles to which larger meshes are simplified, or all.",
        1,
        default="as many as the canvas shows for mesh files, else all",
    ),
    Setting(
        "background",
        "background",
        "scene",
        "Canvas",
        "Colour of the background, or those of its top and bottom.",
        default="light for mesh files, or dark where they are light",
    ),
    Setting("invert", "flag", "scene", "Canvas", "Replace each value v by 255 - v.", option="--invert/--no-invert"),
    Setting(
        "antialias",
        "flag",
        "scene",
        "Canvas",
        "Smooth the edges with four samples per pixel.",
        option="--antialias/--no-antialias",
    ),
    Setting(
        "rotate",
        "rotation",
        None,
        "Camera",
        "Rotate the scene about x, then y, then z, through its middle.",
        unit="degrees",
    ),
    Setting(
        "up_axis",
        "choice",
        None,
        "Camera",
        "Axis of the file that points up in the scene, before `rotate`.",
        default="z for STL files, else y",
        choices=AXES,
    ),
    Setting("eye", "vector", "camera", "Camera", "Position of the camera."),
    Setting("target", "vector", "camera", "Camera", "Point at which the camera looks."),
    Setting("up", "vector", "camera", "Camera", "Direction that points up in the picture."),
    Setting(
        "azimuth",
        "number",
        "camera",
        "Camera",
        "Angle at which the camera stands to the right of the front.",
        unit="degrees",
        default=f"{MESH_STAGING.view.azimuth:g} for mesh files",
    ),
    Setting(
        "elevation",
        "number",
        "camera",
        "Camera",
        "Angle at which the camera stands above the horizon.",
        *ELEVATIONS,
        "degrees",
        f"{MESH_STAGING.view.elevation:g} for mesh files, up to {MESH_STAGING.flat_elevation:g} for flat ones",
    ),
    Setting(
        "margin",
        "number",
        "camera",
        "Camera",
        "Free border, as a fraction of half the picture.",
        *MARGINS,
        default=f"{MESH_STAGING.view.margin:g} for mesh files",
    ),
    Setting(
        "fov",
        "number",
        "camera",
        "Camera",
        "Vertical field of view of a perspective camera.",
        *FIELDS_OF_VIEW,
        "degrees",
        "30 for mesh files, else about 50",
    ),
    Setting(
        "half_height", "number", "camera", "Camera", "Half the height of the view, in perspective at distance 1.", 0
    ),
    Setting("near", "number", "camera", "Camera", "Distance of the near plane; nearer geometry is clipped."),
    Setting(
        "orthographic",
        "flag",
        None,
        "Camera",
        "Use the orthographic projection, or the perspective one.",
        option="--orthographic/--perspective",
    ),
    Setting(
        "preset",
        "choice",
        None,
        "Light",
        "Material, colour, lights and background by the name of a look; other settings change it.",
        choices=tuple(each.name for each in PRESETS),
    ),
    Setting(
        "lights", "lights", "scene", "Light", "Up to four lights, which replace those of the scene.", option="--light"
    ),
    Setting(
        "ambient_light",
        "color",
        "scene",
        "Light",
        "Colour of the ambient light.",
        default="bluish white for mesh files, else white",
    ),
    Setting(
        "hemisphere",
        "hemisphere",
        "scene",
        "Light",
        "Light from the sky above and from the ground below, added to the ambient light.",
    ),
    Setting("rim", "rim", "scene", "Light", "Light along the outlines of objects; its exponent sets its width."),
    Setting(
        "fog",
        "fog",
        "scene",
        "Light",
        "Fog that begins at one distance from the eye and hides everything at another.",
        default="distances of the nearest and the farthest point",
    ),
    Setting(
        "shadow",
        "flag",
        None,
        "Light",
        "Let objects cast shadows from the first light.",
        option="--shadow/--no-shadow",
    ),
    Setting("ground", "ground", "scene", "Light", "Ground under the objects, which receives shadows."),
    Setting("exposure", "number", "tone", "Light", "Multiplier of all light.", *EXPOSURES, default="1"),
    Setting(
        "filmic",
        "flag",
        "tone",
        "Light",
        "Compress bright light as film does, instead of clipping it.",
        option="--filmic/--no-filmic",
    ),
    Setting(
        "gamma",
        "flag",
        "tone",
        "Light",
        "Add light in linear space instead of as sRGB values.",
        option="--gamma/--no-gamma",
    ),
    Setting(
        "shading",
        "choice",
        "material",
        "Light",
        "Kind of shading.",
        default="by `crease` for mesh files",
        choices=SHADINGS,
    ),
    Setting(
        "crease",
        "number",
        None,
        "Light",
        "Compute normals for smooth shading, except across edges of more than this angle.",
        *CREASES,
        "degrees",
        "the normals of the mesh, or by the shape where there are none",
    ),
    Setting("smooth", "flag", None, "Light", "Same as --shading smooth.", option="--smooth"),
    Setting("unlit", "flag", None, "Light", "Same as --shading unlit.", option="--unlit"),
    Setting(
        "ambient",
        "number",
        "material",
        "Light",
        "Share of ambient light.",
        *COEFFICIENTS,
        default=f"{_SURFACE.ambient:g} for mesh files",
    ),
    Setting(
        "diffuse",
        "number",
        "material",
        "Light",
        "Share of diffuse light.",
        *COEFFICIENTS,
        default=f"{_SURFACE.diffuse:g} for mesh files",
    ),
    Setting(
        "specular",
        "number",
        "material",
        "Light",
        "Strength of highlights.",
        *COEFFICIENTS,
        default=f"{_SURFACE.specular:g} for mesh files",
    ),
    Setting(
        "shininess",
        "whole",
        "material",
        "Light",
        "Exponent of highlights: the larger, the smaller they are.",
        *EXPONENTS,
        default=f"{_SURFACE.shininess:g} for mesh files",
    ),
    Setting("emission", "color", "material", "Surface", "Colour of the light that surfaces emit.", default="black"),
    Setting("color", "color", "object", "Surface", "One colour for all meshes.", default="their own"),
    Setting(
        "cull",
        "flag",
        "object",
        "Surface",
        "Cull back faces.",
        default="true for closed parts of mesh files",
        option="--cull/--no-cull",
    ),
    Setting(
        "two_sided",
        "flag",
        "object",
        "Surface",
        "Light what is seen from behind as from the front.",
        default="true for what is not culled of mesh files, up to 16,384 vertices or if the file says so",
        option="--two-sided/--one-sided",
    ),
    Setting("wireframe", "flag", "object", "Surface", "Draw edges only.", option="--wireframe/--filled"),
    Setting("opacity", "number", "object", "Surface", "Opacity of the objects.", *OPACITIES),
    Setting(
        "animation",
        "entry",
        "file",
        "glTF files",
        "Animation that poses the model.",
        default="the first if `time` is given, else the pose at rest",
    ),
    Setting("time", "number", "file", "glTF files", "Time in the animation.", 0, unit="seconds", default="0"),
    Setting("use_camera", "entry", "file", "glTF files", "Camera of the file that is taken, with the lights there."),
)


def settings_of(part: Part) -> list[Setting]:
    """Return the settings that are fields of a part of a scene."""
    return [setting for setting in SETTINGS if setting.part == part]


#: A colour as it is given.
AnyColor = ArrayLike | str


class LookOptions(TypedDict, total=False):
    """The keywords of a look, but for `size`; what they mean says the table `SETTINGS`. None leaves what there is."""

    max_triangles: int | Literal["all"] | None
    background: Background | AnyColor | tuple[AnyColor, AnyColor] | None
    invert: bool | None
    antialias: bool | None
    rotate: ArrayLike | None
    up_axis: Axis | None
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
    preset: str | None
    lights: Light | Sequence[Light] | None
    ambient_light: AnyColor | None
    hemisphere: Hemisphere | AnyColor | tuple[AnyColor, AnyColor] | None
    rim: Rim | AnyColor | tuple[AnyColor, int] | None
    fog: Fog | AnyColor | tuple[AnyColor, float, float] | None
    shadow: bool | None
    ground: Ground | AnyColor | None
    exposure: float | None
    filmic: bool | None
    gamma: bool | None
    shading: Shading | None
    crease: float | None
    smooth: bool | None
    unlit: bool | None
    ambient: float | None
    diffuse: float | None
    specular: float | None
    shininess: int | None
    emission: AnyColor | None
    color: AnyColor | None
    cull: bool | None
    two_sided: bool | None
    wireframe: bool | None
    opacity: float | None
    animation: str | int | None
    time: float | None
    use_camera: str | int | None


#: How alike a name must be, from 0 to 1, to be what was meant.
CLOSE = 0.8
_SIZE = "`size` is the side in pixels, or (width, height)"
_SURFACE_WORDS = "`color`, `shading`, `specular` and others set it, or render an Object with a Material"
#: What to give instead of keywords that other programs have.
_INSTEAD = {
    **dict.fromkeys(("width", "height", "resolution", "shape"), _SIZE),
    **dict.fromkeys(("material", "texture"), _SURFACE_WORDS),
    "aa": "did you mean antialias?",
    "alpha": "`transparent` of render leaves out the background, `opacity` is that of the objects",
    "bg": "did you mean background?",
    "camera": "`eye`, `target`, `up` and `fov` place the camera, `use_camera` takes that of a glTF "
    "file; or render a Scene with a Camera",
    "depth": "depths are not returned",
    "emissive": "did you mean emission?",
    "fps": "`duration` of a turntable is the time of a frame in milliseconds",
    **dict.fromkeys(("output", "path", "filename"), "`save` of what is returned writes it to a file"),
    "projection": "did you mean orthographic?",
    "rotation": "did you mean rotate?",
}


def checked_look(options: Mapping[str, Any]) -> dict[str, Any]:
    """Return what is set, each converted by its kind; without what is None.

    InputError names the keyword that is wrong, or two that exclude each other, each in `backticks`.
    """
    known = {setting.name: setting for setting in SETTINGS}
    for name in options:
        if name not in known:
            close = get_close_matches(name, known, 1, CLOSE)
            meant = f"did you mean {close[0]}?" if close else _INSTEAD.get(name, f"known are {', '.join(known)}")
            raise TypeError(f"{name!r} is not a keyword of a look; {meant}")
    look = {name: known[name].check(value, f"`{name}`") for name, value in options.items() if value is not None}
    shadings = {name for name in ("smooth", "unlit") if look.pop(name, False)} | {*filter(None, [look.get("shading")])}
    if len(shadings) > 1:
        raise InputError(f"the shading cannot be {' and '.join(sorted(shadings))} at once")
    if shadings:
        look["shading"] = shadings.pop()
    if "preset" in look:
        preset = preset_of(look["preset"]).settings
        if "crease" in look:
            del preset["shading"]
        look = preset | look
    if "up_axis" in look:
        look["rotate"] = multiply(look.get("rotate", IDENTITY), upright(look.pop("up_axis")))
    if "crease" in look and look.get("shading", "smooth") != "smooth":
        raise InputError(f"`crease` is for smooth shading, and excludes {look['shading']}")
    exclude(look, "`{}`".format)
    return look


def exclude(given: Collection[str], quote: Callable[[str], str]) -> None:
    """Raise an InputError for settings that exclude each other; `quote` makes a name what messages call it."""
    for pair in _EXCLUSIVE:
        one, other = (next((name for name in names if name in given), None) for names in pair)
        if one is not None and other is not None:
            raise InputError(f"{quote(one)} and {quote(other)} exclude each other: give one of them")


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
    for setting in settings_of("file"):
        if setting.name in look:
            raise InputError(f"`{setting.name}` is for what is read of one glTF file")
    if isinstance(thing, Scene) and not look:
        return thing
    crease = look.get("crease")
    view = None
    if isinstance(thing, Scene):
        scene = turn(thing, look["rotate"]) if "rotate" in look else thing
        width, height = look.get("size", (scene.width, scene.height))
        scene = evolve(scene, width=width, height=height)
        looks = [look] * len(scene.objects)
    else:
        parts = [Object(thing, material=staging.material)] if isinstance(thing, Mesh) else list(thing)
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
        points = np.concatenate([each.world_positions() for each in parts]) if around is None else around
        own = staging.view_of(rotate(rotation, points))
        view = view_of(look, width, height, look.get("orthographic", False), own)
        shaded = [_shaded(each, look) if staging.by_normals else (each, look) for each in parts]
        scene = placed([each for each, _ in shaded], points, rotation, view, staging, width, height)
        looks = [own_look for _, own_look in shaded]
    chosen = _given(look, settings_of("scene"))
    fog = chosen.pop("fog", scene.fog)
    objects = [_object(each, own_look) for each, own_look in zip(scene.objects, looks, strict=True)]
    if view is not None and staging.by_normals and "two_sided" not in look:
        count = sum(len(each.mesh.positions) for each in objects if not each.cull)
        objects = [
            evolve(each, two_sided=not each.cull and (each.two_sided or count <= MOST_TWO_SIDED)) for each in objects
        ]
    scene = evolve(scene, objects=objects, tone=_tone(scene.tone, look), **chosen)
    if view is not None and staging.by_normals and "background" not in look:
        scene = evolve(scene, background=contrasting(scene.objects))
    if "preset" in look and "lights" not in look:
        seen = _camera(scene, look, view, is_framed=around is not None)
        x, _, z = (seen.eye - seen.target).tolist()
        casts = any(each.shadow for each in scene.lights)
        scene = evolve(scene, lights=preset_of(look["preset"]).lights(math.degrees(math.atan2(x, z)), casts))
    if "shadow" in look:
        lights = [evolve(light, shadow=look["shadow"] and number == 0) for number, light in enumerate(scene.lights)]
        scene = evolve(scene, lights=lights)
    scene = evolve(scene, camera=_camera(scene, look, view, is_framed=around is not None))
    scene = evolve(scene, fog=_fog_between(scene, fog) if isinstance(fog, tuple) else fog)
    if look.get("max_triangles", ALL) == ALL:
        return scene
    from ._simplify import simplify_scene

    return simplify_scene(scene, look["max_triangles"], crease)


def _shaded(o: Object, look: Mapping[str, Any]) -> tuple[Object, Mapping[str, Any]]:
    """Return the object and the look with the shading that suits the normals of the mesh, unless the look or the file
    says which.
    """
    mesh = o.mesh
    if o.material.shading == "unlit" or "crease" in look or look.get("shading", "smooth") != "smooth":
        return o, look
    if mesh.normals is None:
        return o, {**look, "crease": None}
    if "shading" not in look and is_flat(mesh.positions, mesh.faces, mesh.normals[mesh.faces]):
        return evolve(o, mesh=without_normals(mesh)), {**look, "shading": "flat"}
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


def size_of(value: int | tuple[int, int], name: str = "`size`") -> tuple[int, int]:
    """Return width and height, of one number or two. InputError for anything else."""
    try:
        are_rows = np.ndim(value) > 1
    except ValueError:  # of different lengths
        are_rows = True
    if are_rows:
        raise InputError(f"{name} must be one number or (width, height); vertices and faces are one argument, in ()")
    try:
        side = integer(value)
        width, height = value if side is None else (side, side)  # type: ignore[misc]
    except (TypeError, ValueError):
        raise InputError(f"{name} must be one number or (width, height), not {value!r:.60}") from None
    sides = integer(width), integer(height)
    if None in sides:
        raise InputError(f"{name} must be whole numbers, not {value!r:.60}")
    return cast(tuple[int, int], sides)


def _object(o: Object, look: Mapping[str, Any]) -> Object:
    changes = _given(look, settings_of("object"))
    if "color" in changes:
        o = painted_object(o, changes.pop("color"))
    material = _given(look, settings_of("material"))
    shading = material.pop("shading", "smooth" if "crease" in look else o.material.shading)
    o = evolve(o, material=evolve(o.material, **material), **changes)
    return shaded(o, shading, look.get("crease"), anew="crease" in look)


def _tone(tone: Tone | None, look: Mapping[str, Any]) -> Tone | None:
    chosen = _given(look, settings_of("tone"))
    if not chosen:
        return tone
    changed = evolve(tone or Tone(), **chosen)
    return None if changed == Tone() else changed


def _fog_between(scene: Scene, color: Color) -> Fog:
    """Return fog that begins at the nearest point of the objects, and hides the farthest one."""
    camera = scene.camera
    forward = camera.target - camera.eye
    points = scene.world_positions() - camera.eye
    if not forward.any() or not len(points):
        return Fog(color, 0, 1)
    depths = dot(points, forward / length(forward))
    near, far = max(float(depths.min()), 0.0), float(depths.max())
    # a scene without depth is clear
    return Fog(color, near, far if far > near else 2 * near + 1)


def _camera(scene: Scene, look: Mapping[str, Any], view: Viewpoint | None, is_framed: bool) -> Camera:
    """Return the camera that a look asks for. view: that of a scene that is staged. is_framed: whether it stays."""
    camera = scene.camera
    orthographic = look.get("orthographic", camera.projection == "orthographic")
    projection: Projection = "orthographic" if orthographic else "perspective"
    chosen = half_height_in(look, orthographic)
    if view is not None:
        camera = camera if is_framed else frame(to_be_seen(scene), view)
    elif scene.objects and {"azimuth", "elevation", "margin"} & look.keys():
        view = view_of(look, scene.width, scene.height, orthographic)
        if not orthographic and chosen is None:
            own = camera.half_height if camera.projection == projection else DEFAULT_HALF_HEIGHT
            view = evolve(view, half_height=own)
        camera = frame(to_be_seen(scene), view)
    camera = evolve(camera, **{name: look[name] for name in ("eye", "target", "up") if name in look})
    half_height, near = camera.half_height, camera.near
    if projection != camera.projection:
        # what the camera looks at keeps its size
        near = None
        forward = camera.target - camera.eye
        distance = float(dot(middle(scene) - camera.eye, forward) / length(forward)) if forward.any() else 0.0
        if distance > 0:
            half_height *= distance if orthographic else 1 / distance
    return evolve(
        camera,
        projection=projection,
        half_height=half_height if chosen is None else chosen,
        near=look.get("near", near),
    )


def half_height_in(look: Mapping[str, Any], orthographic: bool) -> float | None:
    """Return the half height of the view that a look asks for; None if it does not."""
    if "fov" not in look:
        return look.get("half_height")
    if orthographic:
        raise InputError("an orthographic camera has no field of view: give `half_height` instead of `fov`")
    return half_height_of(look["fov"])


#: Settings that cannot be given together: one of the first and one of the second.
_EXCLUSIVE = ((("fov",), ("half_height",)), (("azimuth", "elevation", "margin"), ("eye", "target")))


def _given(look: Mapping[str, Any], settings: Iterable[Setting]) -> dict[str, Any]:
    return {setting.name: look[setting.name] for setting in settings if setting.name in look}


def _background(value: Any, setting: Setting, name: str) -> Background:
    if isinstance(value, str) and value.strip().lower() == "transparent":
        raise InputError(f"{name} is a colour: give `transparent` for a picture without a background")
    return background_of(value)


def _entry(value: object, setting: Setting, name: str) -> str | int:
    number = None if isinstance(value, str) else integer(value)
    if number is None and not isinstance(value, str):
        raise InputError(f"{name} must be a name, or a number from 0, not {value!r:.60}")
    return value if isinstance(value, str) else cast(int, number)


def _count(value: object, setting: Setting, name: str) -> int | str:
    if isinstance(value, str):
        if value == ALL:
            return ALL
        raise InputError(f"{name} must be a whole number, at least {setting.low:g}, or {ALL}, not {value!r:.60}")
    return whole(value, name, setting.low, setting.high)


def _unless_none(made: Callable[[Any, str], Any], value: object, name: str) -> Any:
    """Return an effect of a value, or None for the word that removes it."""
    return None if isinstance(value, str) and value.strip().lower() == NONE else made(value, name)


_CHECKS: dict[Kind, Callable[[Any, Setting, str], Any]] = {
    "size": lambda value, setting, name: size_of(value, name),
    "whole": lambda value, setting, name: whole(value, name, setting.low, setting.high),
    "count": _count,
    "number": lambda value, setting, name: number(value, name, setting.low, setting.high),
    "vector": lambda value, setting, name: vector(value, name),
    "rotation": lambda value, setting, name: rotation_of(value, name),
    "flag": lambda value, setting, name: flag(value, name),
    "color": lambda value, setting, name: color(value, name),
    "background": _background,
    "choice": lambda value, setting, name: choice(value, name, setting.choices),
    "lights": lambda value, setting, name: lights_of(value),
    "hemisphere": lambda value, setting, name: _unless_none(hemisphere_of, value, name),
    "rim": lambda value, setting, name: _unless_none(rim_of, value, name),
    "fog": lambda value, setting, name: _unless_none(fog_or_color, value, name),
    "ground": lambda value, setting, name: _unless_none(ground_of, value, name),
    "entry": _entry,
}
