"""The controls of the page, which change a picture, and the checks of their values.

A control that sets what the table `shackled.scene.SETTINGS` lists takes its range, unit, choices and help from it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import Any, Literal

from ..checks import choice, color
from ..errors import InputError
from ..scene import INNER_ANGLE, LIGHT_KINDS, MAX_LIGHTS, OUTER_ANGLE, POWERS, SETTINGS

ControlKind = Literal["number", "choice", "switch", "color"]

#: Pixels a side on the page; the command line makes larger pictures.
MAX_SIDE = 1024
#: Number of objects whose opacity can be set one by one.
MAX_OPACITIES = 8
#: Significant digits of numbers: more than a picture shows, and few enough for short links.
DIGITS = 6
AXES = {"x": 0, "y": 1, "z": 2}


@dataclass(frozen=True)
class Control:
    """One value of the state.

    path: its place in the state, such as "camera.fov" or "lights.0.color".
    group: the panel that shows it. help: one sentence.
    low, high, step, unit: of numbers. reach: the range of the slider, where it is smaller than low..high.
    logarithmic: whether equal distances on the slider are equal ratios. turn: an angle that wraps around, so that 181
        is -179. whole: whether the number is an integer.
    choices: (value, label) pairs.
    none: the label of None, which stands for the source's own value; "" where None is not allowed.
    """

    path: str
    group: str
    label: str
    kind: ControlKind = "number"
    low: float = 0
    high: float = 1
    step: float = 1
    unit: str = ""
    reach: tuple[float, float] = (-math.inf, math.inf)
    logarithmic: bool = False
    turn: bool = False
    whole: bool = False
    choices: tuple[tuple[str, str], ...] = ()
    none: str = ""
    help: str = ""

    @property
    def slider(self) -> tuple[float, float]:
        """Smallest and largest value of the slider."""
        return max(self.low, self.reach[0]), min(self.high, self.reach[1])

    @property
    def keys(self) -> tuple[str | int, ...]:
        """The path as names of fields and places in tuples."""
        return tuple(AXES.get(key, int(key) if key.isdigit() else key) for key in self.path.split("."))


#: The panels in their order: key and title.
GROUPS = (
    ("object", "Object"),
    ("camera", "Camera"),
    ("lights", "Lights"),
    ("atmosphere", "Sky, rim and fog"),
    ("tone", "Tone"),
    ("material", "Material"),
    ("background", "Background"),
    ("drawing", "Drawing"),
    ("size", "Size"),
)

_SETTINGS = {setting.name: setting for setting in SETTINGS}
_KINDS: Mapping[str, ControlKind] = {
    "number": "number",
    "whole": "number",
    "count": "number",
    "size": "number",
    "flag": "switch",
    "color": "color",
    "background": "color",
    "choice": "choice",
}
_UNITS = {"degrees": "°"}


def _set(path: str, group: str, label: str, setting: str = "", **changes: Any) -> Control:
    """Return a control of the setting of that name, by default the last key of the path."""
    of = _SETTINGS[setting or path.rpartition(".")[2]]
    made = Control(
        path,
        group,
        label,
        _KINDS[of.kind],
        step=1 if of.kind in ("whole", "count", "size") or of.unit == "degrees" else 0.01,
        unit=_UNITS.get(of.unit, of.unit),
        whole=of.kind in ("whole", "count", "size"),
        choices=tuple((each, each.capitalize()) for each in of.choices),
        help=of.text,
    )
    if math.isfinite(of.low):
        made = replace(made, low=of.low)
    if math.isfinite(of.high):
        made = replace(made, high=of.high)
    return replace(made, **changes)


def _angle(path: str, group: str, label: str, help: str) -> Control:
    return Control(path, group, label, low=-180, high=180, unit="°", turn=True, help=help)


def _places(path: str, group: str, labels: tuple[str, str, str], high: float) -> tuple[Control, ...]:
    help = "One unit is the radius of the object."
    return tuple(
        _length(f"{path}.{axis}", group, label, -high, high, reach=(-2, 2), help=help)
        for axis, label in zip("xyz", labels, strict=True)
    )


def _length(path: str, group: str, label: str, low: float, high: float, **changes: Any) -> Control:
    return Control(path, group, label, low=low, high=high, step=0.01, unit="radii", **changes)


def _color(path: str, label: str, help: str) -> Control:
    return Control(path, "atmosphere", label, "color", help=help)


_PROJECTIONS = (("perspective", "Perspective"), ("orthographic", "Orthographic"))

CONTROLS: tuple[Control, ...] = (
    *_places("pose.position", "object", ("Move right", "Move up", "Move forward"), 100),
    _angle("pose.rotation.x", "object", "Tilt", "Rotation about the x axis, which points right."),
    _angle("pose.rotation.y", "object", "Turn", "Rotation about the y axis, which points up."),
    _angle("pose.rotation.z", "object", "Roll", "Rotation about the z axis, which points forward."),
    Control(
        "pose.scale",
        "object",
        "Scale",
        low=0.01,
        high=100,
        step=0.01,
        unit="times",
        reach=(0.1, 10),
        logarithmic=True,
    ),
    _set("max_triangles", "object", "At most", low=4, high=65535, unit="triangles", logarithmic=True, none="all"),
    _angle("camera.azimuth", "camera", "Azimuth", _SETTINGS["azimuth"].text),
    _set("camera.elevation", "camera", "Elevation"),
    _angle("camera.roll", "camera", "Roll", "Rotation of the camera about its line of sight."),
    _length("camera.distance", "camera", "Distance", 0.01, 1000, reach=(0.5, 20), logarithmic=True),
    Control("camera.projection", "camera", "Projection", "choice", choices=_PROJECTIONS),
    _set("camera.fov", "camera", "Field of view", reach=(5, 120)),
    *_places("camera.target", "camera", ("Look at, right", "Look at, up", "Look at, forward"), 1000),
    Control(
        "lights_follow",
        "lights",
        "Lights move with the camera",
        "switch",
        help="Keep the lights fixed relative to the camera.",
    ),
    _set("ambient_light", "lights", "Ambient light"),
    Control("hemisphere.on", "atmosphere", "Sky light", "switch", help=_SETTINGS["hemisphere"].text),
    _color("hemisphere.sky", "Sky", "Colour of the light from above."),
    _color("hemisphere.ground", "Ground", "Colour of the light from below."),
    Control("rim.on", "atmosphere", "Rim light", "switch", help=_SETTINGS["rim"].text),
    _color("rim.color", "Rim colour", "Colour of the light along outlines."),
    Control(
        "rim.power",
        "atmosphere",
        "Rim exponent",
        low=POWERS[0],
        high=POWERS[1],
        whole=True,
        help="From a wide rim to a narrow one.",
    ),
    Control("fog.on", "atmosphere", "Fog", "switch", help=_SETTINGS["fog"].text),
    _color("fog.color", "Fog colour", "Colour of the fog."),
    _length("fog.near", "atmosphere", "Fog from", 0, 1000, reach=(0, 10), help="Distance at which the fog begins."),
    _length("fog.far", "atmosphere", "Fog to", 0, 1000, reach=(0, 10), help="Distance at which it hides everything."),
    _set("tone.exposure", "tone", "Exposure", reach=(0, 4)),
    _set("tone.filmic", "tone", "Filmic"),
    _set("tone.gamma", "tone", "Linear light"),
    _set("surface.shading", "material", "Shading"),
    _set("surface.color", "material", "Colour", none="its own colours"),
    _set("surface.ambient", "material", "Ambient", reach=(0, 2)),
    _set("surface.diffuse", "material", "Diffuse", reach=(0, 2)),
    _set("surface.specular", "material", "Specular", reach=(0, 2)),
    _set("surface.shininess", "material", "Shininess"),
    _set("surface.emission", "material", "Emission"),
    _set("surface.opacity", "material", "Opacity"),
    *(
        _set(f"opacities.{number}", "material", f"Opacity of object {number + 1}", "opacity", none="as all")
        for number in range(MAX_OPACITIES)
    ),
    _set("background.top", "background", "Top", "background", help="Colour at the top of the picture."),
    _set("background.bottom", "background", "Bottom", "background", help="Colour at the bottom of the picture."),
    _set("cull", "drawing", "Cull back faces", help="Faster; correct for closed objects."),
    _set("wireframe", "drawing", "Wireframe"),
    _set("invert", "drawing", "Invert"),
    _set("antialias", "drawing", "Anti-aliasing"),
    _set("size.width", "size", "Width", "size", high=MAX_SIDE, reach=(16, 512), help="Width of the picture."),
    _set("size.height", "size", "Height", "size", high=MAX_SIDE, reach=(16, 512), help="Height of the picture."),
)

#: The controls of the first light; see `lamp_controls`.
_LAMP: tuple[Control, ...] = (
    Control(
        "lights.0.kind", "lights", "Kind", "choice", choices=tuple((each, each.capitalize()) for each in LIGHT_KINDS)
    ),
    _angle("lights.0.azimuth", "lights", "Azimuth", "Angle at which the light stands to the right of the front."),
    Control(
        "lights.0.elevation",
        "lights",
        "Elevation",
        low=-90,
        high=90,
        unit="°",
        help="Angle at which the light stands above the horizon.",
    ),
    _length(
        "lights.0.distance",
        "lights",
        "Distance",
        0,
        1000,
        reach=(0.2, 20),
        help="Distance of the light from the middle of the object.",
    ),
    Control("lights.0.color", "lights", "Colour", "color"),
    *_places("lights.0.target", "lights", ("Points at, right", "Points at, up", "Points at, forward"), 1000),
    Control(
        "lights.0.inner_angle",
        "lights",
        "Full light",
        high=180,
        unit="°",
        reach=(0, 90),
        help=f"Angle from the direction of the light up to which it is at full strength (default: {INNER_ANGLE:g}).",
    ),
    Control(
        "lights.0.outer_angle",
        "lights",
        "No light",
        high=180,
        unit="°",
        reach=(0, 90),
        help=f"Angle from the direction of the light at which it has faded to nothing (default: {OUTER_ANGLE:g}).",
    ),
)


def lamp_controls(number: int) -> tuple[Control, ...]:
    """Return the controls of a light. number: from 0."""
    return tuple(replace(control, path=control.path.replace("0", str(number), 1)) for control in _LAMP)


_BY_PATH = {
    each.path: each for each in (*CONTROLS, *(each for number in range(MAX_LIGHTS) for each in lamp_controls(number)))
}


def control(path: str) -> Control:
    """Return the control of a path. KeyError if there is none."""
    return _BY_PATH[path]


# ---- checks ----


def tidy(value: float) -> float:
    """Return a number rounded to 6 significant digits, and 0 for rounding errors about 0."""
    return 0.0 if abs(value) < 1e-9 else float(f"{value:.{DIGITS}g}")


def within(path: str, value: float) -> float:
    """Return the nearest number that a control takes, rounded to 6 significant digits."""
    of = control(path)
    return tidy(min(max(value, of.low), of.high))


def around(degrees: float) -> float:
    """Return an angle from -180 to 180."""
    return degrees if -180 <= degrees <= 180 else (degrees + 180) % 360 - 180


def check_fields(part: Any, path: str, name: str, optional: bool = False) -> None:
    """Check all fields of a frozen dataclass and convert them to their types. InputError names the wrong one.

    path: of the part in the state. name: of the part in messages. optional: whether None is allowed.
    """
    for field in fields(part):
        label = f"the {field.name} of the {name}"
        value = getattr(part, field.name)
        if f"{path}.{field.name}.x" in _BY_PATH:
            if not isinstance(value, list | tuple) or len(value) != 3:
                raise InputError(f"{label} must be 3 numbers, not {value!r:.60}")
            axes = [control(f"{path}.{field.name}.{axis}") for axis in AXES]
            checked: Any = tuple(_number(each, label, axis) for each, axis in zip(value, axes, strict=True))
        else:
            checked = checked_value(value, control(f"{path}.{field.name}"), label, optional)
        object.__setattr__(part, field.name, checked)


def checked_value(value: Any, of: Control, label: str, optional: bool) -> Any:
    """Return a value that a control takes, in its type. InputError if it does not take it."""
    if value is None and optional:
        return None
    if of.kind == "switch":
        if not isinstance(value, bool):
            raise InputError(f"{label} must be true or false, not {value!r:.60}")
        return value
    if of.kind == "choice":
        choices = tuple(each for each, _ in of.choices)
        if not isinstance(value, str) or value not in choices:
            raise InputError(f"{label} must be one of {', '.join(choices)}, not {value!r:.60}")
        return choice(value, label, choices)
    if of.kind == "color":
        if not isinstance(value, str) or len(value) != 7:
            raise InputError(f"{label} must be a colour #rrggbb, not {value!r:.60}")
        return "#{:02x}{:02x}{:02x}".format(*color(value, label))
    return _number(value, label, of)


def _number(value: object, label: str, of: Control) -> float:
    right = f"a {'whole ' if of.whole else ''}number from {of.low:g} to {of.high:g}"
    if not isinstance(value, int | float) or isinstance(value, bool) or not of.low <= value <= of.high:
        raise InputError(f"{label} must be {right}, not {value!r:.60}")
    if not of.whole:
        return float(value) + 0.0  # no -0.0
    if value % 1:
        raise InputError(f"{label} must be {right}, not {value!r:.60}")
    return int(value)
