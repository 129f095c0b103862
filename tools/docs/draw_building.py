"""Draw the pictures of docs/building.md: the scenes of examples/building/ShapeGallery.sol and StageGallery.sol.

    python -m tools.docs.draw_building

Needs the compiler: `npm ci` in contracts/.
"""

from __future__ import annotations

import io

import numpy as np
from numpy.typing import NDArray
from PIL import Image as PillowImage

from shackled.artifacts import artifact
from tools.examples import compile_example
from tools.ledger import World
from tools.pages import IMAGES

#: The pictures by name: the scenes that stand side by side in each, as functions with their argument, if any.
PICTURES: dict[str, dict[str, list[str]]] = {
    "examples/building/ShapeGallery.sol": {
        "shapes": ["box()", "sphere()", "cylinder()", "cone()"],
        "drawn": ["lathe()", "torus()", "extrusion()"],
        "text": ["text()"],
        "alphabet": ["alphabet()"],
    },
    "examples/building/StageGallery.sol": {
        "smooth": ["shading()"],
        "painted": ["painted()"],
        "placed": ["placed()"],
        "lens": ["lens(int256) 90", "lens(int256) 50", "lens(int256) 20", "lens(int256) 0"],
        "lit": ["lit(uint256) 0", "lit(uint256) 1", "lit(uint256) 2"],
    },
}


def scenes(world: World, gallery: str, functions: list[str]) -> list[bytes]:
    """Return scenes of a gallery, ABI-encoded, and print the gas of building each."""
    creation, selectors = compile_example(gallery)
    contract = world.deploy(creation)
    made = []
    for each in functions:
        function, _, argument = each.partition(" ")
        made.append(world.run(contract, selectors[function] + int(argument or 0).to_bytes(32, "big")))
        print(f"{each}: {world.gas:,} gas to build")
    return made


def draw(world: World, scene: bytes) -> NDArray[np.uint8]:
    """Return the picture of an ABI-encoded scene, and print the gas of drawing it."""
    output = world.run(world.address("Renderer"), artifact("Renderer").selectors["render"] + scene)
    print(f"    {world.gas:,} gas to draw")
    return np.asarray(PillowImage.open(io.BytesIO(output[64:])))


def main() -> None:
    """Draw the pictures."""
    world = World()
    for gallery, pictures in PICTURES.items():
        for name, functions in pictures.items():
            row = np.hstack([draw(world, scene) for scene in scenes(world, gallery, functions)])
            PillowImage.fromarray(row).save(IMAGES / f"building-{name}.png", optimize=True)


if __name__ == "__main__":
    main()
