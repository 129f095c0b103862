"""Results of workers: pictures, and their encodings."""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image as PillowImage

from ..animation import Animation
from ..gas import Fit
from ..image import decode_bmp, pillow_bytes
from ._scene import Facts
from ._state import Source

Pixels = NDArray[np.uint8]


@dataclass(frozen=True)
class Frame:
    """A picture.

    bmp: the file as returned by the contract. gas, intrinsic_gas: None if gas is not counted. triangles, lit_pixels:
    None if they were not requested. calldata_bytes: of the call. seconds: duration of the call. fits: empty if gas is
    not counted.
    """

    bmp: bytes
    width: int
    height: int
    gas: int | None
    intrinsic_gas: int | None
    triangles: int | None
    lit_pixels: int | None
    calldata_bytes: int
    seconds: float
    fits: tuple[Fit, ...]

    @property
    def png(self) -> bytes:
        """The picture as a PNG file; encoded on access, since most frames are only shown."""
        return png(decode_bmp(self.bmp, self.width, self.height), 1)


@dataclass(frozen=True)
class StagePicture:
    """A stage of the pipeline. detail: a few words with numbers. png: its output."""

    name: str
    title: str
    detail: str
    png: bytes


@dataclass(frozen=True)
class Upload:
    """An uploaded file that was read. notes: what was changed or left out, one sentence each."""

    source: Source
    facts: Facts
    notes: tuple[str, ...]


@dataclass(frozen=True)
class Comparison:
    """The picture of a node compared with ours. same: whether all bytes are equal. seconds: duration on the node."""

    same: bool
    node: str
    seconds: float


@dataclass(frozen=True)
class File:
    """A file to download."""

    name: str
    media_type: str
    data: bytes


def gif(frames: Sequence[bytes], milliseconds: int, scale: int = 1) -> bytes:
    """Return an endless GIF. frames: PNG files of one size. milliseconds: per frame. scale: see `enlarged`."""
    shown = [enlarged(np.asarray(PillowImage.open(io.BytesIO(frame)).convert("RGB")), scale) for frame in frames]
    return Animation(shown, milliseconds).encode(".gif")


def enlarged(pixels: Pixels, scale: int) -> Pixels:
    """Return (H * scale, W * scale, 3): each pixel as a square."""
    return pixels.repeat(scale, axis=0).repeat(scale, axis=1)


def png(pixels: Pixels, level: int, **options: Any) -> bytes:
    """Return (H, W, 3) pixels as a PNG file. level: of compression, 1 to 9. options: of Pillow."""
    return pillow_bytes(PillowImage.fromarray(pixels), "PNG", compress_level=level, **options)
