"""Measure what shadows cost, group by group.

    python -m benchmarks.shadows

measures pictures on a ground, without and with shadows, rewrites the table of docs/light.md, and prints it.
"""

from __future__ import annotations

from statistics import fmean

from attrs import evolve
from tools.pages import ROOT, update

from shackled import Camera, Ground, Light, Material, Object, Scene, load
from shackled.bench._measure import gas
from shackled.datasets import pieces
from shackled.datasets._pieces import require
from shackled.datasets.common.shapes import sphere

from . import run_main

PAGE = ROOT / "docs" / "light.md"


def groups() -> dict[str, list[Scene]]:
    """Return the scenes of each group, 128 x 128 pixels each."""
    models = ["uv-sphere", "torus", "torus-knot"]
    return {
        f"{', '.join(models)}, smooth": [load(name, size=128, shading="smooth") for name in models],
        "the same, flat": [load(name, size=128, shading="flat") for name in models],
        "28 icons": [piece.make() for piece in pieces("icons")],
        "Genesis 0 to 23": [require(f"genesis/{number}").make() for number in range(24)],
        "a point light amid six spheres": [amid_spheres()],
    }


def amid_spheres() -> Scene:
    """Return a scene with a point light in the middle of six spheres of 504 triangles each."""
    places = [(4, 0, 0), (-4, 0, 0), (0, 4, 0), (0, -4, 0), (0, 0, 4), (0, 0, -4)]
    ball = sphere(21, 13)
    return Scene(
        camera=Camera(eye=(14, 8, 18), target=(0, 0, 0)),
        lights=[Light("point", (0, 0, 0))],
        objects=[Object(ball, position=place, material=Material(shading="flat")) for place in places],
    )


def table(scenes: dict[str, list[Scene]]) -> str:
    """Return the gas of each group as a table in Markdown."""
    lines = [
        "| pictures | triangles | without, mean gas | with shadows | ratio of means | least | most |",
        "|---|" + 6 * "---:|",
    ]
    for name, each in scenes.items():
        plain, shaded = ([gas_of(scene, shadow) for scene in each] for shadow in (False, True))
        ratios = [after / before for before, after in zip(plain, shaded, strict=True)]
        lines.append(
            f"| {name} | {fmean(scene.triangles for scene in each):,.0f} | {fmean(plain) / 1e6:.1f}M | "
            f"{fmean(shaded) / 1e6:.1f}M | {sum(shaded) / sum(plain):.2f} | {min(ratios):.2f} | {max(ratios):.2f} |"
        )
    return "\n".join(lines)


def gas_of(scene: Scene, shadow: bool) -> int:
    """Return the gas of a scene on a ground, of which the first light casts shadows or not."""
    first, *others = scene.lights
    return gas(evolve(scene, lights=[evolve(first, shadow=shadow), *others], ground=Ground("gray")))


def main() -> int:
    """Measure, print and write the table."""
    found = table(groups())
    print(found)
    return update({PAGE: {"shadows": found}.get}, "python -m benchmarks.shadows")


if __name__ == "__main__":
    run_main(main)
