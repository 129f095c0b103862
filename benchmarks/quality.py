"""Measure how good anti-aliasing looks: edges and whole pictures, against 1,024 samples per pixel.

    python -m benchmarks.quality

draws everything, which takes about three minutes, rewrites quality.json and the table of docs/measurements.md, and
prints it. It needs OpenGL (`python3 tools/prepare.py opengl`). The figures of meshes that are not there are kept.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import partial
from itertools import count, islice, product
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
from attrs import evolve
from numpy.typing import NDArray
from tools.pages import ROOT, update

from shackled import Scene, load, render
from shackled.base.checks import Flags, Floats, Ints
from shackled.datasets import pieces

from . import flip, read_figures, run_main, shared, write_figures
from .antialiasing import PAGE

sys.path.insert(0, str(ROOT / "tests" / "support"))
sys.path.insert(0, str(ROOT / "tests"))
sys.path.insert(0, str(ROOT / "contracts"))
from conformance.world import World, background, before_camera

FILE = Path(__file__).with_name("quality.json")
recorded = partial(read_figures, FILE)
SIDE = 128
#: Samples of the truth along a side of a pixel: so many in each of so many pictures a side.
WITHIN, PICTURES = 8, 4
#: Levels by which the colours of samples must differ in a channel, so that a pixel is on an edge.
CONTRAST = 8
#: What is judged, by its column in the table.
JUDGED = ("plain", "antialiased", "OpenGL, 4 samples", "16 samples")
#: Pixels whose errors are measured: edges, and those of them that show the background, too.
KINDS = ("edges", "silhouettes")

#: Of a group: numbers of "pictures", and of pixels of each of KINDS; of each column the mean error of these in levels,
#: and the mean FLIP.
Figures = dict[str, dict[str, float]]


@dataclass(frozen=True)
class Truth:
    """pixels: (H, W, 3) mean colours of the samples, 0..255. edges: (H, W) whether they show several triangles, or a
    triangle and the background, in different colours. silhouettes: (H, W) whether these are edges with the background.
    """

    pixels: Floats
    edges: Flags
    silhouettes: Flags


def groups() -> dict[str, list[Scene]]:
    """Return the scenes of each group in their default look; meshes if they are there. OpenGL draws no wires."""
    genesis = (load(f"genesis/{number}", size=SIDE) for number in count())
    return {
        "15 meshes": [load(path, size=SIDE) for path in shared.meshes()],
        "28 icons": [load(piece.name, size=SIDE) for piece in pieces("icons")],
        "24 pieces of Genesis": list(islice((each for each in genesis if not each.objects[0].wireframe), 24)),
    }


def true_picture(scene: Scene) -> Truth:
    """Return the means of 1,024 samples per pixel, which OpenGL draws in floats from the numbers of the scene."""
    world, behind = before_camera(scene), background(scene)
    total = np.zeros((scene.height, scene.width, 3))
    first, last = np.full((2, *total.shape[:2]), [[[np.inf]], [[-np.inf]]])
    darkest, brightest = np.full((2, *total.shape), [[[[np.inf]]], [[[-np.inf]]]])
    places = (np.arange(PICTURES) + 0.5) / PICTURES - 0.5
    for row, column in product(places, repeat=2):
        triangles, colors = samples(world, behind, WITHIN, (column, row))
        total += over_pixels(np.add, colors)
        np.minimum(darkest, over_pixels(np.minimum, colors), out=darkest)
        np.maximum(brightest, over_pixels(np.maximum, colors), out=brightest)
        np.minimum(first, over_pixels(np.minimum, triangles), out=first)
        np.maximum(last, over_pixels(np.maximum, triangles), out=last)
    edges = (first != last) & ((brightest - darkest).max(axis=2) > CONTRAST)
    return Truth(shown(scene, total / (WITHIN * PICTURES) ** 2), edges, edges & (first < 0))


def samples(world: World, behind: Floats, within: int, place: tuple[float, float] = (0.0, 0.0)) -> tuple[Ints, Floats]:
    """Draw within x within samples of each pixel: their triangles, (H, n, W, n), and their colours, (H, n, W, n, 3)."""
    from conformance import opengl  # here, since it needs moderngl

    drawing = opengl.draw(replace(world, width=within * world.width, height=within * world.height), place=place)
    triangles = drawing.triangle.reshape(world.height, within, world.width, within)
    colors = drawing.color.reshape(*triangles.shape, 3)
    return triangles, np.where(triangles[..., None] < 0, behind[:, None, :, None], colors)


def over_pixels(reduce: np.ufunc, values: NDArray[Any]) -> NDArray[Any]:
    """Return (H, n, W, n, ...) reduced to (H, W, ...)."""
    reduced: NDArray[Any] = reduce.reduce(reduce.reduce(values, axis=1), axis=2)
    return reduced


def judged_pictures(scene: Scene) -> Iterator[Floats]:
    """Yield the pictures of JUDGED, (H, W, 3) each, in whole levels."""
    from conformance import opengl

    for antialias in (False, True):
        yield render(evolve(scene, antialias=antialias)).pixels.astype(float)
    world, behind = before_camera(scene), background(scene)
    light, part = opengl.multisample(world)
    yield np.rint(shown(scene, light + (1 - part) * behind))
    yield np.rint(shown(scene, over_pixels(np.add, samples(world, behind, 4)[1]) / 16))


def shown(scene: Scene, pixels: Floats) -> Floats:
    """Return pixels as the scene shows them, inverted or not."""
    return 255 - pixels if scene.invert else pixels


def judge(scene: Scene) -> tuple[dict[str, Floats], list[float]]:
    """Return the errors of KINDS, (n, k) each for the k pictures of JUDGED, and the FLIP of each picture."""
    truth = true_picture(scene)
    pictures = list(judged_pictures(scene))
    errors = np.stack([np.abs(each - truth.pixels).mean(axis=2) for each in pictures], axis=2)
    # of pictures in whole levels, as they are seen
    flips = [flip(np.rint(truth.pixels), np.rint(each)) for each in pictures]
    return {"edges": errors[truth.edges], "silhouettes": errors[truth.silhouettes]}, flips


def measure(results: list[tuple[dict[str, Floats], list[float]]]) -> Figures:
    """Return the means of a group, of which `judge` gave these results."""
    errors = {kind: np.concatenate([each[kind] for each, _ in results]) for kind in KINDS}
    flips = np.mean([each for _, each in results], axis=0)
    return {
        "number": {"pictures": len(results)} | {kind: len(each) for kind, each in errors.items()},
        **{kind: dict(zip(JUDGED, each.mean(axis=0).round(2).tolist(), strict=True)) for kind, each in errors.items()},
        "FLIP": dict(zip(JUDGED, flips.round(4).tolist(), strict=True)),
    }


def table(figures: dict[str, Figures]) -> str:
    """Return the figures as a table in Markdown."""
    lines = [f"| | number | {' | '.join(JUDGED)} |", "|---|" + 5 * "---:|"]
    for what, counted, places in (*((f"error at {kind}", kind, 1) for kind in KINDS), ("FLIP", "pictures", 4)):
        for group, each in figures.items():
            values = " | ".join(f"{each[what.removeprefix('error at ')][name]:.{places}f}" for name in JUDGED)
            lines.append(f"| {group}, {what} | {each['number'][counted]:,.0f} | {values} |")
    return "\n".join(lines)


def main() -> int:
    """Measure, print and write the figures."""
    from conformance import opengl

    try:
        opengl.context()
    except opengl.Unavailable as error:
        raise SystemExit(str(error)) from None
    old = recorded()
    # the threads of an OpenGL do not survive a fork
    with ProcessPoolExecutor(mp_context=get_context("spawn")) as pool:
        results = {name: list(pool.map(judge, scenes)) for name, scenes in groups().items()}
    found = {name: measure(each) if each else old[name] for name, each in results.items()}
    print(table(found))
    if not shared.meshes():
        print(f"meshes: {shared.MESHES_SKIPPED}; their figures are kept")
    write_figures(FILE, found)
    return update({PAGE: lambda name: table(found) if name == "quality" else None}, "python -m benchmarks.quality")


if __name__ == "__main__":
    run_main(main)
