"""Which faces the contracts light once: told from the scene, judged by the gas of a pixel."""

from __future__ import annotations

from typing import Any

import pytest
from attrs import evolve

from shackled import Light, Material, Mesh, Object, Scene, Texture, Tone, load
from shackled.gas import measure, missed_quick_path
from shackled.gas._quick_path import quick_path_note
from shackled.scene._look import resize

CORNERS, FACES = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], [[0, 1, 2], [0, 2, 3]]
#: The second face has a corner of another colour.
PAINTED = ["tan", "tan", "tan", "white"]
UVS = [[0, 0], [1, 0], [1, 1], [0, 1]]
#: A pixel of a quick face takes 490 gas, with a ground 1,040; another 1,780, and half of them 1,090.
DEAR = 1_065


def square(shading: str = "flat", specular: float = 0, color: Any = "tan", **fields: Any) -> Scene:
    """Return a square with effects that fills most of the picture."""
    more = {name: fields.pop(name) for name in ("texture", "emission") if name in fields}
    opacities, lights = fields.pop("opacities", None), fields.pop("lights", [Light.directional(toward=(1, 2, 3))])
    mesh = Mesh(CORNERS, FACES, color, normals=[[0, 0, 1]] * 4, uvs=UVS, opacities=opacities)
    thing = Object(mesh, material=Material(shading, specular=specular, **more), cull=False)
    looks: dict[str, Any] = {"hemisphere": ("skyblue", "tan"), **fields}
    return evolve(Scene(thing, camera=load("cube").camera, lights=lights), objects=[thing], **looks)


def gas_of_a_pixel(scene: Scene) -> float:
    """Return the gas that a larger picture takes more, for each pixel that it has more."""
    small, large = (measure(resize(scene, side)).gas for side in (48, 96))
    return (large - small) / (96**2 - 48**2)


CASES: dict[str, tuple[dict[str, Any], dict[str, int]]] = {
    "flat": ({}, {}),
    "gamma": ({"tone": Tone(gamma=True)}, {}),
    "unlit": ({"shading": "unlit", "specular": 0.3}, {}),
    "emission": ({"emission": "red"}, {}),
    "ground": ({"ground": "white"}, {}),
    "shadow": ({"lights": [Light.directional(toward=(1, 2, 3), shadow=True)]}, {}),
    "highlight": ({"specular": 0.08}, {"a highlight of 8 percent": 2}),
    "smooth": ({"shading": "smooth"}, {"smooth shading": 2}),
    "colours": ({"color": PAINTED}, {"colours that vary inside the face": 1}),
    "rim": ({"rim": ("white", 3)}, {"rim light": 2}),
    "fog": ({"fog": ("white", 1, 9)}, {"fog": 2}),
    "point": ({"lights": [Light.point((1, 2, 3))]}, {"a point or spot light": 2}),
    "texture": ({"texture": Texture([[[0, 0, 0], [255, 255, 255]]] * 2)}, {"a texture": 2}),
    "opacities": ({"opacities": [0.2, 0.4, 0.6, 0.8]}, {"opacities of vertices": 2}),
    "two": (
        {"color": PAINTED, "specular": 0.3},
        {"a highlight of 30 percent": 1, "colours that vary inside the face and a highlight of 30 percent": 1},
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_what_is_lit_for_each_pixel_costs_more(name: str) -> None:
    given, expected = CASES[name]
    scene = square(**given)
    assert missed_quick_path(scene) == expected
    assert bool(quick_path_note(scene)) == bool(expected)
    assert (gas_of_a_pixel(scene) > DEAR) == bool(expected)


def test_without_effects_there_is_nothing_to_miss() -> None:
    scene = square(specular=0.3, color=PAINTED, hemisphere=None)
    assert missed_quick_path(scene) == {}
    assert quick_path_note(scene) == ""
    note = "of 2 faces, these miss the quick path of effects: 2 because of a highlight of 30 percent"
    assert quick_path_note(square(specular=0.3)) == note
