"""Measure what moves: turntables and models of every icon, made by contracts in one call each.

    python -m benchmarks.motion

measures everything, rewrites motion.json and the table of docs/motion.md, and prints it.
"""

from __future__ import annotations

from functools import partial
from pathlib import Path

from tools.pages import ROOT

from shackled import Scene
from shackled.artifacts import artifact
from shackled.chain import open_chain
from shackled.chain._chain import returned_bytes
from shackled.datasets import pieces
from shackled.scene._look import resize
from shackled.studio import store_scene
from shackled.studio._storage import ANIMATE

from . import publish, read_figures, run_main

FILE = Path(__file__).with_name("motion.json")
recorded = partial(read_figures, FILE)
PAGE = ROOT / "docs" / "motion.md"

#: Of the turntables: frames, sides in pixels, and the gas that most nodes give a call without being asked.
FRAMES = 12
SIDE = 64
LIMIT = 50_000_000
#: Side of the pictures, and of the square that each pixel of an SVG becomes.
PICTURE = 128
SCALE = 4

Figures = dict[str, int]

#: The columns of the table: what is measured, and the signature of the Studio's function.
COLUMNS = {
    "turntable": ANIMATE,
    "model": "glb(address)",
    "SVG": "renderSVG(address,uint256)",
    "PNG": "renderPNG(address,uint256)",
}


def measure(scene: Scene) -> Figures:
    """Store a scene in the embedded chain; return gas and bytes of each file that the Studio makes of it."""
    chain = open_chain()
    studio, interface = chain.address("Studio"), artifact("Studio").interface
    stored = store_scene(scene, studio)
    pointer = "0x" + stored[-1].pointer.hex()
    changes = (16, (0, 0, 0, 0), 0, (0, 0), 0, (SIDE, SIDE))
    arguments = {
        "turntable": (pointer, (FRAMES, 100, 1, (0, 1 << 32, 0), True), changes),
        "model": (pointer,),
        "SVG": (pointer, SCALE),
        "PNG": (pointer, SCALE),
    }
    figures: Figures = {}
    for each in stored:
        chain.put(each.pointer, each.code)
    try:
        for name, signature in COLUMNS.items():
            result = chain.run(studio, interface.encode(signature, *arguments[name]))
            figures |= {f"{name}: gas": result.gas, f"{name}: bytes": len(returned_bytes(result.output))}
    finally:
        for each in stored:
            chain._codes.pop(each.pointer, None)
    return figures


def take() -> Figures:
    """Measure all icons, each as its token stores it."""
    return {
        f"{piece.name.partition('/')[2]}: {name}": value
        for piece in pieces("icons")
        for name, value in measure(resize(piece.make(), (PICTURE, PICTURE))).items()
    }


def fitting(figures: Figures) -> list[str]:
    """Return the icons whose turntable fits the limit."""
    ending = ": turntable: gas"
    return [name.removesuffix(ending) for name, gas in figures.items() if name.endswith(ending) and gas <= LIMIT]


def table(figures: Figures) -> str:
    """Return the figures as a table in Markdown, the cheapest turntable first."""
    icons = sorted({name.partition(":")[0] for name in figures}, key=lambda icon: figures[f"{icon}: turntable: gas"])
    lines = [
        "| icon | turntable, gas | bytes | model, gas | bytes | SVG, gas | bytes | PNG, gas |",
        "|---|" + 7 * "---:|",
    ]
    names = [f"{column}: {what}" for column in COLUMNS for what in ("gas", "bytes")][:-1]
    lines += [f"| {icon} | " + " | ".join(f"{figures[f'{icon}: {name}']:,}" for name in names) + " |" for icon in icons]
    lines.append(f"\n{len(fitting(figures))} of {len(icons)} turntables take at most {LIMIT // 10**6} million gas.")
    return "\n".join(lines)


def main() -> int:
    """Measure, print and write the figures."""
    figures = take()
    return publish("motion", figures, table(figures), PAGE, "icons")


if __name__ == "__main__":
    run_main(main)
