"""Render frames: cut them into parts, render the parts on backends, assemble the pictures."""

from __future__ import annotations

import time
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .._on import Bounds, Nodes, On, Place, place_of
from ..chain import Drawing, NodeChain, open_chain
from ..errors import caller
from ..gas import BAND_PIXELS
from ..image import Image, decode_bmp, encode_bmp, most, total
from ..scene import Rectangle, Scene
from ._backends import SAMPLE, Backend, ChainBackend, Part, Verifier
from ._counter import Counter
from ._estimate import Estimate, estimate
from ._scheduler import Listener, Outline, Scheduler
from ._store import PartStore
from ._tiles import area, cut, grid

#: Parts for each slot, so that all are busy until the end, and the extra gas that this may cost.
PARTS_PER_SLOT = 4
MOST_EXTRA = 0.3
#: The least pixels of a part, or a row where that is more: in smaller ones the fixed cost of a call dominates.
LEAST_PIXELS = 1024
#: The most pixels of a part: about 50 MB for its pixels and buffers.
MOST_PIXELS = 1 << 22
#: Pictures that take less gas are compared whole, which takes a second or two.
COMPARED_GAS = 500_000_000
#: The bounds of calls where none were given.
UNBOUNDED = Bounds()


@dataclass(frozen=True)
class Finished:
    """The result of a job.

    images: the frames. calls: how many parts were rendered. shares: how many of them by each backend, by its name.
    """

    images: list[Image]
    calls: int
    estimated_gas: int
    shares: dict[str, int]


