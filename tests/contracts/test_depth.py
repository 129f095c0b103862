"""What is in front is seen."""

from __future__ import annotations

import numpy as np
import pytest
from attrs import evolve

import judge
from pictures import UNLIT, call_data, draw, soup, unlit_scene
from shackled import Camera, Light, Material, Mesh, Object, Scene
from shackled.datasets.common.shapes import joined

RED, GREEN, BLUE = (255, 0, 0), (0, 255, 0), (0, 0, 255)
SQUARE = [[0, 1, 2], [0, 2, 3]]
CAMERAS = {
    "perspective": Camera(near=1),
    "orthographic": Camera(projection="orthographic", half_height=600.0, near=1),
}


def wall(z: float, size: float, color: tuple[int, int, int]) -> Mesh:
    return Mesh(size * np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) + [0, 0, z], SQUARE, color)


@pytest.mark.parametrize("camera", CAMERAS.values(), ids=CAMERAS.keys())
@pytest.mark.parametrize(("far", "near"), [(-1500, -1000), (-1001, -1000), (-30000, -8)])
def test_the_nearer_wins_in_any_order(camera: Camera, far: float, near: float) -> None:
    size = min(-near, 600) // 4 if camera.projection == "perspective" else 100
    behind, before = wall(far, 20000, BLUE), wall(near, size, RED)
    pictures = []
    for meshes in ((behind, before), (before, behind)):
        pictures.append(draw(unlit_scene(joined(*meshes), camera, 40)))
        things = [Object(mesh, material=UNLIT) for mesh in meshes]
        pictures.append(draw(unlit_scene(things, camera, 40)))
    assert all((picture == pictures[0]).all() for picture in pictures)
    assert (pictures[0][20, 20] == RED).all()
    assert (pictures[0][0, 0] == BLUE).all()


def test_orthographic_depth_behind_the_eye() -> None:
    """An orthographic camera may see what is behind its eye; the order there goes on."""
    camera = evolve(CAMERAS["orthographic"], near=-5000)
    scene = unlit_scene(
        [Object(wall(z, 300, c), material=UNLIT) for z, c in ((900, RED), (-900, BLUE), (2000, GREEN))], camera, 16
    )
    assert (draw(scene)[8, 8] == GREEN).all()
    assert (draw(evolve(scene, objects=scene.objects[:2]))[8, 8] == RED).all()


@pytest.mark.parametrize("camera", CAMERAS.values(), ids=CAMERAS.keys())
def test_of_two_coplanar_triangles_the_first_wins(camera: Camera) -> None:
    rng = np.random.default_rng(2)
    for _ in range(10):
        points = np.rint(rng.uniform(-900, 900, (3, 3)) + np.array([0, 0, -2500]))
        first, second = soup(points, RED), soup(points, GREEN)
        alone = draw(unlit_scene(first, camera, 32))
        assert (draw(unlit_scene(joined(first, second), camera, 32)) == alone).all()
        things = [Object(mesh, material=UNLIT, cull=False) for mesh in (first, second)]
        assert (draw(unlit_scene(things, camera, 32)) == alone).all()


@pytest.mark.parametrize("distance", [10.0, 1000.0, 30000.0])
def test_depths_a_thousandth_apart(distance: float) -> None:
    """With the near plane at a thousandth of the distance."""
    walls = wall(-1000, 300, RED), wall(-1001, 400, BLUE)
    things = [Object(mesh, scale=distance / 1000, material=UNLIT) for mesh in walls]
    scene: Scene = unlit_scene(things, Camera(near=distance / 1000), 32)
    picture = draw(scene)
    assert (picture[16, 16] == RED).all()
    assert (picture == draw(evolve(scene, objects=things[::-1]))).all()


@pytest.mark.slow
def test_a_face_whose_depths_differ_by_more_than_their_precision() -> None:
    """One corner is at a distance of 2^-10, the others at 2^22; a wall at 2^21 is in front of the far edge."""
    rng = np.random.default_rng(11)
    size, near, far = 32, 2.0**-10, 2.0**22
    camera = Camera(half_height=1.0, near=2.0**-12)
    plane = Object(wall(0, 1024, BLUE), (0, 0, -(2.0**21)), scale=2.0**12, material=UNLIT)
    seen = 0
    for _ in range(200):
        # on centres of pixels, so that these are on the edges
        screen = (rng.integers(0, size, (3, 2)) + 0.5) * 2 / size - 1
        points = np.column_stack([screen, -np.ones(3)])
        place = np.rint(near * points[0] * 2**32) / 2**32
        corners = np.rint((far * points - place) * 2)
        corners[0] = 0
        face = Object(soup([np.clip(corners, -(2**23), 2**23 - 1)], RED), place, scale=0.5, material=UNLIT, cull=False)
        expected = judge.render(call_data("render", unlit_scene([face, plane], camera, size))).pixels
        for objects in ([face, plane], [plane, face]):
            picture = draw(unlit_scene(objects, camera, size))
            assert (picture == expected).all(), np.argwhere((picture != expected).any(axis=2))
            seen += int((picture == RED).all(axis=2).sum())
    assert seen > 1000


@pytest.mark.parametrize("camera", CAMERAS.values(), ids=CAMERAS.keys())
@pytest.mark.parametrize("towards", [1, -1])
def test_of_surfaces_that_coincide_the_first_stays(camera: Camera, towards: int) -> None:
    """Both sides of a tilted wall are faces, of which one is black and the other has light and highlights."""
    corners = np.array([[-900, -700, -500], [800, -600, -1700], [700, 900, -1900], [-600, 700, -800]])
    sun = Light("directional", (0.3, 0.2, towards))
    shiny = Material("flat", ambient=0.0, diffuse=0.8, specular=0.4, shininess=30)

    def picture(faces: list[list[int]]) -> np.ndarray:
        mesh = Mesh(corners, faces, [[250, 200, 150]] * 4)
        return draw(Scene([Object(mesh, material=shiny, cull=False)], camera, [sun], width=96, height=96))

    front, back = [[0, 1, 2], [0, 2, 3]], [[2, 1, 0], [3, 2, 0]]
    alone = picture(front)
    assert (picture(front + back) == alone).all()
    assert (picture(back) != alone).any()
