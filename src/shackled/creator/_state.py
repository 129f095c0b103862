"""All settings of a picture, as one small immutable value.

None stands for the source's own value, so that an untouched state is exactly the scene of its source. Lengths are in
radii of the source and positions relative to its middle, so that equal numbers look alike for objects of any size.
Angles are in degrees, colours "#rrggbb" in lower case.
"""

from __future__ import annotations

import hashlib
import json
import re
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any, Literal, cast

from ..checks import choice
from ..errors import InputError
from ..scene import INNER_ANGLE, MAX_LIGHTS, OUTER_ANGLE, LightKind, Projection, Shading
from ._controls import MAX_OPACITIES, check_fields, checked_value, control

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class Source:
    """The scene that is changed.

    kind "piece": a piece of a dataset by its name, or "genesis/" and a seed. "upload": an uploaded file by the SHA-256
    of its bytes, 64 hexadecimal digits.
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
    """A transformation of all objects: scaled, rotated about x, then y, then z through their middle, then moved."""

    position: Vector = (0.0, 0.0, 0.0)
    rotation: Vector = (0.0, 0.0, 0.0)
    scale: float = 1.0

    def __post_init__(self) -> None:
        check_fields(self, "pose", "object")


@dataclass(frozen=True)
class Orbit:
    """A camera that looks at `target` from `distance`, `azimuth` to the right of the front (+z) and `elevation` above
    the horizon. fov: vertical; an orthographic camera shows what a perspective one would show at the target.
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
    """A light, relative to the middle of the source.

    distance: of point and spot lights. target, inner_angle, outer_angle: of spot lights; the point at which the light
    points, and the angles of its cone as in `shackled.Light`.
    """

    kind: LightKind = "directional"
    azimuth: float = 0.0
    elevation: float = 30.0
    distance: float = 3.0
    color: str = "#ffffff"
    target: Vector = (0.0, 0.0, 0.0)
    inner_angle: float = INNER_ANGLE
    outer_angle: float = OUTER_ANGLE

    def __post_init__(self) -> None:
        check_fields(self, "lights.0", "light")


@dataclass(frozen=True)
class Sky:
    """Light from above and below; without effect unless it is on."""

    on: bool = False
    sky: str = "#b4c8e6"
    ground: str = "#3c342c"

    def __post_init__(self) -> None:
        check_fields(self, "hemisphere", "sky light")


@dataclass(frozen=True)
class Outline:
    """Light along outlines; without effect unless it is on."""

    on: bool = False
    color: str = "#ffffff"
    power: int = 3

    def __post_init__(self) -> None:
        check_fields(self, "rim", "rim")


@dataclass(frozen=True)
class Haze:
    """Fog between two distances from the eye; without effect unless it is on."""

    on: bool = False
    color: str = "#8892a2"
    near: float = 2.0
    far: float = 4.0

    def __post_init__(self) -> None:
        check_fields(self, "fog", "fog")


@dataclass(frozen=True)
class Curve:
    """The conversion of light to colours."""

    exposure: float = 1.0
    filmic: bool = False
    gamma: bool = False

    def __post_init__(self) -> None:
        check_fields(self, "tone", "tone")


@dataclass(frozen=True)
class Surface:
    """The material of all objects, where it replaces their own; `color` replaces the colours of the meshes."""

    shading: Shading | None = None
    ambient: float | None = None
    diffuse: float | None = None
    specular: float | None = None
    shininess: int | None = None
    color: str | None = None
    opacity: float | None = None
    emission: str | None = None

    def __post_init__(self) -> None:
        check_fields(self, "surface", "material", optional=True)


@dataclass(frozen=True)
class Backdrop:
    """A vertical gradient; one colour if both are equal."""

    top: str = "#000000"
    bottom: str = "#000000"

    def __post_init__(self) -> None:
        check_fields(self, "background", "background")


@dataclass(frozen=True)
class Size:
    """Size of the picture in pixels."""

    width: int = 128
    height: int = 128

    def __post_init__(self) -> None:
        check_fields(self, "size", "picture")


@dataclass(frozen=True)
class State:
    """All settings of a picture.

    lights_follow: whether the lights move with the camera. opacities: of the first objects; None takes that of the
    surface. max_triangles: larger meshes are simplified to this number.
    """

    source: Source
    pose: Pose = Pose()
    camera: Orbit | None = None
    lights: tuple[Lamp, ...] | None = None
    lights_follow: bool = False
    ambient_light: str | None = None
    hemisphere: Sky | None = None
    rim: Outline | None = None
    fog: Haze | None = None
    tone: Curve | None = None
    surface: Surface = Surface()
    opacities: tuple[float | None, ...] = (None,) * MAX_OPACITIES
    background: Backdrop | None = None
    cull: bool | None = None
    wireframe: bool | None = None
    invert: bool | None = None
    antialias: bool | None = None
    size: Size | None = None
    max_triangles: int | None = None

    def __post_init__(self) -> None:
        if self.lights is not None:
            object.__setattr__(self, "lights", tuple(self.lights))
            if len(self.lights) > MAX_LIGHTS:
                raise InputError(f"a picture has up to {MAX_LIGHTS} lights, not {len(self.lights)}")
        if not isinstance(self.opacities, list | tuple) or len(self.opacities) != MAX_OPACITIES:
            raise InputError(f"opacities must be {MAX_OPACITIES} numbers or null, not {self.opacities!r:.60}")
        opacities = [
            checked_value(value, control(f"opacities.{i}"), f"opacities[{i}]", optional=True)
            for i, value in enumerate(self.opacities)
        ]
        object.__setattr__(self, "opacities", tuple(opacities))
        for name in ("lights_follow", "ambient_light", "cull", "wireframe", "invert", "antialias", "max_triangles"):
            value = checked_value(getattr(self, name), control(name), name, optional=name != "lights_follow")
            object.__setattr__(self, name, value)


# ---- as JSON ----


def to_document(state: State) -> dict[str, Any]:
    """Return the state as a JSON object, without default values."""
    return cast(dict[str, Any], _plain(state))


def scene_key(state: State) -> str:
    """Return a digest of all settings but those that turning, moving and zooming change."""
    camera = state.camera and replace(state.camera, azimuth=0.0, elevation=0.0, distance=1.0, target=(0.0, 0.0, 0.0))
    document = json.dumps(to_document(replace(state, camera=camera)))
    return hashlib.sha256(document.encode()).hexdigest()[:32]


def from_document(document: object) -> State:
    """Return the state of an object as made by `to_document`. InputError, which names the key, for anything else."""
    keys = _keys(document, "the state", State)
    made = {name: _part(name, value) for name, value in keys.items()}
    if "source" not in made:
        raise InputError("the state must have a source")
    return State(**made)


_PARTS: dict[str, type] = {
    "source": Source,
    "pose": Pose,
    "camera": Orbit,
    "hemisphere": Sky,
    "rim": Outline,
    "fog": Haze,
    "tone": Curve,
    "surface": Surface,
    "background": Backdrop,
    "size": Size,
}


def _part(name: str, value: object) -> Any:
    if name == "lights":
        if not isinstance(value, list):
            raise InputError(f"lights must be a list, not {value!r:.60}")
        return tuple(Lamp(**_keys(each, f"lights[{i}]", Lamp)) for i, each in enumerate(value[: MAX_LIGHTS + 1]))
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
