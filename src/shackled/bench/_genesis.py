"""Gas against triangles over a whole collection."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from ..datasets import require
from ._measure import cost
from ._original import original
from ._plots import INK, ORIGINAL, OURS, THIRD
from ._report import ExperimentReport, millions, table
from ._runner import Runner
from .fits import Column, r2_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PIECES = range(1024)
QUICK_PIECES = range(0, 1024, 128)


@dataclass(frozen=True)
class GenesisCost:
    """Faces of the mesh; triangles that survive culling; covered pixels; whether only edges are drawn."""

    number: int
    faces: int
    drawn: int
    lit_pixels: int
    wireframe: bool
    gas: int


def run(runner: Runner) -> ExperimentReport:
    """Measure every piece."""
    found = runner.map("genesis", measure, QUICK_PIECES if runner.quick else PIECES)
    gas = np.array([piece.gas for piece in found], float)
    theirs = [figures for name, figures in original().items() if name.startswith("genesis_")]

    def draw(figure: Figure) -> None:
        left, middle, right = figure.subplots(1, 3)
        _panel(left, [f.triangles for f in theirs], [f.gas / 1e9 for f in theirs], ORIGINAL)
        left.set(title=f"original, {len(theirs)} pieces", xlabel="triangles", ylabel="gas, billions")
        solid, wires = ([p for p in found if p.wireframe is wireframe] for wireframe in (False, True))
        for axes, name in ((middle, "faces"), (right, "lit_pixels")):
            axes.plot(
                [getattr(p, name) for p in wires], [p.gas / 1e6 for p in wires], "x", color=THIRD, ms=3.5, alpha=0.7
            )
            _panel(axes, [getattr(p, name) for p in solid], [p.gas / 1e6 for p in solid], OURS)
        middle.set(title=f"Shackled now, {len(found)} pieces", xlabel="triangles", ylabel="gas, millions")
        right.set(title="x: wireframe, not fitted", xlabel="lit pixels")

    return ExperimentReport(
        "Genesis: gas against triangles",
        ["piece", "triangles", "drawn", "lit_pixels", "wireframe", "gas"],
        [[p.number, p.faces, p.drawn, p.lit_pixels, int(p.wireframe), p.gas] for p in found],
        _text(found, gas, [(figures.triangles, figures.lit_pixels, figures.gas) for figures in theirs]),
        draw,
        (9.6, 3.2),
    )


def measure(number: int) -> GenesisCost:
    """Measure one piece."""
    scene = require(f"genesis/{number}").make()
    found = cost(scene)
    wireframe = any(o.wireframe for o in scene.objects)
    return GenesisCost(number, scene.triangles, found.triangles, found.lit_pixels, wireframe, found.gas)


def line(x: ArrayLike, y: ArrayLike) -> tuple[float, float, float]:
    """Return slope and constant by numpy.polyfit, as the paper does, and R2."""
    x, y = np.asarray(x, float), np.asarray(y, float)
    slope, constant = np.polyfit(x, y, 1)
    return float(slope), float(constant), r2_of(y, slope * x + constant)


def _panel(axes: Axes, x: list[int], y: list[float], color: str) -> None:
    axes.plot(x, y, "o", color=color, ms=3, alpha=0.5, mew=0)
    slope, constant, r2 = line(x, y)
    ends = np.array([min(x), max(x)])
    axes.plot(ends, slope * ends + constant, "-", color=INK, lw=1.2)
    axes.text(0.97, 0.03, f"R2 {r2:.3f}", transform=axes.transAxes, ha="right")
    axes.set(xlim=(0, None), ylim=(0, None))


def _text(found: list[GenesisCost], gas: Column, theirs: list[tuple[int, int, int]]) -> str:
    solid = [piece for piece in found if not piece.wireframe]
    lines = [
        ["original", str(len(theirs)), *_line("triangles", [f[0] for f in theirs], [f[2] for f in theirs])],
        ["original", str(len(theirs)), *_line("lit pixels", [f[1] for f in theirs], [f[2] for f in theirs])],
        ["ours", str(len(found)), *_line("triangles", [p.faces for p in found], gas)],
        ["ours", str(len(found)), *_line("lit pixels", [p.lit_pixels for p in found], gas)],
        ["ours, no wireframes", str(len(solid)), *_line("triangles", [p.faces for p in solid], [p.gas for p in solid])],
        [
            "ours, no wireframes",
            str(len(solid)),
            *_line("lit pixels", [p.lit_pixels for p in solid], [p.gas for p in solid]),
        ],
    ]
    before_gas = np.array([f[2] for f in theirs], float)
    faces = [piece.faces for piece in found]
    ranks = [["original", *_spread(before_gas, 0)], ["ours", *_spread(gas, 2)]]
    over = int((gas + 21000 > 1 << 24).sum())
    return (
        f"{len(found)} pieces, {min(faces)} to {max(faces)} triangles; on average"
        f" {before_gas.mean() / gas.mean():,.0f} times less gas than the {len(theirs)} pieces of the original that were"
        f" measured. What a piece costs now follows the pixels it covers rather than its triangles. The most"
        f" expensive takes {millions(gas.max())}; {'none is' if not over else f'{over} are'} above the 16.777M of one"
        " transaction.\n\n"
        + table(["gas", "least", "median", "mean", "most"], ranks)
        + "\n\nLines by `numpy.polyfit`:\n\n"
        + table(["pieces", "number", "against", "line", "R2"], lines)
    )


def _line(against: str, x: ArrayLike, gas: ArrayLike) -> list[str]:
    slope, constant, r2 = line(x, gas)
    return [against, f"{constant:,.0f} {slope:+,.1f} x", f"{r2:.4f}"]


def _spread(gas: Column, digits: int) -> list[str]:
    return [millions(value, digits) for value in (gas.min(), float(np.median(gas)), gas.mean(), gas.max())]
