"""The settings of the look of a picture: one table of them, for Python, the command line and scene files."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Any, Final, Literal, TypedDict

from attrs import Factory, evolve, field, frozen
from numpy.typing import ArrayLike

from ..base.checks import choice, color, flag, integer, number, vector, whole
from ..base.synonyms import hint, understood
from ..errors import InputError, KeywordError
from ._arithmetic import IDENTITY, multiply, rotation_of
from ._camera import Camera
from ._effects import NONE, Background, Fog, Hemisphere, Rim, background_of, fog_or_color, hemisphere_of, rim_of
from ._fields import FIELDS, Axis, Shading
from ._ground import Ground, ground_of
from ._light import Light, lights_of
from ._object import Material
from ._presets import PRESETS, preset_of
from ._staging import MAX_SIDE, MESH_STAGING
from ._upright import upright

#: What a setting is a field of; "camera" also has settings from which a camera is made, "file" those that say what is
#: read of a glTF file.
ScenePart = Literal["scene", "camera", "object", "material", "tone", "file"]
_Plain = Literal["size", "whole", "count", "number", "vector", "rotation", "flag", "color", "choice", "entry"]
Kind = _Plain | Literal["background", "lights", "hemisphere", "rim", "fog", "ground"]
_ANY = (-math.inf, math.inf)


@frozen
class Setting:
    """A setting of the look of a picture.

    name: the keyword. part: the class whose field this is, in Python and in scene files; None for what only `load` and
    the command line take. limits, unit: for numbers. default: shown in the help. option: --name, unless it is another.
    Limits and choices of fields are those of contracts/scene_fields.toml.
    """

    name: str
    kind: Kind
    part: ScenePart | None
    text: str
    limits: tuple[float, float] = _ANY
    unit: str = ""
    default: str = ""
    choices: tuple[str, ...] = ()
    option: str = field(default=Factory(lambda self: self._usual_option, takes_self=True))
    group: str = ""

    @property
    def _usual_option(self) -> str:
        name = self.name.replace("_", "-")
        return f"--{name}/--no-{name}" if self.kind == "flag" else f"--{name}"

    def check(self, value: object, name: str) -> Any:
        """Return the value, converted by the kind of the setting. InputError, with the name, if it cannot be one."""
        return _KINDS[self.kind][1](value, self, name)

    @property
    def help(self) -> str:
        """The sentence, with what values may be, and the default."""
        limits = self.range or ", ".join(self.choices) or self.unit
        more = "; ".join(filter(None, [limits, f"default: {self.default}" if self.default else ""]))
        return f"{self.text[:-1]} ({more})." if more else self.text

    @property
    def values(self) -> str:
        """What values may be, such as "0.2 to 179.8 degrees" or "a colour"."""
        words = _KINDS[self.kind][0]
        return self.range or ", ".join(self.choices) or (f"{words}, {self.unit}" if self.unit else words)

    @property
    def range(self) -> str:
        """Such as "0.2 to 179.8 degrees"; "" where a number may be any, and for what is none."""
        low, high = self.limits
        return f"{low:g} to {high:g}{f' {self.unit}' if self.unit else ''}" if math.isfinite(high) else ""


#: The value of `max_triangles` that leaves meshes as they are.
ALL: Final = "all"


def _background(value: Any, setting: Setting, name: str) -> Background | None:
    if isinstance(value, str) and value.strip().lower() == "transparent":
        raise InputError(f"{name} is a colour: give `transparent` for a picture without a background")
    return background_of(value)


def _entry(value: object, setting: Setting, name: str) -> str | int:
    entry = value if isinstance(value, str) else integer(value)
    if entry is None:
        raise InputError(f"{name} must be a name, or a number from 0, not {value!r:.60}")
    return entry


def _count(value: object, setting: Setting, name: str) -> int | str:
    if isinstance(value, str) and value != ALL:
        raise InputError(f"{name} must be a whole number, at least {setting.limits[0]:g}, or {ALL}, not {value!r:.60}")
    return ALL if isinstance(value, str) else whole(value, name, *setting.limits)


def _unless_none(made: Callable[[Any, str], Any]) -> Callable[[Any, Setting, str], Any]:
    """Return what makes an effect of a value, or None of the word that removes it."""
    return lambda value, _, name: (
        None if isinstance(value, str) and value.strip().lower() == NONE else made(value, name)
    )


def _flag(value: object, setting: Setting, name: str) -> bool:
    # an antialiased picture has four samples per pixel
    return (setting.name == "antialias" and integer(value) == 4) or flag(value, name)


def size_of(value: int | tuple[int, int], name: str = "`size`") -> tuple[int, int]:
    """Return width and height, of one number or two. InputError for anything else."""
    side = integer(value)
    try:
        width, height = map(integer, value) if side is None else (side, side)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        hint = "; `save` of what is returned writes a file" if isinstance(value, str) else ""
        raise InputError(f"{name} must be one number or (width, height), not {value!r:.60}{hint}") from None
    if width is None or height is None:
        raise InputError(f"{name} must be whole numbers, not {value!r:.60}")
    return width, height


#: For each kind, what its values are, and their check.
_KINDS: dict[Kind, tuple[str, Callable[[Any, Setting, str], Any]]] = {
    "size": ("pixels", lambda value, setting, name: size_of(value, name)),
    "whole": ("a whole number", lambda value, setting, name: whole(value, name, *setting.limits)),
    "count": ("a whole number, or all", _count),
    "number": ("a number", lambda value, setting, name: number(value, name, *setting.limits)),
    "vector": ("x, y, z", lambda value, setting, name: vector(value, name)),
    "rotation": ("x, y, z", lambda value, setting, name: rotation_of(value, name)),
    "flag": ("true or false", _flag),
    "color": ("a colour", lambda value, setting, name: color(value, name)),
    "background": ("one colour or two", _background),
    "choice": ("a word", lambda value, setting, name: choice(value, name, setting.choices)),
    "lights": ("lights", lambda value, setting, name: lights_of(value)),
    "hemisphere": ("one colour or two, or none", _unless_none(hemisphere_of)),
    "rim": ("a colour, optionally with an exponent from 1 to 16, or none", _unless_none(rim_of)),
    "fog": ("a colour, optionally with two distances, or none", _unless_none(fog_or_color)),
    "ground": ("a colour, or none", _unless_none(ground_of)),
    "entry": ("a name, or a number from 0", _entry),
}

#: The view and the material of mesh files.
_VIEW, _SURFACE = MESH_STAGING.view, MESH_STAGING.material
#: What is taken where a setting is not given, in words, where nothing else says it.
_DEFAULTS = {
    "size": f"the scene's, or {MESH_STAGING.side} for mesh files and pieces of datasets",
    "max_triangles": "as many as the canvas can show for mesh files, else all",
    "background": "light for mesh files, dark if the surface is very light",
    "up_axis": "z for STL files, else y",
    "azimuth": f"{_VIEW.azimuth:g} for mesh files",
    "elevation": f"{_VIEW.elevation:g} for mesh files, up to {MESH_STAGING.flat_elevation:g} for flat ones",
    "margin": f"{_VIEW.margin:g} for mesh files",
    "fov": "30 for mesh files, else about 50",
    "ambient_light": "bluish white for mesh files, else white",
    "fog": "distances of the nearest and the farthest point",
    "exposure": "1",
    "shading": "depends on `crease` for mesh files",
    "crease": "the normals of the mesh, or an angle that depends on its shape",
    "ambient": f"{_SURFACE.ambient:g} for mesh files",
    "diffuse": f"{_SURFACE.diffuse:g} for mesh files",
    "specular": f"{_SURFACE.specular:g} for mesh files",
    "shininess": f"{_SURFACE.shininess:g} for mesh files",
    "emission": "black",
    "color": "their own",
    "cull": "true for closed parts of mesh files",
    "two_sided": "true for parts of mesh files that are not culled, up to 16,384 vertices or if the file requests it",
    "animation": "the first if `time` is given, else the rest pose",
    "time": "0",
}
#: By groups, in the order in which they are shown.
_GROUPS: dict[str, list[Setting]] = {
    "Canvas": [
        Setting("size", "size", None, "Width and height of the picture.", (1, MAX_SIDE), "pixels"),
        Setting(
            "max_triangles",
            "count",
            None,
            "Number of triangles to which larger meshes are simplified, or all.",
            (1, math.inf),
        ),
        Setting("background", "background", "scene", "Background colour, or the colours of its top and bottom."),
        Setting("invert", "flag", "scene", "Invert all colours, including the background."),
        Setting("antialias", "flag", "scene", "Smooth the edges with four samples per pixel."),
    ],
    "Camera": [
        Setting(
            "rotate", "rotation", None, "Rotate the scene about x, then y, then z, through its middle.", unit="degrees"
        ),
        Setting("up_axis", "choice", None, "Up axis of the file, turned upright before `rotate`."),
        Setting("eye", "vector", "camera", "Position of the camera."),
        Setting("target", "vector", "camera", "Point at which the camera looks."),
        Setting("up", "vector", "camera", "Direction that points up in the picture."),
        Setting("azimuth", "number", "camera", "Angle of the camera to the right of the front.", unit="degrees"),
        Setting("elevation", "number", "camera", "Angle of the camera above the horizon.", unit="degrees"),
        Setting("margin", "number", "camera", "Free border, as a fraction of half the picture."),
        Setting("fov", "number", "camera", "Vertical field of view of a perspective camera.", unit="degrees"),
        Setting("half_height", "number", "camera", "Half the height of the view, in perspective at distance 1."),
        Setting("near", "number", "camera", "Distance of the near plane; nearer geometry is clipped."),
        Setting(
            "orthographic",
            "flag",
            None,
            "Use an orthographic or a perspective projection.",
            option="--orthographic/--perspective",
        ),
    ],
    "Light": [
        Setting(
            "preset",
            "choice",
            None,
            "Named look: material, colour, lights and background. Other settings modify it.",
            choices=tuple(each.name for each in PRESETS),
        ),
        Setting("lights", "lights", "scene", "Up to four lights, which replace those of the scene.", option="--light"),
        Setting("ambient_light", "color", "scene", "Colour of the ambient light."),
        Setting(
            "hemisphere",
            "hemisphere",
            "scene",
            "Light from the sky above and the ground below, added to the ambient light.",
        ),
        Setting("rim", "rim", "scene", "Light along the outlines of objects; its exponent sets its width."),
        Setting("fog", "fog", "scene", "Fog that begins at one distance from the eye and hides everything at another."),
        Setting("shadow", "flag", None, "Let objects cast shadows from the first light."),
        Setting("ground", "ground", "scene", "Ground under the objects, which receives shadows."),
        Setting("exposure", "number", "tone", "Multiplier of all light."),
        Setting("filmic", "flag", "tone", "Compress bright light as film does, instead of clipping it."),
        Setting("gamma", "flag", "tone", "Add light in linear space instead of as sRGB values."),
        Setting("shading", "choice", "material", "Kind of shading."),
        Setting(
            "crease",
            "number",
            None,
            "Compute normals for smooth shading, with hard edges above this angle.",
            unit="degrees",
        ),
        Setting("smooth", "flag", None, "Same as --shading smooth.", option="--smooth"),
        Setting("unlit", "flag", None, "Same as --shading unlit.", option="--unlit"),
        Setting("ambient", "number", "material", "Strength of ambient light."),
        Setting("diffuse", "number", "material", "Strength of diffuse light."),
        Setting("specular", "number", "material", "Strength of highlights."),
        Setting("shininess", "whole", "material", "Exponent of highlights; larger values make smaller highlights."),
    ],
    "Surface": [
        Setting("emission", "color", "material", "Colour of the light that surfaces emit."),
        Setting("color", "color", "object", "One colour for all meshes."),
        Setting("cull", "flag", "object", "Cull back faces."),
        Setting(
            "two_sided",
            "flag",
            "object",
            "Light the backs of faces like their fronts.",
            option="--two-sided/--one-sided",
        ),
        Setting("wireframe", "flag", "object", "Draw edges only.", option="--wireframe/--filled"),
        Setting("opacity", "number", "object", "Opacity of the objects."),
    ],
    "glTF files": [
        Setting("animation", "entry", "file", "Animation that poses the model."),
        Setting("time", "number", "file", "Time in the animation.", (0, math.inf), "seconds"),
        Setting("use_camera", "entry", "file", "Camera in the file to use, together with the file's lights."),
    ],
}


def _limited(setting: Setting) -> Setting:
    """Return the setting with the limits and choices of its field; those without a part may be keys of objects."""
    field = FIELDS.get((setting.part or "object").capitalize(), {}).get(setting.name)
    if field is None:
        return setting
    return evolve(setting, choices=field.choices, limits=(*field.limits, math.inf)[:2] if field.limits else _ANY)


#: All settings.
SETTINGS = tuple(
    evolve(_limited(each), group=group, default=_DEFAULTS.get(each.name, ""))
    for group, settings in _GROUPS.items()
    for each in settings
)


def settings_of(part: ScenePart) -> list[Setting]:
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


#: Settings that cannot be given together: one of the first and one of the second.
_EXCLUSIVE = ((("fov",), ("half_height",)), (("azimuth", "elevation", "margin"), ("eye", "target")))


def checked_look(options: Mapping[str, Any]) -> dict[str, Any]:
    """Return what is set, each converted by its kind; without what is None.

    InputError names the keyword that is wrong, or two that exclude each other, each in `backticks`.
    """
    options = understood("look", _taken_apart({name: value for name, value in options.items() if value is not None}))
    known = {setting.name: setting for setting in SETTINGS}
    for name in options:
        if name not in known:
            raise KeywordError(f"{name!r} is not a keyword of a look; {hint(name, known)}", name)
    look = {name: known[name].check(value, f"`{name}`") for name, value in options.items()}
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


def _taken_apart(given: dict[str, Any]) -> dict[str, Any]:
    """Return keywords with the settings of a camera, a material, and a width and height in place of these."""
    if {"width", "height"} <= given.keys():
        given.setdefault("size", (given.pop("width"), given.pop("height")))
    found: dict[str, Any] = {}
    if isinstance(camera := given.get("camera"), Camera):
        del given["camera"]
        names = ("eye", "target", "up", "near", *(() if "fov" in given else ("half_height",)))
        found = {name: getattr(camera, name) for name in names if getattr(camera, name) is not None}
        found["orthographic"] = camera.projection == "orthographic"
    if isinstance(material := given.get("material"), Material) and material.texture is None:
        del given["material"]
        found |= {setting.name: getattr(material, setting.name) for setting in settings_of("material")}
    return found | given


def exclude(given: Collection[str], quote: Callable[[str], str]) -> None:
    """Raise an InputError for settings that exclude each other; `quote` makes a name what messages call it."""
    for pair in _EXCLUSIVE:
        one, other = (next((name for name in names if name in given), None) for names in pair)
        if one is not None and other is not None:
            raise InputError(f"{quote(one)} and {quote(other)} exclude each other: give one of them")
