"""Gas against the number of equal triangles, and so of pixels."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from PIL import Image as PillowImage

from ._measure import cost, picture
from ._original import original_gas
from ._report import ORIGINAL, OURS, ExperimentReport, millions, ratio, table
from ._runner import Runner
from .fits import Column, LinearFit, fit, quadratic_share
from .scenes import equal_triangles

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COUNTS = tuple(range(1, 17))
QUICK_COUNTS = (1, 2, 3, 4)


def run(runner: Runner) -> ExperimentReport:
    """Measure pictures of 1 to 16 triangles."""
    counts = QUICK_COUNTS if runner.quick else COUNTS
    costs = runner.map("triangles", cost, [equal_triangles(count) for count in counts])
    gas = np.array([found.gas for found in costs], float)
    theirs = np.array([original_gas(f"tris_{count:02}") for count in counts], float)
    x = np.array(counts, float)

    def draw(figure: Figure) -> None:
        left, right = figure.subplots(1, 2)
        _panel(left, x, theirs / 1e9, ORIGINAL, "original", "gas, billions")
        _panel(right, x, gas / 1e6, OURS, "Shackled now", "gas, millions")

    ours, before = fit([x], gas), fit([x], theirs)
    rows = zip(counts, costs, theirs, strict=True)
    text = (
        f"A line through the gas is {_line(ours)}; through that of the original {_line(before)}. A term with the"
        f" square of the triangles takes {_share(x, gas)} of the gas of the last picture; in the original"
        f" {_share(x, theirs)}.\n\n"
    )
    lines = [
        [str(count), f"{found.lit_pixels:,}", millions(b, 0), millions(found.gas, 3), ratio(b, found.gas)]
        for count, found, b in zip(counts, costs, theirs, strict=True)
    ]
    return ExperimentReport(
        "Gas against equal triangles",
        ["triangles", "lit_pixels", "gas", "original_gas"],
        [[count, found.lit_pixels, found.gas, int(b)] for count, found, b in rows],
        text + table(["triangles", "pixels", "original", "ours", "ratio"], lines),
        draw,
        (7.2, 3.2),
        {"pictures": _gallery(counts)},
    )


def _line(by: LinearFit) -> str:
    constant, slope = by.coefficients
    return f"{constant:,.0f} + {slope:,.0f} a triangle (R2 {by.r2:.6f})"


def _share(x: Column, gas: Column) -> str:
    return f"{quadratic_share([x], gas) + 0.0:.2%}"


def _panel(axes: Axes, x: Column, y: Column, color: str, title: str, label: str) -> None:
    constant, slope = fit([x], y).coefficients
    axes.plot(x, y, "o", color=color, ms=4)
    axes.plot(x, constant + slope * x, ":", color=color, lw=1.2)
    axes.set(title=title, xlabel="triangles", ylabel=label, xlim=(0, x.max() + 1), ylim=(0, None))
    axes.locator_params(axis="x", integer=True)


def _gallery(counts: tuple[int, ...]) -> PillowImage.Image:
    """Return the pictures, four in a row."""
    pictures = [picture(equal_triangles(count)) for count in counts]
    rows = [np.hstack(pictures[at : at + 4]) for at in range(0, len(pictures), 4)]
    return PillowImage.fromarray(np.vstack(rows))
