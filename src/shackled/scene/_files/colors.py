"""Colours as files write them: bytes, larger integers, or fractions of 1."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...errors import InputError


def to_bytes(colors: ArrayLike, largest: float | None = None) -> NDArray[np.float64]:
    """Return colours with channels 0..`largest` as whole numbers 0..255; the alpha channel, if any, is left out.

    colors: (..., 3 or 4). Without `largest` it is taken to be 1 where no channel is above 1, and 255 otherwise.
    """
    channels = np.asarray(colors, dtype=np.float64)[..., :3]
    bad = np.argwhere(~np.isfinite(channels).all(axis=-1))
    if len(bad):
        place = tuple(bad[0])
        number = f" {', '.join(map(str, place))}" if place else ""
        raise InputError(f"colour{number} must be three finite numbers, not {channels[place].tolist()}")
    if largest is None:
        largest = 1 if channels.size == 0 or channels.max() <= 1 else 255
    return np.clip(np.rint(channels * (255 / largest)), 0, 255)
