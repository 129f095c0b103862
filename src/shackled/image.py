"""Images: pixels, what they cost, and their file formats."""

from __future__ import annotations

import base64
import hashlib
import io
import os
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any, BinaryIO, Generic, TypeVar

import numpy as np
from attrs import evolve, field, frozen
from numpy.typing import ArrayLike, DTypeLike, NDArray
from PIL import Image as PillowImage
from PIL.PngImagePlugin import PngInfo

from .base.checks import Ints, fixed
from .base.values import Value, array_key
from .base.whole_file import check_output_file, write_output
from .chain._chain import Drawing
from .chain._opening import open_chain
from .errors import InputError, RenderError
from .scene._files.picture import CHUNK, DIGEST, PICTURE, SceneChunk, scene_chunk
from .scene._scene import Scene

Pixels = NDArray[np.uint8]


def _pixels(values: ArrayLike) -> Pixels:
    try:
        given = np.asarray(values)
        with np.errstate(invalid="ignore"):
            pixels = fixed(given, np.uint8)
    except (TypeError, ValueError, OverflowError):
        given = pixels = np.zeros(0, np.uint8)
    if pixels.ndim != 3 or pixels.shape[2] != 3 or not pixels.size or not (pixels == given).all():
        raise InputError(f"the pixels of a picture must be bytes of shape (height, width, 3), not {values!r:.60}")
    return pixels


def _alpha(values: ArrayLike | None) -> Pixels | None:
    return None if values is None else fixed(np.asarray(values), np.uint8)


