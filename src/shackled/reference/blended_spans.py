"""Draw objects that are not opaque.

They are drawn twice: the first pass finds the nearest fragment of each pixel, the second mixes its colour with what is
there, once. The last two bits of a depth say how far it is.
"""

from __future__ import annotations

from .compositor import over
from .fragment_shader import Span
from .layout import IS_BLENDED
from .patches import HALF_85, pack, sampled
from .registers import Registers
from .words import MASK

FOUND, DRAWN = 1, 2


def draw(spans: list[Span], r: Registers) -> None:
    """Draw spans."""
    for row, first, end, attribute, step in spans:
        line = row - r.band_top
        for column in range(first, end):
            place = line, column - r.column_begin
            if passes(attribute, place, r):
                color = over(sampled(attribute, column, row, r), place, r)
                r.image[place] = pack(((color << 48) + HALF_85) & MASK)
            attribute += step


def passes(attribute: int, place: tuple[int, int], r: Registers) -> bool:
    """Make the depth test of either pass; return whether the fragment is to be drawn now."""
    old, depth = int(r.depth[place]), (attribute & MASK) >> 192 & ~3
    second = bool(r.mode & IS_BLENDED)
    if old != depth | FOUND if second else depth <= old:
        return False
    r.depth[place] = depth | (DRAWN if second else FOUND)
    return second
