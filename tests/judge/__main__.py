"""Judge what the contracts draw: random scenes of all kinds, and models with the default look.

    make conformance
    python tests/judge --count 1000 --seed 1      the random scenes of these seeds
    python tests/judge --only shadows             one kind; `meshes` are the models of ../shared/meshes/decimated
    python tests/judge --small                    on small canvases of odd sizes, which is `make fuzz`

A wrong pixel is printed with its scene, what is drawn and what would be right. The exit code is 1 then.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

if __package__ in (None, ""):
    TESTS = Path(__file__).parents[1]
    sys.path[:0] = [str(each) for each in (TESTS, TESTS / "support", TESTS.parent, TESTS.parent / "contracts")]

from benchmarks.shared import FOLDER

from judge import Verdict, draw_in_tiles, judge, judge_pixels, render
from judge.verdict import report
from pictures import call_data, draw
from random_scenes import TAME, random_case, random_scene
from shackled import load
from shackled.errors import ShackledError

#: Of so many random scenes, one is drawn in tiles.
TILED = 10
MESHES = FOLDER.parent / "meshes" / "decimated"
SIZES = (128, 256)
#: What is judged if nothing else is asked for: wild scenes have numbers for which nothing is promised.
ALL = [*TAME, "meshes"]


def judged(task: tuple[str, str | int, int]) -> tuple[str, Verdict]:
    """Judge a random scene by its kind and seed, or a mesh file by its path and size. size: 1 for a small canvas."""
    kind, which, size = task
    if isinstance(which, str):
        return f"{kind}, {size}", judge(f"{Path(which).stem} at {size}", load(which, size=size))
    name = f"{kind} {which}"
    try:
        if size:
            scene = random_case(which, kind).scene
            return kind, judge_pixels(name, draw(scene), render(call_data("render", scene)))
        scene = random_scene(kind, which)
        return kind, judge(name, scene, draw_in_tiles) if which % TILED == 0 else judge(name, scene)
    except ShackledError as error:
        return kind, Verdict(scenes=1, faults=[f"{name}: {error}"])


def tasks(count: int, seed: int, only: list[str], small: bool) -> Iterator[tuple[str, str | int, int]]:
    """So many random scenes of these kinds; and the meshes."""
    kinds = [kind for kind in only if kind != "meshes"]
    yield from ((kinds[i % len(kinds)], seed + i // len(kinds), int(small)) for i in range(count if kinds else 0))
    if "meshes" in only and not small:
        yield from (("meshes", str(path), size) for size in SIZES for path in sorted(MESHES.glob("*.ply")))


def main() -> int:
    """The command."""
    parser = argparse.ArgumentParser(prog="tests/judge", description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--count", type=int, default=1000, help="how many random scenes (1000)")
    parser.add_argument("--seed", type=int, default=1, help="the first seed of each kind (1)")
    parser.add_argument("--only", nargs="+", choices=[*ALL, "wild"], default=ALL, help="kinds")
    parser.add_argument("--small", action="store_true", help="on small canvases of odd sizes")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="processes")
    arguments = parser.parse_args()
    started = time.perf_counter()
    if "meshes" in arguments.only and not MESHES.is_dir():
        print(f"there are no meshes in {MESHES}: they are left out")
    listed = tasks(arguments.count, arguments.seed, arguments.only, arguments.small)
    with ProcessPoolExecutor(arguments.jobs) as pool:
        whole, is_right = report(pool.map(judged, listed, chunksize=2))
    print(f"{whole.far + whole.outside} wrong pixels, in {time.perf_counter() - started:.0f} s")
    return 0 if is_right else 1


if __name__ == "__main__":
    sys.exit(main())
