"""Colours of files: bytes, larger integers, fractions of 1, and those of textures at the vertices of a mesh."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from PIL import Image

from ...errors import InputError


def to_bytes(colors: ArrayLike, largest: float | None = None) -> NDArray[np.float64]:
    """Return colours with channels 0..`largest` as whole numbers 0..255.

    colors: (..., n). Without `largest` it is taken to be 1 where no channel is above 1, and 255 otherwise.
    """
    channels = np.asarray(colors, dtype=np.float64)
    bad = np.argwhere(~np.isfinite(channels).all(axis=-1))
    if len(bad):
        place = tuple(bad[0])
        number = f" {', '.join(map(str, place))}" if place else ""
        raise InputError(f"colour{number} must be finite numbers, not {channels[place].tolist()}")
    if largest is None:
        largest = 1 if channels.size == 0 or channels.max() <= 1 else 255
    return np.rint(np.clip(channels, 0, largest) * (255 / largest))


def to_srgb(linear: ArrayLike) -> NDArray[np.float64]:
    """Return linear colours 0..1 as whole numbers 0..255, encoded as sRGB."""
    values = np.clip(np.asarray(linear, dtype=np.float64), 0, 1)
    encoded = np.where(values <= 0.0031308, 12.92 * values, 1.055 * values ** (1 / 2.4) - 0.055)
    return np.asarray(np.rint(255 * encoded))


def sample(image: Image.Image, coordinates: ArrayLike) -> NDArray[np.float64]:
    """Return the colours of an image, (n, 3), 0..255, interpolated between the nearest four texels.

    coordinates: (n, 2) float, from the bottom left (0, 0) to the top right (1, 1); outside of it the image repeats.
    """
    texels = np.asarray(image.convert("RGB"), dtype=np.float64)
    height, width = texels.shape[:2]
    uv = np.nan_to_num(np.asarray(coordinates, dtype=np.float64)[:, :2], posinf=0, neginf=0)
    # the far border belongs to the image itself, not to its first repetition
    uv = np.where((uv >= 0) & (uv <= 1), uv, uv % 1)
    x = np.clip(uv[:, 0] * width - 0.5, 0, width - 1)
    y = np.clip((1 - uv[:, 1]) * height - 0.5, 0, height - 1)
    left, top = np.floor(x).astype(int), np.floor(y).astype(int)
    right, bottom = np.minimum(left + 1, width - 1), np.minimum(top + 1, height - 1)
    fx, fy = (x - left)[:, None], (y - top)[:, None]
    upper = texels[top, left] * (1 - fx) + texels[top, right] * fx
    lower = texels[bottom, left] * (1 - fx) + texels[bottom, right] * fx
    result: NDArray[np.float64] = np.rint(upper * (1 - fy) + lower * fy)
    return result
