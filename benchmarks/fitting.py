"""Measure what the eye loses and the gas saves where antialiasing, size or triangles are lowered.

    python -m benchmarks.fitting

draws models of the cost table in their default look, 256 x 256 pixels, compares the lowered pictures, enlarged to that
size again, with them, rewrites the tables of docs/measurements.md, and prints them. It takes about two minutes. The
steps of `shackled.gas.fit_scene` follow from it.
"""

from __future__ import annotations

from collections.abc import Iterable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path
from statistics import fmean

import numpy as np
from attrs import evolve
from PIL import Image as PillowImage
from tools.pages import ROOT, update

from shackled import Image, Scene, load, render
from shackled.scene._simplify import simplify_scene

from . import flip, run_main, shared

PAGE = ROOT / "docs" / "measurements.md"
SIDE = 256
#: Meshes with more triangles than the simplified ones.
FINE = ("spot.obj", "cow.obj", "utah-teapot.obj", "armadillo.obj")


@dataclass(frozen=True)
class Lowered:
    """How pictures are lowered. triangles: of a mesh at most; below 1, a share of those of the mesh."""

    title: str
    antialias: bool = False
    side: int = SIDE
    triangles: float = 1.0

    def scene(self, scene: Scene) -> Scene:
        """Return the lowered scene."""
        most = round(self.triangles * scene.triangles) if self.triangles <= 1 else round(self.triangles)
        simpler = simplify_scene(scene, most) if most < scene.triangles else scene
        return evolve(simpler, width=self.side, height=self.side, antialias=self.antialias)


#: The groups of rows: coarse meshes, of about 1,200 triangles, and fine ones, of 5,800 to 29,000.
COARSE_ROWS = (
    Lowered("size 224", True, 224),
    Lowered("size 192", True, 192),
    Lowered("85 % of the triangles", True, SIDE, 0.85),
    Lowered("**no antialiasing**"),
    Lowered("no antialiasing, 70 % of the triangles", triangles=0.7),
    Lowered("size 128", True, 128),
    Lowered("**no antialiasing, size 192**", side=192),
    Lowered("**no antialiasing, size 128**", side=128),
    Lowered("no antialiasing, size 128, 70 % of the triangles", side=128, triangles=0.7),
    Lowered("**no antialiasing, size 64**", side=64),
    Lowered("no antialiasing, size 128, 35 % of the triangles", side=128, triangles=0.35),
    Lowered("**no antialiasing, size 64, 50 % of the triangles**", side=64, triangles=0.5),
)
FINE_ROWS = (
    Lowered("**no antialiasing**"),
    Lowered("**no antialiasing, size 128**", side=128),
    Lowered("no antialiasing, 3,000 triangles", triangles=3000),
    Lowered("no antialiasing, size 64", side=64),
    Lowered("**no antialiasing, size 128, 3,000 triangles**", side=128, triangles=3000),
    Lowered("no antialiasing, 1,200 triangles", triangles=1200),
    Lowered("**no antialiasing, size 128, 2,048 triangles**", side=128, triangles=2048),
    Lowered("**no antialiasing, size 64, 2,048 triangles**", side=64, triangles=2048),
    Lowered("no antialiasing, size 128, 800 triangles", side=128, triangles=800),
    Lowered("**no antialiasing, size 64, 1,200 triangles**", side=64, triangles=1200),
)


def cost(image: Image) -> int:
    """Return the gas of a picture, intrinsic gas included."""
    assert image.gas is not None
    assert image.intrinsic_gas is not None
    return image.gas + image.intrinsic_gas


def enlarged(image: Image, side: int) -> np.ndarray:
    """Return the picture as it is seen at the size that was asked for, (side, side, 3), enlarged as browsers do."""
    return np.asarray(image.to_pil().resize((side, side), PillowImage.Resampling.BICUBIC)).astype(float)


def judge(path: Path, rows: tuple[Lowered, ...]) -> list[tuple[float, float, float]]:
    """Return for each row its share of gas, FLIP, and mean error in levels, beside the picture that was asked for."""
    scene = load(path, size=SIDE, max_triangles="all")
    asked = render(scene)
    right = asked.pixels.astype(float)
    found = []
    for row in rows:
        image = render(row.scene(scene))
        seen = enlarged(image, SIDE)
        found.append((cost(image) / cost(asked), flip(right, seen), float(np.abs(right - seen).mean())))
    return found


def table(rows: tuple[Lowered, ...], results: Iterable[list[tuple[float, float, float]]]) -> str:
    """Return the means over all models as a table in Markdown, most gas first."""
    lines = ["| | gas | FLIP | mean error, levels |", "|---|---:|---:|---:|"]
    means = [[fmean(values) for values in zip(*row, strict=True)] for row in zip(*results, strict=True)]
    for (gas, difference, error), row in sorted(zip(means, rows, strict=True), key=lambda each: -each[0][0]):
        lines.append(f"| {row.title} | {100 * gas:.0f} % | {difference:.4f} | {error:.2f} |")
    return "\n".join(lines)


def main() -> int:
    """Measure, print and write the tables."""
    # of the room only walls would be left
    coarse = [path for path in shared.meshes() if path.stem != "cornell-box"]
    fine = [shared.SHARED / "meshes" / "full" / name for name in FINE]
    if not coarse or not all(path.exists() for path in fine):
        print(f"{shared.MESHES_SKIPPED}; the tables are kept")
        return 0
    with ProcessPoolExecutor(mp_context=get_context("spawn")) as pool:
        tables = {
            name: table(rows, list(pool.map(judge, paths, [rows] * len(paths))))
            for name, rows, paths in (("coarse", COARSE_ROWS, coarse), ("fine", FINE_ROWS, fine))
        }
    print("\n\n".join(tables.values()))
    return update({PAGE: tables.get}, "python -m benchmarks.fitting")


if __name__ == "__main__":
    run_main(main)
