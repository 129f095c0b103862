"""Bitmap files."""

from __future__ import annotations

import struct

import numpy as np
from numpy.typing import NDArray


def encode_bmp(pixels: NDArray[np.uint8]) -> bytes:
    """A 24-bit BMP of (height, width, 3) pixels, red, green, blue, rows from the top."""
    height, width, _ = pixels.shape
    rows = pixels[::-1, :, ::-1].reshape(height, 3 * width)
    body = np.pad(rows, ((0, 0), (0, -3 * width % 4))).tobytes()
    # 24 bits a pixel, 2835 pixels per metre (72 dots per inch)
    header = struct.pack(
        "<2sIIIIiiHHIIiiII", b"BM", 54 + len(body), 0, 54, 40, width, height, 1, 24, 0, len(body), 2835, 2835, 0, 0
    )
    return header + body
