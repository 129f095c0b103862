"""From a scene to a picture."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from .animation import DURATION, Animation
from .chain import Chain, open_chain
from .checks import integer
from .errors import InputError
from .image import Image, decode_bmp
from .scene.scene import Scene
from .scene.turning import full_turn

if TYPE_CHECKING:
    from .parallel import Where


def render(
    scene: Scene | str | Path,
    size: int | tuple[int, int] | None = None,
    chain: Chain | str | None = None,
    max_triangles: int | None = None,
    *,
    jobs: int | None = None,
    rpc: str | Sequence[str] = (),
    address: str | None = None,
    cluster: str | None = None,
    gas_limit: int | None = None,
    tile: int | tuple[int, int] | None = None,
    verify: str | None = None,
) -> Image:
    """Makes the picture of a scene.

    scene: a Scene, the path of a mesh or scene file, or the name of a piece of a dataset.
    size: side of a square picture, or (width, height), in pixels; None takes the scene's.
    chain: where, by name or itself; None takes the fastest EVM that is installed.
    max_triangles: meshes of more are simplified.
    jobs: worker processes here, or calls at a time to each node, or workers of a cluster of our own.
    rpc: the addresses of nodes that compute it. address: of a renderer that is deployed there; None takes the one that
    is known, or brings it along. cluster: the address of a dask scheduler, "" for a cluster of our own.
    gas_limit: what a call may use. tile: side, or (width, height), of the parts in which the picture is made; None
    takes what fits. The pixels are the same, however they are spread. verify: how much of what nodes draw is compared
    with what is drawn here, "all", "some" or "none"; None compares all, or some from 500 million gas on.
    InputError for what is wrong with the scene, ChainError for what fails in the call.
    """
    scene = _prepared(scene, size, max_triangles)
    where = _where(chain, jobs, rpc, address, cluster, gas_limit, tile, verify)
    if not where.alone:
        from .parallel import render_frames

        return render_frames([scene], where).images[0]
    place = open_chain(chain) if chain is None or isinstance(chain, str) else chain
    return render_whole(scene, place)


def turntable(
    scene: Scene | str | Path,
    frames: int = 36,
    size: int | tuple[int, int] | None = None,
    chain: Chain | str | None = None,
    max_triangles: int | None = None,
    *,
    duration: int = DURATION,
    jobs: int | None = None,
    rpc: str | Sequence[str] = (),
    address: str | None = None,
    cluster: str | None = None,
    gas_limit: int | None = None,
    tile: int | tuple[int, int] | None = None,
    verify: str | None = None,
) -> Animation:
    """Makes the pictures of a full turn of a scene about the vertical axis through its middle.

    The contract turns it: each frame is a call, with the rotation in it. Background, lights and camera stand still.
    frames: how many, from 2. duration: milliseconds that each is shown, from 20. The rest as in `render`.
    """
    from .parallel import render_frames

    turned = full_turn(_prepared(scene, size, max_triangles), frames)
    where = _where(chain, jobs, rpc, address, cluster, gas_limit, tile, verify)
    return Animation(render_frames(turned, where).images, duration)


def render_whole(scene: Scene, chain: Chain) -> Image:
    """The picture of a scene, by one call."""
    started = time.perf_counter()
    drawing = chain.draw(scene)
    seconds = time.perf_counter() - started
    return Image(
        pixels=decode_bmp(drawing.bmp, scene.width, scene.height),
        bmp=drawing.bmp,
        gas=drawing.gas,
        intrinsic_gas=drawing.intrinsic_gas,
        chain=chain.name,
        seconds=seconds,
        scene=scene,
    )


def resize(scene: Scene, size: int | tuple[int, int]) -> Scene:
    """The scene on a canvas of another size; the camera keeps its vertical field of view."""
    width, height = _pair(size, "the size of a picture")
    return replace(scene, width=width, height=height)


def simplify_scene(scene: Scene, max_triangles: int) -> Scene:
    """The scene with every mesh of more triangles simplified to `max_triangles`."""
    from .scene.simplify import simplify

    return replace(scene, objects=[replace(o, mesh=simplify(o.mesh, max_triangles)) for o in scene.objects])


def _prepared(scene: Scene | str | Path, size: int | tuple[int, int] | None, max_triangles: int | None) -> Scene:
    if not isinstance(scene, Scene):
        from .load import load

        scene = load(scene)
    if size is not None:
        scene = resize(scene, size)
    return scene if max_triangles is None else simplify_scene(scene, max_triangles)


def _where(
    chain: Chain | str | None,
    jobs: int | None,
    rpc: str | Sequence[str],
    address: str | None,
    cluster: str | None,
    gas_limit: int | None,
    tile: int | tuple[int, int] | None,
    verify: str | None,
) -> Where:
    from .parallel import Where

    nodes = (rpc,) if isinstance(rpc, str) else tuple(rpc)
    sides = None if tile is None else _pair(tile, "the size of a tile")
    return Where(chain, jobs, nodes, address, cluster=cluster, gas_limit=gas_limit, tile=sides, verify=verify)


def _pair(value: int | tuple[int, int], name: str) -> tuple[int, int]:
    try:
        side = integer(value)
        first, second = value if side is None else (side, side)  # type: ignore[misc]
    except (TypeError, ValueError):
        raise InputError(f"{name} must be one number or (width, height), not {value!r}") from None
    return first, second
