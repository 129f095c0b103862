"""Lights."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from numpy.typing import ArrayLike

from ..checks import choice, color, number, vector
from ..errors import InputError
from .value import Value

LightKind = Literal["directional", "point", "spot"]
LIGHT_KINDS: tuple[LightKind, ...] = ("directional", "point", "spot")

#: Degrees, of a spot light whose angles are not given; as in glTF.
INNER_ANGLE = 0.0
OUTER_ANGLE = 45.0


@dataclass(frozen=True, eq=False)
class Light(Value):
    """One light; a scene has up to four.

    kind: "directional", "point", or "spot", a point light that shines into a cone only.
    vector: (3,) float; the direction toward a directional light (any length but zero), the position of any other.
    color: red, green, blue, 0..255, or floats 0..1.
    direction: (3,) float; where a spot light points, any length but zero; others have none.
    inner_angle, outer_angle: of a spot light, in degrees from there, 0..180: its light is whole up to the inner angle
        and falls to nothing at the outer one.
    """

    kind: LightKind
    vector: ArrayLike
    color: ArrayLike = (255, 255, 255)
    direction: ArrayLike | None = None
    inner_angle: float = INNER_ANGLE
    outer_angle: float = OUTER_ANGLE

    def __post_init__(self) -> None:
        choice(self.kind, "the kind of a light", LIGHT_KINDS)
        object.__setattr__(self, "vector", vector(self.vector, "the direction or position of a light"))
        object.__setattr__(self, "color", color(self.color, "the colour of a light"))
        if self.kind == "directional" and not self.vector.any():  # type: ignore[union-attr]
            raise InputError("the direction of a light must not be zero")
        if self.kind != "spot":
            if self.direction is not None or (self.inner_angle, self.outer_angle) != (INNER_ANGLE, OUTER_ANGLE):
                raise InputError(f"only a spot light has direction, inner_angle and outer_angle, not a {self.kind} one")
            return
        if self.direction is None:
            raise InputError("a spot light needs a direction, in which it points")
        object.__setattr__(self, "direction", vector(self.direction, "the direction of a spot light"))
        if not self.direction.any():  # type: ignore[union-attr]
            raise InputError("the direction of a spot light must not be zero")
        for name in ("inner_angle", "outer_angle"):
            value = number(getattr(self, name), f"the {name} of a spot light", 0, 180)
            object.__setattr__(self, name, value)
        if self.inner_angle > self.outer_angle:
            raise InputError(
                f"the inner_angle of a spot light, {self.inner_angle:g}, must not be above its outer_angle, "
                f"{self.outer_angle:g}"
            )
