"""Small scenes that go through every stage, by name."""

from __future__ import annotations

import pytest

from shackled import Background, Camera, Light, Material, Mesh, Object, Scene
from shackled.datasets import teapot

SQUARE = Mesh(
    [[-2, -2, 0], [2, -2, 0], [2, 2, 0], [-2, 2, 0]],
    [[0, 1, 2], [0, 2, 3]],
    [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 0]],
)
POT = teapot(2)
CAMERA = Camera(eye=(2, 4, 8), target=(0, 1.5, 0))
SCENES = {
    "smooth": Scene(
        [Object(POT, material=Material("smooth"))],
        CAMERA,
        [Light("point", (3, 6, 5)), Light("directional", (-1, 0.5, 0), (90, 60, 30))],
        Background("#102040", "#a0b0c0"),
        width=24,
        height=16,
    ),
    "clipped, wires, inverted": Scene(
        [Object(SQUARE, (0, 0, 2), scale=1.5, cull=False), Object(POT, wireframe=True, material=Material("unlit"))],
        Camera(eye=(1, 1, 2.5), target=(0, 1, 0), near=0.25),
        [Light("directional", (1, 1, 1))],
        invert=True,
        width=17,
        height=11,
    ),
    "empty": Scene([], width=5, height=3),
}


@pytest.fixture(scope="session")
def scenes() -> dict[str, Scene]:
    return SCENES
