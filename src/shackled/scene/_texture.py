"""Textures: images that are multiplied with the colours of a mesh; and colours of files as sRGB bytes."""

from __future__ import annotations

import io
import math
import os
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import IO

import numpy as np
from attrs import field, frozen
from numpy.typing import ArrayLike, NDArray
from PIL import Image

from ..base.checks import Floats, choice, fixed, whole
from ..base.values import Value
from ..errors import InputError
from ._fields import FIELDS, Filter, Wrap
from ._files.signatures import HEAD, signature_of
from ._table import USUAL, from_table

#: The most texels along a side.
MAX_TEXTURE_SIDE: int = FIELDS["Texture"]["width"].limits[1]
#: So many rows of an image are converted at a time.
_ROWS = 256
#: The most pixels of an image that is read.
MAX_PIXELS = 1 << 26


def _pixels(values: ArrayLike) -> NDArray[np.uint8]:
    if isinstance(values, str | os.PathLike):
        values = Texture.open(values).pixels
    levels = _levels(values, "the pixels of a texture", "(height, width, 3)")
    height, width, channels = levels.shape
    if channels != 3:
        raise InputError(f"the pixels of a texture must be of shape (height, width, 3), not {levels.shape}")
    if not (1 <= width <= MAX_TEXTURE_SIDE and 1 <= height <= MAX_TEXTURE_SIDE):
        raise InputError(
            f"a texture has from 1 to {MAX_TEXTURE_SIDE} texels along each side, not {width} x {height};"
            " Texture.open reduces an image"
        )
    return levels


def _alpha(values: ArrayLike | None) -> NDArray[np.uint8] | None:
    return None if values is None else _levels(values, "the alpha of a texture", "(height, width)")


def _levels(values: ArrayLike, name: str, shape: str) -> NDArray[np.uint8]:
    try:
        levels = np.asarray(values)
        is_whole = levels.dtype.kind in "iu" or (levels.dtype.kind == "f" and bool((levels % 1 == 0).all()))
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"{name} must be an array of shape {shape}") from None
    if levels.ndim != 1 + shape.count(","):
        raise InputError(f"{name} must be of shape {shape}, not {levels.shape}")
    if not is_whole or (levels.size and not 0 <= levels.min() <= levels.max() <= 255):
        raise InputError(f"{name} must be whole numbers from 0 to 255")
    return fixed(levels, np.uint8)


@frozen(field_transformer=from_table, repr=False)
class Texture(Value):
    """An image that is multiplied with the colours of a mesh, at the places that `Mesh.uvs` gives.

    pixels: (h, w, 3), rows from the top, 0..255; up to 256 x 256.
    filter: "nearest" takes the colour of a texel, "bilinear" interpolates between four, as OpenGL does.
    wrap: outside of 0..1 the image repeats, or the colours of its border go on ("clamp").
    alpha: (h, w), 0..255, what each texel hides of what is behind it; None if all are opaque.
    cutoff: the least alpha of what is drawn, 1..255, which is opaque then (a mask); 0 if the surface is blended with
        what is behind it.
    """

    pixels: NDArray[np.uint8] = field(converter=_pixels)
    filter: Filter = field(default=USUAL, converter=choice)
    wrap: Wrap = field(default=USUAL, converter=choice)
    alpha: NDArray[np.uint8] | None = field(default=None, converter=_alpha)
    cutoff: int = field(default=USUAL, converter=whole)

    def __attrs_post_init__(self) -> None:
        shape = self.pixels.shape[:2]
        if self.alpha is not None and self.alpha.shape != shape:
            raise InputError(f"the alpha of a texture must be of shape {shape}, as its pixels, not {self.alpha.shape}")

    @classmethod
    def open(
        cls,
        image: str | os.PathLike[str] | bytes | IO[bytes] | Image.Image,
        filter: Filter = "bilinear",
        wrap: Wrap = "repeat",
        alpha: bool = False,
        cutoff: int = 0,
    ) -> Texture:
        """Return the texture of an image, or of a file of one, reduced to 256 texels along each side.

        image: of Pillow; or the path of a file, its bytes, or an open file.
        alpha: whether it has the alpha of the image, if that is transparent anywhere; hidden texels get the colours of
        the nearest visible ones. cutoff: see `Texture`. InputError if the file does not exist or is not an image.
        """
        convert = with_alpha if alpha else as_rgb
        if isinstance(image, Image.Image):
            opened = convert(image)
        elif isinstance(image, str | os.PathLike):
            opened = open_image(Path(image), str(image), convert)
        else:
            opened = open_image(io.BytesIO(image) if isinstance(image, bytes) else image, "the image", convert)
        return cls.of_image(reduced(opened), filter, wrap, cutoff)

    @classmethod
    def of_image(cls, image: Image.Image, filter: Filter, wrap: Wrap, cutoff: int = 0) -> Texture:
        """Return the texture of an image of at most 256 x 256 texels, RGB, or RGBA with the alpha that is meant."""
        pixels = np.asarray(image)
        if pixels.shape[2] == 3 or pixels[..., 3].min() == 255:
            return cls(pixels[..., :3], filter, wrap)
        return cls(_unhidden(pixels, wrap), filter, wrap, pixels[..., 3], cutoff)

    @property
    def width(self) -> int:
        """Texels of a row."""
        return int(self.pixels.shape[1])

    @property
    def height(self) -> int:
        """Rows."""
        return int(self.pixels.shape[0])

    def __repr__(self) -> str:
        return f"<Texture {self.width}x{self.height}, {self.filter}, {self.wrap}>"