@frozen(repr=False)
class Image(Value):
    """A picture as a contract made it.

    pixels: (H, W, 3) uint8, rows from the top. bmp: the file that the contract returned; by default of the pixels.
    gas, intrinsic_gas: of the execution, and of a transaction before it; None where gas is not counted.
    made_by: the EVM, node or cluster. seconds: the duration of the call, which == ignores.
    scene: None if it is not known. calls: the number of calls that made it. call_gas: the gas of the most expensive of
    them.
    evm: the name of the embedded EVM that counts triangles and covered pixels; None for the default.
    alpha: (H, W) uint8, from 0 where there is nothing to 255; None for a picture with a background.
    """

    pixels: Pixels = field(converter=_pixels, eq=array_key)
    bmp: bytes = b""
    gas: int | None = None
    intrinsic_gas: int | None = None
    made_by: str = ""
    seconds: float = field(default=0.0, eq=False)
    scene: Scene | None = None
    calls: int = 1
    alpha: Pixels | None = field(default=None, converter=_alpha, eq=array_key)
    evm: str | None = field(default=None, eq=False)
    call_gas: int | None = None

    def __attrs_post_init__(self) -> None:
        if self.calls == 1 and self.call_gas is None:
            object.__setattr__(self, "call_gas", self.gas)
        if self.alpha is not None and self.alpha.shape != self.pixels.shape[:2]:
            raise InputError(
                f"alpha must have the shape {self.pixels.shape[:2]} of the picture, not {self.alpha.shape}"
            )
        if not self.bmp:
            object.__setattr__(self, "bmp", encode_bmp(self.pixels))

    @property
    def width(self) -> int:
        """The number of pixels."""
        return int(self.pixels.shape[1])

    @property
    def height(self) -> int:
        """The number of pixels."""
        return int(self.pixels.shape[0])

    @property
    def triangles(self) -> int | None:
        """The number of triangles after culling and clipping; None if the scene is not known.

        Counted by the contract, in the embedded EVM, at the first access of this or `covered_pixels`. Raises the errors
        of `render`.
        """
        return self._counts[0]

    @property
    def covered_pixels(self) -> int | None:
        """The number of pixels that triangles cover; None if the scene is not known. Counted as `triangles` are."""
        return self._counts[1]

    @cached_property
    def _counts(self) -> tuple[int, int] | tuple[None, None]:
        return (None, None) if self.scene is None else open_chain(self.evm).count(self.scene)

    @cached_property
    def visible_pixels(self) -> int | None:
        """The number of pixels that differ from the background; None if the scene is not known.

        A background has one colour in each row: the embedded EVM draws one column of it. Raises the errors of `render`.
        """
        if self.alpha is not None:
            return int(np.count_nonzero(self.alpha))
        if self.scene is None:
            return None
        behind = open_chain(self.evm).draw(evolve(self.scene, objects=[], ground=None, width=1))
        return int((self.pixels != decode_bmp(behind.bmp, 1, self.height)).any(axis=2).sum())

    @property
    def sha256(self) -> str:
        """The SHA-256 of the bytes of `channels`, in hexadecimal digits."""
        return hashlib.sha256(self.channels.tobytes()).hexdigest()

    @property
    def channels(self) -> Pixels:
        """Red, green and blue of all pixels, (H, W, 3), or with alpha, (H, W, 4), rows from the top."""
        return self.pixels if self.alpha is None else np.dstack([self.pixels, self.alpha])

    @cached_property
    def scene_chunk(self) -> SceneChunk | None:
        """The scene as a PNG file carries it; None if it is not known."""
        return None if self.scene is None else scene_chunk(self.scene)

    def encode(self, extension: str, scene: bool | None = None) -> bytes:
        """Return the bytes of a file in a format of `FORMATS`, such as ".png". InputError for any other.

        A GIF has at most 256 colours, the nearest where there are more; a JPEG is near; other formats are exact. A
        picture with alpha needs ".png", ".svg" or ".webp".
        scene: whether a PNG file carries the scene, from which `load` restores it; None if it takes at most 64 KB.
        """
        return encoded(self, self.alpha is not None, extension, FORMATS, scene)

    def save(
        self,
        file: str | os.PathLike[str] | BinaryIO,
        extension: str | None = None,
        scene: bool | None = None,
        *,
        format: str | None = None,
    ) -> None:
        """Write a file atomically in the format of its extension, or to an open file in the format of `extension`.

        format: another word for `extension`, such as "PNG". scene: as in `encode`. InputError where the path or the
        extension is wrong, OutputError where the disk is full or fails.
        """
        if not isinstance(file, str | os.PathLike):
            write_open(file, extension or format, FORMATS, lambda kind: self.encode(kind, scene))
            return
        path = check_output(file)
        write_output(path, self.encode(extension or format or path.suffix, scene))

    def data_uri(self, extension: str = ".png") -> str:
        """Return a URI that holds a file, for HTML and JSON."""
        return data_uri(FORMATS[check_extension(extension, FORMATS)].media_type, self.encode(extension))

    def to_pil(self) -> PillowImage.Image:
        """Return the picture as an image of Pillow."""
        return PillowImage.fromarray(self.channels)

    def show(self) -> None:
        """Open the picture in the viewer of the system."""
        self.to_pil().show()

    def __array__(self, dtype: DTypeLike | None = None, copy: bool | None = None) -> NDArray[Any]:
        """Return the pixels, (H, W, 3), or with alpha, (H, W, 4), for NumPy."""
        return as_array(self.channels, dtype, copy)

    def __repr__(self) -> str:
        return f"<Image {self.width}x{self.height}{gas_in_short(self.gas)}>"

    def _repr_png_(self) -> bytes:
        return self.encode(".png")


Encoded = TypeVar("Encoded")


@frozen
class Format(Generic[Encoded]):
    """A file format: its media type, its encoder, and whether it keeps alpha."""

    media_type: str
    encode: Callable[[Encoded, bool | None], bytes]
    has_alpha: bool = False


def encoded(
    made: Encoded, has_alpha: bool, extension: object, formats: Mapping[str, Format[Any]], scene: bool | None
) -> bytes:
    """Return the bytes of a file of a picture or an animation. scene: as in `Image.encode`."""
    kind = check_extension(extension, formats)
    if has_alpha:
        check_alpha(kind, formats)
    if scene and kind != PICTURE:
        raise InputError(f"only a {PICTURE} file carries its scene, not {kind}")
    return formats[kind].encode(made, scene)


def _encode_png(image: Image, scene: bool | None = None) -> bytes:
    return pillow_bytes(image.to_pil(), "PNG", **png_options(image, scene))