def render_frames(
    frames: Sequence[Scene],
    on: On | Place | None = None,
    bounds: Bounds = UNBOUNDED,
    listener: Listener | None = None,
    keep: Path | None = None,
) -> Finished:
    """Render frames of equal size. on: as in `render`.

    keep: a folder for finished parts, so that an interrupted job can be continued; the caller removes it.
    """
    listener, place = listener or Listener(), place_of(on)
    listener.place = caller()
    started = time.perf_counter()
    with ExitStack() as stack:
        stack.callback(listener.ended)
        backends = place.open(listener, bounds.gas_limit)
        for backend in backends:
            stack.callback(backend.close)
        expected = estimate(frames[0], open_chain())
        tiles = plan(frames[0], len(frames), backends, expected, bounds.tile)
        parts = [Part(number, tile) for number in range(len(frames)) for tile in tiles]
        verifier, compared = choose_verifier(frames[0], backends, expected, place.verify)
        # a single part may be cut later
        store = PartStore(keep, frames, compared) if keep is not None else None
        if store is not None and len(parts) > 1:
            parts = _planned(store, parts, bounds)
        pixels = frames[0].width * frames[0].height
        gas = len(frames) * expected.gas(pixels, max(1, len(parts) // len(frames)))
        listener.planned(Outline(len(parts), len(frames), pixels * len(frames), gas))
        if not compared and place.verify is None and len(parts) > 1:
            listener.warned(
                f"only a sample of the parts of so large a picture is verified (one in {SAMPLE}): "
                "`verify` all verifies every part"
            )
        scheduler = Scheduler(frames, backends, store, listener, verifier)
        try:
            pieces = scheduler.run(parts)
        except BaseException:
            if store is not None and store.leave():
                listener.warned(f"finished parts are kept in {store.folder}: run the same command to resume")
            raise
        name = _name(scheduler.used)
        seconds = time.perf_counter() - started
        if isinstance(place, Nodes):
            # nodes that were dropped are not asked for counts either
            chains = [backend.chain for backend in scheduler.used if isinstance(backend, ChainBackend)]
            place = place.only([each.connection.url for each in chains if isinstance(each, NodeChain)])
        images = [
            _assemble(n, scene, pieces, name, seconds / len(frames), place, bounds) for n, scene in enumerate(frames)
        ]
        return Finished(images, len(pieces), gas, scheduler.shares)


def plan(
    scene: Scene, frames: int, backends: Sequence[Backend], expected: Estimate, tile: tuple[int, int] | None
) -> list[Rectangle]:
    """Return the tiles of each frame. tile: their size if it is fixed."""
    width, height = scene.width, scene.height
    if tile is not None:
        return list(grid(width, height, *tile))
    pixels = MOST_PIXELS
    for backend in backends:
        if backend.gas is not None:
            pixels = min(pixels, expected.pixels_within(backend.gas))
    # if the estimate says that nothing fits, try the smallest useful tiles
    pixels = max(pixels, width, LEAST_PIXELS)
    slots = sum(backend.slots for backend in backends)
    wanted = 1 if frames >= slots else -(-PARTS_PER_SLOT * slots // frames)
    if wanted > 1:
        spare = MOST_EXTRA * expected.gas(width * height) / max(1.0, expected.call)
        wanted = max(min(wanted, 1 + int(spare)), -(-slots // frames))
    return cut(width, height, pixels, max(wanted, _of_whole_bands(expected.cheapest_strips(), width, height)))


def _of_whole_bands(strips: int, width: int, height: int) -> int:
    """Return so many strips, or a few more: all of whole bands of the contract, where they divide the canvas."""
    if strips == 1:
        return 1
    rows, band = height // strips, BAND_PIXELS // width
    return -(-height // (rows - rows % band if rows > band else rows))


def choose_verifier(
    scene: Scene, backends: Sequence[Backend], expected: Estimate, verify: str | None
) -> tuple[Verifier | None, bool]:
    """Return the verifier of untrusted backends, or None; and whether every part is known to be right in the end."""
    if not any(backend.untrusted for backend in backends):
        return None, True
    if verify is None:
        verify = "all" if expected.gas(scene.width * scene.height) < COMPARED_GAS else "some"
    return (None if verify == "none" else Verifier(verify == "all")), verify == "all"


def _planned(store: PartStore, parts: list[Part], bounds: Bounds) -> list[Part]:
    """Return the parts of an earlier run of the same job, or else those given."""
    earlier = store.read_plan()
    if earlier is not None and bounds.tile is None:
        return earlier
    store.write_plan(parts)
    return parts


def _assemble(
    number: int, scene: Scene, pieces: dict[Part, Drawing], chain: str, seconds: float, place: Place, bounds: Bounds
) -> Image:
    """Return the picture of a frame, assembled from its parts."""
    own = {part.tile: piece for part, piece in pieces.items() if part.frame == number}
    pixels = np.zeros((scene.height, scene.width, 3), np.uint8)
    for tile, piece in own.items():
        drawn = decode_bmp(piece.bmp, tile.width, tile.height)
        pixels[tile.y : tile.y + tile.height, tile.x : tile.x + tile.width] = drawn
    if sum(tile.width * tile.height for tile in own) != scene.width * scene.height:
        raise AssertionError("the parts of a picture are not the whole")
    return Image(
        pixels=pixels,
        bmp=_bmp(pixels, list(own.values())),
        gas=total(piece.gas for piece in own.values()),
        intrinsic_gas=total(piece.intrinsic_gas for piece in own.values()),
        made_by=chain,
        seconds=seconds,
        scene=scene,
        calls=len(own),
        call_gas=most(piece.gas for piece in own.values()),
        counter=Counter(place, max(map(area, own)) if len(own) > 1 else None, bounds.gas_limit),
    )


def _bmp(pixels: np.ndarray, pieces: list[Drawing]) -> bytes:
    """Return the BMP file of the contract, or of several tiles the same bytes as it would have made."""
    if len(pieces) == 1:
        return pieces[0].bmp
    return encode_bmp(pixels)


def _name(backends: Sequence[Backend]) -> str:
    if len(backends) == 1:
        return backends[0].name
    return f"{len(backends)} nodes: {', '.join(backend.name.removeprefix('node ') for backend in backends)}"
