"""Whether gas grows linearly: with equal triangles, and with triangles and pixels of other scenes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image as PillowImage

from ..scene._light import Light
from ..scene._object import Material
from ..scene._scene import Scene
from ._measure import cost, picture
from ._original import original, original_gas
from ._report import FOURTH, ORIGINAL, OURS, THIRD, ExperimentReport, millions, ratio, table
from ._runner import Runner
from .regression import Column, LinearFit, fit, quadratic_share
from .scenes import GLOSSY, MATTE, SUN, UNLIT, cube, equal_triangles, square, turned_cube

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COUNTS = tuple(range(1, 17))
QUICK_COUNTS = (1, 2, 3, 4)


def triangles(runner: Runner) -> ExperimentReport:
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
        f"The fitted line is {_line(ours)}; for the original, it is {_line(before)}. A term with the square of the"
        f" number of triangles accounts for {_share(x, gas)} of the gas of the last picture; in the original, for"
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


def _plot_line(axes: Axes, x: Column, y: Column, mark: str, color: str, label: str | None = None) -> None:
    constant, slope = fit([x], y).coefficients
    axes.plot(x, y, mark, color=color, ms=4, label=label)
    axes.plot(x, constant + slope * x, ":", color=color, lw=1.2)


def _panel(axes: Axes, x: Column, y: Column, color: str, title: str, label: str) -> None:
    _plot_line(axes, x, y, "o", color)
    axes.set(title=title, xlabel="triangles", ylabel=label, xlim=(0, x.max() + 1), ylim=(0, None))
    axes.locator_params(axis="x", integer=True)


def _gallery(counts: tuple[int, ...]) -> PillowImage.Image:
    pictures = [picture(equal_triangles(count)) for count in counts]
    rows = [np.hstack(pictures[at : at + 4]) for at in range(0, len(pictures), 4)]
    return PillowImage.fromarray(np.vstack(rows))


# ---- other scenes ----

#: Divisions of each side of a square: 2 to 1152 triangles.
DIVISIONS = tuple(range(1, 25))
#: Sides of the canvas on which a cube is drawn.
SIDES = (8, 16, 32, 64, 128, 256, 512)
SQUARE_SIDE = 128

LOOKS: dict[str, tuple[Material, tuple[Light, ...]]] = {
    "unlit": (UNLIT, ()),
    "matte": (MATTE, (SUN,)),
    "glossy": (GLOSSY, (SUN,)),
}
COLORS = {"unlit": THIRD, "matte": FOURTH, "glossy": OURS}
MARKS = dict(zip(LOOKS, "os^", strict=True))

#: A scene: its series, triangles, pixels of the canvas, gas.
Row = tuple[str, int, int, int]


def linear(runner: Runner) -> ExperimentReport:
    """Measure squares of more and more triangles, cubes on larger and larger canvases, and the original's scenes."""
    divisions, sides = (DIVISIONS[::8], SIDES[:3]) if runner.quick else (DIVISIONS, SIDES)
    tasks: list[tuple[str, Scene]] = []
    for look in LOOKS:
        tasks += [(f"{look} squares", scene) for scene in squares(look, divisions)]
        tasks += [(f"{look} cubes", scene) for scene in cubes(look, sides)]
    tasks += [("equal triangles", equal_triangles(n)) for n in (QUICK_COUNTS if runner.quick else COUNTS)]
    tasks += [("cubes of the original", cube(side)) for side in sides]
    costs = runner.map("linear", cost, [scene for _, scene in tasks])
    rows = [
        (series, scene.triangles, scene.width * scene.height, found.gas)
        for (series, scene), found in zip(tasks, costs, strict=True)
    ]

    def draw(figure: Figure) -> None:
        left, right = figure.subplots(1, 2)
        for look in LOOKS:
            for axes, kind, place in ((left, "squares", 0), (right, "cubes", 1)):
                columns = columns_of(rows, f"{look} {kind}")
                _plot_line(axes, columns[place], columns[2] / 1e6, MARKS[look], COLORS[look], look)
        left.set(xlabel="triangles of a square of fixed size", ylabel="gas, millions", xlim=(0, None), ylim=(0, None))
        right.set(xlabel="pixels of the canvas of a cube", xlim=(0, None), ylim=(0, None))
        left.legend()

    return ExperimentReport(
        "Straight lines", ["series", "triangles", "pixels", "gas"], rows, _text(rows), draw, (7.6, 3.3)
    )


