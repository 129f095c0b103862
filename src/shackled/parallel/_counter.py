"""Counts of a picture, taken in the embedded EVM with the contracts that drew it."""

from __future__ import annotations

import os
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from ..chain import open_chain
from ..scene import Rectangle, Scene
from ._tiles import is_large


def count(scene: Scene, evm: str | None = None) -> tuple[int, int]:
    """Count the triangles and covered pixels of a scene; of a large one in strips at the same time.

    evm: the name of an EVM; None for the default. Raises RenderError if the contract refuses the scene.
    """
    chain = open_chain(evm)
    if not is_large(scene):
        return chain.count(scene)
    chain.address("Renderer")  # set up here, before several threads ask for it
    jobs = os.cpu_count() or 1
    parts = list(strips(scene.height, -(-scene.height // jobs)))
    with ThreadPoolExecutor(jobs) as pool:
        tiles = (Rectangle(0, rows.start, scene.width, len(rows)) for _, rows in parts)
        found = list(pool.map(lambda tile: chain.count(scene, tile), tiles))
    triangles, pixels = np.array([sign for sign, _ in parts]) @ np.array(found)
    return int(triangles), int(pixels)


def strips(rows: int, height: int) -> Iterator[tuple[int, range]]:
    """Yield strips of at most so many rows, but at least two, that share a row each with the next one, with the sign 1;
    and the shared rows with the sign -1.

    A tile counts the triangles that do not lie entirely beyond one of its edges, so the counts of adjacent tiles do not
    add up. Those of strips that share a row do: a triangle that reaches into both also reaches into the row, which is
    subtracted. The same holds for pixels.
    """
    step = max(height, 2) - 1
    for top in range(0, max(rows - 1, 1), step):
        yield 1, range(top, min(top + step + 1, rows))
        if top > 0:
            yield -1, range(top, top + 1)
