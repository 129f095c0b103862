"""Four samples for each pixel: which of them a triangle covers, exactly, and what the picture is made of.

The fill rule and the shapes are those of `test_fill_rule`, at the places of the samples in place of the centres.
"""

from __future__ import annotations

import numpy as np
import pytest
from attrs import evolve
from benchmarks.scenes import cubes, staged_teapot
from numpy.typing import NDArray

from pictures import draw, on_pixel_grid, pixel_grid_camera, soup, unlit_scene
from shackled import Background, Light, Scene, load, render
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


# ---- what is made of the samples ----


def supersampled(scene: Scene) -> NDArray[np.float64]:
    """The mean of 4 x 4 pixels of a plain picture, four times as large, for each pixel."""
    large = render(evolve(scene, width=4 * scene.width, height=4 * scene.height, antialias=False)).pixels
    return np.asarray(large.reshape(scene.height, 4, scene.width, 4, 3).mean(axis=(1, 3)))


@pytest.mark.parametrize("name", ["unlit", "flat", "cubes", "icons/crown", "icons/ethereum", "genesis/12"])
def test_half_as_far_from_a_supersampled_picture(name: str) -> None:
    if name == "cubes":
        scene = cubes(96)
    elif "/" in name:
        scene = load(name)
    else:
        scene = staged_teapot(name, 96)  # type: ignore[arg-type]
    expected = supersampled(scene)
    plain, smoothed = (np.abs(render(evolve(scene, antialias=flag)).pixels - expected).mean() for flag in (False, True))
    assert smoothed <= plain / 2


def test_a_wire_is_a_pixel_wide() -> None:
    """A line of 20 pixels in any direction has the area of 20 pixels."""
    for angle in np.radians([0, 7, 30, 45, 80, 91, 133]):
        middle, end = np.array([4011, 4013]), 2560 * np.array([np.cos(angle), np.sin(angle)])
        mesh = soup(on_pixel_grid(np.array([middle - end, middle + end, middle])[None], 31, 31))
        # the line to the corner in the middle and back lies on the first; without an area there are no wires
        mesh = evolve(mesh, positions=mesh.positions + np.outer([0, 0, 1], [1, 1, 0]))
        (thing,) = (scene := unlit_scene(mesh, pixel_grid_camera(31), 31, background=Background("black"))).objects
        pixels = render(evolve(scene, objects=[evolve(thing, wireframe=True)], antialias=True)).pixels
        assert 18.5 <= pixels[:, :, 0].sum() / 255 <= 21.5, angle


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
