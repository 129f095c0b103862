"""From anything that can be drawn to a picture."""

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
    """Make the picture of anything that `load` takes.

    size, look: as of `load`.
    on: where: None for the fastest EVM that is installed here, "pyrevm", "pyevm" or "reference" for one by its name,
    or `Processes`, `Nodes` or `Cluster`. The pixels are the same everywhere.
    gas_limit: what a call may use. tile: side, or (width, height), in pixels of the parts in which the picture is made;
    None takes what fits.
    listener: told how a picture of several parts goes on. keep: a folder in which finished parts are kept, for the same
    call to go on from there; whoever uses the picture removes it.
    InputError for what is wrong with the scene, ChainError for what fails in a call.
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
    """Make the pictures of a full turn about the vertical axis through the middle of anything that `load` takes.

    The contract turns it: each frame is a call, with the rotation in it. Background, lights and camera stand still.
    frames: how many, 2..720. duration: milliseconds that each is shown, 20..10,000. The rest as in `render`.
    """
    from .parallel import render_frames

    turned = full_turn(load(thing, size, **look), frames)
    return Animation(render_frames(turned, _where(on, gas_limit, tile), listener, keep).images, duration)


def draw(scene: Scene, where: Where, listener: Listener | None = None, keep: Path | None = None) -> Image:
    """Return the picture of a scene, by one call here or by several anywhere."""
    if where.alone:
        chain = where.chain
        return render_whole(scene, open_chain(chain) if chain is None or isinstance(chain, str) else chain)
    from .parallel import render_frames

    return render_frames([scene], where, listener, keep).images[0]


def render_whole(scene: Scene, chain: Chain) -> Image:
    """Return the picture of a scene, by one call."""
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
