"""Backgrounds, and effects of a whole scene: light from the sky and along outlines, fog, and how light becomes colours.

`Scene.extensions` has a record for each effect. Scenes with any of them are antialiased.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from attrs import Factory, field, frozen

from ..base.checks import Color, color, flag, instance, number, whole
from ..errors import InputError
from ._table import USUAL, from_table

#: What removes an effect, as a setting of a look.
NONE = "none"

Effect = TypeVar("Effect")


@frozen(field_transformer=from_table)
class Hemisphere:
    """Light from everywhere above and below, in proportion to the ambient coefficients of materials.

    A surface that faces up (+y) has the light of the sky, one that faces down that of the ground, others a mixture. It
    is added to the ambient light of the scene.
    """

    sky: Color = field(converter=color)
    ground: Color = field(default=USUAL, converter=color)


@frozen(field_transformer=from_table)
class Rim:
    """Light along the outlines of objects, where the surface turns away from the viewer.

    power: 1 (wide) to 16 (narrow), a whole number.
    """

    color: Color = field(converter=color)
    power: int = field(default=USUAL, converter=whole)


@frozen(field_transformer=from_table)
class Fog:
    """Fog, through which nothing is seen from some distance on; the background has none.

    near, far: distances along the line of sight in world units, at least 0: where the fog begins, and where it hides
    everything.
    """

    color: Color = field(converter=color)
    near: float = field(converter=number)
    far: float = field(converter=number)

    def __attrs_post_init__(self) -> None:
        if self.near >= self.far:
            raise InputError(
                f"the near distance of the fog, {self.near:g}, must be below its far distance, {self.far:g}"
            )


@frozen(field_transformer=from_table)
class Tone:
    """How the light of surfaces becomes colours.

    exposure: a factor of all light, 0..64.
    filmic: whether bright light is compressed as on film, instead of cut off at white.
    gamma: whether light is added up in linear space, as in nature, instead of as sRGB values.
    """

    exposure: float = field(default=USUAL, converter=number)
    filmic: bool = field(default=USUAL, converter=flag)
    gamma: bool = field(default=USUAL, converter=flag)


@frozen(field_transformer=from_table)
class Background:
    """A vertical gradient from the colour of the top row to that of the bottom row, by default the same.

    Colours are red, green, blue, 0..255; also given as floats 0..1, "#rrggbb" or a name.
    """

    top: Color = field(default=USUAL, converter=color)
    bottom: Color = field(default=Factory(lambda self: self.top, takes_self=True), converter=color)


# ---- from what may be given in their place ----


def hemisphere_of(value: Any, name: str = "the hemisphere") -> Hemisphere | None:
    """Return a hemisphere, given as itself, as one colour, or as two, (sky, ground)."""
    return _made(Hemisphere, value, name)


def rim_of(value: Any, name: str = "the rim") -> Rim | None:
    """Return a rim, given as itself, as a colour, or as (colour, power)."""
    return _made(Rim, value, name)


def background_of(value: Any, name: str = "the background colour") -> Background | None:
    """Return a background, given as itself, as one colour, or as two, (top, bottom)."""
    return _made(Background, value, name)


def _made(kind: Callable[..., Effect], value: Any, name: str) -> Effect | None:
    if value is None or isinstance(value, kind):  # type: ignore[arg-type]
        return value
    first, *more = value if isinstance(value, list | tuple) and len(value) == 2 else [value]
    return kind(color(first, name), *more)


def fog_of(value: Any, name: str = "the fog") -> Fog | None:
    """Return fog, given as itself or as (colour, near, far)."""
    if isinstance(found := fog_or_color(value, name), tuple):
        raise InputError(f"{name} must be a shackled.Fog or (colour, near, far), not {value!r:.60}")
    return found


def fog_or_color(value: Any, name: str) -> Fog | Color | None:
    """Return fog as `fog_of` does, or the colour of fog whose distances are not given."""
    if value is None or isinstance(value, Fog):
        return value
    if isinstance(value, list | tuple) and len(value) == 3 and hasattr(value[0], "__len__"):
        return Fog(color(value[0], name), *value[1:])
    return color(value, name)


def tone_of(value: Tone | None) -> Tone | None:
    return None if value is None else instance(value, "the tone of a scene", Tone)
