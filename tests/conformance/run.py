"""Many scenes, in several processes."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context

from judge.scenes import SIZES, built_in, built_in_scene, random_scene

from .compare import Result, compare


@dataclass(frozen=True)
class Task:
    """One comparison. row: of the table. piece: the name of a built-in piece, or "" for a random scene.
    number: the size of its canvas in pixels, or the seed.
    """

    row: str
    piece: str
    number: int

    def run(self) -> Result:
        """Compares."""
        if not self.piece:
            return compare(f"random scene {self.number}", random_scene("plain", self.number))
        scene = built_in_scene(self.piece, self.number)
        # OpenGL draws no wires
        if all(o.wireframe for o in scene.objects):
            return Result()
        return compare(f"{self.piece} at {self.number}", scene, is_piece=True)


def tasks(count: int, seed: int, only: str | None = None) -> Iterator[Task]:
    """Random scenes, then the pieces; `only` is the name of a dataset or of a piece, or "random"."""
    if only in (None, "random"):
        yield from (Task("random", "", number) for number in range(seed, seed + count))
    for piece in built_in() if only != "random" else ():
        if only in (None, piece.dataset, piece.name):
            yield from (Task(f"{piece.dataset}, {size}", piece.name, size) for size in SIZES)


def run(listed: list[Task], jobs: int) -> Iterator[tuple[Task, Result]]:
    """Each task with its result, in this order."""
    # the threads of an OpenGL do not survive a fork
    with ProcessPoolExecutor(jobs, mp_context=get_context("spawn")) as pool:
        yield from zip(listed, pool.map(Task.run, listed, chunksize=4), strict=True)
