"""A finished picture."""

from __future__ import annotations

import base64
import io
import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image as PillowImage

from .errors import InputError, RenderError
from .whole_file import write_whole

#: What `Image.save` can write, by extension.
FORMATS = (".png", ".bmp", ".svg", ".gif")


@dataclass(frozen=True, eq=False)
class Image:
    """A picture as a contract made it.

    pixels: (H, W, 3) uint8, rows from the top. bmp: the bytes that the contract returned.
    gas, intrinsic_gas: of the execution, and what a transaction costs before it; None where none is counted.
    triangles, lit_pixels: triangles that survived culling and clipping, pixels that any of them covers; None if they
        were not counted.
    chain: where it was made. seconds: how long the call took.
    """

    pixels: NDArray[np.uint8]
    bmp: bytes
    gas: int | None
    intrinsic_gas: int | None
    triangles: int | None
    lit_pixels: int | None
    chain: str
    seconds: float

    @property
    def width(self) -> int:
        """In pixels."""
        return int(self.pixels.shape[1])

    @property
    def height(self) -> int:
        """In pixels."""
        return int(self.pixels.shape[0])

    def encode(self, extension: str) -> bytes:
        """The bytes of a file: ".png", ".bmp" (as the contract made it), ".svg" (the BMP in a frame that scales without
        smoothing) or ".gif" (at most 256 colours; the nearest where there are more).
        """
        if extension == ".bmp":
            return self.bmp
        if extension == ".svg":
            return self._svg().encode()
        picture = PillowImage.fromarray(self.pixels)
        if extension == ".gif":
            picture = picture.quantize(256, dither=PillowImage.Dither.NONE)
        stream = io.BytesIO()
        picture.save(stream, extension.removeprefix("."))
        return stream.getvalue()

    def save(self, path: str | Path) -> None:
        """Writes a file, in the format of its extension; it is there whole or not at all."""
        path = check_output(path)
        content = self.encode(path.suffix.lower())
        try:
            write_whole(path, content)
        except OSError as error:
            raise InputError(f"{path} cannot be written: {error.strerror}") from None

    def _svg(self) -> str:
        # character by character what the contract's renderSVG returns
        data = base64.b64encode(self.bmp).decode()
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {self.width} {self.height}">'
            f'<image width="{self.width}" height="{self.height}" style="image-rendering:pixelated"'
            f' href="data:image/bmp;base64,{data}"/></svg>'
        )

    def _repr_png_(self) -> bytes:
        return self.encode(".png")


def check_output(path: str | Path) -> Path:
    """The path, if a picture can be saved there."""
    path = Path(path)
    if path.suffix.lower() not in FORMATS:
        raise InputError(f"the picture {path} must end in one of {' '.join(FORMATS)}")
    if path.is_dir():
        raise InputError(f"{path} is a folder, not the file of a picture")
    if not path.parent.is_dir():
        raise InputError(f"the folder {path.parent} of the picture {path.name} does not exist")
    if not os.access(path.parent, os.W_OK):
        raise InputError(f"the picture {path} cannot be written: nothing can be written to its folder")
    return path


def decode_bmp(data: bytes, width: int, height: int) -> NDArray[np.uint8]:
    """The pixels, (H, W, 3), of a 24-bit BMP as the contracts make it; anything else is a RenderError."""
    size = 54 + (3 * width + 3) // 4 * 4 * height
    try:
        with PillowImage.open(io.BytesIO(data), formats=["BMP"]) as picture:
            picture.load()
            found, mode = picture.size, picture.mode
            pixels = np.array(picture)
    except (OSError, ValueError, SyntaxError) as error:
        raise RenderError(f"the contract did not return a picture: {error}") from None
    if found != (width, height) or mode != "RGB" or len(data) != size or int.from_bytes(data[2:6], "little") != size:
        raise RenderError(
            f"the contract returned a {mode} picture of {found[0]} x {found[1]} pixels in {len(data):,} bytes"
            f" instead of {width} x {height} in {size:,}"
        )
    return pixels
