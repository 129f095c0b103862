"""Rendering: images and turntables of anything that `load` takes."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Unpack

from ._load import Thing, load
from ._on import On, where_of
from .animation import DURATION, Animation
from .chain import Chain, open_chain
from .image import Image, decode_bmp
from .scene import LookOptions, Scene, full_turn, size_of

if TYPE_CHECKING:
    from .parallel import Listener, Where


def render(
    thing: Thing,
    size: int | tuple[int, int] | None = None,
    *,
    on: On | None = None,
    gas_limit: int | None = None,
    tile: int | tuple[int, int] | None = None,
    listener: Listener | None = None,
    keep: Path | None = None,
    **look: Unpack[LookOptions],
) -> Image:
    """Render anything that `load` takes.

    size, look: as in `load`.
    on: where to render: "pyrevm", "pyevm" or "reference" for an embedded EVM, `Processes`, `Nodes` or `Cluster`; None
    for the fastest embedded EVM that is installed. The pixels are the same everywhere.
    gas_limit: of a call. tile: side, or (width, height), in pixels of the parts in which a picture is rendered; None
    for the largest that fit.
    listener: receives the progress of a picture in several parts. keep: a folder for finished parts, from which the
    same call continues after an interruption; the caller removes it.
    InputError if the scene is not valid, ChainError if a call fails.
    """
    return draw(load(thing, size, **look), _where(on, gas_limit, tile), listener, keep)


def turntable(
    thing: Thing,
    frames: int = 36,
    size: int | tuple[int, int] | None = None,
    *,
    duration: int = DURATION,
    on: On | None = None,
    gas_limit: int | None = None,
    tile: int | tuple[int, int] | None = None,
    listener: Listener | None = None,
    keep: Path | None = None,
    **look: Unpack[LookOptions],
) -> Animation:
    """Render a full turn about the vertical axis through the middle of anything that `load` takes.

    The contract rotates the objects; background, lights and camera stand still.
    frames: their number, 2..720. duration: of each in milliseconds, 20..10,000. Other parameters as in `render`.
    """
    from .parallel import render_frames

    turned = full_turn(load(thing, size, **look), frames)
    return Animation(render_frames(turned, _where(on, gas_limit, tile), listener, keep).images, duration)


def draw(scene: Scene, where: Where, listener: Listener | None = None, keep: Path | None = None) -> Image:
    """Render a scene, by one call or in parts."""
    if where.alone:
        chain = where.chain
        return render_whole(scene, open_chain(chain) if chain is None or isinstance(chain, str) else chain)
    from .parallel import render_frames

    return render_frames([scene], where, listener, keep).images[0]


def render_whole(scene: Scene, chain: Chain) -> Image:
    """Render a scene by one call."""
    started = time.perf_counter()
    drawing = chain.draw(scene)
    seconds = time.perf_counter() - started
    return Image(
        pixels=decode_bmp(drawing.bmp, scene.width, scene.height),
        bmp=drawing.bmp,
        gas=drawing.gas,
        intrinsic_gas=drawing.intrinsic_gas,
        made_by=chain.name,
        seconds=seconds,
        scene=scene,
    )


def _where(on: On | None, gas_limit: int | None, tile: int | tuple[int, int] | None) -> Where:
    return where_of(on, gas_limit, None if tile is None else size_of(tile, "`tile`"))
