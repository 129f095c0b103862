"""Backgrounds."""

from __future__ import annotations

from collections.abc import Sequence

from attrs import field, frozen
from numpy.typing import ArrayLike

from ..checks import Color, color
from ..values import checked, with_names


def _bottom(value: ArrayLike | str | None, name: str = "") -> Color:
    # None is replaced by the top right after
    return value if value is None else color(value, name)  # type: ignore[return-value]


@frozen(field_transformer=with_names)
class Background:
    """A vertical gradient from the colour of the top row to that of the bottom row, by default the same.

    Colours are red, green, blue, 0..255; also given as floats 0..1, "#rrggbb" or a name.
    """

    top: Color = field(default=(0, 0, 0), converter=color, metadata=checked("the background colour"))
    bottom: Color = field(
        default=None, converter=_bottom, metadata=checked("the colour at the bottom of the background")
    )

    def __attrs_post_init__(self) -> None:
        """Take the top's colour where none is given for the bottom."""
        if self.bottom is None:
            object.__setattr__(self, "bottom", self.top)


def background_of(value: Background | ArrayLike | str | Sequence[ArrayLike | str]) -> Background:
    """Return a background, given as itself, as one colour, or as two, (top, bottom)."""
    if isinstance(value, Background):
        return value
    if isinstance(value, list | tuple) and len(value) == 2:
        return Background(*value)
    return Background(value)  # type: ignore[arg-type]
