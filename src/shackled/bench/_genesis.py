"""Gas against triangles over a whole collection."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import astuple, dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..datasets._pieces import require
from ._measure import cost
from ._original import Measured, original
from ._report import ORIGINAL, OURS, THIRD, ExperimentReport, millions, table
from ._runner import Runner
from .regression import Column, fit

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PIECES = range(1024)
QUICK_PIECES = range(0, 1024, 128)


@dataclass(frozen=True)
class GenesisCost:
    """Faces of the mesh; triangles that survive culling; covered pixels; whether only edges are drawn."""

    number: int
    triangles: int
    drawn: int
    lit_pixels: int
    wireframe: bool
    gas: int


Pieces = Sequence[GenesisCost | Measured]


def genesis(runner: Runner) -> ExperimentReport:
    """Measure every piece."""
    found = runner.map("genesis", measure, QUICK_PIECES if runner.quick else PIECES)
    theirs = [figures for name, figures in original().items() if name.startswith("genesis_")]

    def draw(figure: Figure) -> None:
        left, middle, right = figure.subplots(1, 3)
        _panel(left, theirs, "triangles", 1e9, ORIGINAL)
        left.set(title=f"original, {len(theirs)} pieces", xlabel="triangles", ylabel="gas, billions")
        solid, wires = ([p for p in found if p.wireframe is wireframe] for wireframe in (False, True))
        for axes, name in ((middle, "triangles"), (right, "lit_pixels")):
            axes.plot(_column(wires, name), _column(wires, "gas") / 1e6, "x", color=THIRD, ms=3.5, alpha=0.7)
            _panel(axes, solid, name, 1e6, OURS)
        middle.set(title=f"Shackled now, {len(found)} pieces", xlabel="triangles", ylabel="gas, millions")
        right.set(title="x: wireframe, not fitted", xlabel="lit pixels")

    return ExperimentReport(
        "Genesis: gas against triangles",
        ["piece", "triangles", "drawn", "lit_pixels", "wireframe", "gas"],
        [[int(value) for value in astuple(piece)] for piece in found],
        _text(found, theirs),
        draw,
        (9.6, 3.2),
    )


def measure(number: int) -> GenesisCost:
    scene = require(f"genesis/{number}").make()
    found = cost(scene)
    wireframe = any(o.wireframe for o in scene.objects)
    return GenesisCost(number, scene.triangles, found.triangles, found.lit_pixels, wireframe, found.gas)


def _column(pieces: Pieces, name: str) -> Column:
    return np.array([getattr(piece, name) for piece in pieces], float)


def _panel(axes: Axes, pieces: Pieces, name: str, unit: float, color: str) -> None:
    x, y = _column(pieces, name), _column(pieces, "gas") / unit
    axes.plot(x, y, "o", color=color, ms=3, alpha=0.5, mew=0)
    found = fit([x], y)
    constant, slope = found.coefficients
    ends = np.array([x.min(), x.max()])
    axes.plot(ends, slope * ends + constant, "-", color="black", lw=1.2)
    axes.text(0.97, 0.03, f"R2 {found.r2:.3f}", transform=axes.transAxes, ha="right")
    axes.set(xlim=(0, None), ylim=(0, None))


def _text(found: list[GenesisCost], theirs: list[Measured]) -> str:
    groups: dict[str, Pieces] = {
        "original": theirs,
        "ours": found,
        "ours, no wireframes": [p for p in found if not p.wireframe],
    }
    lines = []
    for group, pieces in groups.items():
        for name in ("triangles", "lit_pixels"):
            line = fit([_column(pieces, name)], _column(pieces, "gas"))
            constant, slope = line.coefficients
            words = [f"{constant:,.0f} {slope:+,.1f} x", f"{line.r2:.4f}"]
            lines.append([group, str(len(pieces)), name.replace("_", " "), *words])
    before, gas, faces = _column(theirs, "gas"), _column(found, "gas"), [piece.triangles for piece in found]
    over = int((gas + 21000 > 1 << 24).sum())
    return (
        f"{len(found)} pieces, {min(faces)} to {max(faces)} triangles. On average, they take"
        f" {before.mean() / gas.mean():,.0f} times less gas than the {len(theirs)} measured pieces of the original. The"
        f" cost of a piece now depends on the pixels that it covers rather than on its triangles. The most"
        f" expensive piece takes {millions(gas.max())}; {'none is' if not over else f'{over} are'} above the"
        f" 16.777M of one"
        " transaction.\n\n"
        + table(
            ["gas", "least", "median", "mean", "most"], [["original", *_spread(before, 0)], ["ours", *_spread(gas, 2)]]
        )
        + "\n\nLines of least squares:\n\n"
        + table(["pieces", "number", "against", "line", "R2"], lines)
    )


def _spread(gas: Column, digits: int) -> list[str]:
    return [millions(value, digits) for value in (gas.min(), float(np.median(gas)), gas.mean(), gas.max())]
