"""Gas against the size of the canvas, for both projections."""

from __future__ import annotations

from math import log2
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from PIL import Image as PillowImage

from ..scene._fields import Projection
from ._measure import cost, picture
from ._original import original_gas
from ._report import ORIGINAL, OURS, ExperimentReport, millions, ratio, table
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
        axes.set_xscale("log", base=2)
        axes.set_xticks(sides, [str(side) for side in sides])
        axes.minorticks_off()
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