def _encode_svg(image: Image, _: bool | None) -> bytes:
    # a PNG, since image servers draw nothing for a bitmap within an SVG
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {image.width} {image.height}">'
        f'<image width="{image.width}" height="{image.height}" style="image-rendering:pixelated"'
        f' href="{data_uri("image/png", _encode_png(image, False))}"/></svg>'
    ).encode()


#: Pillow's options for a WebP file that keeps every byte.
WEBP = {"lossless": True, "exact": True}
#: Its colours have full resolution: edges of one pixel stay sharp.
JPEG: Format[Image] = Format(
    "image/jpeg", lambda image, _: pillow_bytes(image.to_pil(), "JPEG", quality=95, subsampling=0)
)

#: The formats of `Image.save`, by extension.
FORMATS: dict[str, Format[Image]] = {
    PICTURE: Format("image/png", _encode_png, has_alpha=True),
    ".bmp": Format("image/bmp", lambda image, _: image.bmp),
    ".svg": Format("image/svg+xml", _encode_svg, has_alpha=True),
    ".gif": Format("image/gif", lambda image, _: pillow_bytes(indexed([image.pixels])[0], "GIF")),
    ".jpg": JPEG,
    ".jpeg": JPEG,
    ".webp": Format("image/webp", lambda image, _: pillow_bytes(image.to_pil(), "WEBP", **WEBP), has_alpha=True),
}


def one_of(formats: Iterable[str]) -> str:
    """Return extensions in words, such as ".png .bmp or .gif"."""
    *others, last = formats
    return f"{' '.join(others)} or {last}"


def pillow_bytes(picture: PillowImage.Image, name: str, **options: Any) -> bytes:
    """Return the bytes of a file in a format of Pillow."""
    stream = io.BytesIO()
    picture.save(stream, name, **options)
    return stream.getvalue()


def png_options(image: Image, scene: bool | None = None) -> dict[str, PngInfo]:
    """Return Pillow's options for a PNG file that carries the scene of an image. scene: as in `Image.encode`.

    InputError where the scene is wanted but not possible.
    """
    chunk = None if scene is False else image.scene_chunk
    if scene:
        if chunk is None:
            raise InputError("the picture cannot carry its scene, which is not known")
        chunk.check()
    if chunk is None:
        return {}
    texts = PngInfo()
    texts.add(*((CHUNK, chunk.data) if scene or chunk.is_small else (DIGEST, chunk.digest)))
    return {"pnginfo": texts}


def check_alpha(extension: str, formats: Mapping[str, Format[Any]]) -> None:
    """Refuse one of the formats if it does not keep alpha."""
    if not formats[extension].has_alpha:
        known = one_of(name for name, each in formats.items() if each.has_alpha)
        raise InputError(f"a transparent picture needs a {known} file: {extension} has no alpha channel")


