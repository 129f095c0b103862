"""Pictures in 256 colours, as GIF needs them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from PIL import Image as PillowImage

MOST_COLORS = 256
#: The number of frames that are sampled to choose the colours of an animation.
SAMPLED = 16

Pixels = NDArray[np.uint8]


def colors(frames: Sequence[Pixels]) -> int:
    """Return how many colours there are in all frames."""
    return len(_distinct(frames))


def indexed(frames: Sequence[Pixels]) -> list[PillowImage.Image]:
    """Return frames, (H, W, 3), as images with one palette of at most 256 colours, without flicker.

    They are exact if there are no more colours, and otherwise in the nearest ones.
    """
    found = _distinct(frames)
    if len(found) <= MOST_COLORS:
        table = np.stack([found >> 16, found >> 8 & 255, found & 255], axis=1).astype(np.uint8).tobytes()
        pictures = [PillowImage.fromarray(np.searchsorted(found, _packed(f)).astype(np.uint8), "L") for f in frames]
        for picture in pictures:
            picture.putpalette(table)
        return pictures
    if len(frames) == 1:
        return [PillowImage.fromarray(frames[0]).quantize(MOST_COLORS, dither=PillowImage.Dither.NONE)]
    step = -(-len(frames) // SAMPLED)
    sample = PillowImage.fromarray(np.concatenate(frames[::step]))
    palette = PillowImage.new("P", (1, 1))
    palette.putpalette(sample.quantize(MOST_COLORS, dither=PillowImage.Dither.NONE).getpalette() or [])
    return [PillowImage.fromarray(f).quantize(palette=palette, dither=PillowImage.Dither.NONE) for f in frames]


def _distinct(frames: Sequence[Pixels]) -> NDArray[np.int64]:
    """Return the colours 0xRRGGBB of all frames, in order."""
    return np.unique(np.concatenate([np.unique(_packed(frame)) for frame in frames]))


def _packed(frame: Pixels) -> NDArray[np.int64]:
    """Return the colours as numbers 0xRRGGBB, (H, W)."""
    return np.asarray(frame.astype(np.int64) @ [1 << 16, 1 << 8, 1])
