"""Measure what textures cost, and look at models that others publish.

python -m benchmarks.textures                measures, and rewrites the tables of docs/light.md
python -m benchmarks.textures --models DIR   fetches BoxTextured and Duck, and draws them into a folder
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from attrs import evolve
from tools.pages import ROOT, update

from shackled import Camera, Light, Material, Mesh, Object, Scene, Texture, Tone, load, render
from shackled.bench._measure import cost, gas
from shackled.chain import open_chain
from shackled.scene._fields import FILTERS
from shackled.scene._packed import pack_texture
from shackled.studio import store_scene

from . import run_main

PAGE = ROOT / "docs" / "light.md"

#: Models of the Khronos Group, of which only `--models` brings a copy.
MODELS = "https://raw.githubusercontent.com/KhronosGroup/glTF-Sample-Assets/main/Models/{0}/glTF-Binary/{0}.glb"
NAMES = ("BoxTextured", "Duck")

#: Formats of texels: colours, and a title.
FORMATS = {16: "palette of 16 colours", 256: "palette of 256 colours", 5000: "RGB"}
SQUARE = Mesh([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], [[0, 1, 2], [0, 2, 3]], "white")
UVS = [[0, 1], [1, 1], [1, 0], [0, 0]]


def image(side: int, colors: int) -> np.ndarray[tuple[int, ...], np.dtype[np.uint8]]:
    """Return random pixels, (side, side, 3), of so many colours."""
    random = np.random.default_rng(colors)
    palette = random.integers(0, 256, (colors, 3), dtype=np.uint8)
    numbers = np.concatenate([np.arange(min(colors, side * side)), random.integers(0, colors, side * side)])
    return np.asarray(palette[numbers[: side * side]].reshape(side, side, 3))


def square(texture: Texture | None) -> Scene:
    """Return a flat square that fills most of the picture."""
    thing = Object(SQUARE, material=Material("flat"), cull=False)
    if texture is not None:
        mesh = evolve(SQUARE, uvs=UVS)
        thing = evolve(thing, mesh=mesh, material=evolve(thing.material, texture=texture))
    return Scene([thing], Camera((0, 0, 2.6)), [Light("directional", (1, 2, 3))], width=128, height=128, antialias=True)


def per_pixel() -> str:
    """Return the gas that a textured pixel takes as a table in Markdown."""
    plain = cost(square(None))
    pixels = plain.lit_pixels
    lines = ["| gas for each pixel | nearest | bilinear |", "|---|---:|---:|"]
    lines.append(f"| without a texture, antialiased | {plain.gas // pixels:,} | |")
    with_effects = gas(evolve(square(None), tone=Tone()))
    lines.append(f"| without a texture, by the EffectsEngine | {with_effects // pixels:,} | |")
    for colors, title in FORMATS.items():
        values = [gas(square(Texture(image(64, colors), filter))) // pixels for filter in FILTERS]
        lines.append(f"| {title} | {' | '.join(f'{value:,}' for value in values)} |")
    return "\n".join(lines)


def stored() -> str:
    """Return the gas of storing textures as a table in Markdown."""
    chain = open_chain()
    studio = chain.address("Studio")
    without = sum(each.gas for each in store_scene(square(None), studio)[1:])
    lines = ["| texture | bytes | gas to store it with a scene |", "|---|---:|---:|"]
    for side, colors in ((32, 16), (64, 16), (64, 256), (128, 256), (256, 256), (256, 5000)):
        texture = Texture(image(side, colors), "nearest")
        more = sum(each.gas for each in store_scene(square(texture), studio)[1:]) - without
        size = len(pack_texture(texture, np.array(UVS, dtype=np.float64)))
        lines.append(f"| {side} x {side}, {FORMATS[colors]} | {size:,} | {more:,} |")
    return "\n".join(lines)


def draw_models(folder: Path) -> None:
    """Fetch the models and draw them."""
    import pooch

    for name in NAMES:
        path = Path(pooch.retrieve(MODELS.format(name), None, f"{name}.glb", folder))
        picture = render(load(path))
        picture.save(folder / f"{name}.png")
        print(f"{name}: {picture.triangles:,} triangles, {picture.gas:,} gas, {folder / name}.png")


def main() -> int:
    """Run the command."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--models", type=Path, metavar="DIR", help="fetch models, and draw them into this folder")
    folder = parser.parse_args().models
    if folder is not None:
        draw_models(folder)
        return 0
    tables = {"texels": per_pixel(), "stored": stored()}
    print("\n\n".join(tables.values()))
    return update({PAGE: tables.get}, "python -m benchmarks.textures")


if __name__ == "__main__":
    run_main(main, has_options=True)
