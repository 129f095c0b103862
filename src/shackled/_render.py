"""Rendering of pictures and turntables."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Unpack

from attrs import evolve

from ._load import Thing, load_frames, load_picture, of_arrays
from .animation import DURATION, DURATIONS, Animation, with_duration
from .base.synonyms import Given, with_synonyms
from .errors import InputError, OutOfGasError, warn
from .image import Image, render_whole, uncovered
from .parallel._job import render_frames
from .parallel._scheduler import Listener
from .parallel.places import Embedded, On, RenderOptions
from .scene._effects import Background
from .scene._scene import Scene
from .scene._settings import LookOptions
from .scene._turning import full_turn


def _of_picture(given: Given) -> Given:
    """Return keywords with vertices and faces as one thing, and a transparent background as a flag."""
    if str(given.get("background")).strip().lower() == "transparent":
        given |= {"background": None, "transparent": True}
    return of_arrays(given)


def _of_film(given: Given) -> Given:
    """Return the same, with the duration of a frame."""
    return with_duration(_of_picture(given))


@with_synonyms("vertices", "faces", read=_of_picture)
def render(
    thing: Thing,
    size: int | tuple[int, int] | None = None,
    *,
    on: On | None = None,
    gas_limit: int | None = None,
    tile: int | tuple[int, int] | None = None,
    listener: Listener | None = None,
    keep: Path | None = None,
    transparent: bool = False,
    fit: str | None = None,
    **look: Unpack[LookOptions],
) -> Image:
    """Render a picture.

    thing, size, look: as in `load`.
    on: where the calls run: the name of an EVM ("revm", "pyrevm", "pyevm"), the address of a node, `Processes`, `Nodes`
        or `Cluster`; None for revm, which is always there. The pixels are the same everywhere.
    gas_limit: gas that a call may use.
    tile: size of the tiles in pixels, one number or (width, height); None chooses it, if tiles are needed at all: for a
        canvas of 1024 x 1024 pixels or more, strips are cheaper, since the memory of the whole costs its square.
    listener: receives the progress of a picture of several tiles.
    keep: a folder in which finished tiles are stored, so that the same call resumes; the caller removes it.
    transparent: whether to leave out the background and to return `Image.alpha`. The scene is drawn twice, over black
        and over white, so the gas is that of two pictures.
    fit: lower antialiasing, size and triangles as far as needed for one request: "transaction" on Ethereum, intrinsic
        gas included; one on "base", "optimism", "monad", "arbitrum" or "polygon"; or "call", a read call of a node with
        geth's default settings. An InputWarning says what was done. It excludes `tile` and `gas_limit`. InputError if
        nothing fits.

    Raises InputError for an invalid scene, ChainError if a call fails.
    """
    scene, how = load_picture(thing, size, **look), RenderOptions(on, gas_limit, tile, listener, keep, transparent)
    if fit is not None:
        from .gas._fitting import fit_scene

        for name, given in (("tile", tile), ("gas_limit", gas_limit)):
            if given is not None:
                raise InputError(f"`fit` and `{name}` exclude each other: give one of them")
        found = fit_scene(scene, fit, look.get("crease"))
        if found.scene != scene:
            warn(found.sentence)
        scene = found.scene
    return picture(scene, how)


@with_synonyms("fps", "vertices", "faces", read=_of_film)
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
    one_call: bool = False,
    transparent: bool = False,
    **look: Unpack[LookOptions],
) -> Animation:
    """Render a full turn about the vertical axis through the middle of the scene.

    The contract rotates the scene: each frame is one call. Background, lights and camera do not move.

    thing, size, look: as in `load`.
    frames: number of frames, 2..720.
    duration: time for which a frame is shown in milliseconds, 20..10,000.
    on, gas_limit, tile, listener, keep: as in `render`.
    one_call: whether the contract Turntable makes the whole animated PNG file in one call, as for a token. At most 360
        frames, no tiles, and `on` as in `shackled.studio.make_apng`.
    transparent: as in `render`.
    """
    scene, how = load_picture(thing, size, **look), RenderOptions(on, gas_limit, tile, listener, keep, transparent)
    return turn(scene, frames, duration, how, one_call)


@with_synonyms("fps", "vertices", "faces", read=_of_film)
def animate(
    thing: str | os.PathLike[str],
    frames: int = 36,
    size: int | tuple[int, int] | None = None,
    *,
    duration: int | None = None,
    on: On | None = None,
    gas_limit: int | None = None,
    tile: int | tuple[int, int] | None = None,
    listener: Listener | None = None,
    keep: Path | None = None,
    transparent: bool = False,
    **look: Unpack[LookOptions],
) -> Animation:
    """Render an animation of a glTF file, by default its first one. Each frame is one call; the camera does not move.

    thing: the path of the file.
    frames: number of frames, 2..720, at equal steps from the start up to, and without, the end.
    duration: as in `turntable`; None for the pace of the file.
    animation: its name or number. size, look: as in `load`, but for `time`.
    on, gas_limit, tile, listener, keep, transparent: as in `render`.
    """
    scenes, length = load_frames(thing, frames, size, **look)
    shown = pace(length, frames) if duration is None else duration
    return film(scenes, shown, RenderOptions(on, gas_limit, tile, listener, keep, transparent))


def pace(length: float, frames: int) -> int:
    """Return the duration in milliseconds, 20..10,000, of each of so many frames that take so many seconds."""
    return round(min(max(1000 * length / frames, DURATIONS[0]), DURATIONS[1]))


def turn(scene: Scene, frames: int, duration: int, how: RenderOptions, one_call: bool = False) -> Animation:
    """Render a full turn of a scene. The arguments are those of `turntable`."""
    if not one_call:
        return film(full_turn(scene, frames), duration, how)
    from .studio._files import make_apng

    if how.transparent:
        raise InputError("`one_call` and `transparent` exclude each other: the contract's file has a background")
    if how.tile is not None:
        raise InputError("a turntable of one call has no tiles: leave out `tile` or `one_call`")
    on = how.on.chain if isinstance(how.on, Embedded) else how.on
    return Animation.of(make_apng(scene, frames, duration, on=on, gas_limit=how.gas_limit), duration)


def film(scenes: Sequence[Scene], duration: int, how: RenderOptions) -> Animation:
    """Render scenes of one size as the frames of an animation."""
    images = render_frames([each for scene in scenes for each in _drawn(scene, how)], how)
    if how.transparent:
        images = [uncovered(*both) for both in zip(images[::2], images[1::2], scenes, strict=True)]
    return Animation(images, duration)


def picture(scene: Scene, how: RenderOptions) -> Image:
    """Render a scene, by one call or by several."""
    scenes, is_whole = _drawn(scene, how), how.is_one_call(scene)
    try:
        if isinstance(how.on, Embedded) and is_whole:
            chain, evm = how.on.opened(), how.on.evm
            images = [render_whole(each, chain.draw, chain.name, evm) for each in scenes]
        else:
            images = render_frames(scenes, how)
    except OutOfGasError as error:
        from .gas._savings import savings

        if error.limit is None:
            raise
        raise OutOfGasError(f"{error}{savings(scenes[0], error.limit, not is_whole)}") from None
    return uncovered(images[0], images[1], scene) if how.transparent else images[0]


def _drawn(scene: Scene, how: RenderOptions) -> list[Scene]:
    """Return what is drawn of a scene: itself or, for `uncovered`, the scene over black and over white."""
    if not how.transparent:
        return [scene]
    backgrounds = ("white", "black") if scene.invert else ("black", "white")
    return [evolve(scene, background=Background(each)) for each in backgrounds]
