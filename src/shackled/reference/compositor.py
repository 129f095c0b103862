"""Draw the background under the objects, and blend fragments with what is behind them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .layout import LANE_85, ONES
from .registers import Registers
from .structs import Background, Rectangle, Scene
from .words import MASK, color_lanes, divide_signed

#: Just below 256, Q10.
BRIGHTEST = 0x3FFFF


def begin(blended: bool, scene: Scene, r: Registers) -> None:
    """Draw the background under the opaque objects.

    Blended objects are drawn over the picture of the opaque ones.
    """
    if not blended:
        r.image = background(scene.background, scene.canvas.height, r.tile)


def background(colors: Background, height: int, tile: Rectangle) -> NDArray[np.uint8]:
    """Return the background of a tile: (height, width, 3) blue, green, red, rows from the top."""
    top, bottom = colors.top, colors.bottom
    # lanes of Q24: the change from row to row upwards, and the bottom row
    step = lane_step(top, bottom, 1 if height == 1 else height - 1)
    color = (color_lanes(top if height == 1 else bottom) << 24) + (ONES << 23)
    color += step * (height - tile.y - tile.height)
    rows = []
    for _ in range(tile.height):
        rows.append([(color >> shift) & 0xFF for shift in (24, 80, 136)])
        color = (color + step) & MASK
    return np.repeat(np.array(rows[::-1], np.uint8)[:, None], tile.width, axis=1)


def lane_step(top: int, bottom: int, rows: int) -> int:
    """Return the change from row to row, lanes of Q24."""
    step = 0
    for i in range(3):
        difference = ((top >> (8 * i)) & 0xFF) - ((bottom >> (8 * i)) & 0xFF)
        step += divide_signed(difference << 24, rows) << (56 * i)
    return step


def over(color: int, place: tuple[int, int], r: Registers) -> int:
    """Return the colour of a fragment over what is there: color * opacity + behind * (1 - opacity).

    color: signed lanes of 85 bits, Q10, which are kept between 0 and 255 first.
    """
    mixed = 0
    for lane, byte in enumerate(r.image[place].tolist()):
        low = color & LANE_85
        value = low - (low >> 84 << 85)
        # without what the lane has borrowed
        color = (color - value) >> 85
        value = min(max(value, 0), BRIGHTEST)
        mixed |= (value * r.opacity + (byte << 10) * ((1 << 24) - r.opacity)) >> 24 << (85 * lane)
    return mixed
