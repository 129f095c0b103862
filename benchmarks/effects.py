"""Measure what each effect costs for each pixel.

    python -m benchmarks.effects

draws a square with one effect at a time, prints the gas for each pixel, and writes it into benchmarks/effects.json, of
which `python -m tools.generated` makes the table of docs/light.md.
"""

from collections.abc import Callable
from typing import Any

from attrs import evolve
from tools.readme import EFFECTS

from shackled import Camera, Fog, Light, Material, Mesh, Object, Rim, Scene, Tone
from shackled.bench._measure import cost
from shackled.scene import Hemisphere

from . import run_main, write_figures

CORNERS = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]
#: Normals that differ, so that every fragment has its own.
NORMALS = [[-1, -1, 3], [1, -1, 3], [1, 1, 3], [-1, 1, 3]]
COLORS = ["white", "tan", "silver", "gold"]
SQUARE = Mesh(CORNERS, [[0, 1, 2], [0, 2, 3]], COLORS, normals=NORMALS)

Change = Callable[[Scene], Scene]


def square(shading: str, quick: bool = False) -> Scene:
    """Return a square that fills most of the picture, with highlights; quick: of one colour, and without."""
    mesh = evolve(SQUARE, colors="tan") if quick else SQUARE
    thing = Object(mesh, material=Material(shading, specular=0.0 if quick else 0.4), cull=False)
    return Scene([thing], Camera((0, 0, 2.6)), [Light("directional", (1, 2, 3))], width=128, height=128, antialias=True)


def scene_with(**fields: Any) -> Change:
    """Return the change of these fields of a scene."""
    return lambda scene: evolve(scene, **fields)


def object_with(**fields: Any) -> Change:
    """Return the change of these fields of all objects."""
    return lambda scene: evolve(scene, tone=Tone(), objects=[evolve(each, **fields) for each in scene.objects])


def ground(scene: Scene) -> Scene:
    """Make the square a ground that fades."""
    return object_with(fade=(0.1, 2.0))(scene)


def emission(scene: Scene) -> Scene:
    """Let the square emit light."""
    objects = [evolve(each, material=evolve(each.material, emission="tan")) for each in scene.objects]
    return evolve(scene, objects=objects)


ROWS: dict[str, Change] = {
    "antialiased, without effects": lambda scene: scene,
    "the EffectsEngine, with no effect": scene_with(tone=Tone()),
    "hemisphere light": scene_with(hemisphere=Hemisphere("skyblue", "tan")),
    "rim, exponent 3": scene_with(rim=Rim("white", 3)),
    "emission": emission,
    "fog": scene_with(fog=Fog("white", 1.0, 4.0)),
    "exposure": scene_with(tone=Tone(1.5)),
    "filmic": scene_with(tone=Tone(1.5, filmic=True)),
    "gamma": scene_with(tone=Tone(gamma=True)),
    "gamma, filmic": scene_with(tone=Tone(1.5, filmic=True, gamma=True)),
    "opacity of the object": object_with(opacity=0.5),
    "opacities of vertices": object_with(mesh=evolve(SQUARE, opacities=[0.2, 0.4, 0.6, 0.8])),
    "a ground, where it fades": ground,
}


def gas_of_a_pixel(scene: Scene) -> int:
    """Return the gas of a picture for each of its covered pixels."""
    found = cost(scene)
    return found.gas // found.lit_pixels


def main() -> int:
    """Measure, print and write the figures."""
    squares = (square("flat"), square("smooth"), square("flat", quick=True))
    found = {name: [gas_of_a_pixel(change(each)) for each in squares] for name, change in ROWS.items()}
    for name, gas in found.items():
        print(f"{name:36}" + "".join(f"{each:>8,}" for each in gas))
    write_figures(EFFECTS, found)
    return 0


if __name__ == "__main__":
    run_main(main)
