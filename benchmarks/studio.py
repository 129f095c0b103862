"""Measure the gas of the Studio: storing, decoding, PNG files.

    python -m benchmarks.studio

measures everything, rewrites studio.json and the tables of docs/studio.md, and prints what changed.
"""

from __future__ import annotations

from functools import partial
from pathlib import Path

import numpy as np
from attrs import evolve
from numpy.typing import NDArray
from tools.pages import ROOT, update

from shackled import Object, load, render
from shackled.artifacts import artifact
from shackled.chain import open_chain
from shackled.datasets import teapot
from shackled.datasets._pieces import require
from shackled.datasets.genesis import generate_on_chain, picture_on_chain, seed_of
from shackled.image import encode_bmp
from shackled.scene import stage
from shackled.scene._in_range import in_range
from shackled.scene._packed import pack
from shackled.studio import store_scene
from shackled.studio._compact_mesh import compact
from shackled.studio._storage import quantize, store_mesh

from . import read_figures, run_main, write_figures
from .snapshot import changes

FILE = Path(__file__).with_name("studio.json")
recorded = partial(read_figures, FILE)
PAGE = ROOT / "docs" / "studio.md"

Figures = dict[str, int]

#: The names of two figures.
SMALLEST = "992 triangles, smooth, grid of 2^11, normals of 6 bits"
SCENE = "icons/crown: store the scene, its mesh being there"

#: Pieces of Genesis of which the mean is taken.
PIECES = 16


class Keeper:
    """The embedded chain, with what its Studio stores."""

    def __init__(self) -> None:
        """Open the chain."""
        self.chain = open_chain()
        self.studio = self.chain.address("Studio")

    def gas(self, contract: str, function: str, data: bytes) -> int:
        """Return the execution gas of a call."""
        identifiers = artifact(contract).selectors
        return self.chain.call(contract, identifiers[function] + data).gas

    def kept_mesh(self, o: Object, normal_bits: int) -> tuple[int, int, int]:
        """Return the bytes of a mesh, the gas of the transaction that stores it, and that of reading it."""
        packed = pack(o.mesh, o.material.shading == "smooth")
        (storing,) = store_mesh("mesh", compact(packed, normal_bits), self.studio)
        self.chain._codes[storing.pointer] = b"\0" + compact(packed, normal_bits)
        try:
            reading = self.gas("Studio", "mesh", storing.pointer.rjust(32, b"\0"))
        finally:
            del self.chain._codes[storing.pointer]
        return storing.size, storing.gas, reading


def mesh_figures(keeper: Keeper) -> Figures:
    """Measure 1,000 triangles: 992 of a teapot, without loss and with."""
    smooth = require("teapot").make()
    flat = stage(teapot(4))
    figures: Figures = {}
    for name, scene, bits, normal_bits in (
        ("992 triangles, faces of one shade", flat, None, 10),
        ("992 triangles, smooth", smooth, None, 10),
        (SMALLEST, smooth, 11, 6),
        ("icons/crown", require("icons/crown").make(), None, 10),
        ("icons/heart", require("icons/heart").make(), None, 10),
    ):
        if bits is not None:
            scene = evolve(scene, objects=[quantize(o, bits) for o in scene.objects])
        (o,) = in_range(scene).objects
        size, storing, reading = keeper.kept_mesh(o, normal_bits)
        figures |= {f"{name}: bytes": size, f"{name}: store": storing, f"{name}: decode": reading}
    figures[SCENE] = store_scene(require("icons/crown").make(), keeper.studio)[-1].gas
    return figures


