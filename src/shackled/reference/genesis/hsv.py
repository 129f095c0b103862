"""Convert colours to hue, saturation and value, 0..255 each, by integer division.

As contracts/src/genesis/Hsv.sol.
"""

from __future__ import annotations

from .trigonometry import Point3, quotient


def rgb_to_hsv(color: Point3) -> Point3:
    """Convert red, green and blue from 0; if they exceed 255, so may the value."""
    r, g, b = (channel * 1000 // 255 for channel in color)
    most = max(r, g, b)
    spread = most - min(r, g, b)
    if spread == 0:
        sextant = 0
    elif most == r:
        sextant = quotient((g - b) * 1000, spread)
    elif most == g:
        sextant = quotient((b - r) * 1000, spread) + 2000
    else:
        sextant = quotient((r - g) * 1000, spread) + 4000
    if sextant < 0:
        sextant += 6000
    saturation = spread * 1000 // most * 255 // 1000 if most else 0
    return 60 * sextant // 360 * 255 // 1000, saturation, most * 255 // 1000


def hsv_to_rgb(hue: int, saturation: int, value: int) -> Point3:
    """Convert hue, saturation and value from 0 to 255; hue 255 is hue 0."""
    turn, s, v = hue % 255 * 1000 // 255, saturation * 1000 // 255, value * 1000 // 255
    chroma = v * s // 1000
    sixth = 6 * turn
    middle = chroma * (1000 - abs(sixth % 2000 - 1000)) // 1000
    red, green, blue = (
        (chroma, middle, 0),
        (middle, chroma, 0),
        (0, chroma, middle),
        (0, middle, chroma),
        (middle, 0, chroma),
        (chroma, 0, middle),
    )[sixth // 1000]
    base = v - chroma
    return (red + base) * 255 // 1000, (green + base) * 255 // 1000, (blue + base) * 255 // 1000
