"""What lowers the gas of a call that ran out of it enough, measured on its scene."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from threading import Timer

from attrs import evolve

from ..chain import RevmChain
from ..errors import ShackledError
from ..scene import Rectangle, Scene, simplify_scene

#: Seconds after which is told what was found so far.
PATIENCE = 20.0
#: The width and height of the tile that is measured where even the smallest one failed.
TILE = 16, 4
#: The parts of the triangles of the largest mesh that are tried, until one is enough.
PARTS = (4, 16, 64)

Change = Callable[[Scene], Scene]


def savings(scene: Scene, limit: int, is_tile: bool) -> str:
    """Return which settings are each enough, with their gas, as the end of a message; "" if none was found.

    limit: gas of a call, which no try exceeds. is_tile: whether even the smallest tile failed.
    """
    width, height = min(TILE[0], scene.width), min(TILE[1], scene.height)
    middle = Rectangle((scene.width - width) // 2, (scene.height - height) // 2, width, height)
    chain = RevmChain(limit, is_stoppable=True)

    def measured(changes: dict[str, Change]) -> str:
        """Return the first change that is enough, in words; "" if none is."""
        for name, change in changes.items():
            try:
                gas = chain.draw(change(scene), middle if is_tile else None).gas
            except ShackledError:  # too much still, stopped, or a mesh that cannot be simplified
                continue
            return f"`{name}` ({gas:,})"
        return ""

    timer = Timer(PATIENCE, chain.stop)
    timer.start()
    try:
        chain.address("Renderer")  # set up here, before several threads ask for it
        with ThreadPoolExecutor() as threads:
            found = [each for each in threads.map(measured, _changes(scene, is_tile)) if each]
    finally:
        timer.cancel()
    what = "a tile in its middle" if is_tile else "it"
    return f"; for {what}, each of these is enough: {', '.join(found)}" if found else ""


def _changes(scene: Scene, is_tile: bool) -> list[dict[str, Change]]:
    """Return what can be lowered, as functions by keywords with their values; of each dictionary one is wanted."""
    triangles = max((o.mesh.triangles for o in scene.objects), default=0)
    width, height = max(1, scene.width // 2), max(1, scene.height // 2)
    found: list[dict[str, Change]] = []
    if scene.antialias:
        found.append({"antialias=False": lambda of: evolve(of, antialias=False)})
    if any(o.material.shading == "smooth" for o in scene.objects):
        found.append({"shading=flat": _flat})
    if not is_tile:
        size = f"{width}" if width == height else f"{width}x{height}"
        found.append({f"size={size}": lambda of: evolve(of, width=width, height=height)})
    counts = [triangles // part for part in PARTS if triangles >= part]
    return [*found, {f"max_triangles={n}": lambda of, n=n: simplify_scene(of, n) for n in counts}]  # type: ignore[misc]


def _flat(scene: Scene) -> Scene:
    return evolve(scene, objects=[evolve(o, material=evolve(o.material, shading="flat")) for o in scene.objects])
