"""Colour the vertices: a gradient, and a random offset in hue, saturation and value.

As contracts/src/genesis/Colors.sol.
"""

from __future__ import annotations

from ...errors import InputError
from .hsv import hsv_to_rgb, rgb_to_hsv
from .layout import PlaneTriangle
from .prisms import Prisms
from .random import Random, keccak256
from .schemes import CENTER_X, DOWN, LARGEST, LEFT, RADIUS, RANDOM, UP, Paint, Scheme
from .trigonometry import Point3, quotient


def clamp(value: int) -> int:
    """Clamp a number to 0..255."""
    return min(255, max(0, value))


def paint(random: Random, scheme: Scheme, prisms: Prisms) -> list[Point3]:
    """Return the colours of all vertices, in their order."""
    chosen = highlights(random, scheme, prisms)
    return [
        color
        for k in range(len(prisms.flat))
        for color in paint_prism(random, scheme.highlight if k in chosen else scheme.primary, prisms, k)
    ]


def highlights(random: Random, scheme: Scheme, prisms: Prisms) -> set[int]:
    """Return which prisms are highlights; raise InputError for the one case in which the rule has no answer."""
    total = len(prisms.flat)
    count = min(scheme.count, total)
    if scheme.select == RANDOM:
        if count and total == 1:
            raise InputError(f"the seed {random.seed.hex()} has no piece: it would choose among no prisms")
        return {
            int.from_bytes(keccak256(random.seed + i.to_bytes(32, "big")), "big") % (total - 1) for i in range(count)
        }
    keys = [key_of(triangle, scheme.key) for triangle in prisms.flat]
    sign = -1 if scheme.select == LARGEST else 1
    # the first prism stays where it is
    order = [0, *sorted(range(1, total), key=lambda k: sign * keys[k])]
    return set(order[:count])


def key_of(triangle: PlaneTriangle, key: int) -> int:
    """Return the key by which prisms are ordered."""
    if key == RADIUS:
        return triangle.radius
    x, y = triangle.center
    return x if key == CENTER_X else y


def paint_prism(random: Random, paint: Paint, prisms: Prisms, k: int) -> list[Point3]:
    """Return the colours of the six vertices of prism k."""
    axis = 1 if paint.direction in (UP, DOWN) else 0
    values = [point[axis] for point in prisms.near[k]]
    if paint.across:
        low, high = -prisms.half[axis], prisms.half[axis]
    else:
        low, high = min(values), max(values)
        if paint.direction in (LEFT, DOWN):
            low, high = high, low
    bases = [rgb_to_hsv(gradient(paint, value, low, high)) for value in values]
    colors = []
    for base, offset, is_far in zip(2 * bases, offsets(random, paint), 3 * [True] + 3 * [False], strict=True):
        hue, saturation, value = (clamp(part + added) for part, added in zip(base, offset, strict=True))
        shift = paint.shift if is_far else 0
        red, green, blue = (clamp(channel - shift) for channel in hsv_to_rgb(hue, saturation, value))
        colors.append((red, green, blue))
    return colors


def gradient(paint: Paint, value: int, low: int, high: int) -> Point3:
    """Return the colour at `value`; beyond `low` and `high` it is extrapolated, but not below 0."""
    place = 1 if high == low else quotient((value - low) * 1000, high - low)
    red, green, blue = (
        max(0, start + quotient((end - start) * place, 1000)) for start, end in zip(paint.start, paint.end, strict=True)
    )
    return red, green, blue


def offsets(random: Random, paint: Paint) -> list[Point3]:
    """Return the offset of each of the six vertices of a prism: the same for every prism."""
    word, found = 0, []
    for _ in range(6):
        hue, saturation, value = (
            random.draw(tag, word, low=0, high=2 * jiggle) for tag, jiggle in zip("012", paint.jiggle, strict=True)
        )
        found.append((hue, saturation, value))
        if paint.by_vertex:
            word = hue
    return found
