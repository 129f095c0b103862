"""What can be changed about a picture: label, unit, range, step and default of each value, for the page to show."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

Kind = Literal["number", "choice", "switch", "color"]


@dataclass(frozen=True)
class Control:
    """One value of the state.

    path: where it stands, as `change.get` and `change.put` take it. group: the panel in which it belongs.
    low, high, step, unit: of numbers; low and high are what the state takes. logarithmic: equal ways of a slider are
    equal ratios. turn: an angle that goes round, so that 181 is -179. whole: no fractions.
    choices: (value, label) of a choice. optional: None is a value, which is the source's own; none says what that is
    called. help: one sentence.
    """

    path: str
    group: str
    label: str
    kind: Kind
    low: float = 0
    high: float = 1
    step: float = 1
    unit: str = ""
    logarithmic: bool = False
    turn: bool = False
    whole: bool = False
    choices: tuple[tuple[str, str], ...] = ()
    optional: bool = False
    none: str = ""
    help: str = ""


#: The panels, in their order: key and title.
GROUPS = (
    ("object", "Object"),
    ("camera", "Camera"),
    ("lights", "Lights"),
    ("material", "Material"),
    ("background", "Background"),
    ("drawing", "Drawing"),
    ("size", "Size"),
)

MAX_LAMPS = 4
MAX_SIDE = 1024

_SHADINGS = (("unlit", "Unlit"), ("flat", "Flat"), ("smooth", "Smooth"))
_PROJECTIONS = (("perspective", "Perspective"), ("orthographic", "Orthographic"))
_KINDS = (("directional", "Directional"), ("point", "Point"))


def _angle(path: str, group: str, label: str, help: str = "") -> Control:
    return Control(path, group, label, "number", -180, 180, 1, "°", turn=True, help=help)


def _place(path: str, group: str, label: str, reach: float, help: str) -> Control:
    return Control(path, group, label, "number", -reach, reach, 0.01, "radii", help=help)


_MOVE = "One unit is the radius of the object."

CONTROLS: tuple[Control, ...] = (
    _place("pose.position.x", "object", "Move right", 100, _MOVE),
    _place("pose.position.y", "object", "Move up", 100, _MOVE),
    _place("pose.position.z", "object", "Move forward", 100, _MOVE),
    _angle("pose.rotation.x", "object", "Tilt", "About the x axis, which points right."),
    _angle("pose.rotation.y", "object", "Turn", "About the y axis, which points up."),
    _angle("pose.rotation.z", "object", "Roll", "About the z axis, which points at the front."),
    Control("pose.scale", "object", "Scale", "number", 0.01, 100, 0.01, "times", logarithmic=True),
    Control(
        "max_triangles",
        "object",
        "At most",
        "number",
        4,
        65535,
        1,
        "triangles",
        logarithmic=True,
        whole=True,
        optional=True,
        none="all",
        help="Meshes of more are simplified.",
    ),
    _angle("camera.azimuth", "camera", "Azimuth", "To the right of the front."),
    Control("camera.elevation", "camera", "Elevation", "number", -90, 90, 1, "°", help="Above the horizon."),
    _angle("camera.roll", "camera", "Roll"),
    Control("camera.distance", "camera", "Distance", "number", 0.01, 1000, 0.01, "radii", logarithmic=True),
    Control("camera.projection", "camera", "Projection", "choice", choices=_PROJECTIONS),
    Control("camera.fov", "camera", "Field of view", "number", 1, 150, 1, "°", help="From bottom to top."),
    _place("camera.target.x", "camera", "Look at, right", 1000, _MOVE),
    _place("camera.target.y", "camera", "Look at, up", 1000, _MOVE),
    _place("camera.target.z", "camera", "Look at, forward", 1000, _MOVE),
    Control(
        "lights_follow",
        "lights",
        "Lights move with the camera",
        "switch",
        help="They stay where they are for the viewer.",
    ),
    Control("ambient_light", "lights", "Light from everywhere", "color"),
    Control("surface.shading", "material", "Shading", "choice", choices=_SHADINGS),
    Control(
        "surface.color",
        "material",
        "Colour",
        "color",
        optional=True,
        none="its own colours",
        help="One colour for all of the object.",
    ),
    Control("surface.ambient", "material", "Ambient", "number", 0, 4, 0.01),
    Control("surface.diffuse", "material", "Diffuse", "number", 0, 4, 0.01),
    Control("surface.specular", "material", "Specular", "number", 0, 4, 0.01),
    Control("surface.shininess", "material", "Shininess", "number", 1, 128, 1, whole=True),
    Control("background.top", "background", "Top", "color"),
    Control("background.bottom", "background", "Bottom", "color"),
    Control("cull", "drawing", "Leave out back faces", "switch", help="Quicker; right for closed objects."),
    Control("wireframe", "drawing", "Wireframe", "switch", help="The edges only."),
    Control("invert", "drawing", "Invert", "switch", help="Each value becomes 255 minus itself."),
    Control("size.width", "size", "Width", "number", 1, MAX_SIDE, 1, "pixels", whole=True),
    Control("size.height", "size", "Height", "number", 1, MAX_SIDE, 1, "pixels", whole=True),
)

#: Those of one lamp; their paths are of the first, see `lamp_controls`.
_LAMP: tuple[Control, ...] = (
    Control("lights.0.kind", "lights", "Kind", "choice", choices=_KINDS),
    _angle("lights.0.azimuth", "lights", "Azimuth", "To the right of the front."),
    Control("lights.0.elevation", "lights", "Elevation", "number", -90, 90, 1, "°", help="Above the horizon."),
    Control(
        "lights.0.distance",
        "lights",
        "Distance",
        "number",
        0,
        1000,
        0.01,
        "radii",
        help="Of a point light, from the middle of the object.",
    ),
    Control("lights.0.color", "lights", "Colour", "color"),
)


def lamp_controls(number: int) -> tuple[Control, ...]:
    """The controls of one of the lights, from 0."""
    return tuple(replace(control, path=control.path.replace("0", str(number), 1)) for control in _LAMP)


def control(path: str) -> Control:
    """The control of a path; KeyError if there is none."""
    return _BY_PATH[path]


_BY_PATH = {
    each.path: each for each in (*CONTROLS, *(each for number in range(MAX_LAMPS) for each in lamp_controls(number)))
}
