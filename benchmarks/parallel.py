"""`python -m benchmarks.parallel`: measure the gas of tiles, and the frames per second of several backends.

Written to parallel.md and parallel.json beside this file. Gas is exact; times are of one run on one machine, so
only their ratios are meaningful.
"""

from __future__ import annotations

import os
import sys
import time
from contextlib import ExitStack
from statistics import fmean

from attrs import evolve
from tools.anvil import Anvil, AnvilChain, find_anvil
from tools.cluster import cluster

from shackled import Cluster, Nodes, Processes, Scene
from shackled.bench._measure import gas
from shackled.bench._report import millions, table
from shackled.chain import open_chain
from shackled.chain._embedded import RevmChain
from shackled.datasets._pieces import require
from shackled.parallel import Listener
from shackled.parallel._backends import Backend, ChainBackend, Part
from shackled.parallel._scheduler import Scheduler
from shackled.parallel._tiles import grid
from shackled.parallel.places import Embedded, Place
from shackled.scene._codec import Rectangle
from shackled.scene._turning import full_turn

from . import FOLDER, Section, measured, run_main, shared, write_figures

SIDES = (128, 256, 512, 1024)
#: Tiles of a picture: how many across, how many down.
GRIDS = ((1, 4), (1, 16), (1, 64), (2, 2), (4, 4), (8, 8))
#: The turntable: frames, and their side.
FRAMES, SIDE = 16, 512
RUNS = 4


