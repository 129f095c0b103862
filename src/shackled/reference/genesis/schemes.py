"""Colour schemes: two gradients, one of them for highlights; which prisms those are; the background.

As contracts/src/genesis/Schemes.sol.
"""

from __future__ import annotations

from dataclasses import dataclass

from .hsv import hsv_to_rgb
from .random import Random
from .trigonometry import Point3

#: The names, and the last of the draws 0..10000 that give each.
BOUNDS = {
    "Accentuated": 1500,
    "Emergent": 2500,
    "Sunset": 3000,
    "Stone & Gold": 3100,
    "Denatured": 5500,
    "Chameleonic": 6000,
    "Gradiated": 6500,
    "Vivid Alabaster": 8000,
    "Vivid Ink": 9500,
    "Pigmented": 10000,
}

#: The schemes that are never inverted.
NEVER_INVERTED = (2, 3, 7, 8)

BLACK = (0, 0, 0)
WHITE = (255, 255, 255)

# The directions in which a gradient runs.
RIGHT, LEFT, UP, DOWN = range(4)

# Which prisms are highlights: random ones, the first of those with the largest key or with the smallest.
RANDOM, LARGEST, SMALLEST = range(3)
# The keys.
RADIUS, CENTER_X, CENTER_Y = range(3)


@dataclass(frozen=True)
class Paint:
    """How prisms are coloured.

    start, end: the colours of the gradient. across: whether it runs across the whole piece, not each triangle.
    jiggle: the mean of what is added to hue, saturation and value. by_vertex: whether each vertex gets its own.
    shift: what the far end loses in brightness.
    """

    start: Point3
    end: Point3
    across: bool
    direction: int
    jiggle: Point3
    by_vertex: bool
    shift: int


@dataclass(frozen=True)
class Scheme:
    """The colours of a piece. count, select, key: how many prisms are highlights, and which."""

    index: int
    name: str
    primary: Paint
    highlight: Paint
    count: int
    select: int
    key: int
    top: Point3
    bottom: Point3


def choose_scheme(random: Random, prisms: int) -> Scheme:
    """Choose the scheme of a piece of so many prisms."""
    value = random.draw("schemedId", low=0, high=10000)
    index, name = next((i, name) for i, (name, bound) in enumerate(BOUNDS.items()) if value <= bound)
    primary = _primary(random, index)
    count, select, key = _highlights(random, index, prisms)
    top, bottom = _background(random, index)
    return Scheme(index, name, primary, _highlight(random, index, primary.direction), count, select, key, top, bottom)


def _primary(random: Random, index: int) -> Paint:
    def direction(tag: str, low: int, high: int) -> int:
        return random.draw(tag, low=low, high=high)

    if index == 1:
        return Paint((0, 77, 255), (0, 255, 25), False, direction("priDir", 2, 3), (60, 60, 60), False, -255)
    if index == 2:
        return Paint((179, 0, 179), (0, 0, 255), True, UP, (25, 25, 25), True, 127)
    if index == 3:
        return Paint((50, 50, 50), (100, 100, 100), False, direction("pirDir", 0, 1), (10, 10, 10), True, 128)
    if index == 7:
        return Paint(WHITE, WHITE, False, RIGHT, (25, 25, 25), True, 127)
    if index == 8:
        return Paint(BLACK, BLACK, False, RIGHT, (25, 25, 25), False, -60)
    if index in (4, 5, 6):
        start, end = _random_color(random, "PA"), _random_color(random, "PB")
        if index == 4:
            return Paint(start, end, True, direction("pri", 0, 1), (0, 0, 0), False, 127)
        if index == 5:
            return Paint(start, end, False, direction("pri", 0, 3), (25, 25, 25), True, 0)
        return Paint(start, end, True, direction("pri", 0, 1), (127, 127, 127), False, 205)
    return Paint((60 if index == 0 else 50, 30, 25), (205, 205, 205), True, RIGHT, (13, 13, 13), False, 205)


def _highlight(random: Random, index: int, direction: int) -> Paint:
    opposite = direction ^ 1
    if index == 1:
        return Paint((0, 77, 255), (0, 255, 25), False, DOWN, (60, 60, 60), False, -255)
    if index == 2:
        return Paint(BLACK, BLACK, False, RIGHT, (15, 0, 15), True, 0)
    if index == 3:
        return Paint((255, 197, 0), (255, 126, 0), False, direction, (0, 0, 0), False, 64)
    if index in (4, 5, 6):
        start, end = _random_color(random, "HA"), _random_color(random, "HB")
        if index == 4:
            return Paint(start, end, True, random.draw("hlt", low=0, high=1), (0, 0, 0), False, 127)
        if index == 5:
            return Paint(start, end, False, opposite, (255, 255, 255), True, 205)
        return Paint(start, end, True, opposite, (127, 127, 127), False, 205)
    if index in (7, 8):
        hue = random.draw("hsv", low=0, high=255)
        if index == 7:
            color = hsv_to_rgb(hue, 230, 255)
            return Paint(color, color, False, RIGHT, (25, 50, 50), True, 180)
        color = hsv_to_rgb(hue, 245, 190)
        return Paint(color, color, False, RIGHT, (0, 0, 0), False, -60)
    jiggle = (50, 50, 50) if index == 0 else (255, 50, 50)
    return Paint((255, 0, 0), (255, 50, 0), False, random.draw("hltDir", low=0, high=3), jiggle, False, 205)


def _highlights(random: Random, index: int, prisms: int) -> tuple[int, int, int]:
    """Choose the number of highlights, their order, and its key."""
    if index == 0:
        return random.draw("hltNum", low=3, high=5), LARGEST, RADIUS
    if index == 1:
        return random.draw("hltNum", low=4, high=6), SMALLEST, RADIUS
    if index == 2:
        most = max(0, prisms - 8)
        return random.draw("hltNum", low=max(0, most - 2), high=most), SMALLEST, RADIUS
    if index == 3:
        return 1, LARGEST, RADIUS
    if index == 4:
        return prisms // 2, SMALLEST, RADIUS
    if index in (5, 6):
        return 12, SMALLEST, RADIUS
    if index in (7, 8):
        key = random.draw("hltVar", low=0, high=2) if index == 8 else RADIUS
        return (prisms + 1) // 2, random.draw("hltSel", low=0, high=2), key
    return prisms // 3, LARGEST, RADIUS


def _background(random: Random, index: int) -> tuple[Point3, Point3]:
    if index == 1:
        return WHITE, WHITE
    if index == 2:
        return (250, 103, 247), (157, 104, 250)
    if index in (7, 8):
        hue = random.draw("hsv", low=0, high=255)
        return hsv_to_rgb((hue - 9) % 255, 105, 255), hsv_to_rgb((hue + 9) % 255, 105, 255)
    top, bottom = {0: (0, 1), 3: (0, 0), 9: (0, 7)}.get(index, (3, 0))
    return (top, top, top), (bottom, bottom, bottom)


def _random_color(random: Random, tag: str) -> Point3:
    red, green, blue = (random.draw(tag + channel, low=25, high=255) for channel in "RGB")
    return red, green, blue
