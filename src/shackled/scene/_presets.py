"""Presets: whole looks by name, of surface, lights, background and drawing, from presets.toml. They leave meshes,
culling, camera, size, effects and ground as they are.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Mapping
from importlib.resources import files
from typing import Any

from attrs import Factory, field, frozen
from attrs.converters import optional

from ..base import checks
from ..base.checks import Color
from ._effects import Background, background_of
from ._light import WHITE, Light
from ._object import Material
from ._staging import view_axes


@frozen
class Lamp:
    """A directional light that stands so many degrees to the right of the camera, and above the horizon."""

    azimuth: float
    elevation: float
    color: Color = field(default=WHITE, converter=checks.color)


@frozen
class Preset:
    """A look. material: without texture and emission, which stay. color: of all meshes; None for their own."""

    name: str
    help: str
    material: Material
    lamps: tuple[Lamp, ...]
    background: Background = field(converter=background_of)
    color: Color | None = field(default=None, converter=optional(checks.color))
    ambient_light: Color = field(default=WHITE, converter=checks.color)
    wireframe: bool = False
    invert: bool = False
    title: str = field(default=Factory(lambda self: self.name.title(), takes_self=True))

    @property
    def settings(self) -> dict[str, Any]:
        """What it sets, but for lights, by the keywords of a look."""
        surface = ("shading", "ambient", "diffuse", "specular", "shininess")
        own = ("background", "ambient_light", "wireframe", "invert", *(["color"] if self.color else []))
        return {name: getattr(self.material, name) for name in surface} | {name: getattr(self, name) for name in own}

    def lights(self, azimuth: float, shadow: bool = False) -> list[Light]:
        """Return the lights for a camera that stands at an azimuth. shadow: whether the first one casts shadows."""
        return [
            Light.directional(
                toward=view_axes(each.azimuth + azimuth, each.elevation)[2],
                color=each.color,
                shadow=shadow and number == 0,
            )
            for number, each in enumerate(self.lamps)
        ]


def _preset(name: str, material: Mapping[str, Any], lamps: Iterable[Iterable[Any]], **fields: Any) -> Preset:
    return Preset(name, material=Material(**material), lamps=tuple(Lamp(*each) for each in lamps), **fields)


_FIELDS = tomllib.loads(files(__package__).joinpath("presets.toml").read_text("utf-8"))
PRESETS = tuple(_preset(name, **fields) for name, fields in _FIELDS.items())


def preset_of(name: str) -> Preset:
    """Return the preset of a name that is known."""
    return next(each for each in PRESETS if each.name == name)