def tiles() -> Section:
    """Measure the gas of a picture in tiles against that of the whole."""
    rows, data = [], {}
    for side in SIDES:
        scene = evolve(require("teapot").make(), width=side, height=side)
        whole = gas(scene)
        sums = {}
        for across, down in GRIDS:
            parts = grid(side, side, side // across, side // down)
            sums[f"{across} x {down}"] = sum(gas(scene, "renderTile", part) for part in parts)
        data[str(side)] = {"whole": whole} | sums
        rows.append([f"{side} x {side}", millions(whole), *(f"{each / whole:.2f}" for each in sums.values())])
    heads = ["picture", "whole, gas", *(f"{across} x {down} tiles" for across, down in GRIDS)]
    text = (
        "The teapot, 992 triangles, smooth. Gas of all tiles together, divided by that of the whole picture.\n\n"
        + table(heads, rows)
        + "\n\nEach tile reads the vertices and faces of the whole scene once more, to find those that it shows, so "
        "that tiles are expensive for small pictures. Up to 16 strips (1 x n) cost about as much as squares; of 64 "
        "tiles squares cost up to 16% less. "
        "Tiles of a large picture can cost less than the whole: the price of memory grows with the square of its size."
    )
    return Section("Tiles", text, data)


#: Limits of the gas of all tiles by that of the whole, 512 x 512 pixels: teapot and cube, and the mean of the objects.
MOST = {"4 x 4": (1.6, 2.2), "8 x 8": (1.6, 3.0)}


def many_tiles() -> Section:
    """Measure the tiles of many scenes at 512 x 512 pixels."""
    if not shared.is_there():
        return Section("Tiles of 512 x 512 pixels", shared.SKIPPED, {})
    scenes = {"teapot": require("teapot").make(), "cube": shared.scene(shared.LARGE_CUBE)}
    scenes |= {name: shared.scene(name) for name in shared.objects()}
    ratios: dict[str, list[float]] = {}
    for name, each in scenes.items():
        scene = evolve(each, width=512, height=512)
        whole = gas(scene)
        ratios[name] = [
            sum(gas(scene, "renderTile", part) for part in grid(512, 512, 512 // n, 512 // n)) / whole for n in (4, 8)
        ]
    ratios["mean of the objects"] = [fmean(ratios[name][i] for name in shared.objects()) for i in (0, 1)]
    rows = [[name, *(f"{ratio:.2f}" for ratio in each)] for name, each in ratios.items()]
    most = ", ".join(f"{name}: teapot and cube {one}, mean {mean}" for name, (one, mean) in MOST.items())
    text = (
        "Gas of all tiles together, divided by that of the whole picture of 512 x 512 pixels. Aimed at, at most: "
        f"{most}.\n\n{table(['scene', *MOST], rows)}"
    )
    return Section("Tiles of 512 x 512 pixels", text, ratios)


def throughput() -> Section:
    """Measure the frames per second of a turntable on several backends."""
    frames = full_turn(evolve(require("teapot").make(), width=SIDE, height=SIDE), FRAMES)
    with ExitStack() as stack:
        places = opened(stack)
        best = dict.fromkeys(places, float("inf"))
        # in turns, so that other load on the machine affects all of them
        for turn in range(RUNS + 1):
            for name, each in places.items():
                seconds = timed(frames, each)
                if turn:
                    best[name] = min(best[name], seconds)
    used = sum(gas(frame) for frame in frames)
    base = best["this process"]
    rows, data = [], {}
    for name, seconds in best.items():
        speed = len(frames) / seconds
        rows.append([name, f"{speed:.1f}", f"{used / seconds / 1e6:.0f}", f"{base / seconds:.2f}"])
        data[name] = {"seconds": round(seconds, 3), "frames a second": round(speed, 2)}
    text = (
        f"{FRAMES} frames of the teapot at {SIDE} x {SIDE} pixels, {millions(used)} gas in all, on a machine of "
        f"{os.cpu_count()} processors, which the nodes share with the client. Places were warm: EVMs set up, workers "
        f"started, nodes probed. No answer was checked. Of {RUNS} runs in turns, the best.\n\n"
        + table(["place", "frames a second", "million gas a second", "times this process"], rows)
    )
    return Section("Frames", text, data)


def opened(stack: ExitStack) -> dict[str, list[Backend]]:
    """Open the backends, which close with the stack."""
    wanted: dict[str, Place] = {
        "this process": Embedded(),
        "2 threads": Processes(2),
        "dask, 1 worker": Cluster(stack.enter_context(cluster(1))[0]),
        "dask, 2 workers": Cluster(stack.enter_context(cluster(2))[0]),
    }
    binary = find_anvil()
    if binary is None:
        print("there is no anvil: npm ci in contracts/", file=sys.stderr)
    else:
        one, two = (stack.enter_context(Anvil(binary)) for _ in range(2))
        deployed = stack.enter_context(AnvilChain(binary))
        wanted["anvil, state override"] = Nodes(one.url)
        wanted["anvil, deployed"] = Nodes(deployed.node.url, address=deployed.address("Renderer"))
        wanted["anvil, 2 calls at a time"] = Nodes(one.url, jobs=2)
        wanted["2 anvils"] = Nodes(one.url, two.url)
    # `Processes(1)` is this process: a thread shows what it costs that its calls can be stopped
    found: dict[str, list[Backend]] = {"1 thread": [ChainBackend(RevmChain(is_stoppable=True))]}
    found |= {name: where.open(Listener()) for name, where in wanted.items()}
    for places in found.values():
        for place in places:
            stack.callback(place.close)
    return found


def timed(frames: list[Scene], places: list[Backend]) -> float:
    """Return the seconds that backends take for frames."""
    parts = [Part(number, Rectangle(0, 0, SIDE, SIDE)) for number in range(len(frames))]
    started = time.perf_counter()
    pieces = Scheduler(frames, places).run(parts)
    seconds = time.perf_counter() - started
    assert pieces[parts[1]].bmp == open_chain().draw(frames[1]).bmp
    return seconds


def main() -> int:
    """Measure everything and write the files."""
    heading = "# Tiles and places\n\nMade by `python -m benchmarks.parallel`.\n"
    text, data = measured(heading, (tiles, many_tiles, throughput))
    (FOLDER / "parallel.md").write_text(text, "utf-8")
    write_figures(FOLDER / "parallel.json", data)
    return 0


if __name__ == "__main__":
    run_main(main)
