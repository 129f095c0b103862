"""What backface culling saves, and whether it changes the picture."""

from __future__ import annotations

from dataclasses import astuple, dataclass, fields
from statistics import fmean
from typing import TYPE_CHECKING

import numpy as np
from attrs import evolve

from ..datasets._pieces import require
from ..datasets.common import builtin
from ..scene._look import resize
from ._measure import cost, picture
from ._original import PAPER_CULLED, PAPER_CULLING_RATIO, PAPER_UNCULLED, original
from ._report import FOURTH, OURS, ExperimentReport, millions, table
from ._runner import Runner

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: How many objects a quick run measures.
QUICK = 3
SIDE = 128

#: The models that the original was measured with, and the prefixes of the names of their scenes.
ORIGINAL_MODELS = {"models of 400 to 1,198 triangles": "obj_", "models of about 300": "small_"}


@dataclass(frozen=True)
class Pair:
    """An object with and without culling: faces, drawn triangles, gas, pixels that differ."""

    name: str
    faces: int
    drawn: int
    gas: int
    drawn_without: int
    gas_without: int
    different: int

    @property
    def looks_alike(self) -> bool:
        """Return whether at most 1 in 1000 pixels differs."""
        return self.different * 1000 <= SIDE * SIDE


def culling(runner: Runner) -> ExperimentReport:
    """Measure the common objects of the package with and without culling."""
    names = [piece.name for piece in builtin.pieces()]
    pairs = runner.map("culling", measure, names[:QUICK] if runner.quick else names)

    def draw(figure: Figure) -> None:
        axes = figure.add_subplot()
        y = np.arange(len(pairs))
        axes.barh(y - 0.2, [p.gas_without / 1e6 for p in pairs], 0.38, color=FOURTH, label="without culling")
        axes.barh(y + 0.2, [p.gas / 1e6 for p in pairs], 0.38, color=OURS, label="with culling")
        axes.set_yticks(y, [p.name + ("" if p.looks_alike else " *") for p in pairs])
        axes.invert_yaxis()
        axes.margins(y=0.02)
        axes.grid(axis="y", visible=False)
        axes.set(xlabel="gas, millions    (* looks different without culling)")
        # above the bars, not on them
        axes.legend(loc="lower right", bbox_to_anchor=(1, 1), ncols=2)

    head = [field.name for field in fields(Pair)]
    return ExperimentReport(
        "Backface culling", head, [astuple(p) for p in pairs], _text(pairs), draw, (6.4, 1 + 0.25 * len(pairs))
    )


def measure(name: str) -> Pair:
    scene = resize(require(name).make(), SIDE)
    culled, open_ = (evolve(scene, objects=[evolve(o, cull=cull) for o in scene.objects]) for cull in (True, False))
    a, b = cost(culled), cost(open_)
    pixels = [picture(each) for each in (culled, open_)]
    different = int((pixels[0] != pixels[1]).any(axis=2).sum())
    return Pair(name, scene.triangles, a.triangles, a.gas, b.triangles, b.gas, different)


def _text(pairs: list[Pair]) -> str:
    alike = [p for p in pairs if p.looks_alike]
    culled, unculled = fmean(p.gas for p in alike), fmean(p.gas_without for p in alike)
    lines = [["paper, its common objects", "", *_cells(PAPER_CULLED, PAPER_UNCULLED, 0)]]
    for what, prefix in ORIGINAL_MODELS.items():
        known = _original_pairs(prefix)
        means = fmean(pair[0] for pair in known), fmean(pair[1] for pair in known)
        lines.append([f"original, {what}", str(len(known)), *_cells(*means, 0)])
    lines.append(["ours, the objects that look alike", str(len(alike)), *_cells(culled, unculled, 2)])
    details = [
        [p.name, f"{p.faces:,}", f"{p.drawn:,}", *_cells(p.gas, p.gas_without, 2), f"{p.different:,}"] for p in pairs
    ]
    head = ["object", "triangles", "drawn", "with culling", "without", "ratio", "pixels that differ"]
    return (
        f"Of {len(pairs)} objects at {SIDE} x {SIDE} pixels, {len(alike)} look the same with and without"
        f" culling: at most"
        f" one pixel in 1000 differs. For these, culling makes the mean picture {unculled / culled:.2f} times cheaper."
        f" The ratio was {PAPER_CULLING_RATIO} in the paper because the cost of the original grows with the square"
        " of its triangles: half the triangles take a quarter of the gas. Here, culling saves only the cost of the"
        " hidden faces. The other objects are open surfaces, or wires, whose backs are visible.\n\n"
        + table(["mean gas", "objects", "with culling", "without", "ratio"], lines)
        + "\n\n"
        + table(head, details)
    )


def _cells(culled: float, unculled: float, digits: int) -> list[str]:
    return [millions(culled, digits), millions(unculled, digits), f"{unculled / culled:.2f}"]


def _original_pairs(prefix: str) -> list[tuple[int, int]]:
    """Return the original's gas with and without culling of the models that have back faces."""
    found = original()
    return [
        (figures.gas, found[name.replace("_cull", "_nocull")].gas)
        for name, figures in found.items()
        if name.startswith(prefix) and name.endswith("_cull") and figures.drawn < figures.triangles
    ]
