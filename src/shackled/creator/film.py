"""Pictures enlarged without smoothing, and one after the other as a GIF that goes round for ever."""

from __future__ import annotations

import io
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from PIL import Image as PillowImage

from ..animation import Animation

Pixels = NDArray[np.uint8]


def film(frames: Sequence[bytes], milliseconds: int, scale: int = 1) -> bytes:
    """A GIF of pictures of one size, given as PNG; each is shown so long. scale: each pixel becomes a square."""
    shown = [enlarged(np.asarray(PillowImage.open(io.BytesIO(frame)).convert("RGB")), scale) for frame in frames]
    return Animation(shown, milliseconds).encode(".gif")


def enlarged(pixels: Pixels, scale: int) -> Pixels:
    """(H, W, 3), each pixel a square of so many."""
    return pixels.repeat(scale, axis=0).repeat(scale, axis=1)


def png(pixels: Pixels, level: int) -> bytes:
    """(H, W, 3) as a PNG file. level: of compression, 1 to 9."""
    stream = io.BytesIO()
    PillowImage.fromarray(pixels).save(stream, "png", compress_level=level)
    return stream.getvalue()
