"""OpenGL against the contracts: random scenes, and every built-in piece at 128 and 512 pixels.

    make conformance
    python tests/conformance --count 500 --seed 1      the random scenes of these seeds
    python tests/conformance --only genesis/5          one piece; or `icons`, or `random`

The scenes are drawn by the contracts and by OpenGL. What is out of bounds is printed with scene, pixel and both
colours, and the exit code is 1 then; 2 without OpenGL.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from importlib import import_module
from multiprocessing import get_context
from pathlib import Path

if __package__ in (None, ""):
    TESTS = Path(__file__).parents[1]
    sys.path[:0] = [str(TESTS), str(TESTS / "support"), str(TESTS.parent / "contracts")]

from conformance import opengl
from conformance.compare import ANOTHER, compare
from judge.verdict import Verdict, report
from random_scenes import random_scene
from shackled.datasets import pieces
from shackled.datasets._pieces import require
from shackled.scene._look import resize

#: Sides of the pictures of built-in pieces, in pixels.
SIZES = (128, 512)

#: A row of the table; the name of a piece, or "" for a random scene; the size of its canvas in pixels, or the seed.
Task = tuple[str, str, int]


def compared(task: Task) -> tuple[str, Verdict]:
    """Compare one scene; return it with its row."""
    row, piece, number = task
    if not piece:
        return row, compare(f"random scene {number}", random_scene("plain", number))
    scene = resize(require(piece).make(), (number, number))
    # OpenGL draws no wires
    if all(o.wireframe for o in scene.objects):
        return row, Verdict()
    return row, compare(f"{piece} at {number}", scene, is_piece=True)


def tasks(count: int, seed: int, only: str | None = None) -> Iterator[Task]:
    """Random scenes, then the pieces; `only` is the name of a dataset or of a piece, or "random"."""
    if only in (None, "random"):
        yield from (("random", "", number) for number in range(seed, seed + count))
    for piece in pieces():
        if only in (None, piece.dataset, piece.name) and piece.ready():
            yield from ((f"{piece.dataset}, {size}", piece.name, size) for size in SIZES)


def main() -> int:
    """The command."""
    parser = argparse.ArgumentParser(prog="tests/conformance", description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--count", type=int, default=500, help="how many random scenes (500)")
    parser.add_argument("--seed", type=int, default=1, help="the seed of the first (1)")
    parser.add_argument("--only", help="a piece, a dataset, or `random`")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="processes")
    arguments = parser.parse_args()
    try:
        print(f"OpenGL: {opengl.context().info['GL_RENDERER']}, {opengl.context().info['GL_VERSION']}", flush=True)
    except opengl.Unavailable as error:
        print(error, file=sys.stderr)
        return 2
    started = time.perf_counter()
    # the threads of an OpenGL do not survive a fork
    with ProcessPoolExecutor(arguments.jobs, mp_context=get_context("spawn")) as pool:
        listed = tasks(arguments.count, arguments.seed, arguments.only)
        _, is_right = report(pool.map(compared, listed, chunksize=4), (ANOTHER,))
    print(f"{time.perf_counter() - started:.0f} s")
    return 0 if is_right else 1


if __name__ == "__main__":
    # processes find what they run by the name of its module
    sys.exit(import_module("conformance.__main__").main())