def squares(look: str, divisions: Sequence[int] = DIVISIONS) -> list[Scene]:
    """Make the same square, cut ever finer."""
    material, lights = LOOKS[look]
    return [square(each, SQUARE_SIDE, material, lights) for each in divisions]


def cubes(look: str, sides: Sequence[int] = SIDES) -> list[Scene]:
    """Make the same cube on ever larger canvases."""
    material, lights = LOOKS[look]
    return [turned_cube(side, material, lights) for side in sides]


def columns_of(rows: list[Row], *series: str) -> tuple[Column, Column, Column]:
    """Return triangles, pixels and gas of some series."""
    columns = np.array([row[1:] for row in rows if row[0] in series], float).T
    return columns[0], columns[1], columns[2]


def _text(rows: list[Row]) -> str:
    lines = []
    for name, kind, quantity in (("tris_", "equal triangles", "triangles"), ("cube_persp_", "cubes", "pixels")):
        found = sorted((f for key, f in original().items() if key.startswith(name)), key=lambda f: f.gas)
        x = [f.triangles if quantity == "triangles" else f.canvas**2 for f in found]
        lines.append(
            _fitted(f"original: {kind}", {quantity: np.array(x, float)}, np.array([f.gas for f in found], float))
        )
    series = {"equal triangles": "equal triangles", "cubes": "cubes of the original"}
    series |= {f"{look} {kind}": f"{look} {kind}" for look in LOOKS for kind in ("squares", "cubes")}
    for name, each in series.items():
        triangles, pixels, gas = columns_of(rows, each)
        lines.append(_fitted(f"ours: {name}", {"pixels": pixels} if "cubes" in name else {"triangles": triangles}, gas))
    for look in LOOKS:
        triangles, pixels, gas = columns_of(rows, f"{look} squares", f"{look} cubes")
        lines.append(_fitted(f"ours: {look}, all", {"triangles": triangles, "pixels": pixels}, gas))
    counts = [row[1] for row in rows if row[0] == "unlit squares"]
    return (
        "R2 is the share of the variance that a straight line explains. Square: the share of the gas of the largest"
        " scene that a term with the square of the triangles, or of the pixels, accounts for, if the fit may use such a"
        " term. The first four rows are the same scenes in both renderers. Squares: one square of fixed size, cut into"
        f" {min(counts):,} to {max(counts):,} triangles at {SQUARE_SIDE} x {SQUARE_SIDE} pixels. Matte: without"
        " highlights. Highlights are computed for single pixels of large triangles and for the vertices of small ones,"
        " so a glossy square that is cut more finely first needs more gas, then less, then more again: no line"
        " fits it.\n\n" + table(["scenes", "gas", "R2", "square"], lines)
    )


def _fitted(name: str, columns: dict[str, Column], gas: Column) -> list[str]:
    """Return the row of a fit: its gas, R2, and the share of a term with a square where there is one quantity."""
    x = list(columns.values())
    found = fit(x, gas)
    constant, *slopes = found.coefficients
    terms = [f"{slope:+,.1f} {quantity}" for slope, quantity in zip(slopes, columns, strict=True)]
    square = f"{quadratic_share(x, gas):+.2%}" if len(x) == 1 else ""
    return [name, " ".join([f"{constant:,.0f}", *terms]), f"{found.r2:.6f}", square]
