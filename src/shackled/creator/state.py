"""All that a visitor may choose about a picture, as one small immutable value.

None stands for what the source says by itself; so a state that nobody has touched is the source's own scene, to the
byte. Lengths are in radii of the source, and places are seen from its middle, so that the same numbers look alike for
objects of any size. Angles are in degrees, colours "#rrggbb" in small letters.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, fields, is_dataclass
from typing import Any, Literal, cast

from ..checks import choice
from ..errors import InputError
from .checking import check_field, check_fields
from .controls import MAX_LAMPS, control

Vector = tuple[float, float, float]
Projection = Literal["perspective", "orthographic"]
Shading = Literal["unlit", "flat", "smooth"]
LampKind = Literal["directional", "point"]


@dataclass(frozen=True)
class Source:
    """What is drawn.

    kind "piece": a piece of a dataset, by its name, which may be "genesis/" and a seed. "upload": a file that was
    handed in, by the SHA-256 of its bytes in 64 hexadecimal digits.
    """

    kind: Literal["piece", "upload"]
    name: str

    def __post_init__(self) -> None:
        choice(self.kind, "the kind of a source", ("piece", "upload"))
        pattern = r"[0-9a-z/-]{1,80}" if self.kind == "piece" else r"[0-9a-f]{64}"
        if not isinstance(self.name, str) or not re.fullmatch(pattern, self.name):
            right = "the name of a piece such as teapot" if self.kind == "piece" else "64 hexadecimal digits"
            raise InputError(f"the name of a source must be {right}, not {self.name!r:.60}")


@dataclass(frozen=True)
class Pose:
    """How the object is moved: scaled, turned about the x, then y, then z axis, each about its middle, then shifted."""

    position: Vector = (0.0, 0.0, 0.0)
    rotation: Vector = (0.0, 0.0, 0.0)
    scale: float = 1.0

    def __post_init__(self) -> None:
        check_fields(self, "pose", "object")


@dataclass(frozen=True)
class Orbit:
    """A camera that looks at `target` from `distance`, to the right of the front (+z) by `azimuth` and above the
    horizon by `elevation`. fov: from bottom to top; an orthographic camera shows as much as a perspective one would at
    the target.
    """

    target: Vector = (0.0, 0.0, 0.0)
    distance: float = 3.0
    azimuth: float = 30.0
    elevation: float = 20.0
    roll: float = 0.0
    projection: Projection = "perspective"
    fov: float = 50.0

    def __post_init__(self) -> None:
        check_fields(self, "camera", "camera")


@dataclass(frozen=True)
class Lamp:
    """A light, as seen from the middle of the source. `distance` matters to point lights only."""

    kind: LampKind = "directional"
    azimuth: float = 0.0
    elevation: float = 30.0
    distance: float = 3.0
    color: str = "#ffffff"

    def __post_init__(self) -> None:
        check_fields(self, "lights.0", "light")


@dataclass(frozen=True)
class Surface:
    """The material of all objects, as far as it is not their own; `color` in place of the mesh's colours."""

    shading: Shading | None = None
    ambient: float | None = None
    diffuse: float | None = None
    specular: float | None = None
    shininess: int | None = None
    color: str | None = None

    def __post_init__(self) -> None:
        check_fields(self, "surface", "material", optional=True)


@dataclass(frozen=True)
class Backdrop:
    """A gradient; one colour where both are the same."""

    top: str = "#000000"
    bottom: str = "#000000"

    def __post_init__(self) -> None:
        check_fields(self, "background", "background")


@dataclass(frozen=True)
class Size:
    """Of the picture, in pixels."""

    width: int = 128
    height: int = 128

    def __post_init__(self) -> None:
        check_fields(self, "size", "picture")


@dataclass(frozen=True)
class State:
    """A picture. lights_follow: lights stay where they are for the viewer when the camera moves.

    max_triangles: meshes of more are simplified.
    """

    source: Source
    pose: Pose = Pose()
    camera: Orbit | None = None
    lights: tuple[Lamp, ...] | None = None
    lights_follow: bool = False
    ambient_light: str | None = None
    surface: Surface = Surface()
    background: Backdrop | None = None
    cull: bool | None = None
    wireframe: bool | None = None
    invert: bool | None = None
    size: Size | None = None
    max_triangles: int | None = None

    def __post_init__(self) -> None:
        if self.lights is not None:
            object.__setattr__(self, "lights", tuple(self.lights))
            if len(self.lights) > MAX_LAMPS:
                raise InputError(f"a picture has up to {MAX_LAMPS} lights, not {len(self.lights)}")
        for name in ("lights_follow", "cull", "wireframe", "invert"):
            value = getattr(self, name)
            if not isinstance(value, bool) and not (value is None and name != "lights_follow"):
                raise InputError(f"{name} must be true or false, not {value!r:.60}")
        for name in ("ambient_light", "max_triangles"):
            check_field(self, name, control(name), f"the field {name}", optional=True)


# ---- as JSON ----


def to_document(state: State) -> dict[str, Any]:
    """The state as JSON has it, without what is as it would be anyhow."""
    return cast(dict[str, Any], _plain(state))


def from_document(document: object) -> State:
    """The state of what `to_document` gave. InputError, which names the place, for anything else."""
    keys = _keys(document, "the state", State)
    made = {name: _part(name, value) for name, value in keys.items()}
    if "source" not in made:
        raise InputError("the state must have a source")
    return State(**made)


_PARTS: dict[str, type] = {
    "source": Source,
    "pose": Pose,
    "camera": Orbit,
    "surface": Surface,
    "background": Backdrop,
    "size": Size,
}


def _part(name: str, value: object) -> Any:
    if name == "lights":
        if not isinstance(value, list):
            raise InputError(f"lights must be a list, not {value!r:.60}")
        return tuple(Lamp(**_keys(each, f"lights[{i}]", Lamp)) for i, each in enumerate(value[: MAX_LAMPS + 1]))
    if name in _PARTS:
        keys = _keys(value, name, _PARTS[name])
        if name == "source" and set(keys) != {"kind", "name"}:
            raise InputError("source must have a kind and a name")
        return _PARTS[name](**keys)
    return value


def _keys(value: object, where: str, kind: type) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise InputError(f"{where} must be a table, not {value!r:.60}")
    known = [field.name for field in fields(kind)]
    for key in value:
        if key not in known:
            raise InputError(f"{where} has an unknown key {key!r:.60}; known are {', '.join(known)}")
    return value


def _plain(value: Any) -> Any:
    if is_dataclass(value) and not isinstance(value, type):
        result = {}
        for field in fields(value):
            each = getattr(value, field.name)
            if each is not None and each != field.default:
                result[field.name] = _plain(each)
        return result
    return [_plain(each) for each in value] if isinstance(value, tuple) else value
