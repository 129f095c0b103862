"""Animations: GIF, APNG, WebP, MP4, or a folder of PNG files."""

from __future__ import annotations

import io
import os
import tempfile
import webbrowser
from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from importlib.util import find_spec
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from attrs import field, frozen
from numpy.typing import ArrayLike, DTypeLike, NDArray
from PIL import Image as PillowImage
from PIL import ImageSequence

from .base.checks import number
from .base.synonyms import Given, Hinted, with_synonyms
from .base.values import plural
from .base.whole_file import check_output_file, check_output_folder, make_output_folder, write_output
from .contract_file import ContractFile
from .errors import InputError, not_installed
from .image import (
    WEBP,
    Format,
    Image,
    Pixels,
    as_array,
    check_extension,
    data_uri,
    encoded,
    gas_in_short,
    indexed,
    one_of,
    pillow_bytes,
    png_options,
    total,
    write_open,
)
from .scene._files.picture import PICTURE

#: Milliseconds for which a frame is shown.
DURATION = 80
MP4 = ".mp4"
#: The range of durations; viewers ignore shorter ones.
DURATIONS = (20, 10_000)


def check_duration(milliseconds: float) -> int:
    """Return the duration of a frame, within `DURATIONS`."""
    return round(number(milliseconds, "the duration of a frame in milliseconds", *DURATIONS))


def with_duration(given: Given) -> Given:
    """Return keywords with the duration of a frame in milliseconds in place of `fps`, the frames in a second."""
    if "fps" not in given:
        return given
    if "duration" in given:
        raise InputError("`fps` and `duration` exclude each other: give one of them")
    fps = given.pop("fps")
    try:
        given["duration"] = round(1000 / fps)
    except (TypeError, ValueError, ZeroDivisionError, OverflowError):
        raise InputError(f"`fps` must be the number of frames in a second, not {fps!r:.60}") from None
    return given


def _frames(frames: Iterable[Image | ArrayLike]) -> tuple[Image, ...]:
    return tuple(frame if isinstance(frame, Image) else Image(frame) for frame in frames)


@with_synonyms("fps", read=with_duration)
@frozen(repr=False)
class Animation(Hinted):
    """Frames as a contract made them, all of one size, repeated endlessly. They are its members: len, [n] and `for`.

    frames: Images, or pixels, (H, W, 3). duration: of each frame in milliseconds, 20..10,000. file: the APNG, if a
    contract made all of it.
    """

    frames: tuple[Image, ...] = field(converter=_frames)
    duration: int = field(default=DURATION, converter=check_duration)
    file: ContractFile | None = None

    def __attrs_post_init__(self) -> None:
        sizes = {frame.pixels.shape for frame in self.frames}
        if len(sizes) != 1:
            raise InputError(f"an animation needs at least one frame, and all of one size, not {len(sizes)} sizes")
        if len({frame.alpha is None for frame in self.frames}) > 1:
            raise InputError("the frames of an animation must all have alpha, or none of them")

    @classmethod
    def of(cls, file: ContractFile, duration: int) -> Animation:
        """Return the animation of an APNG that a contract made."""
        with PillowImage.open(io.BytesIO(file.content), formats=["PNG"]) as film:
            frames = [
                Image(np.array(frame.convert("RGB")), made_by=file.made_by) for frame in ImageSequence.Iterator(film)
            ]
        return cls(frames, duration, file)

    def __len__(self) -> int:
        return len(self.frames)

    def __iter__(self) -> Iterator[Image]:
        return iter(self.frames)

    def __getitem__(self, number: int) -> Image:
        return self.frames[number]

    def __repr__(self) -> str:
        first = self.frames[0]
        frames = plural(len(self.frames), "frame")
        return f"<Animation {first.width}x{first.height}, {frames}{gas_in_short(self.gas)}>"

    @property
    def gas(self) -> int | None:
        """The sum of all frames; None where gas is not counted."""
        return total(frame.gas for frame in self.frames) if self.file is None else self.file.gas

    @property
    def intrinsic_gas(self) -> int | None:
        """The sum of all frames; None where gas is not counted."""
        return total(frame.intrinsic_gas for frame in self.frames) if self.file is None else self.file.intrinsic_gas

    @property
    def calls(self) -> int:
        """The number of calls for all frames."""
        return sum(frame.calls for frame in self.frames) if self.file is None else 1

    @property
    def pixels(self) -> NDArray[np.uint8]:
        """The pixels of all frames, (n, H, W, 3)."""
        return np.stack([frame.pixels for frame in self.frames])

    def encode(self, extension: str, scene: bool | None = None) -> bytes:
        """Return the bytes of a file: ".gif", ".webp", ".mp4", or ".png" for an APNG. InputError for any other.

        A GIF has at most 256 colours for all frames, the nearest where there are more; an MP4 is near, does not repeat,
        and needs the extra `mp4`; the others are exact. Frames with alpha need ".png" or ".webp".
        scene: whether an APNG carries the scene of its first frame, as in `Image.encode`; that of a contract does not.
        """
        return encoded(self, self.frames[0].alpha is not None, extension, FORMATS, scene)

    def save(
        self,
        file: str | os.PathLike[str] | BinaryIO,
        extension: str | None = None,
        scene: bool | None = None,
        *,
        format: str | None = None,
    ) -> None:
        """Write a file atomically in the format of its extension, or to an open file in the format of `extension`.

        A path without an extension is a folder of numbered PNG files, each with its scene. format: another word for
        `extension`. scene: as in `encode`. InputError where the path or the extension is wrong, OutputError where the
        disk is full or fails.
        """
        if not isinstance(file, str | os.PathLike):
            write_open(file, extension or format, FORMATS, lambda kind: self.encode(kind, scene))
            return
        path = check_animation(file)
        if path.suffix:
            write_output(path, self.encode(extension or format or path.suffix, scene))
            return
        make_output_folder(path)
        for name, frame in zip(frame_names(len(self.frames)), self.frames, strict=True):
            write_output(path / name, frame.encode(PICTURE, scene))

    def data_uri(self, extension: str = ".png") -> str:
        """Return a URI that holds a file, for HTML and JSON."""
        return data_uri(FORMATS[check_extension(extension, FORMATS)].media_type, self.encode(extension))

    def to_pil(self) -> list[PillowImage.Image]:
        """Return the frames as images of Pillow."""
        return [frame.to_pil() for frame in self.frames]

    def show(self) -> None:
        """Open the animation in the browser of the system."""
        with tempfile.NamedTemporaryFile(prefix="shackled-", suffix=".png", delete=False) as file:
            self.save(file, ".png")
        webbrowser.open(Path(file.name).as_uri())

    def __array__(self, dtype: DTypeLike | None = None, copy: bool | None = None) -> NDArray[Any]:
        """Return the pixels, (n, H, W, 3), for NumPy."""
        return as_array(self.pixels, dtype, copy)

    def _repr_mimebundle_(self, **_: Any) -> dict[str, bytes]:
        return {"image/png": self.encode(".png")}