def _unhidden(pixels: NDArray[np.uint8], wrap: Wrap) -> NDArray[np.uint8]:
    """Return the colours of RGBA pixels, (h, w, 3), those of hidden texels, with which others are interpolated, from
    neighbours that are not.
    """
    sums, known = pixels[..., :3].astype(np.float64), pixels[..., 3] > 0
    if not known.any():
        return np.array(pixels[..., :3])
    sums[~known] = 0
    while not known.all():
        padded = np.pad(
            np.dstack([sums, known]), ((1, 1), (1, 1), (0, 0)), mode="wrap" if wrap == "repeat" else "constant"
        )
        around = np.lib.stride_tricks.sliding_window_view(padded, (3, 3), axis=(0, 1)).sum(axis=(3, 4))
        found = ~known & (around[..., 3] > 0)
        sums[found] = around[found][:, :3] / around[found][:, 3:]
        known |= found
    return np.rint(sums).astype(np.uint8)


def cutoff_of(alpha: float) -> int:
    """Return the cutoff, 1..255, of a mask that hides what has an alpha, 0..1, below a number above 0."""
    return min(max(math.ceil(255 * alpha - 1e-6), 1), 255)


def open_image(
    source: Path | IO[bytes], name: str, convert: Callable[[Image.Image], Image.Image] | None = None
) -> Image.Image:
    """Return the image, as RGB or as `convert` returns it. InputError, with its name, if it is none or too large."""
    try:
        with (
            warnings.catch_warnings(action="ignore", category=Image.DecompressionBombWarning),
            Image.open(source) as image,
        ):
            if image.width * image.height > MAX_PIXELS:
                raise InputError(f"{name} has {image.width} x {image.height} pixels; up to {MAX_PIXELS:,} are read")
            return (convert or as_rgb)(image)
    except FileNotFoundError:
        raise InputError(f"{name} does not exist") from None
    except InputError:
        raise
    except (OSError, ValueError, SyntaxError, AttributeError, Image.DecompressionBombError):
        raise InputError(f"{name} is not an image that can be read{_instead(source)}") from None


def _instead(source: Path | IO[bytes]) -> str:
    """Return what a file is that is no image, if that is known."""
    if not isinstance(source, Path) or not source.is_file():
        return ""
    with source.open("rb") as file:
        found = signature_of(file.read(HEAD))
    return "" if found is None or found.format is not None else f": it is {found.name}: {found.do}"


