"""Lights."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from numpy.typing import ArrayLike

from ..checks import choice, color, vector
from ..errors import InputError
from .value import Value


@dataclass(frozen=True, eq=False)
class Light(Value):
    """One light; a scene has up to four.

    kind: "directional" or "point".
    vector: (3,) float; the direction toward a directional light (any length but zero), the position of a point light.
    color: red, green, blue, 0..255, or floats 0..1.
    """

    kind: Literal["directional", "point"]
    vector: ArrayLike
    color: ArrayLike = (255, 255, 255)

    def __post_init__(self) -> None:
        choice(self.kind, "the kind of a light", ("directional", "point"))
        object.__setattr__(self, "vector", vector(self.vector, "the direction or position of a light"))
        object.__setattr__(self, "color", color(self.color, "the colour of a light"))
        if self.kind == "directional" and not self.vector.any():  # type: ignore[union-attr]
            raise InputError("the direction of a light must not be zero")
