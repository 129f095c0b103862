"""A finished picture."""

from __future__ import annotations

import base64
import io
import os
import struct
from functools import cached_property
from pathlib import Path

import numpy as np
from attrs import field, frozen
from numpy.typing import ArrayLike, NDArray
from PIL import Image as PillowImage

from .checks import fixed
from .errors import InputError, RenderError
from .palette import indexed
from .scene.scene import Scene
from .scene.value import array_key, plural
from .whole_file import check_output_file, write_output

#: What `Image.save` can write, by extension.
FORMATS = (".png", ".bmp", ".svg", ".gif")

Pixels = NDArray[np.uint8]


def _pixels(values: ArrayLike) -> Pixels:
    try:
        pixels = fixed(values, np.uint8)
    except (TypeError, ValueError, OverflowError):
        pixels = np.zeros(0, np.uint8)
    if pixels.ndim != 3 or pixels.shape[2] != 3 or not pixels.size:
        raise InputError(f"the pixels of a picture must be bytes of shape (height, width, 3), not {values!r:.60}")
    return pixels


@frozen(repr=False)
class Image:
    """A picture as a contract made it.

    pixels: (H, W, 3) uint8, rows from the top. bmp: the bytes that the contract returned, those of the pixels if not
        given.
    gas, intrinsic_gas: of the execution, and what a transaction costs before it; None where none is counted.
    chain: where it was made. seconds: how long the call took; this alone is not compared by ==.
    scene: what it shows; None if that is not known.
    """

    pixels: Pixels = field(converter=_pixels, eq=array_key)
    bmp: bytes = b""
    gas: int | None = None
    intrinsic_gas: int | None = None
    chain: str = ""
    seconds: float = field(default=0.0, eq=False)
    scene: Scene | None = None

    def __attrs_post_init__(self) -> None:
        """Encode the pixels where the file is not given."""
        if not self.bmp:
            object.__setattr__(self, "bmp", encode_bmp(self.pixels))

    @property
    def width(self) -> int:
        """In pixels."""
        return int(self.pixels.shape[1])

    @property
    def height(self) -> int:
        """In pixels."""
        return int(self.pixels.shape[0])

    @property
    def triangles(self) -> int | None:
        """How many survived culling and clipping; None if the scene is not known."""
        return self._counts[0]

    @property
    def lit_pixels(self) -> int | None:
        """How many any of the triangles covers; None if the scene is not known."""
        return self._counts[1]

    @cached_property
    def _counts(self) -> tuple[int, int] | tuple[None, None]:
        # what `renderCounted` returns, without a second call
        from .reference import count

        return (None, None) if self.scene is None else count(self.scene)

    def encode(self, extension: str) -> bytes:
        """The bytes of a file: ".png", ".bmp" (as the contract made it), ".svg" (the BMP in a frame that scales without
        smoothing) or ".gif" (at most 256 colours; the nearest where there are more). InputError for any other.
        """
        extension = check_extension(extension, FORMATS)
        if extension == ".bmp":
            return self.bmp
        if extension == ".svg":
            return self._svg().encode()
        picture = indexed([self.pixels])[0] if extension == ".gif" else PillowImage.fromarray(self.pixels)
        stream = io.BytesIO()
        picture.save(stream, extension.removeprefix("."))
        return stream.getvalue()

    def save(self, path: str | Path) -> None:
        """Writes a file, in the format of its extension; it is there whole or not at all.

        InputError where the path is wrong, OutputError where the disk is full or fails.
        """
        path = check_output(path)
        write_output(path, self.encode(path.suffix))

    def _svg(self) -> str:
        # character by character what the contract's renderSVG returns
        data = base64.b64encode(self.bmp).decode()
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {self.width} {self.height}">'
            f'<image width="{self.width}" height="{self.height}" style="image-rendering:pixelated"'
            f' href="data:image/bmp;base64,{data}"/></svg>'
        )

    def __repr__(self) -> str:
        triangles = "" if self.triangles is None else f", {plural(self.triangles, 'triangle')}"
        return f"<Image {self.width}x{self.height}{triangles}{gas_in_short(self.gas)}>"

    def _repr_png_(self) -> bytes:
        return self.encode(".png")


def check_output(path: str | Path) -> Path:
    """The path, if a picture can be saved there."""
    path = as_path(path)
    if path.suffix.lower() not in FORMATS:
        raise InputError(f"the picture {path} must end in one of {' '.join(FORMATS)}")
    return check_output_file(path, "picture")


def as_path(path: object) -> Path:
    """A path. InputError for anything else, such as a stream."""
    if not isinstance(path, str | os.PathLike):
        raise InputError(f"a picture is saved to a path, not to {path!r:.60}; encode() gives the bytes")
    return Path(path)


def check_extension(extension: object, formats: tuple[str, ...]) -> str:
    """One of the formats, given as "png", ".png" or ".PNG"."""
    found = f".{extension.removeprefix('.').lower()}" if isinstance(extension, str) else None
    if found not in formats:
        raise InputError(f"the format must be one of {' '.join(formats)}, not {extension!r:.60}")
    return found


def gas_in_short(gas: int | None) -> str:
    """Return what is put after other figures in a line: ", 35.3M gas", or "" where none is counted."""
    if gas is None:
        return ""
    return f", {gas / 1e6:,.1f}M gas" if gas >= 1e6 else f", {gas:,} gas"


def encode_bmp(pixels: Pixels) -> bytes:
    """Return a BMP of 24 bits a pixel as the contracts make it, of pixels (H, W, 3), rows from the top."""
    height, width, _ = pixels.shape
    rows = pixels[::-1, :, ::-1].reshape(height, 3 * width)
    body = np.pad(rows, ((0, 0), (0, -3 * width % 4))).tobytes()
    # 24 bits a pixel, 2835 pixels per metre (72 dots per inch)
    header = struct.pack(
        "<2sIIIIiiHHIIiiII", b"BM", 54 + len(body), 0, 54, 40, width, height, 1, 24, 0, len(body), 2835, 2835, 0, 0
    )
    return header + body


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
