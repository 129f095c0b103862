"""A cube on canvases of growing size: the gas for both projections, and the size and gas of BMP, data URI and SVG."""

from __future__ import annotations

from math import log2
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from PIL import Image as PillowImage

from ..scene import Projection
from ._measure import call_renderer, cost, picture
from ._original import DATA_URI_SIZE, SVG_GAS, SVG_URI_SIZE, original_gas
from ._report import FOURTH, ORIGINAL, OURS, THIRD, Cell, ExperimentReport, millions, powers_of_two, ratio, table
from ._runner import Runner
from .scenes import cube

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: The paper goes to 128.
SIDES = (8, 16, 32, 64, 128, 256, 512)
QUICK_SIDES = (8, 16, 32)
PROJECTIONS: dict[Projection, str] = {"perspective": "persp", "orthographic": "orth"}
#: Side of a picture in the gallery, for every canvas.
SHOWN = 128


def canvas(runner: Runner) -> ExperimentReport:
    """Measure one cube on canvases of growing size."""
    sides = QUICK_SIDES if runner.quick else SIDES
    scenes = {(projection, side): cube(side, projection) for projection in PROJECTIONS for side in sides}
    costs = dict(zip(scenes, runner.map("canvas", cost, scenes.values()), strict=True))
    gas = {key: found.gas for key, found in costs.items()}
    theirs = {(projection, side): original_gas(f"cube_{PROJECTIONS[projection]}_{side}") for projection, side in scenes}
    rows = [
        [projection, side, found.triangles, found.lit_pixels, found.gas, theirs[projection, side]]
        for (projection, side), found in costs.items()
    ]

    def draw(figure: Figure) -> None:
        axes = figure.add_subplot()
        for color, series, name in ((ORIGINAL, theirs, "original"), (OURS, gas, "Shackled now")):
            for mark, projection in zip("os", PROJECTIONS, strict=True):
                points = [(side, value) for side in sides if (value := series[projection, side])]
                style = "-" if mark == "o" else "--"
                axes.plot(
                    *zip(*points, strict=True), mark + style, color=color, ms=4, lw=1.2, label=f"{name}, {projection}"
                )
        powers_of_two(axes, list(sides))
        axes.set(yscale="log", xlabel="side of the canvas, pixels", ylabel="gas")
        axes.legend()

    return ExperimentReport(
        "Gas against the canvas",
        ["projection", "side", "triangles", "lit_pixels", "gas", "original_gas"],
        rows,
        _text(sides, gas, theirs),
        draw,
        pictures={"pictures": _gallery(sides)},
    )


Series = dict[tuple[Projection, int], int]


def _text(sides: tuple[int, ...], gas: Series, theirs: dict[tuple[Projection, int], int | None]) -> str:
    first, last = sides[-2:]
    ours = log2(gas["perspective", last] / gas["perspective", first])
    before, after = theirs["perspective", first], theirs["perspective", last]
    assert before
    assert after
    lines = []
    for side in sides:
        line = [f"{side} x {side}"]
        for projection in PROJECTIONS:
            a, b = theirs[projection, side], gas[projection, side]
            line += [millions(a, 1), millions(b), ratio(a, b)]
        lines.append(line)
    head = ["canvas", "perspective: original", "ours", "ratio", "orthographic: original", "ours", "ratio"]
    return (
        f"From {first} x {first} to {last} x {last} pixels, gas grows as side^{ours:.2f} here (2 would be linear in"
        f" pixels) and as side^{log2(after / before):.2f} in the original, where the price of memory is quadratic. The"
        " orthographic cube is cheaper here: the eye is infinitely far away, so each face has one highlight for all"
        " its pixels.\n\n" + table(head, lines)
    )


def _gallery(sides: tuple[int, ...]) -> PillowImage.Image:
    """Return a row of pictures for each projection, up to the 128 pixels of the paper, enlarged to one size."""
    shown = [side for side in sides if side <= SHOWN]
    rows = [np.hstack([_picture(projection, side) for side in shown]) for projection in PROJECTIONS]
    return PillowImage.fromarray(np.vstack(rows))


def _picture(projection: Projection, side: int) -> NDArray[np.uint8]:
    return np.kron(picture(cube(side, projection)), np.ones((SHOWN // side, SHOWN // side, 1), np.uint8))


# ---- formats ----

FORMATS = {"BMP": "render", "data URI": "renderDataURI", "SVG": "renderSVG"}
COLORS = {"BMP": OURS, "data URI": THIRD, "SVG": FOURTH}
#: The canvas for which the formats of the original are known.
KNOWN = 128


def output(runner: Runner) -> ExperimentReport:
    """Measure the cube on each canvas in each format."""
    sides = QUICK_SIDES[:2] if runner.quick else SIDES
    tasks = [(side, name) for side in sides for name in FORMATS]
    found = dict(zip(tasks, runner.map("output", measure, tasks), strict=True))
    rows: list[list[Cell]] = [
        [side, name, size, gas, gas - found[side, "BMP"][0]] for (side, name), (gas, size) in found.items()
    ]

    def draw(figure: Figure) -> None:
        left, right = figure.subplots(1, 2)
        for name, color in COLORS.items():
            left.plot(sides, [found[side, name][1] for side in sides], "o-", color=color, ms=4, lw=1.2, label=name)
            if name != "BMP":
                more = [(found[side, name][0] - found[side, "BMP"][0]) / side**2 for side in sides]
                right.plot(sides, more, "o-", color=color, ms=4, lw=1.2, label=name)
        for axes in (left, right):
            powers_of_two(axes, list(sides))
            axes.set(xlabel="side of the canvas, pixels")
            axes.legend()
        left.set(yscale="log", ylabel="bytes")
        right.set(ylabel="gas beyond that of the BMP, per pixel", ylim=(0, None))

    lines = []
    for side in sides:
        for name in FORMATS:
            gas, size = found[side, name]
            more = gas - found[side, "BMP"][0]
            lines.append([f"{side} x {side}, {name}", f"{size:,}", millions(gas), millions(more, 3) if more else ""])
    side = sides[-1] if KNOWN not in sides else KNOWN
    uri, svg = found[side, "data URI"], found[side, "SVG"]
    bmp = found[side, "BMP"][0]
    text = (
        "The scene is a cube. Each pixel takes 3 bytes, which base64 turns into 4 characters. At"
        f" {side} x {side}, the data URI costs {millions(uri[0] - bmp, 3)} beyond the BMP and has {uri[1]:,}"
        f" characters,"
        f" the SVG {millions(svg[0] - bmp, 3)} and {svg[1]:,}. In the original, at {KNOWN} x {KNOWN}, the data URI has"
        f" {DATA_URI_SIZE:,}, and the SVG, whose base64 contains base64 again, {SVG_URI_SIZE:,}; the SVG frame"
        f" alone costs"
        f" {millions(SVG_GAS[0], 1)} to {millions(SVG_GAS[1], 1)}.\n\n"
    )
    return ExperimentReport(
        "Output",
        ["side", "format", "bytes", "gas", "gas_beyond_bmp"],
        rows,
        text + table(["picture", "bytes", "gas", "beyond the BMP"], lines),
        draw,
        (7.2, 3.2),
    )


def measure(task: tuple[int, str]) -> tuple[int, int]:
    """Return gas and size of a picture."""
    side, name = task
    result = call_renderer(cube(side), FORMATS[name])
    return result.gas, int.from_bytes(result.output[32:64], "big")
