"""What the workers hand back."""

from __future__ import annotations

from dataclasses import dataclass

from ..image import decode_bmp
from .film import png
from .fits import Fit
from .scene import Facts
from .state import Source


@dataclass(frozen=True)
class Frame:
    """A picture.

    bmp: the file as the contract returned it. gas, intrinsic_gas: None where none is counted. triangles, lit_pixels:
    None if they were not wanted. calldata_bytes: of the call. seconds: that the call took. fits: where the call fits;
    empty where no gas is counted.
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
        """The same picture as a PNG file. It is made here: most pictures are shown as they came, and pass by."""
        return png(decode_bmp(self.bmp, self.width, self.height), 1)


@dataclass(frozen=True)
class StagePicture:
    """A stage of the pipeline. detail: a few words with numbers. png: what it made."""

    name: str
    title: str
    detail: str
    png: bytes


@dataclass(frozen=True)
class Upload:
    """A file that was handed in and read. notes: what was done to it, for people; one sentence each."""

    source: Source
    facts: Facts
    notes: tuple[str, ...]


@dataclass(frozen=True)
class Comparison:
    """The picture of a node beside ours. same: whether all bytes are. node: its name. seconds: that it took."""

    same: bool
    node: str
    seconds: float


@dataclass(frozen=True)
class File:
    """Something to take away. name: for the visitor's folder. media_type: as browsers know it."""

    name: str
    media_type: str
    data: bytes
