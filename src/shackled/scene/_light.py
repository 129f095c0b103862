"""Lights."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, TypeVar

from attrs import field, frozen
from numpy.typing import ArrayLike

from ..base.checks import Color, Floats, choice, color, flag, instance, number, optional_vector, vector
from ..base.synonyms import Given, with_synonyms
from ..base.values import Value, checked
from ..errors import InputError
from ._constants import MAX_LIGHTS
from ._fields import FIELDS, LightKind
from ._table import USUAL, from_table

#: Degrees, of a spot light whose angles are not given; as in glTF.
INNER_ANGLE, OUTER_ANGLE = (float(FIELDS["Light"][name].default) for name in ("inner_angle", "outer_angle"))
WHITE = (255, 255, 255)

Item = TypeVar("Item")


_TOWARD = "toward=, the way from the scene to the light, or direction=, the way in which its light travels"


def _of_words(given: Given) -> Given:
    """Return the fields of a light, whose vector may be given by what it is."""
    is_directional = given.get("kind") == "directional"
    if is_directional and "position" in given:
        raise InputError(f"a directional light has no position: give {_TOWARD}")
    given = {name: value for name, value in given.items() if name != "direction" or value is not None}
    names = ("toward", "direction", "vector") if is_directional else ("position", "vector")
    found = [name for name in names if name in given]
    if len(found) > 1:
        raise InputError(f"`{found[0]}` and `{found[1]}` of a light exclude each other: give one of them")
    if found:
        value = given.pop(found[0])
        given["vector"] = 0 - vector(value, "the direction of a light") if found == ["direction"] else value
    return given


@with_synonyms("toward", "position", read=_of_words)
@frozen(field_transformer=from_table)
class Light(Value):
    """One light; a scene has up to four. `Light.directional`, `Light.point` and `Light.spot` make one of each kind.

    kind: "directional", "point", or "spot", a point light that shines into a cone only.
    vector: (3,) float; the way from the scene to a directional light (any length but zero), the position of any other.
        Also given by the names of `Light.directional`, or as `position`.
    color: red, green, blue, 0..255; also given as floats 0..1, "#rrggbb" or a name.
    direction: (3,) float; where a spot light points, any length but zero; others have none.
    inner_angle, outer_angle: of a spot light, in degrees from its direction, 0..180: its light is full up to the inner
        angle and falls to zero at the outer one.
    shadow: whether objects cast shadows in its light; one light of a scene at most.
    """

    kind: LightKind = field(converter=choice)
    vector: Floats = field(converter=vector, metadata=checked("the direction or position of a light"))
    color: Color = field(default=USUAL, converter=color)
    direction: Floats | None = field(default=None, converter=optional_vector)
    inner_angle: float = field(default=USUAL, converter=number)
    outer_angle: float = field(default=USUAL, converter=number)
    shadow: bool = field(default=USUAL, converter=flag)

    def __attrs_post_init__(self) -> None:
        if self.kind == "directional" and not self.vector.any():
            raise InputError("the direction of a light must not be zero")
        if self.kind != "spot":
            if self.direction is not None or (self.inner_angle, self.outer_angle) != (INNER_ANGLE, OUTER_ANGLE):
                raise InputError(f"only a spot light has direction, inner_angle and outer_angle, not a {self.kind} one")
        elif self.direction is None:
            raise InputError("a spot light needs a direction")
        elif not self.direction.any():
            raise InputError("the direction of a spot light must not be zero")
        elif self.inner_angle > self.outer_angle:
            raise InputError(
                f"the inner_angle of a spot light, {self.inner_angle:g}, must not be above its outer_angle, "
                f"{self.outer_angle:g}"
            )

    @classmethod
    @with_synonyms()
    def directional(
        cls,
        *unnamed: object,
        toward: ArrayLike | None = None,
        direction: ArrayLike | None = None,
        color: ArrayLike | str = WHITE,
        shadow: bool = False,
    ) -> Light:
        """Return a light at infinity.

        toward: (3,) the way from the scene to the light. direction: (3,) the way in which its light travels, the
        opposite. One of them is needed, by its name.
        """
        if unnamed or (toward is None) == (direction is None):
            raise InputError(f"a directional light needs one of {_TOWARD}, by its name")
        given: Any = {"toward": toward} if direction is None else {"direction": direction}
        return cls("directional", color=color, shadow=shadow, **given)

    @classmethod
    @with_synonyms()
    def point(cls, position: ArrayLike, color: ArrayLike | str = WHITE, *, shadow: bool = False) -> Light:
        """Return a light that shines in all directions from a position, (3,) in the world; it does not fade."""
        return cls("point", position, color, shadow=shadow)

    @classmethod
    @with_synonyms()
    def spot(
        cls,
        position: ArrayLike,
        direction: ArrayLike,
        color: ArrayLike | str = WHITE,
        inner_angle: float = INNER_ANGLE,
        outer_angle: float = OUTER_ANGLE,
        *,
        shadow: bool = False,
    ) -> Light:
        """Return a light that shines from a position into a cone about a direction, (3,) each, angles in degrees."""
        return cls("spot", position, color, direction, inner_angle, outer_angle, shadow)


def lights_of(value: Light | Iterable[Light] | None) -> tuple[Light, ...]:
    """Return lights, given as one or as a list of up to four; None is replaced by the Scene."""
    if value is None:
        return value  # type: ignore[return-value]
    lights = parts_of([value] if isinstance(value, Light) else value, "lights", "a Light")
    if len(lights) > MAX_LIGHTS:
        raise InputError(f"a scene has up to {MAX_LIGHTS} lights, not {len(lights)}")
    return tuple(instance(part, f"lights[{index}] of a scene", Light) for index, part in enumerate(lights))


def parts_of(parts: Iterable[Item], name: str, kind: str) -> list[Item]:
    """Return parts of a scene as a list. InputError for what is none; name, kind: of the parts, for the message."""
    try:
        if not isinstance(parts, str | Mapping):
            return list(parts)
    except TypeError:
        pass
    raise InputError(f"the {name} of a scene must be {kind} or a list of these, not {parts!r:.60}")
