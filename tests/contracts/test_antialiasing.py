"""Four samples for each pixel: which of them a triangle covers, exactly; the judge sees what the picture is made of.

The fill rule and the shapes are those of `test_fill_rule`, at the places of the samples in place of the centres.
"""

from __future__ import annotations

import numpy as np
import pytest
from attrs import evolve
from benchmarks.scenes import cubes
from numpy.typing import NDArray

from pictures import draw, on_pixel_grid, pixel_grid_camera, soup, unlit_scene
from shackled import Background, Light, render
from test_fill_rule import KINDS, Integers, Triangles, expected_pixels, fan, grid, random_triangle, strip

#: Columns and rows of the samples from the centre of their pixel, in 1/256 of it.
SAMPLES = np.array([(-32, -96), (96, -32), (-96, 32), (32, 96)])
#: The level of a white pixel on black with so many samples.
LEVELS = np.array([0, 64, 128, 191, 255])


def expected_levels(corners: Integers, width: int, height: int) -> NDArray[np.int64]:
    """(H, W): the levels of a white triangle on black."""
    count = sum(expected_pixels(corners - sample, width, height).astype(int) for sample in SAMPLES)
    return np.asarray(LEVELS[count])


def drawn(corners: Triangles, width: int, height: int) -> NDArray[np.uint8]:
    """The picture of white triangles on black."""
    scene = unlit_scene(soup(on_pixel_grid(corners, width, height)), pixel_grid_camera(height), width, height)
    return draw(evolve(scene, background=Background("black"), antialias=True))[:, :, 0]


@pytest.mark.parametrize("kind", KINDS)
def test_every_sample_obeys_the_fill_rule(kind: str) -> None:
    rng = np.random.default_rng(1)
    covering = 0
    for _ in range(120):
        width, height = (int(side) for side in rng.integers(1, 33, 2))
        corners = random_triangle(rng, KINDS[kind], width, height)
        expected = expected_levels(corners, width, height)
        covering += bool(expected.any())
        assert (drawn(corners, width, height) == expected).all(), f"{corners.tolist()} on {width} x {height}"
    assert covering > 30


@pytest.mark.parametrize("slivers", [False, True])
def test_edges_through_samples_and_slivers(slivers: bool) -> None:
    rng = np.random.default_rng(2)
    for _ in range(120):
        corners = rng.integers(0, 12, (3, 2)) * 256 + 128 + SAMPLES[rng.integers(0, 4, 3)]
        if slivers:
            corners[2] = (corners[0] + corners[1]) // 2 + rng.integers(-40, 41, 2)
        assert (drawn(corners, 12, 12) == expected_levels(corners, 12, 12)).all(), corners.tolist()


@pytest.mark.parametrize("shape", [fan, grid, strip])
def test_triangles_of_a_shape_share_no_sample_and_leave_none_out(shape: object) -> None:
    triangles = shape(np.random.default_rng(5))  # type: ignore[operator]
    alone = sum(np.searchsorted(LEVELS, drawn(corners[None], 32, 32)) for corners in triangles)
    assert (drawn(triangles, 32, 32) == LEVELS[alone]).all()


@pytest.mark.parametrize(("width", "height"), [(60, 44), (200, 110)])
def test_an_inverted_picture_of_several_engines(width: int, height: int) -> None:
    """Flat, smooth, wires, glass, flat again; a spot light. The larger one has more than one band."""
    scene = cubes(height)
    first, second, third = scene.objects
    objects = [
        first,
        evolve(third, position=(0, 100, -1500)),
        evolve(second, position=(-300, -200, -1400), wireframe=True),
        evolve(second, position=(300, 0, -1000), opacity=0.4, scale=0.5),
        evolve(first, position=(0, -400, -1600), scale=0.7),
    ]
    spot = Light.spot(position=(0, 900, -200), direction=(0, -0.5, -1), inner_angle=20, outer_angle=50)
    lights = (*scene.lights, spot)
    scene = evolve(scene, objects=objects, lights=lights, width=width, height=height, antialias=True)
    assert (render(evolve(scene, invert=True)).pixels == 255 - render(scene).pixels).all()
