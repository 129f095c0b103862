"""Presets: whole looks by name, of surface, lights, background and drawing. They leave meshes, culling, camera, size,
effects and ground as they are.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from attrs import Factory, field, frozen
from attrs.converters import optional

from .. import checks
from ..checks import Color
from ._effects import Background, background_of
from ._light import WHITE, Light
from ._object import Material
from ._staging import view_axes


@frozen
class Lamp:
    """A directional light that stands relative to the camera, so that a preset does not depend on the view.

    azimuth, elevation: where it stands, in degrees to the right of the camera, and above the horizon.
    """

    azimuth: float
    elevation: float
    color: Color = field(default=WHITE, converter=checks.color)


@frozen
class Preset:
    """A look.

    material: without texture and emission, which stay. color: of all meshes; None for their own.
    """

    name: str
    help: str
    material: Material
    lamps: Sequence[Lamp]
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


PRESETS = (
    Preset(
        "studio",
        "Its own colours under one soft white light.",
        Material("smooth", 0.32, 0.72, 0.25, 24),
        [Lamp(-30, 42)],
        ("#e9edf2", "#9aa5b4"),
    ),
    Preset(
        "clay",
        "Terracotta on warm paper.",
        Material("smooth", 0.3, 0.8, 0.12, 8),
        [Lamp(-38, 50)],
        ("#f6ecdf", "#d8c3a9"),
        color="#c8674a",
        ambient_light="#ffeadb",
    ),
    Preset(
        "gold",
        "Polished metal in the dark.",
        Material("smooth", 0.22, 0.62, 0.95, 34),
        [Lamp(-35, 45, "#fff3d6"), Lamp(60, 10, "#ff9a3c")],
        ("#1c130a", "#4a3212"),
        color="#e0a52e",
        ambient_light="#ffd98a",
    ),
    Preset(
        "neon",
        "Cyan from the left, magenta from the right.",
        Material("smooth", 0.12, 0.85, 0.8, 40),
        [Lamp(-70, 15, "#00e5ff"), Lamp(70, 10, "#ff2bd6")],
        ("#070312", "#1d0b3a"),
        color="#d8dcff",
        ambient_light="#5a4bff",
    ),
    Preset(
        "noir",
        "One hard light from the side on black.",
        Material("smooth", 0.03, 1, 0.6, 30),
        [Lamp(-75, 25)],
        ("#000000", "#1b1b1b"),
        color="#dddddd",
    ),
    Preset(
        "sunset",
        "A low orange sun against a violet sky.",
        Material("flat", 0.34, 0.9, 0.35, 16),
        [Lamp(-60, 12, "#ff9b54"), Lamp(80, 40, "#5a63c8")],
        ("#2b1b52", "#ff8f5a"),
        ambient_light="#b9a4ff",
    ),
    Preset(
        "facets",
        "Every triangle is visible, as in a cut gem.",
        Material("flat", 0.2, 0.75, 0.85, 12),
        [Lamp(-40, 50), Lamp(65, -5, "#7d8cff")],
        ("#0f2027", "#2c5364"),
        color="#5fc7c1",
    ),
    Preset(
        "blueprint",
        "White lines on blue.",
        Material("unlit"),
        [],
        ("#0b3d91", "#072a66"),
        color="#e8f1ff",
        wireframe=True,
    ),
    Preset(
        "xray",
        "Light and dark are swapped.",
        Material("smooth", 0.1, 0.9, 0.2, 10),
        [Lamp(0, 0)],
        ("#f4f1ea", "#ffffff"),
        color="#f2e6dc",
        invert=True,
        title="X-ray",
    ),
    Preset("flat", "Unlit colours; lowest gas.", Material("unlit"), [], ("#f4f1ea", "#f4f1ea"), title="Unlit"),
)


def preset_of(name: str) -> Preset:
    """Return the preset of a name that is known."""
    return next(each for each in PRESETS if each.name == name)
