"""Measure whether gas is linear in the number of triangles and of pixels."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np

from shackled.bench import DIVISIONS, LOOKS, SIDES, SQUARE_SIDE, cubes, gas, squares, table
from shackled.bench.fits import Column, LinearFit, fit, line, quadratic_share

from . import Section
from .workload import workload_of

TITLE = "Linearity"


@dataclass(frozen=True)
class Series:
    """A column for each quantity of some scenes, and their gas."""

    triangles: Column
    rows: Column
    pixels: Column
    gas: Column


def series(kind: str, look: str) -> Series:
    """Measure the squares or the cubes."""
    scenes = squares(look) if kind == "squares" else cubes(look)
    triangles, rows, pixels = _quantities(kind)
    return Series(triangles, rows, pixels, np.array([gas(scene) for scene in scenes], float))


@cache
def _quantities(kind: str) -> tuple[Column, Column, Column]:
    """Return faces, rows of triangles, and pixels of the canvas, which do not depend on the look."""
    scenes = squares("unlit") if kind == "squares" else cubes("unlit")
    work = [workload_of(scene) for scene in scenes]
    return tuple(np.array([getattr(w, name) for w in work], float) for name in ("faces", "rows", "canvas"))  # type: ignore[return-value]


def section() -> Section:
    """Make the table of the fits."""
    lines, data = [], {}
    for look in LOOKS:
        of_squares, of_cubes = series("squares", look), series("cubes", look)
        together = Series(*(np.concatenate([getattr(s, f) for s in (of_squares, of_cubes)]) for f in _FIELDS))
        whole = fit([together.triangles, together.pixels], together.gas)
        across = [of_squares.triangles, of_squares.rows]
        by_triangles, by_pixels = fit(across, of_squares.gas), fit([of_cubes.pixels], of_cubes.gas)
        shares = quadratic_share(across, of_squares.gas), quadratic_share([of_cubes.pixels], of_cubes.gas)
        lines += [
            [*line(f"{look}, all", ("triangles", "pixels"), whole), ""],
            [*line(f"{look}, squares", ("triangles", "rows"), by_triangles), f"{shares[0]:+.2%}"],
            [*line(f"{look}, cubes", ("pixels",), by_pixels), f"{shares[1]:+.2%}"],
        ]
        data[look] = {
            "all": {"constant, triangles, pixels": whole.coefficients, "r2": whole.r2},
            "squares": _record(of_squares, by_triangles, shares[0]),
            "cubes": _record(of_cubes, by_pixels, shares[1]),
        }
    text = (
        f"Squares: one of fixed size before the camera, cut into {2 * DIVISIONS[0] ** 2} to {2 * DIVISIONS[-1] ** 2}"
        f" triangles, {SQUARE_SIDE} x {SQUARE_SIDE} pixels.\n"
        f"Cubes: one on canvases of {SIDES[0]} x {SIDES[0]} to {SIDES[-1]} x {SIDES[-1]} pixels. All: both together."
        " Matte: without highlights.\n\n"
        "triangles: faces of the mesh; pixels: of the canvas; rows: the pixel rows of all triangles, summed, which\n"
        "grow with the root of the number of triangles. Square: the share of a term with the square of the triangles,\n"
        "or of the pixels, in the gas of the largest scene, if the fit may use such a term.\n\n"
        "Highlights are computed per pixel in large triangles and per vertex in small ones. The gas of a glossy\n"
        "square that is cut finer therefore first rises, then falls, then rises again, and is not linear.\n\n"
    )
    return Section(TITLE, text + table(["look, scenes", "gas", "R2", "square"], lines), data)


_FIELDS = ("triangles", "rows", "pixels", "gas")


def _record(of: Series, by: LinearFit, share: float) -> dict[str, object]:
    figures = {name: getattr(of, name).astype(int).tolist() for name in _FIELDS}
    return figures | {"fit": by.coefficients, "r2": by.r2, "quadratic share": share}
