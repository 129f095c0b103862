"""Measure the gas of a pixel, a row and a triangle by the differences of scenes.

A wavy sheet of triangles is drawn four times: as wide again, as high again, and of four times as many triangles. What
pixels, rows of triangles and triangles cost more than a fixed part is the solution of four equations. A triangle is
counted with its half a vertex; a second light for each triangle, with all its rows and pixels.
"""

from __future__ import annotations

import numpy as np
from attrs import evolve

from shackled import Camera, Material, Mesh, Object, Scene
from shackled.bench._measure import gas
from shackled.bench.scenes import DISTANCE, NIGHT, SUN, grid
from shackled.scene._fields import Shading

from .scenes import SECOND_LIGHT
from .workload import workload_of

#: Pixels of the canvas a side.
SIDE = 256
#: Divisions of the sheet, and its half sides, of the first scene: 200 triangles of 38 pixels, as models have them.
DIVISIONS, SHEET = 10, 390
PATHS: dict[str, tuple[Shading, bool]] = {
    "flat": ("flat", False),
    "smooth": ("smooth", False),
    "flat, antialiased": ("flat", True),
    "smooth, antialiased": ("smooth", True),
}
UNITS = ("pixel", "row", "triangle")


def figures() -> dict[str, int]:
    """Return the gas of each unit, for each way of drawing."""
    found: dict[str, int] = {}
    for path, (shading, antialias) in PATHS.items():
        scenes = [
            sheet(shading, antialias, DIVISIONS, SHEET, SHEET),
            sheet(shading, antialias, DIVISIONS, 2 * SHEET, SHEET),
            sheet(shading, antialias, DIVISIONS, SHEET, 2 * SHEET),
            sheet(shading, antialias, 2 * DIVISIONS, SHEET, SHEET),
        ]
        works = [workload_of(scene) for scene in scenes]
        counts = [(work.lit, work.rows, work.drawn, 1) for work in works]
        *units, _ = np.linalg.solve(np.array(counts, float), [gas(scene) for scene in scenes])
        lit_twice = evolve(scenes[0], lights=[SUN, SECOND_LIGHT])
        found |= {f"{path}, a {unit}": round(each) for unit, each in zip(UNITS, units, strict=True)}
        found[f"{path}, a second light, for each triangle"] = round((gas(lit_twice) - gas(scenes[0])) / works[0].drawn)
    return found


def sheet(shading: Shading, antialias: bool, divisions: int, half_width: int, half_height: int) -> Scene:
    """Make a sheet of 2 * divisions^2 triangles, two waves wide and high, in front of the camera, in one colour."""
    x, y, faces = grid(divisions)
    waves = 40 * np.sin(2 * np.pi * x) * np.sin(2 * np.pi * y)
    positions = np.rint(np.stack([half_width * x, half_height * y, waves], axis=1))
    mesh = Mesh(positions, faces, "tan")
    o = Object(mesh, (0, 0, -DISTANCE), material=Material(shading, 0.25, 0.75, 0.3, 24))
    return Scene([o], Camera(), [SUN], NIGHT, width=SIDE, height=SIDE, antialias=antialias)