def _encode(animation: Animation, pictures: Sequence[PillowImage.Image], name: str, **options: Any) -> bytes:
    durations = [animation.duration] * len(pictures)
    more = {"save_all": True, "append_images": pictures[1:], "loop": 0, "duration": durations}
    return pillow_bytes(pictures[0], name, **more, **options)


def _encode_gif(animation: Animation, _: bool | None) -> bytes:
    pictures = indexed([frame.pixels for frame in animation.frames])
    return _encode(animation, pictures, "GIF", optimize=False, disposal=1)


def _encode_apng(animation: Animation, scene: bool | None = None) -> bytes:
    if animation.file is not None and not scene:
        return animation.file.content
    options = png_options(animation.frames[0], scene)
    return _encode(animation, animation.to_pil(), "PNG", default_image=False, **options)


#: How near to the frames it is: 0 is exact, and 18 is taken as hardly to be told from that.
_QUALITY = "12"
#: Units of time in a second: milliseconds.
_UNITS = 1000


def check_mp4() -> None:
    """Raise an InputError if MP4 files cannot be written here."""
    if find_spec("av") is None:
        raise not_installed("an .mp4 file", "mp4")


def encode_mp4(frames: Sequence[Pixels], duration: int) -> bytes:
    """Return the file of frames, (H, W, 3), each shown for `duration` milliseconds. InputError as `check_mp4`.

    Every player shows such files, whose colours have half the size, so sides are even: an odd one gets one more pixel.
    """
    check_mp4()
    import av

    file = io.BytesIO()
    height, width = (side + side % 2 for side in frames[0].shape[:2])
    with av.open(file, "w", format="mp4") as container:
        stream = container.add_stream("libx264", rate=Fraction(_UNITS, duration), options={"crf": _QUALITY})
        stream.width, stream.height, stream.pix_fmt = width, height, "yuv420p"
        stream.codec_context.time_base = Fraction(1, _UNITS)
        for number, pixels in enumerate(frames):
            more = (height - pixels.shape[0], width - pixels.shape[1])
            frame = av.VideoFrame.from_ndarray(np.pad(pixels, [(0, more[0]), (0, more[1]), (0, 0)], "edge"), "rgb24")
            frame.pts, frame.time_base = number * duration, Fraction(1, _UNITS)
            container.mux(stream.encode(frame))
        container.mux(stream.encode(None))
    return file.getvalue()


#: The formats of `Animation.save`, by extension; a name without one is a folder.
FORMATS: dict[str, Format[Animation]] = {
    ".gif": Format("image/gif", _encode_gif),
    PICTURE: Format("image/png", _encode_apng, has_alpha=True),
    ".webp": Format("image/webp", lambda film, _: _encode(film, film.to_pil(), "WEBP", **WEBP), has_alpha=True),
    MP4: Format("video/mp4", lambda film, _: encode_mp4([frame.pixels for frame in film.frames], film.duration)),
}


def frame_names(count: int) -> list[str]:
    """Return the names of the files of a folder, in the order of the frames."""
    digits = max(3, len(str(count - 1)))
    return [f"{frame:0{digits}}.png" for frame in range(count)]


def check_animation(path: str | os.PathLike[str], in_new_folder: bool = False) -> Path:
    """Return the path, if an animation can be saved there. in_new_folder: as in `check_output_file`."""
    path = Path(path)
    if path.suffix and path.suffix.lower() not in FORMATS:
        raise InputError(f"the animation {path} must end in {one_of(FORMATS)}, or be a folder")
    if path.suffix.lower() == MP4:
        check_mp4()  # before anything is drawn
    is_file = path.suffix or not os.path.lexists(path)
    return check_output_file(path, "animation", in_new_folder) if is_file else check_output_folder(path)
