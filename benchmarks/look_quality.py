"""Measure what each part of a look adds to a picture, beside what the same gas adds as size.

    python -m benchmarks.look_quality

The truth is the picture of the judge of the tests, in float64, with 64 samples a pixel and the whole look. Each row
leaves one part of the look out; its FLIP, a perceptual difference, is compared with that of the whole look on a canvas
so much smaller that it needs the same gas. Rewrites look_quality.json and its table in benchmarks/README.md.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
from attrs import evolve
from PIL import Image as PillowImage
from tools.pages import ROOT

from shackled import Rim, Scene, Tone, load, render
from shackled.base.checks import Floats
from shackled.bench._report import table, wrapped
from shackled.scene import Hemisphere
from shackled.scene._codec import render_call
from shackled.scene._in_range import in_range

sys.path.insert(0, str(ROOT / "tests" / "support"))
sys.path.insert(0, str(ROOT / "tests"))
sys.path.insert(0, str(ROOT / "contracts"))
from judge import render as in_float64

from . import flip, publish, read_figures, run_main

FILE = Path(__file__).with_name("look_quality.json")
recorded = partial(read_figures, FILE)
PIECES = ("teapot", "torus-knot", "icons/crown", "genesis/7")
SIDE = 128
#: Sides of the smaller canvases on which the whole look is drawn, the largest first.
SIDES = (128, 120, 112, 104, 96, 80, 64, 48, 32)
#: The truth has so many pixels along a side of a pixel, of four samples each.
FINER = 4


def plain(piece: str) -> Scene:
    """Return a piece without effects, antialiased and smooth."""
    return load(piece, size=SIDE, antialias=True, shading="smooth")


def effects(piece: str) -> Scene:
    """Return a piece with effects, which are always antialiased."""
    light = Hemisphere("lightskyblue", "tan")
    return evolve(plain(piece), hemisphere=light, rim=Rim("white", 3), tone=Tone(1.2, filmic=True, gamma=True))


def flat(scene: Scene) -> Scene:
    """Return a scene with the normals of its faces."""
    return evolve(scene, objects=[evolve(o, material=evolve(o.material, shading="flat")) for o in scene.objects])


#: Of each look: how it is made, and what is left out of it.
LOOKS: dict[str, tuple[Callable[[str], Scene], dict[str, Callable[[Scene], Scene]]]] = {
    "plain": (
        plain,
        {"anti-aliasing": lambda scene: evolve(scene, antialias=False), "smooth normals": flat},
    ),
    "effects": (
        effects,
        {
            "smooth normals": flat,
            "hemisphere light": lambda scene: evolve(scene, hemisphere=None),
            "rim": lambda scene: evolve(scene, rim=None),
            "exposure, filmic, gamma": lambda scene: evolve(scene, tone=None),
        },
    ),
}


def truth(scene: Scene) -> Floats:
    """Return the picture in float64, (H, W, 3), from 0 to 255."""
    large = evolve(scene, width=FINER * scene.width, height=FINER * scene.height)
    exact = in_float64(render_call(in_range(large))).exact
    return np.asarray(exact.reshape(scene.height, FINER, scene.width, FINER, 3).mean(axis=(1, 3)))


def drawn(scene: Scene, right: Floats) -> tuple[int, float]:
    """Return the gas of a scene, and the FLIP of its picture, enlarged as browsers do."""
    image = render(scene)
    assert image.gas is not None
    seen = image.to_pil().convert("RGB").resize((SIDE, SIDE), PillowImage.Resampling.BICUBIC)
    return image.gas, flip(right, np.asarray(seen))


def measure(piece: str) -> dict[str, list[float]]:
    """Return for each look, and without each part: share of gas, FLIP, and FLIP of a smaller whole at that gas."""
    found = {}
    for look, (make, parts) in LOOKS.items():
        scene = make(piece)
        right = truth(scene)
        sizes = [drawn(evolve(scene, width=side, height=side), right) for side in SIDES]
        gas, flips = zip(*reversed(sizes), strict=True)
        found[f"{look}: nothing"] = [1.0, sizes[0][1], sizes[0][1]]
        for name, change in parts.items():
            spent, without = drawn(change(scene), right)
            found[f"{look}: {name}"] = [spent / sizes[0][0], without, float(np.interp(spent, gas, flips))]
    return {name: np.round(each, 4).tolist() for name, each in found.items()}


def text(figures: dict[str, dict[str, list[float]]]) -> str:
    """Return the means over the pieces as Markdown."""
    lines, dear = [], []
    for name in next(iter(figures.values())):
        share, without, smaller = np.mean([each[name] for each in figures.values()], axis=0)
        if without < smaller:
            dear.append(name)
        lines.append([name, f"{share:.0%}", f"{without:.4f}", f"{smaller:.4f}"])
    head = ["look: left out", "gas", "FLIP", "FLIP of the whole look, smaller, for this gas"]
    return wrapped(
        f"Means of {', '.join(figures)}, {SIDE} x {SIDE} pixels. To save gas, leaving out a part loses less than a"
        f" smaller canvas for {' and '.join(dear) or 'no part'}.\n\n" + table(head, lines)
    )


def main() -> int:
    """Measure, print and write the figures."""
    figures = {piece: measure(piece) for piece in PIECES}
    return publish("look_quality", figures, text(figures))


if __name__ == "__main__":
    run_main(main)