def as_rgb(image: Image.Image) -> Image.Image:
    """Return an image of any mode of Pillow as RGB, without its alpha."""
    if image.mode == "RGB":
        image.load()  # before its file is closed
        return image
    if image.mode[0] not in "IF":
        return image.convert("RGB")
    # Pillow cuts the levels of these off at 255
    parts = [slice(row, row + _ROWS) for row in range(0, image.height, _ROWS)]
    grey = np.asarray(image)

    def levels(part: slice) -> Floats:
        return np.nan_to_num(grey[part].astype(np.float64))

    scale = 1.0
    if image.mode == "F":
        most = max(levels(part).max() for part in parts)
        scale = 65535 / next((each for each in (1, 255) if most <= each), 65535)
    # the upper byte, as of 16-bit colours
    found = [(np.clip(levels(part) * scale, 0, 65535) // 256).astype(np.uint8) for part in parts]
    return Image.fromarray(np.concatenate(found)).convert("RGB")


def with_alpha(image: Image.Image) -> Image.Image:
    """Return an image of any mode of Pillow as RGBA, or as RGB if it is opaque everywhere."""
    if image.has_transparency_data:
        converted = image.convert("RGBA")
        if converted.getchannel("A").getextrema() != (255, 255):
            return converted
    return as_rgb(image)


def reduced(image: Image.Image, side: int = MAX_TEXTURE_SIDE) -> Image.Image:
    """Return the image with at most `side` pixels along each side; it keeps its shape."""
    largest = max(image.size)
    if largest <= side:
        return image
    width, height = (max(1, round(length * side / largest)) for length in image.size)
    return image.resize((width, height), Image.Resampling.LANCZOS)


def to_bytes(colors: ArrayLike, largest: float | None = None) -> Floats:
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


def to_srgb(linear: ArrayLike) -> Floats:
    """Return linear colours 0..1 as whole numbers 0..255, encoded as sRGB."""
    values = np.clip(np.asarray(linear, dtype=np.float64), 0, 1)
    encoded = np.where(values <= 0.0031308, 12.92 * values, 1.055 * values ** (1 / 2.4) - 0.055)
    return np.asarray(np.rint(255 * encoded))


def sample(image: Image.Image, coordinates: ArrayLike) -> Floats:
    """Return the colours of an image, (n, 3), 0..255, interpolated between the nearest four texels.

    coordinates: (n, 2) float, from the bottom left (0, 0) to the top right (1, 1); outside of it the image repeats.
    """
    if not np.size(coordinates):
        return np.zeros((0, 3))
    width, height = image.size
    uv = np.nan_to_num(np.asarray(coordinates, dtype=np.float64)[:, :2], posinf=0, neginf=0)
    # the far border belongs to the image itself, not to its first repetition
    uv = np.where((uv >= 0) & (uv <= 1), uv, uv % 1)
    x = np.clip(uv[:, 0] * width - 0.5, 0, width - 1)
    y = np.clip((1 - uv[:, 1]) * height - 0.5, 0, height - 1)
    left, top = np.floor(x).astype(int), np.floor(y).astype(int)
    right, bottom = np.minimum(left + 1, width - 1), np.minimum(top + 1, height - 1)
    fx, fy = (x - left)[:, None], (y - top)[:, None]
    first, upmost, end, lowest = int(left.min()), int(top.min()), int(right.max()) + 1, int(bottom.max()) + 1
    # in parts, for an array of all of them at once would be made by way of three copies
    parts = ((first, row, end, min(row + _ROWS, lowest)) for row in range(upmost, lowest, _ROWS))
    texels = np.concatenate([np.asarray(as_rgb(image.crop(part))) for part in parts])
    left, right, top, bottom = left - first, right - first, top - upmost, bottom - upmost
    upper = texels[top, left] * (1 - fx) + texels[top, right] * fx
    lower = texels[bottom, left] * (1 - fx) + texels[bottom, right] * fx
    return np.asarray(np.rint(upper * (1 - fy) + lower * fy))
