"""What is seen where nothing is drawn."""

from __future__ import annotations

from dataclasses import dataclass

from numpy.typing import ArrayLike

from ..checks import color
from .value import Value


@dataclass(frozen=True, eq=False)
class Background(Value):
    """A vertical gradient from the colour of the top row to that of the bottom row; red, green, blue, 0..255,
    or floats 0..1.
    """

    top: ArrayLike = (0, 0, 0)
    bottom: ArrayLike | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "top", color(self.top, "the background colour"))
        bottom = self.top if self.bottom is None else self.bottom
        object.__setattr__(self, "bottom", color(bottom, "the colour at the bottom of the background"))