def uncovered(black: Image, white: Image, scene: Scene | None = None) -> Image:
    """Return the picture of a scene without its background, from its pictures over black and over white.

    What covers a share of a pixel hides that share of the difference between the two. The contracts compute the same:
    see contracts/src/encode/TransparentPng.sol. Gas and calls are those of both pictures.
    """
    dark = black.pixels.astype(np.int64)
    alpha = 255 - np.maximum(white.pixels - dark, 0).max(axis=2)
    shared = np.maximum(alpha, 1)[:, :, None]
    pixels = np.where(alpha[:, :, None] > 0, np.minimum((dark * 255 + shared // 2) // shared, 255), 0)
    both = (black, white)
    return Image(
        pixels,
        gas=total(image.gas for image in both),
        intrinsic_gas=total(image.intrinsic_gas for image in both),
        made_by=black.made_by,
        seconds=black.seconds + white.seconds,
        scene=scene,
        calls=black.calls + white.calls,
        call_gas=total((image.call_gas for image in both), max),
        alpha=alpha,
        evm=black.evm,
    )


def total(numbers: Iterable[int | None], of: Callable[[list[int]], int] = sum) -> int | None:
    """Return the sum of gas, or `max` of it; None if it was not counted everywhere."""
    found = [*numbers]
    counted = [each for each in found if each is not None]
    return of(counted) if len(counted) == len(found) else None


def data_uri(media_type: str, data: bytes) -> str:
    """Return a URI that holds the bytes of a file."""
    return f"data:{media_type};base64,{base64.b64encode(data).decode()}"


def as_array(pixels: Pixels, dtype: DTypeLike | None, copy: bool | None) -> NDArray[Any]:
    """Return pixels for `__array__`; ValueError where a copy is needed but not allowed."""
    changed = dtype is not None and np.dtype(dtype) != pixels.dtype
    if changed and copy is False:
        raise ValueError(f"pixels are {pixels.dtype}: an array of another type is a copy")
    return pixels.astype(dtype) if changed else pixels.copy() if copy else pixels


def write_open(
    file: object, extension: str | None, formats: Mapping[str, object], encode: Callable[[str], bytes]
) -> None:
    """Write to an open file, in the format of `extension` or else of its name. InputError if it is neither."""
    if not hasattr(file, "write"):
        raise InputError(f"a picture is saved to a path or an open file, not to {file!r:.60}")
    name = getattr(file, "name", "")
    file.write(encode(extension or check_extension(Path(name if isinstance(name, str) else "").suffix, formats)))


def check_output(path: str | os.PathLike[str], in_new_folder: bool = False) -> Path:
    """Return the path, if a picture can be saved there. InputError if not. in_new_folder: as in `check_output_file`."""
    path = Path(path)
    if path.suffix.lower() not in FORMATS:
        raise InputError(f"the picture {path} must end in one of {' '.join(FORMATS)}")
    return check_output_file(path, "picture", in_new_folder)


def check_extension(extension: object, formats: Iterable[str]) -> str:
    """Return one of the formats, given as "png", ".png" or ".PNG". InputError for any other."""
    known = tuple(formats)
    found = f".{extension.removeprefix('.').lower()}" if isinstance(extension, str) else None
    if found not in known:
        raise InputError(f"the format must be one of {' '.join(known)}, not {extension!r:.60}")
    return found


def gas_in_short(gas: int | None) -> str:
    """Return the end of a line of figures, such as ", 35.3M gas"; "" where gas is not counted."""
    if gas is None:
        return ""
    return f", {gas / 1e6:,.1f}M gas" if gas >= 1e6 else f", {gas:,} gas"


def encode_bmp(pixels: Pixels) -> bytes:
    """Return a BMP of 24 bits a pixel as the contracts make it, of pixels (H, W, 3), rows from the top."""
    return pillow_bytes(PillowImage.fromarray(pixels), "BMP", dpi=(72, 72))


def decode_bmp(data: bytes, width: int, height: int) -> NDArray[np.uint8]:
    """Return the pixels, (H, W, 3), of a 24-bit BMP as the contracts make it; anything else is a RenderError."""
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


def render_whole(scene: Scene, draw: Callable[[Scene], Drawing], made_by: str, evm: str | None = None) -> Image:
    """Render a scene by one call. draw: makes it. made_by, evm: see `Image`."""
    started = time.perf_counter()
    drawing = draw(scene)
    seconds = time.perf_counter() - started
    return Image(
        pixels=decode_bmp(drawing.bmp, scene.width, scene.height),
        bmp=drawing.bmp,
        gas=drawing.gas,
        intrinsic_gas=drawing.intrinsic_gas,
        made_by=made_by,
        seconds=seconds,
        scene=scene,
        evm=evm,
    )


MOST_COLORS = 256
#: The number of frames that are sampled to choose the colours of an animation.
SAMPLED = 16


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
    sample = PillowImage.fromarray(np.concatenate(frames[:: -(-len(frames) // SAMPLED)]))
    palette = sample.quantize(MOST_COLORS, dither=PillowImage.Dither.NONE)
    return [PillowImage.fromarray(f).quantize(palette=palette, dither=PillowImage.Dither.NONE) for f in frames]


def _distinct(frames: Sequence[Pixels]) -> Ints:
    """Return the colours 0xRRGGBB of all frames, in order."""
    return np.unique(np.concatenate([np.unique(_packed(frame)) for frame in frames]))


def _packed(frame: Pixels) -> Ints:
    """Return the colours as numbers 0xRRGGBB, (H, W)."""
    return np.asarray(frame.astype(np.int64) @ [1 << 16, 1 << 8, 1])
