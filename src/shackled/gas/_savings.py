"""What lowers the gas of a call that ran out of it enough, measured on its scene."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import partial
from threading import Timer

from attrs import evolve

from ..chain._embedded import RevmChain
from ..errors import ShackledError
from ..scene._codec import Rectangle
from ..scene._scene import Scene
from ..scene._simplify import simplify_scene

#: Seconds after which is told what was found so far.
PATIENCE = 20.0
#: The width and height of the tile that is measured where even the smallest one failed.
TILE = 16, 4
#: The parts of the triangles of the largest mesh that are tried, until one is enough.
PARTS = (4, 16, 64)


def savings(scene: Scene, limit: int, is_tile: bool) -> str:
    """Return which settings are each enough, with their gas, as the end of a message; "" if none was found.

    limit: gas of a call, which no try exceeds. is_tile: whether even the smallest tile failed.
    """
    width, height = min(TILE[0], scene.width), min(TILE[1], scene.height)
    middle = Rectangle((scene.width - width) // 2, (scene.height - height) // 2, width, height)
    chain, found = RevmChain(limit, is_stoppable=True), dict[str, str]()
    timer = Timer(PATIENCE, chain.stop)
    timer.start()
    try:
        for keyword, value, change in _changes(scene, is_tile):
            # too much still, stopped, or a mesh that cannot be simplified
            with suppress(ShackledError):
                if keyword not in found:
                    gas = chain.draw(change(), middle if is_tile else None).gas
                    found[keyword] = f"`{keyword}={value}` ({gas:,})"
    finally:
        timer.cancel()
    what = "a tile in its middle" if is_tile else "it"
    return f"; for {what}, each of these is enough: {', '.join(found.values())}" if found else ""


def _changes(scene: Scene, is_tile: bool) -> Iterator[tuple[str, object, Callable[[], Scene]]]:
    """Yield keywords and values that lower the gas, with a function that makes the scene; the least change first."""
    if scene.antialias:
        yield "antialias", False, partial(evolve, scene, antialias=False)
    if any(o.material.shading == "smooth" for o in scene.objects):
        flat = [evolve(o, material=evolve(o.material, shading="flat")) for o in scene.objects]
        yield "shading", "flat", partial(evolve, scene, objects=flat)
    if not is_tile:
        width, height = max(1, scene.width // 2), max(1, scene.height // 2)
        size = f"{width}" if width == height else f"{width}x{height}"
        yield "size", size, partial(evolve, scene, width=width, height=height)
    triangles = max((o.mesh.triangles for o in scene.objects), default=0)
    for most in (triangles // part for part in PARTS if triangles >= part):
        yield "max_triangles", most, partial(simplify_scene, scene, most)
