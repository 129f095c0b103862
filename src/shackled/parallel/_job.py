"""From frames to pictures: cut into parts, rendered wherever they may be, put together."""

from __future__ import annotations

import time
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..chain import Drawing, PyrevmChain, open_chain
from ..image import Image, decode_bmp, encode_bmp
from ..scene import Rectangle, Scene
from ._estimate import Estimate, estimate
from ._listener import Listener, Outline
from ._part import Part
from ._place import Place
from ._referee import SAMPLE, Referee
from ._scheduler import Scheduler
from ._store import Store
from ._tiles import cut, grid
from ._where import Where

#: Parts for each seat, so that all have something to do until the end, as long as they cost at most so much more gas.
PARTS_PER_SEAT = 4
MOST_EXTRA = 0.3
#: Pixels of a part, or a row where that is more, at least: smaller ones mostly cost what each call costs.
LEAST_PIXELS = 1024
#: Pixels of a part at most: about 50 MB for its pixels and what is worked out about them.
MOST_PIXELS = 1 << 22
#: Pictures of nodes that take less gas are compared whole: here that takes a second or two. PIXELS: where no gas is
#: known, as only NumPy is there to draw them.
COMPARED_GAS, COMPARED_PIXELS = 500_000_000, 1 << 20


@dataclass(frozen=True)
class Finished:
    """images: the frames. calls: how many made them. shares: how many of them each place made, by its name."""

    images: list[Image]
    calls: int
    estimated_gas: int | None
    shares: dict[str, int]


def render_frames(
    frames: Sequence[Scene],
    where: Where,
    listener: Listener | None = None,
    keep: Path | None = None,
) -> Finished:
    """Renders frames, all of one size.

    keep: a folder in which finished parts are kept until the job is done; whoever uses the pictures removes it.
    """
    listener = listener or Listener()
    started = time.perf_counter()
    with ExitStack() as stack:
        stack.callback(listener.ended)
        places = where.open(listener)
        for place in places:
            stack.callback(place.close)
        expected = _estimate(frames[0], places, where)
        tiles = plan(frames[0], len(frames), places, expected, where.tile)
        parts = [Part(number, tile) for number in range(len(frames)) for tile in tiles]
        referee, compared = choose_referee(frames[0], places, expected, where.verify)
        # a single part may have to be cut too
        store = Store(keep, frames, compared) if keep is not None else None
        if store is not None and len(parts) > 1:
            parts = _planned(store, parts, where)
        pixels = frames[0].width * frames[0].height
        gas = None if expected is None else len(frames) * expected.gas(pixels, max(1, len(parts) // len(frames)))
        listener.planned(Outline(len(parts), len(frames), pixels * len(frames), gas))
        if not compared and where.verify is None and len(parts) > 1:
            listener.warned(
                f"of what nodes draw of a picture as large as this only samples are compared (one part in {SAMPLE}): "
                "`verify` all compares every pixel"
            )
        scheduler = Scheduler(frames, places, store, listener, referee)
        try:
            pieces = scheduler.run(parts)
        except BaseException:
            if store is not None and store.leave():
                listener.warned(f"finished parts are kept in {store.folder}: the same command goes on from there")
            raise
        name = _name(scheduler.used)
        seconds = time.perf_counter() - started
        images = [_assemble(n, scene, pieces, name, seconds / len(frames)) for n, scene in enumerate(frames)]
        return Finished(images, len(pieces), gas, scheduler.shares)


def plan(
    scene: Scene, frames: int, places: Sequence[Place], expected: Estimate | None, tile: tuple[int, int] | None
) -> list[Rectangle]:
    """The tiles of each frame."""
    width, height = scene.width, scene.height
    if tile is not None:
        return list(grid(width, height, *tile))
    pixels = MOST_PIXELS
    for place in places:
        if place.gas is not None and expected is not None:
            pixels = min(pixels, expected.pixels_within(place.gas))
    # what does not fit by this reckoning is tried in the smallest tiles that make sense
    pixels = max(pixels, width, LEAST_PIXELS)
    seats = sum(place.seats for place in places)
    wanted = 1 if frames >= seats else -(-PARTS_PER_SEAT * seats // frames)
    if expected is not None and wanted > 1:
        spare = MOST_EXTRA * expected.gas(width * height) / max(1.0, expected.call)
        wanted = max(min(wanted, 1 + int(spare)), -(-seats // frames))
    return cut(width, height, pixels, wanted)


def _estimate(scene: Scene, places: Sequence[Place], where: Where) -> Estimate | None:
    """What a frame will cost; None where that would take as long as the frame itself."""
    chain = open_chain(None)
    if not isinstance(chain, PyrevmChain) or any(place.name.startswith("NumPy") for place in places):
        return None
    return estimate(scene, chain)


def choose_referee(
    scene: Scene, places: Sequence[Place], expected: Estimate | None, verify: str | None
) -> tuple[Referee | None, bool]:
    """Who compares what places draw that may be wrong, and whether every part is right in the end."""
    if not any(place.distant for place in places):
        return None, True
    if verify is None:
        pixels = scene.width * scene.height
        cheap = pixels <= COMPARED_PIXELS if expected is None else expected.gas(pixels) < COMPARED_GAS
        verify = "all" if cheap else "some"
    return (None if verify == "none" else Referee(verify == "all")), verify == "all"


def _planned(store: Store, parts: list[Part], where: Where) -> list[Part]:
    """The parts of an earlier run of the same job, or else those."""
    earlier = store.read_plan()
    if earlier is not None and where.tile is None:
        return earlier
    store.write_plan(parts)
    return parts


def _assemble(number: int, scene: Scene, pieces: dict[Part, Drawing], chain: str, seconds: float) -> Image:
    """The picture of a frame from its parts."""
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
        gas=_sum([piece.gas for piece in own.values()]),
        intrinsic_gas=_sum([piece.intrinsic_gas for piece in own.values()]),
        made_by=chain,
        seconds=seconds,
        scene=scene,
        calls=len(own),
    )


def _bmp(pixels: np.ndarray, pieces: list[Drawing]) -> bytes:
    """The file: the one that the contract made, or, of tiles, the same as it would have made."""
    if len(pieces) == 1:
        return pieces[0].bmp
    return encode_bmp(pixels)


def _sum(numbers: Sequence[int | None]) -> int | None:
    known = [number for number in numbers if number is not None]
    return sum(known) if len(known) == len(numbers) else None


def _name(places: Sequence[Place]) -> str:
    if len(places) == 1:
        return places[0].name
    return f"{len(places)} nodes: {', '.join(place.name.removeprefix('node ') for place in places)}"