def png_figures(keeper: Keeper) -> Figures:
    """Measure PNG files of pictures of 128 x 128 pixels."""

    def encoding(scale: int, *pictures: NDArray[np.uint8]) -> tuple[int, int]:
        """Return gas and bytes of the PNG file of a picture, or of those over black and over white."""
        files = [encode_bmp(pixels) for pixels in pictures]
        signature = "encode(bytes,uint256)" if len(files) == 1 else "encodeTransparent(bytes,bytes,uint256)"
        data = artifact("PngEncoder").interface.encode(signature, *files, scale)
        result = keeper.chain.call("PngEncoder", data)
        return result.gas, int.from_bytes(result.output[32:64], "big")

    pieces = [picture_on_chain(generate_on_chain(seed_of(number))[0]).pixels for number in range(PIECES)]
    figures: Figures = {}
    for scale in (1, 2, 4, 8):
        gas, size = zip(*(encoding(scale, pixels) for pixels in pieces), strict=True)
        name = f"PNG, Genesis, x {scale}, mean of {PIECES} pieces"
        figures |= {f"{name}: gas": sum(gas) // PIECES, f"{name}: bytes": sum(size) // PIECES}
    others = {
        "one colour": np.full((128, 128, 3), 200, np.uint8),
        "teapot": render(require("teapot").make(), size=128).pixels,
        "noise": np.random.default_rng(1).integers(0, 256, (128, 128, 3), np.uint8),
    }
    for picture, pixels in others.items():
        gas_, size_ = encoding(4, pixels)
        figures |= {f"PNG, {picture}, x 4: gas": gas_, f"PNG, {picture}, x 4: bytes": size_}
    black, white = (
        render(load(require("teapot").make(), size=128, background=each)).pixels for each in ("black", "white")
    )
    for scale in (1, 4):
        name, (gas_, size_) = f"PNG, teapot, transparent, x {scale}", encoding(scale, black, white)
        figures |= {f"{name}: gas": gas_, f"{name}: bytes": size_}
    return figures


def take() -> Figures:
    """Measure all figures."""
    keeper = Keeper()
    return mesh_figures(keeper) | png_figures(keeper)


def meshes(figures: Figures) -> str:
    """Return the figures of stored meshes as a table in Markdown."""
    lines = ["| | bytes | store | decode |", "|---|---:|---:|---:|"]
    for title, name in {
        "992 triangles, one shade a face, nothing lost": "992 triangles, faces of one shade",
        "992 triangles, smooth, nothing lost": "992 triangles, smooth",
        "992 triangles, smooth, grid of 2^11, normals of 6 bits": SMALLEST,
        "the crown among the icons": "icons/crown",
    }.items():
        values = (figures[f"{name}: {what}"] for what in ("bytes", "store", "decode"))
        lines.append(f"| {title} | {' | '.join(f'{value:,}' for value in values)} |")
    return "\n".join([*lines, f"| the scene of the crown, if its mesh is stored | | {figures[SCENE]:,} | |"])


def pictures(figures: Figures) -> str:
    """Return the figures of PNG files as a table in Markdown."""
    lines = ["| PNG of 128 x 128 pixels | gas | bytes |", "|---|---:|---:|"]
    for name in (
        "Genesis, x 1, mean of 16 pieces",
        "Genesis, x 4, mean of 16 pieces",
        "teapot, x 4",
        "teapot, transparent, x 4",
        "noise, x 4",
    ):
        title = name.replace("x 1", "128 x 128").replace("x 4", "512 x 512")
        lines.append(f"| {title} | {figures[f'PNG, {name}: gas']:,} | {figures[f'PNG, {name}: bytes']:,} |")
    return "\n".join(lines)


def content(figures: Figures) -> dict[str, str]:
    """Return the tables of docs/studio.md by the names of their marks."""
    return {"meshes": meshes(figures), "pictures": pictures(figures)}


def main() -> int:
    """Measure, print the changes and write studio.json and the page."""
    old, new = recorded(), take()
    worse, better = changes({"studio": old}, {"studio": new})
    print("\n".join([*worse, *better]) or "no figure has changed")
    write_figures(FILE, new, sort_keys=True)
    return update({PAGE: content(new).get}, "python -m benchmarks.studio")


if __name__ == "__main__":
    run_main(main)
