"""Geometry behind the eye, degenerate, or exactly on a border; the judge sees what is clipped in random scenes."""

from __future__ import annotations

from itertools import pairwise, product

import numpy as np
import pytest
from attrs import evolve
from numpy.typing import NDArray

from pictures import counts, covered, draw, on_pixel_grid, pixel_grid_camera, soup, unlit_scene
from shackled import Camera, Light, Material, Mesh, Object, Scene

Array = NDArray[np.float64]


def test_what_is_behind_the_eye_is_not_drawn() -> None:
    rng = np.random.default_rng(2)
    corners = np.rint(rng.uniform(-1000, 1000, (50, 3, 3)))
    corners[..., 2] = np.abs(corners[..., 2])
    scene = unlit_scene(soup(corners), Camera(near=1), 30)
    assert counts(scene) == (0, 0)
    assert not draw(scene).any()


def test_what_is_nearer_than_the_near_plane_is_not_drawn() -> None:
    square = [[[-50, -50, -100], [50, -50, -100], [0, 50, -100]]]
    for camera in (Camera(near=100), Camera(projection="orthographic", half_height=100.0, near=100)):
        assert covered(unlit_scene(soup(square), camera, 20)).any()
        assert not covered(unlit_scene(soup(square), evolve(camera, near=100 + 2**-20), 20)).any()


@pytest.mark.parametrize(
    ("camera", "corners", "rows"),
    [
        # a floor: y / z = -20 / 200 at the plane, of half a height of 0.5: 10 of 50 rows below the middle
        (Camera(half_height=0.5, near=200), [(-9000, -20, 9000), (9000, -20, 9000), (9000, -20, -9000)], range(50, 60)),
        # a slope, 1 down for 10 away: y = -20 at the plane is the lower border, or y = -10 a quarter above it
        (
            Camera(projection="orthographic", half_height=20, near=200),
            [(-300, 10, 100), (300, 10, 100), (300, -60, -600)],
            range(0),
        ),
        (
            Camera(projection="orthographic", half_height=20, near=100),
            [(-300, 10, 100), (300, 10, 100), (300, -60, -600)],
            range(75, 100),
        ),
    ],
)
def test_the_near_plane_cuts_where_it_is(camera: Camera, corners: list[tuple[int, int, int]], rows: range) -> None:
    """What begins at the near plane, whose distance says in which row."""
    a, b, c = np.array(corners)
    floor = soup([[a, b, c], [a, c, a + c - b]])
    assert np.flatnonzero(covered(unlit_scene(floor, camera, 100)).any(axis=1)).tolist() == list(rows)


def degenerate_meshes() -> dict[str, Mesh]:
    point, line = [[5, 5, -100]] * 3, [[-5, -5, -100], [0, 0, -100], [5, 5, -100]]
    corners = [[-30, -30, -100], [30, -30, -100], [0, 30, -100]]
    return {
        "all points equal": soup([point]),
        "points on a line": soup([line]),
        "points on a line toward the eye": soup([[[0, 0, -10], [0, 0, -100], [0, 0, -1000]]]),
        "a plane through the eye": soup([[[-10, 0, -100], [10, 0, -100], [0, 0, -1000]]]),
        "one index three times": Mesh(corners, [[1, 1, 1]]),
        "one index twice": Mesh(corners, [[0, 1, 1], [0, 0, 2], [2, 1, 2]]),
        "at the eye": soup([[[0, 0, 0]] * 3]),
        "through the eye": soup([[[0, 0, 0], [0, 0, -100], [0, 0, 50]]]),
        "a line to far below and beside the picture": soup(
            [[[0, 0, -100], [-3000, -6000, -100], [-3000, -6000, -100]]]
        ),
    }


@pytest.mark.parametrize("name", degenerate_meshes())
@pytest.mark.parametrize("shading", ["unlit", "flat", "smooth"])
@pytest.mark.parametrize("wireframe", [False, True])
def test_degenerate_triangles_are_not_drawn(name: str, shading: str, wireframe: bool) -> None:
    material = Material(shading, 0.2, 0.7, 0.5, 10)
    thing = Object(degenerate_meshes()[name], material=material, cull=False, wireframe=wireframe)
    lights = [Light("point", (10, 20, 30)), Light("directional", (1, 1, 1))]
    for camera in (Camera(near=1), Camera(projection="orthographic", half_height=40.0, near=1)):
        scene = Scene([thing], camera, lights, width=24, height=24)
        if "plane through" in name and camera.projection == "orthographic":
            continue
        assert counts(scene) == (0, 0)


def test_corners_on_the_near_plane() -> None:
    """They are inside: nothing is cut off."""
    corners = [[[-40, -30, -100], [40, -30, -100], [0, 50, -100]], [[-40, -30, -100], [40, -30, -200], [0, 50, -300]]]
    for triangle in corners:
        at, within = (draw(unlit_scene(soup([triangle]), Camera(near=near), 40)) for near in (100, 50))
        assert (at == within).all()
        assert at.any()


def test_corners_on_the_borders_of_the_guard_band() -> None:
    """From pixel -1536 to pixel 2560: on the border, and one step within and beyond it, the picture is the same."""
    size = 20
    low, high = -1536 * 256 + 128, 2560 * 256 + 128
    pictures = []
    for step in (-2, -1, 0, 1, 2):
        outer = np.array([[low + step, low + step], [low + step, high + step], [high + step, high + step]])
        mesh = soup(on_pixel_grid(outer, size, size), (80, 90, 100))
        pictures.append(draw(unlit_scene(mesh, pixel_grid_camera(size), size)))
    # the diagonal goes through centres of pixels, which belong to the other side
    assert all((a == b).all() for a, b in pairwise(pictures))
    assert (pictures[0] == (80, 90, 100)).all(axis=2).sum() == size * (size - 1) // 2


@pytest.mark.parametrize("far", list(product((-1000, -5000), (1000, 9000), (-1200, -3000), (1500, 4000))))
def test_each_border_of_the_guard_band_cuts(far: tuple[int, int, int, int]) -> None:
    """A square around the picture that reaches beyond one border or more."""
    size, (left, right, top, bottom) = 16, far
    corners = 256 * np.array([[left, top], [left, bottom], [right, bottom], [right, top]])
    mesh = Mesh(on_pixel_grid(corners, size, size), [[0, 1, 2], [0, 2, 3]], (7, 8, 9))
    # at a distance where a pixel of the default perspective camera is about 256 units
    away = evolve(mesh, positions=mesh.positions * [1, 1, 0] - [0, 0, round(128 * size * 2.145)])
    for camera, each in ((pixel_grid_camera(size), mesh), (Camera(near=1), away)):
        assert (draw(unlit_scene(each, camera, size)) == (7, 8, 9)).all()
