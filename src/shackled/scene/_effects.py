"""Backgrounds, and effects of a whole scene: light from the sky and along outlines, fog, and how light becomes colours.

`Scene.extensions` has a record for each effect. Scenes with any of them are antialiased.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from attrs import Factory, field, frozen

from ..base.checks import Color, color, flag, instance, number, whole
from ..base.values import checked, with_names
from ..errors import InputError

#: The range of the exponent of a rim, and that of exposures.
POWERS = (1, 16)
EXPOSURES = (0, 64)
#: What removes an effect, as a setting of a look.
NONE = "none"

Effect = TypeVar("Effect")


@frozen(field_transformer=with_names)
class Hemisphere:
    """Light from everywhere above and below, in proportion to the ambient coefficients of materials.

    A surface that faces up (+y) has the light of the sky, one that faces down that of the ground, others a mixture. It
    is added to the ambient light of the scene.
    """

    sky: Color = field(converter=color, metadata=checked("the sky of a hemisphere"))
    ground: Color = field(default=(0, 0, 0), converter=color, metadata=checked("the ground of a hemisphere"))


@frozen(field_transformer=with_names)
class Rim:
    """Light along the outlines of objects, where the surface turns away from the viewer.

    power: 1 (wide) to 16 (narrow), a whole number.
    """

    color: Color = field(converter=color, metadata=checked("the colour of a rim"))
    power: int = field(default=3, converter=whole, metadata=checked("the power of a rim", *POWERS))


@frozen(field_transformer=with_names)
class Fog:
    """Fog, through which nothing is seen from some distance on; the background has none.

    near, far: distances along the line of sight in world units, at least 0: where the fog begins, and where it hides
    everything.
    """

    color: Color = field(converter=color, metadata=checked("the colour of the fog"))
    near: float = field(converter=number, metadata=checked("the near distance of the fog", 0))
    far: float = field(converter=number, metadata=checked("the far distance of the fog", 0))

    def __attrs_post_init__(self) -> None:
        """Check the distances against each other."""
        if self.near >= self.far:
            raise InputError(
                f"the near distance of the fog, {self.near:g}, must be below its far distance, {self.far:g}"
            )


@frozen(field_transformer=with_names)
class Tone:
    """How the light of surfaces becomes colours.

    exposure: a factor of all light, 0..64.
    filmic: whether bright light is compressed as on film, instead of cut off at white.
    gamma: whether light is added up in linear space, as in nature, instead of as sRGB values.
    """

    exposure: float = field(default=1.0, converter=number, metadata=checked("the exposure", *EXPOSURES))
    filmic: bool = field(default=False, converter=flag, metadata=checked("filmic of a tone"))
    gamma: bool = field(default=False, converter=flag, metadata=checked("gamma of a tone"))


@frozen(field_transformer=with_names)
class Background:
    """A vertical gradient from the colour of the top row to that of the bottom row, by default the same.

    Colours are red, green, blue, 0..255; also given as floats 0..1, "#rrggbb" or a name.
    """

    top: Color = field(default=(0, 0, 0), converter=color, metadata=checked("the background colour"))
    bottom: Color = field(
        default=Factory(lambda self: self.top, takes_self=True),
        converter=color,
        metadata=checked("the colour at the bottom of the background"),
    )


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
    """Return a tone, or None."""
    return None if value is None else instance(value, "the tone of a scene", Tone)
