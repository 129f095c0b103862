"""Render frames: cut them into parts, render the parts on backends, assemble the pictures."""

from __future__ import annotations

import time
from collections.abc import Sequence
from contextlib import ExitStack

import numpy as np

from ..chain._chain import Drawing
from ..chain._layout import BAND_PIXELS
from ..errors import caller
from ..image import Image, decode_bmp, total
from ..scene._codec import Rectangle
from ..scene._scene import Scene
from ._backends import SAMPLE, Backend, Part, Verifier
from ._estimate import Estimate, estimate
from ._scheduler import Listener, Outline, Scheduler
from ._store import PartStore
from ._tiles import area, cut, grid
from .places import Nodes, RenderOptions

#: Parts for each slot, so that all are busy until the end, and the extra gas that this may cost.
PARTS_PER_SLOT = 4
MOST_EXTRA = 0.3
#: The least pixels of a part, or a row where that is more: in smaller ones the fixed cost of a call dominates.
LEAST_PIXELS = 1024
#: The most pixels of a part: about 50 MB for its pixels and buffers.
MOST_PIXELS = 1 << 22
#: Pictures that take less gas are compared whole, which takes a second or two.
COMPARED_GAS = 500_000_000
DEFAULTS = RenderOptions()


def render_frames(frames: Sequence[Scene], how: RenderOptions = DEFAULTS) -> list[Image]:
    """Render frames of equal size. The folder `keep` of finished parts remains: the caller removes it."""
    listener, place = how.listener or Listener(), how.on
    listener.place = caller()
    started = time.perf_counter()
    with ExitStack() as stack:
        stack.callback(listener.ended)
        backends = place.open(listener, how.gas_limit)
        for backend in backends:
            stack.callback(backend.close)
        expected = estimate(frames[0])
        tiles = plan(frames[0], len(frames), backends, expected, how.tile)
        parts = [Part(number, tile) for number in range(len(frames)) for tile in tiles]
        verifier, compared = choose_verifier(backends, expected, place.verify)
        store = None if how.keep is None else PartStore(how.keep, frames, compared)
        count = len(frames)
        listener.planned(Outline(len(parts), count, count * expected.area, count * expected.gas(len(tiles))))
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
        name, seconds = _name(scheduler.used), (time.perf_counter() - started) / len(frames)
        evm = None if isinstance(place, Nodes) else place.evm
        return [_assemble(number, scene, pieces, name, seconds, evm) for number, scene in enumerate(frames)]


def plan(
    scene: Scene, frames: int, backends: Sequence[Backend], expected: Estimate, tile: tuple[int, int] | None
) -> list[Rectangle]:
    """Return the tiles of each frame. tile: their size if it is fixed."""
    width, height = scene.width, scene.height
    if tile is not None:
        return list(grid(width, height, *tile))
    fitting = [expected.pixels_within(backend.gas) for backend in backends if backend.gas is not None]
    # if the estimate says that nothing fits, try the smallest useful tiles
    pixels = max(min([MOST_PIXELS, *fitting]), width, LEAST_PIXELS)
    slots = sum(backend.slots for backend in backends)
    wanted = 1 if frames >= slots else -(-PARTS_PER_SLOT * slots // frames)
    if wanted > 1:
        spare = MOST_EXTRA * expected.gas() / max(1.0, expected.call)
        wanted = max(min(wanted, 1 + int(spare)), -(-slots // frames))
    return cut(width, height, pixels, max(wanted, _of_whole_bands(expected.cheapest_strips(), width, height)))


def _of_whole_bands(strips: int, width: int, height: int) -> int:
    """Return so many strips, or a few more: all of whole bands of the contract, where they divide the canvas."""
    if strips == 1:
        return 1
    rows, band = height // strips, BAND_PIXELS // width
    return -(-height // (rows - rows % band if rows > band else rows))


def choose_verifier(
    backends: Sequence[Backend], expected: Estimate, verify: str | None
) -> tuple[Verifier | None, bool]:
    """Return the verifier of untrusted backends, or None; and whether every part is known to be right in the end."""
    if not any(backend.untrusted for backend in backends):
        return None, True
    if verify is None:
        verify = "all" if expected.gas() < COMPARED_GAS else "some"
    return (None if verify == "none" else Verifier(verify == "all")), verify == "all"


def _assemble(
    number: int, scene: Scene, pieces: dict[Part, Drawing], name: str, seconds: float, evm: str | None
) -> Image:
    """Return the picture of a frame, assembled from its parts."""
    own = {part.tile: piece for part, piece in pieces.items() if part.frame == number}
    pixels = np.zeros((scene.height, scene.width, 3), np.uint8)
    for tile, piece in own.items():
        drawn = decode_bmp(piece.bmp, tile.width, tile.height)
        pixels[tile.y : tile.y + tile.height, tile.x : tile.x + tile.width] = drawn
    if sum(map(area, own)) != scene.width * scene.height:
        raise AssertionError("the parts of a picture are not the whole")
    return Image(
        pixels=pixels,
        # of several tiles the same bytes as the contract would have made
        bmp=next(iter(own.values())).bmp if len(own) == 1 else b"",
        gas=total(piece.gas for piece in own.values()),
        intrinsic_gas=total(piece.intrinsic_gas for piece in own.values()),
        made_by=name,
        seconds=seconds,
        scene=scene,
        calls=len(own),
        call_gas=total((piece.gas for piece in own.values()), max),
        evm=evm,
    )


def _name(backends: Sequence[Backend]) -> str:
    if len(backends) == 1:
        return backends[0].name
    return f"{len(backends)} nodes: {', '.join(backend.name.removeprefix('node ') for backend in backends)}"
