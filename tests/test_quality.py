"""The measure of how good anti-aliasing looks, on edges whose areas are known; and what its last run found."""

from __future__ import annotations

import numpy as np
import pytest
from benchmarks import antialiasing, quality

from conformance import opengl
from pictures import on_pixel_grid, pixel_grid_camera, unlit_scene
from shackled import Mesh, Scene
from shackled.base.checks import Floats

SIDE = 16
#: Left, top, right and bottom border in pixels.
BORDERS = (2.25, 3.75, 12.75, 9.25)


@pytest.fixture
def square() -> Scene:
    try:
        opengl.context()
    except opengl.Unavailable as error:
        pytest.skip(str(error))
    left, top, right, bottom = (256 * each for each in BORDERS)
    corners = on_pixel_grid([(left, top), (left, bottom), (right, bottom), (right, top)], SIDE, SIDE)
    return unlit_scene(Mesh(corners, [(0, 1, 2), (0, 2, 3)], "white"), pixel_grid_camera(SIDE), SIDE)


def area() -> Floats:
    """(H, W): how much of each pixel the square covers."""
    left, top, right, bottom = BORDERS
    across, down = (
        np.clip(np.minimum(np.arange(SIDE) + 1, high) - np.maximum(np.arange(SIDE), low), 0, 1)
        for low, high in ((left, right), (top, bottom))
    )
    return np.outer(down, across)


def test_the_truth_is_the_covered_area(square: Scene) -> None:
    truth = quality.true_picture(square)
    np.testing.assert_allclose(truth.pixels, np.repeat(255 * area()[..., None], 3, axis=2), atol=1e-6)
    # the diagonal, on which both triangles show the same, is none
    assert (truth.edges == ((area() > 0) & (area() < 1))).all()


def test_each_picture_has_its_samples(square: Scene) -> None:
    plain, antialiased, multisampled, sixteen = (each[..., 0] / 255 for each in quality.judged_pictures(square))
    assert set(np.unique(plain)) == {0, 1}
    # borders at quarters of a pixel are exact in 4 x 4 samples, and in four of which no two share a row or a column
    sides = area() * 4 == np.rint(area() * 4)
    np.testing.assert_allclose(sixteen, area(), atol=0.002)
    for each in (antialiased, multisampled):
        np.testing.assert_allclose(each[sides], area()[sides], atol=0.002)


def test_errors_and_flip_are_those_of_the_pictures(square: Scene) -> None:
    pytest.importorskip("flip_evaluator")
    errors, flips = quality.judge(square)
    edges = (area() > 0) & (area() < 1)
    assert errors["edges"].shape == (edges.sum(), 4)
    # the square stands alone
    assert (errors["silhouettes"] == errors["edges"]).all()
    # centres are covered where more than half of the pixel is
    np.testing.assert_allclose(errors["edges"][:, 0], 255 * np.abs(np.rint(area()) - area())[edges], atol=1e-6)
    assert errors["edges"][:, 3].max() < 1
    assert flips[0] > flips[1] > flips[3] >= 0


def test_the_documentation_has_the_last_run() -> None:
    assert quality.table(quality.recorded()) in antialiasing.PAGE.read_text("utf-8"), "run python -m benchmarks.quality"


@pytest.mark.parametrize("group", quality.recorded())
def test_edges_are_as_good_as_those_of_opengl(group: str) -> None:
    for what in (*quality.KINDS, "FLIP"):
        plain, antialiased, multisampled, sixteen = quality.recorded()[group][what].values()
        assert sixteen < antialiased < 0.6 * plain
        assert antialiased < 1.1 * multisampled
