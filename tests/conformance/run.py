"""Many scenes, in several processes."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context

from .antialiasing import compare_samples
from .compare import Result, compare
from .effects import compare_effects, with_effects
from .scenes import SIZES, built_in, built_in_scene, glass_scene, random_scene, textured_scene


@dataclass(frozen=True)
class Task:
    """One comparison. row: of the table. piece: the name of a built-in piece, or "" for a random scene.
    number: the size of its canvas in pixels, or the seed. samples: whether the picture is antialiased. effects: whether
    it has effects. textured, glass: whether the random scene has textures, or objects that are seen through.
    """

    row: str
    piece: str
    number: int
    samples: bool = False
    effects: bool = False
    textured: bool = False
    glass: bool = False

    def run(self) -> Result:
        """Compares the pictures of the scene."""
        if self.piece:
            scene = built_in_scene(self.piece, self.number)
            # OpenGL draws no wires
            if all(o.wireframe for o in scene.objects):
                return Result()
            if self.samples:
                return compare_samples(f"{self.piece} at {self.number}, antialiased", scene)
            return compare(f"{self.piece} at {self.number}", scene, is_piece=True)
        if self.effects:
            return compare_effects(
                f"random scene {self.number}, effects", with_effects(random_scene(self.number), self.number)
            )
        if self.glass:
            return compare_effects(f"glass scene {self.number}", glass_scene(self.number))
        if self.samples:
            return compare_samples(f"random scene {self.number}, antialiased", random_scene(self.number))
        if self.textured:
            return compare(f"textured scene {self.number}", textured_scene(self.number))
        return compare(f"random scene {self.number}", random_scene(self.number))


def tasks(count: int, seed: int, only: str | None = None) -> Iterator[Task]:
    """Random scenes, then the pieces; `only` is the name of a dataset or of a piece, or "random"."""
    if only in (None, "random"):
        yield from (Task("random", "", number) for number in range(seed, seed + count))
        yield from (Task("random, antialiased", "", number, True) for number in range(seed, seed + count))
        yield from (Task("random, textured", "", number, textured=True) for number in range(seed, seed + count))
        # the judge is slow
        yield from (Task("random, effects", "", number, effects=True) for number in range(seed, seed + count // 5))
        yield from (Task("random, glass", "", number, glass=True) for number in range(seed, seed + count // 5))
    for piece in built_in() if only != "random" else ():
        if only in (None, piece.dataset, piece.name):
            yield from (Task(f"{piece.dataset}, {size}", piece.name, size) for size in SIZES)
            if piece.dataset != "genesis":
                yield Task(f"{piece.dataset}, {SIZES[0]}, antialiased", piece.name, SIZES[0], True)


def run(listed: list[Task], jobs: int) -> Iterator[tuple[Task, Result]]:
    """Each task with its result, in this order."""
    # the threads of an OpenGL do not survive a fork
    with ProcessPoolExecutor(jobs, mp_context=get_context("spawn")) as pool:
        yield from zip(listed, pool.map(Task.run, listed, chunksize=4), strict=True)
