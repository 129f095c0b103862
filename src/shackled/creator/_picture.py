"""Results of workers: pictures, the limits that they fit, and their encodings."""

from __future__ import annotations

import io
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image as PillowImage

from ..animation import Animation
from ..errors import OutOfGasError
from ..gas import KEPT, Limit, floor_gas, limits
from ..image import decode_bmp, pillow_bytes
from ._scene import Facts
from ._state import Source

Pixels = NDArray[np.uint8]

#: Largest transaction that nodes relay, in bytes: geth's txMaxSize, four slots of 32 KiB.
MAX_TRANSACTION = 4 * 32 * 1024
#: Bytes of a transaction besides its data: signature, addresses, fees; rounded up.
ENVELOPE = 512


@dataclass(frozen=True)
class Fit:
    """The comparison of a picture with one limit.

    kind: "transaction" or "call". limit: in gas. needed: gas limit that the request needs, or an upper bound of it.
    reason: why it does not fit, if gas is not the reason, or "". source, date, remark: of the limit.
    """

    name: str
    kind: str
    limit: int
    needed: int
    fits: bool
    reason: str
    source: str
    date: str
    remark: str

    @property
    def share(self) -> float:
        """Needed gas over the limit."""
        return self.needed / self.limit


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


# ---- where it fits ----


def places(
    gas: int, intrinsic_gas: int, calldata: bytes, suffices: Callable[[int], bool] | None = None
) -> tuple[Fit, ...]:
    """Return how a picture fits into each known limit, the smallest first.

    gas: of the execution. suffices: whether the call succeeds with a given gas for the execution. It is called only
    where the bounds do not decide, since a call must be given a little more gas than it uses; without it such a limit
    counts as too small.
    """
    floor = floor_gas(calldata)
    least, enough = gas, gas + gas // (KEPT - 1) + 1
    return tuple(_fit(limit, least, enough, intrinsic_gas, floor, len(calldata), suffices) for limit in limits())


def _fit(
    limit: Limit,
    least: int,
    enough: int,
    intrinsic: int,
    floor: int,
    size: int,
    suffices: Callable[[int], bool] | None,
) -> Fit:
    needed = max(intrinsic + enough, floor)
    fits = needed <= limit.gas
    if not fits and max(intrinsic + least, floor) <= limit.gas and suffices is not None:
        fits = suffices(limit.gas - intrinsic)
        needed = limit.gas if fits else needed
    reason = ""
    if limit.kind == "transaction" and size + ENVELOPE > MAX_TRANSACTION:
        fits, reason = False, f"its data of {size:,} bytes is more than the {MAX_TRANSACTION:,} that nodes relay"
    return Fit(limit.name, limit.kind, limit.gas, needed, fits, reason, limit.source, limit.date, limit.remark)


def headline(fits: tuple[Fit, ...]) -> str:
    """Return the result in a few words, such as "fits one transaction, and any node's read call"."""
    transactions = [fit for fit in fits if fit.kind == "transaction"]
    calls = [fit for fit in fits if fit.kind == "call"]
    nodes = sum(fit.fits for fit in calls)
    in_transaction = bool(transactions) and all(fit.fits for fit in transactions)
    if nodes == len(calls):
        where = "any node's read call"
    elif nodes:
        where = f"calls of {nodes} of {len(calls)} kinds of nodes"
    else:
        return "fits no usual node: take fewer pixels or triangles"
    return f"fits one transaction, and {where}" if in_transaction else f"fits {where}"


def by_trying(call: Callable[[int], object]) -> Callable[[int], bool]:
    """Return `suffices` for a function that makes the call with a given gas, and raises OutOfGasError."""

    def suffices(gas: int) -> bool:
        try:
            call(gas)
        except OutOfGasError:
            return False
        return True

    return suffices
