"""Geometry of any size and place: behind the eye, through its plane, huge, degenerate, exactly on a border."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import pairwise

import numpy as np
import pytest
from attrs import evolve
from numpy.typing import NDArray

import judge
from pictures import UNLIT, call_data, counts, covered, draw, on_pixel_grid, pixel_grid_camera, soup, unlit_scene
from shackled import Camera, Light, Material, Mesh, Object, Scene
from shackled.scene import vertex_normals
from shackled.scene._object import Shading

Array = NDArray[np.float64]


def through_the_eye_plane(shading: Shading) -> Iterator[Scene]:
    """Triangles of which a part is behind the eye and a part may be seen."""
    rng = np.random.default_rng(1)
    material = Material(shading, 0.3, 0.7, 0.3, 10)
    for _ in range(60):
        mesh = colored(rng, np.rint(rng.uniform(-1000, 1000, (1, 3, 3))))
        things = [Object(mesh, material=material, cull=False)]
        yield Scene(things, Camera(near=5), [Light("directional", (1, 2, 3))], width=40, height=40)


def huge(exponent: int) -> Iterator[Scene]:
    """Triangles about 2^exponent units large, of which a corner is before the eye."""
    rng = np.random.default_rng(3)
    for _ in range(25):
        corners = rng.uniform(-1, 1, (1, 3, 3)) * (2**exponent - 1)
        corners[0, 0] = [*corners[0, 0, :2] / 50, -abs(corners[0, 0, 2]) - 100]
        yield unlit_scene(colored(rng, np.rint(corners)), Camera(near=1), 32)


def colored(rng: np.random.Generator, corners: Array) -> Mesh:
    mesh = soup(corners)
    positions, faces = mesh.positions, mesh.faces
    return Mesh(positions, faces, rng.integers(0, 256, (3, 3)), vertex_normals(positions, faces))


CLIPPED: dict[str, Callable[[], Iterator[Scene]]] = {
    "through the plane of the eye, unlit": lambda: through_the_eye_plane("unlit"),
    "through the plane of the eye, flat": lambda: through_the_eye_plane("flat"),
    "through the plane of the eye, smooth": lambda: through_the_eye_plane("smooth"),
    "2^13 units large": lambda: huge(13),
    "2^18 units large": lambda: huge(18),
    "2^23 units large": lambda: huge(23),
}


@pytest.mark.parametrize("name", CLIPPED)
def test_clipped_triangles_cover_what_they_should(name: str) -> None:
    different, total = 0, 0
    for scene in CLIPPED[name]():
        expected = judge.render(call_data("render", scene)).triangle >= 0
        found = covered(scene)
        different += int((found != expected).sum())
        total += int(expected.sum())
        # the cut may move an edge across the centre of a pixel, but no farther
        grown = np.pad(expected, 1)
        shifted = np.array(
            [grown[y : y + len(expected), x : x + expected.shape[1]] for y in range(3) for x in range(3)]
        )
        assert not (found & ~shifted.any(axis=0)).any()
        assert not (~found & shifted.all(axis=0)).any()
    assert total > 2000
    assert different <= total / 1000


@pytest.mark.parametrize("name", CLIPPED)
def test_clipped_triangles_have_the_right_colors(name: str) -> None:
    errors = []
    for scene in CLIPPED[name]():
        expected = judge.render(call_data("render", scene))
        seen = (expected.triangle >= 0) & covered(scene)
        errors.append(np.abs(draw(scene).astype(int) - expected.pixels)[seen])
    error = np.concatenate(errors)
    assert error.mean() <= 0.6
    assert (error.max(axis=1) <= 4).mean() >= 0.999, f"up to {error.max()} levels off"


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


@pytest.mark.parametrize("projection", ["perspective", "orthographic"])
def test_the_near_plane_cuts_where_it_is(projection: str) -> None:
    """A floor that begins at the near plane, whose distance says in which row."""
    half_height = 0.5 if projection == "perspective" else 20.0
    camera = Camera(projection=projection, half_height=half_height, near=200)
    floor = [
        [[-9000, -20, 9000], [9000, -20, 9000], [9000, -20, -9000]],
        [[-9000, -20, 9000], [9000, -20, -9000], [-9000, -20, -9000]],
    ]
    if projection == "orthographic":
        # a slope instead: 1 down for 10 away
        floor = [
            [[-300, 10, 100], [300, 10, 100], [300, -60, -600]],
            [[-300, 10, 100], [300, -60, -600], [-300, -60, -600]],
        ]
    rows = covered(unlit_scene(soup(floor), camera, 100)).any(axis=1)
    if projection == "perspective":
        # y / z = -20 / 200 at the plane, of half a height of 0.5: 10 of 50 rows below the middle
        assert rows.tolist() == [False] * 50 + [True] * 10 + [False] * 40
    else:
        # y = -20 at the plane is the lower border: nothing of the slope is left
        assert not rows.any()
        assert (
            covered(unlit_scene(soup(floor), evolve(camera, near=100), 100)).any(axis=1).tolist()
            == [False] * 75 + [True] * 25
        )


def test_a_huge_triangle_over_everything() -> None:
    far = 2**23 - 1
    corners = [[[-far, -far, -1000], [far, -far, -1000], [0, far, -1000]]]
    for camera in (Camera(near=1), Camera(projection="orthographic", half_height=100.0, near=1)):
        scene = unlit_scene(
            [Object(soup(corners, (10, 200, 30)), scale=4.0, position=(0, 0, 3000), material=UNLIT)], camera, 33, 21
        )
        assert (draw(scene) == (10, 200, 30)).all()
        assert counts(scene) == (1, 33 * 21)


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


def test_no_size() -> None:
    thing = Object(soup([[[-5, -5, 0], [5, -5, 0], [0, 5, 0]]]), (0, 0, -20), scale=0.0, material=UNLIT)
    assert counts(unlit_scene([thing], Camera(near=1), 20)) == (0, 0)


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


def test_each_border_of_the_guard_band_cuts() -> None:
    """A square around the picture that reaches beyond one border or more."""
    size = 16
    for left in (-1000, -5000):
        for right in (1000, 9000):
            for top in (-1200, -3000):
                for bottom in (1500, 4000):
                    corners = 256 * np.array([[left, top], [left, bottom], [right, bottom], [right, top]])
                    points = on_pixel_grid(corners, size, size)
                    mesh = Mesh(points, [[0, 1, 2], [0, 2, 3]], [[7, 8, 9]] * 4)
                    for camera, scene_mesh in ((pixel_grid_camera(size), mesh), (Camera(near=1), away(mesh, size))):
                        assert (draw(unlit_scene(scene_mesh, camera, size)) == (7, 8, 9)).all()


def away(mesh: Mesh, size: int) -> Mesh:
    """The mesh at a distance where a pixel of the default perspective camera is about 256 units."""
    return evolve(mesh, positions=mesh.positions * [1, 1, 0] - [0, 0, round(128 * size * 2.145)])


def test_clipping_keeps_colors_where_they_are() -> None:
    """A floor coloured by its distance: whatever is cut off, the colour at a pixel stays."""
    near = [[-500, -50, -50], [500, -50, -50], [500, -50, -2000], [-500, -50, -2000]]
    behind = [[-500, -50, 1900], [500, -50, 1900], [500, -50, -2000], [-500, -50, -2000]]
    # red falls from the near edge to the far one in proportion to z: 0 at -2000, 100 at -50, 200 at 1900
    colors = [[100, 0, 0], [100, 0, 0], [0, 0, 0], [0, 0, 0]]
    faces = [[0, 1, 2], [0, 2, 3]]
    camera = Camera(near=10, half_height=1.0)
    first = draw(unlit_scene(Mesh(near, faces, colors), camera, 50)).astype(int)
    second = draw(unlit_scene(Mesh(behind, faces, np.array(colors) * 2), camera, 50)).astype(int)
    mask = covered(unlit_scene(Mesh(near, faces, colors), camera, 50))
    assert mask.sum() > 500
    assert np.abs(first - second)[mask].max() <= 4
    assert np.abs(first - second)[mask].mean() <= 0.6
