"""The background."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .layout import ONES
from .structs import Rectangle
from .words import MASK, color_lanes, divide_signed


def background(top: int, bottom: int, height: int, tile: Rectangle) -> NDArray[np.uint8]:
    """The background of a tile: (height, width, 3) blue, green, red, rows from the top."""
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
    """The change from row to row, lanes of Q24."""
    step = 0
    for i in range(3):
        difference = ((top >> (8 * i)) & 0xFF) - ((bottom >> (8 * i)) & 0xFF)
        step += divide_signed(difference << 24, rows) << (56 * i)
    return step
