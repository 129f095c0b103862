"""Counts of a picture, taken on access where the picture was made."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from queue import SimpleQueue
from typing import Any

from attrs import field, frozen

from .._on import Embedded, Nodes, Place
from ..errors import OutOfGasError, TooLargeError
from ..scene import Rectangle, Scene
from ._backends import Backend
from ._scheduler import Listener


class _Silent(Listener):
    """Shows no warnings: those of nodes that fail were shown when the picture was rendered."""

    def warned(self, text: str) -> None:
        """Ignore a failure that does not end the job."""


@frozen
class Counter:
    """Counts the triangles and covered pixels of a picture with the contracts that drew it, in calls of the same size.

    A tile counts the triangles that do not lie entirely beyond one of its edges, so the counts of adjacent tiles do not
    add up. Those of strips that share a row do: a triangle that reaches into both also reaches into the row, which is
    subtracted. The same holds for pixels.

    place: where the picture was rendered. pixels: of a tile at most; None for a picture of one call. gas_limit: of a
    call.
    """

    place: Place = field(repr=False)  # addresses of nodes may have keys
    pixels: int | None = None
    gas_limit: int | None = None

    def __call__(self, scene: Scene) -> tuple[int, int]:
        """Count a scene. Raises the errors of `render`."""
        with ExitStack() as stack:
            backends = self.place.open(_Silent(), self.gas_limit)
            free: SimpleQueue[tuple[Backend, int]] = SimpleQueue()
            for backend in backends:
                for slot in range(backend.slots):
                    free.put((backend, slot))
            pool = ThreadPoolExecutor(sum(backend.slots for backend in backends))
            stack.callback(pool.shutdown, cancel_futures=True)
            for backend in backends:
                # before the pool, so that calls end on Ctrl-C
                stack.callback(backend.close)

            def count(rows: range) -> tuple[int, int]:
                backend, slot = free.get()
                try:
                    return backend.count(slot, scene, Rectangle(0, rows.start, scene.width, len(rows)))
                except (OutOfGasError, TooLargeError):
                    if len(rows) < 3:
                        raise
                finally:
                    free.put((backend, slot))
                return _sum((sign, count(part)) for sign, part in strips(rows, len(rows) // 2 + 1))

            rows = scene.height if self.pixels is None else self.pixels // scene.width
            parts = list(strips(range(scene.height), rows))
            found = pool.map(count, [part for _, part in parts])
            return _sum(zip((sign for sign, _ in parts), found, strict=True))

    def __reduce__(self) -> tuple[type, tuple[Any, ...]]:
        # an EVM cannot leave its process, and a node's address may have a key: a copy counts in the embedded EVM
        chain = self.place.chain if isinstance(self.place, Embedded) else None
        stays = isinstance(self.place, Nodes) or not (chain is None or isinstance(chain, str))
        return Counter, (Embedded(),) if stays else (self.place, self.pixels, self.gas_limit)


def strips(rows: range, height: int) -> Iterator[tuple[int, range]]:
    """Yield strips of at most so many rows, but at least two, that share a row each with the next one, with the sign 1;
    and the shared rows with the sign -1.
    """
    step = max(height, 2) - 1
    for top in range(rows.start, max(rows.stop - 1, rows.start + 1), step):
        yield 1, range(top, min(top + step + 1, rows.stop))
        if top > rows.start:
            yield -1, range(top, top + 1)


def _sum(counts: Iterator[tuple[int, tuple[int, int]]]) -> tuple[int, int]:
    triangles = pixels = 0
    for sign, found in counts:
        triangles += sign * found[0]
        pixels += sign * found[1]
    return triangles, pixels
