"""Predict the gas of a picture from its triangles, rows and pixels, and measure the error on meshes of other people.

    python -m benchmarks.gas_model

fits a linear model for each way of drawing to generated meshes, predicts the gas of the models of some packages of
tools/models.toml, which it downloads into build/models, and rewrites gas_model.json and its table in
benchmarks/README.md. A model that does not fit one picture, such as one with more than MOST triangles, is left out.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from tools.models import packages

from shackled import InputError, Scene, load
from shackled.base.checks import Floats
from shackled.bench._measure import gas
from shackled.bench._report import table, wrapped
from shackled.datasets.common import shapes
from shackled.errors import InputWarning
from shackled.scene._mesh import Mesh
from shackled.scene._settings import LookOptions

from . import publish, read_figures, run_main
from .workload import workload_of

FILE = Path(__file__).with_name("gas_model.json")
recorded = partial(read_figures, FILE)
#: Packages whose models are predicted: small ones.
HELD_OUT = ("compas", "devjoni-stllib", "node-stl", "pymeshfix", "skeletor")
#: Triangles of a predicted model at most: the largest mesh of the fit has fewer than half as many.
MOST = 10_000
SIDES = (64, 128, 256)
LOOKS: dict[str, LookOptions] = {
    "flat": {"shading": "flat", "antialias": False},
    "smooth": {"shading": "smooth", "antialias": False},
    "flat, antialiased": {"shading": "flat", "antialias": True},
    "smooth, antialiased": {"shading": "smooth", "antialias": True},
}
#: What is counted, as a table names it. Curved: with a normal of its own at each corner.
COUNTS = ("a face", "a drawn one", "if curved", "a row", "if curved", "a tested pixel", "if curved")


def generated() -> Iterator[Mesh]:
    """Yield meshes of 40 to 4,600 triangles, of round, thin and flat bodies."""
    for scale in (0.5, 1, 2):
        yield shapes.torus(across=round(36 * scale), down=round(16 * scale))
        yield shapes.torus_knot(across=round(84 * scale), down=max(4, round(7 * scale)))
        yield shapes.spring(across=round(72 * scale), down=max(4, round(8 * scale)))
        yield shapes.superellipsoid(across=round(36 * scale), down=round(16 * scale))
        yield shapes.seashell(across=round(66 * scale), down=max(5, round(9 * scale)))
        yield shapes.cylinder(round(40 * scale))
        yield shapes.cone(round(40 * scale))
    yield from (shapes.icosphere(halvings) for halvings in (1, 2, 3))
    yield from (shapes.menger_sponge(depth) for depth in (1, 2))


def training(look: LookOptions) -> Iterator[Scene]:
    """Yield the generated meshes, each turned otherwise, on each canvas."""
    for number, mesh in enumerate(generated()):
        for place, side in enumerate(SIDES):
            turn = 47.0 * (len(SIDES) * number + place)
            yield load(mesh, size=side, **look | LookOptions(azimuth=turn % 360, elevation=turn % 70 - 20))


def held_out(look: LookOptions) -> Iterator[tuple[str, Scene]]:
    """Yield the models of other people by their names, on the middle canvas."""
    for package in packages():
        if package.name not in HELD_OUT:
            continue
        for name, path in package.models():
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", InputWarning)
                try:
                    scene = load(path, size=SIDES[1], **look | LookOptions(max_triangles="all"))
                except InputError:
                    continue
            if scene.triangles <= MOST:
                yield f"{package.name}/{Path(name).name}", scene


def measured(scenes: Iterable[Scene]) -> tuple[Floats, Floats]:
    """Return the counts of scenes behind a one, (n, 8), and their gas, (n,)."""
    rows, found = [], []
    for scene in scenes:
        work, (faces, area) = workload_of(scene), curved(scene)
        parts = (work.drawn, faces * work.drawn, work.rows, area * work.rows, work.tested, area * work.tested)
        rows.append([1.0, work.faces, *parts])
        found.append(float(gas(scene)))
    return np.array(rows), np.array(found)


def curved(scene: Scene) -> tuple[float, float]:
    """Return the share of the faces of a scene whose corners have different normals, and their share of the area."""
    parts, areas = [], []
    for o in scene.objects:
        a, b, c = o.world_positions()[o.mesh.faces].transpose(1, 0, 2)
        areas.append(np.linalg.norm(np.cross(b - a, c - a), axis=1))
        smooth = o.material.shading == "smooth"
        normals = None if o.mesh.normals is None else o.mesh.normals[o.mesh.faces]
        parts.append(np.full(len(a), smooth) if normals is None else smooth & (np.ptp(normals, axis=1) > 1e-6).any(1))
    part, area = np.concatenate(parts), np.concatenate(areas)
    return float(part.mean()), float(area[part].sum() / area.sum())


def fitted(counts: Floats, found: Floats) -> Floats:
    """Return the coefficients whose errors, as shares of the gas, have the least squares."""
    # a count that is zero everywhere gets no gas
    scale = np.maximum(counts.max(axis=0), 1)
    solution = np.linalg.lstsq(counts / scale / found[:, None], np.ones(len(found)), rcond=None)[0]
    return np.asarray(solution / scale)


def errors(counts: Floats, found: Floats, coefficients: Floats) -> Floats:
    """Return the errors of predictions as shares of the gas; positive where too much is predicted."""
    return np.asarray(counts @ coefficients / found - 1)


def measure(look: LookOptions) -> dict[str, Any]:
    """Return the coefficients of a way of drawing, the errors of its fit, and those of the models by name."""
    counts, found = measured(training(look))
    coefficients = fitted(counts, found)
    others = dict(held_out(look))
    held = errors(*measured(others.values()), coefficients)
    return {
        "coefficients": coefficients.round(1).tolist(),
        "fit": errors(counts, found, coefficients).round(4).tolist(),
        "held out": dict(zip(others, held.round(4).tolist(), strict=True)),
    }


def text(figures: dict[str, Any]) -> str:
    """Return the figures as Markdown."""
    first = next(iter(figures.values()))
    lines = []
    for name, each in figures.items():
        fit, held = np.abs(each["fit"]), np.abs(list(each["held out"].values()))
        shares = np.median(fit), np.median(held), held.max()
        lines.append([name, *(f"{round(value):,}" for value in each["coefficients"]), *(f"{x:.0%}" for x in shares)])
    head = ["gas of", "a picture", *COUNTS]
    return wrapped(
        f"Fitted to {len(first['fit'])} pictures of generated meshes; predicted are {len(first['held out'])} models of"
        f" the packages {', '.join(HELD_OUT)} at {SIDES[1]} x {SIDES[1]} pixels. Rows and tested pixels are those of"
        " all drawn triangles; a triangle is curved if the normals of its corners differ, and as large a share of the"
        " rows and pixels is as of the area.\n\n"
        + table([*head, "median error of the fit", "of the prediction", "largest"], lines)
    )


def main() -> int:
    """Measure, print and write the figures."""
    figures = {name: measure(look) for name, look in LOOKS.items()}
    return publish("gas_model", figures, text(figures))


if __name__ == "__main__":
    run_main(main)
