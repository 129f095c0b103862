"""Pictures one after the other: GIF, APNG, or a folder of PNG files."""

from __future__ import annotations

import io
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image as PillowImage

from .checks import number
from .errors import InputError
from .image import Image
from .whole_file import write_whole

#: What `Animation.save` can write, by extension; a name without one is a folder.
FORMATS = (".gif", ".png")
#: Milliseconds that a frame is shown.
DURATION = 80
MOST_COLORS = 256
#: Frames that are looked at to choose the colours of a GIF.
SAMPLED = 16


@dataclass(frozen=True, eq=False)
class Animation:
    """Frames as a contract made them, all of one size; the last leads over to the first."""

    frames: Sequence[Image]
    duration: int = DURATION

    def __post_init__(self) -> None:
        check_duration(self.duration)

    @property
    def gas(self) -> int | None:
        """Of all frames together; None where none is counted."""
        return _sum([frame.gas for frame in self.frames])

    @property
    def intrinsic_gas(self) -> int | None:
        """Of all frames together; None where none is counted."""
        return _sum([frame.intrinsic_gas for frame in self.frames])

    @property
    def pixels(self) -> NDArray[np.uint8]:
        """(n, H, W, 3): n frames."""
        return np.stack([frame.pixels for frame in self.frames])

    def encode(self, extension: str) -> bytes:
        """The bytes of a file: ".gif" (256 colours for all frames together, the nearest where there are more) or ".png"
        (an APNG, exact).
        """
        stream = io.BytesIO()
        if extension == ".gif":
            pictures = _shared_palette([frame.pixels for frame in self.frames])
            options: dict[str, Any] = {"format": "GIF", "optimize": False, "disposal": 1}
        else:
            pictures = [PillowImage.fromarray(frame.pixels) for frame in self.frames]
            options = {"format": "PNG", "default_image": False}
        durations = [round(self.duration)] * len(pictures)
        pictures[0].save(stream, save_all=True, append_images=pictures[1:], loop=0, duration=durations, **options)
        return stream.getvalue()

    def save(self, path: str | Path) -> None:
        """Writes a file, in the format of its extension, whole or not at all; or a folder of numbered PNG files."""
        path = check_animation(path)
        try:
            if path.suffix:
                write_whole(path, self.encode(path.suffix.lower()))
                return
            path.mkdir(exist_ok=True)
            for name, frame in zip(frame_names(len(self.frames)), self.frames, strict=True):
                write_whole(path / name, frame.encode(".png"))
        except OSError as error:
            raise InputError(f"{path} cannot be written: {error.strerror}") from None

    def _repr_mimebundle_(self, **_: Any) -> dict[str, bytes]:
        return {"image/png": self.encode(".png")}


def check_duration(milliseconds: int) -> int:
    """How long a frame is shown, if it can be: what is shorter than two hundredths of a second, viewers show longer."""
    return round(number(milliseconds, "the duration of a frame in milliseconds", 20, 10_000))


def frame_names(count: int) -> list[str]:
    """The names of the files of a folder, in the order of the frames."""
    digits = max(3, len(str(count - 1)))
    return [f"{frame:0{digits}}.png" for frame in range(count)]


def check_animation(path: str | Path) -> Path:
    """The path, if an animation can be saved there."""
    path = Path(path)
    if path.suffix and path.suffix.lower() not in FORMATS:
        raise InputError(f"the turntable {path} must end in .gif or .png, or in nothing for a folder of pictures")
    if path.exists() and path.is_dir() == bool(path.suffix):
        raise InputError(f"{path} is there already, and is no {'file' if path.suffix else 'folder'}")
    if not path.parent.is_dir():
        raise InputError(f"the folder {path.parent} of the turntable {path.name} does not exist")
    if not os.access(path.parent, os.W_OK):
        raise InputError(f"the turntable {path} cannot be written: nothing can be written to its folder")
    return path


def colors(frames: Sequence[NDArray[np.uint8]]) -> int:
    """How many colours there are in all frames."""
    return len(_distinct(frames))


def _shared_palette(frames: Sequence[NDArray[np.uint8]]) -> list[PillowImage.Image]:
    """The frames in one palette of at most 256 colours: a colour that does not move does not flicker then."""
    found = _distinct(frames)
    if len(found) <= MOST_COLORS:
        colors = np.stack([found >> 16, found >> 8 & 255, found & 255], axis=1).astype(np.uint8).tobytes()
    else:
        step = -(-len(frames) // SAMPLED)
        sample = PillowImage.fromarray(np.concatenate(frames[::step]))
        colors = bytes(sample.quantize(MOST_COLORS, dither=PillowImage.Dither.NONE).getpalette() or [])
    palette = PillowImage.new("P", (1, 1))
    palette.putpalette(colors)
    return [PillowImage.fromarray(f).quantize(palette=palette, dither=PillowImage.Dither.NONE) for f in frames]


def _distinct(frames: Sequence[NDArray[np.uint8]]) -> NDArray[np.int64]:
    """The colours 0xRRGGBB of all frames."""
    each = [np.unique(frame.reshape(-1, 3).astype(np.int64) @ [1 << 16, 1 << 8, 1]) for frame in frames]
    return np.unique(np.concatenate(each))


def _sum(numbers: Sequence[int | None]) -> int | None:
    known = [value for value in numbers if value is not None]
    return sum(known) if len(known) == len(numbers) else None
