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
from pathlib import Path

if __package__ in (None, ""):
    TESTS = Path(__file__).parents[1]
    sys.path[:0] = [str(TESTS), str(TESTS / "support")]

import numpy as np

from conformance import opengl
from conformance.compare import Result
from conformance.run import run, tasks


def table(rows: dict[str, Result]) -> str:
    """The counts, a line for each row."""
    width = max(map(len, rows))
    lines = [
        f"{'':{width}} {'scenes':>6} {'empty':>5} {'pixels':>11} {'other triangle':>14} {'interior':>11} {'mean':>6} "
        f"{'>4':>6} {'worst':>6} {'faults':>6}"
    ]
    for name, r in rows.items():
        lines.append(
            f"{name:{width}} {r.scenes:6,} {r.empty:5,} {r.pixels:11,} {r.differing:14,} {r.interior:11,} "
            f"{r.mean:6.3f} {r.many:6,} {r.worst:6.1f} {len(r.faults):6,}"
        )
    return "\n".join(lines)


def main() -> int:
    """The command."""
    parser = argparse.ArgumentParser(prog="tests/conformance", description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--count", type=int, default=500, help="how many random scenes (500)")
    parser.add_argument("--seed", type=int, help="the seed of the first; by default another each time")
    parser.add_argument("--only", help="a piece, a dataset, or `random`")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="processes")
    arguments = parser.parse_args()
    try:
        print(f"OpenGL: {opengl.context().info['GL_RENDERER']}, {opengl.context().info['GL_VERSION']}")
    except opengl.Unavailable as error:
        print(error, file=sys.stderr)
        return 2
    seed = arguments.seed if arguments.seed is not None else int(np.random.SeedSequence().generate_state(1)[0])
    print(f"the random scenes are those of the seeds {seed} to {seed + arguments.count - 1}", flush=True)
    started = time.perf_counter()
    rows: dict[str, Result] = {}
    whole = Result()
    for task, result in run(list(tasks(arguments.count, seed, arguments.only)), arguments.jobs):
        rows[task.row] = rows.get(task.row, Result()) + result
        whole += result
        for fault in result.faults:
            print(fault, flush=True)
    print(table(rows | {"all": whole}))
    found = whole.faults_of_run()
    for fault in found[len(whole.faults) :]:
        print(fault)
    print(f"{len(found)} out of bounds, in {time.perf_counter() - started:.0f} s")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
