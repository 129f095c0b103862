"""Colours where their numbers are near a bound, against the judge."""

from __future__ import annotations

import numpy as np

import judge
from judge.verdict import MANY
from pictures import call_data, draw
from shackled import Camera, Light, Material, Mesh, Object, Scene, load


def test_faces_that_a_lamp_and_the_eye_meet_at_small_angles() -> None:
    """The walls of the box, along which a pixel is a long way."""
    verdict = judge.judge("box", load("cornell-box"))
    assert verdict.faults == []
    assert verdict.interior > 0
    assert verdict.worst <= MANY


def test_colors_next_to_black_and_white_do_not_wrap() -> None:
    """Channels that are 0 along an edge of a bright triangle stay near 0 there, and those that are 255 near 255."""
    rng = np.random.default_rng(5)
    triangles = list(np.rint(rng.uniform(-1000, 1000, (80, 3, 3)) * [1, 1, 2]))
    triangles.append(np.array([[929.0, 489.0, -681.0], [-589.0, 438.0, 674.0], [153.0, 83.0, -898.0]]))
    colors, normals = [[0, 0, 255], [255, 0, 0], [0, 255, 255]], [[0.1, 0.1, 1], [0, -0.1, 1], [0.1, -0.1, 1]]
    for shading in ("smooth", "flat", "unlit"):
        material = Material(shading, ambient=0.8, diffuse=0.8, specular=0)
        for corners in triangles:
            thing = Object(Mesh(corners, [[0, 1, 2]], colors, normals), (0, 0, -5000), material=material, cull=False)
            scene = Scene([thing], Camera(near=1), [Light("directional", (0, 0, 1))], width=96, height=96)
            expected = judge.render(call_data("render", scene))
            error = np.abs(draw(scene).astype(int) - expected.pixels).max(axis=2)
            assert error.max() <= 40, f"{shading} {corners.tolist()}, at row, column {np.argwhere(error > 40)[0]}"


def test_colors_of_a_far_triangle_do_not_wrap() -> None:
    """Where its depths are so small beside that of the near plane that its weights are rough."""
    corners = [[103303, 101361, -6891344], [-19907, 1838851, 1023926], [-5195858, 25530, 7157482]]
    mesh = Mesh(corners, [[0, 1, 2]], [[255, 0, 0], [0, 255, 0], [0, 0, 255]])
    scene = Scene([Object(mesh, material=Material("unlit"), cull=False)], Camera(near=1), width=32, height=32)
    expected = judge.render(call_data("render", scene))
    error = np.abs(draw(scene).astype(int) - expected.pixels).max(axis=2)
    assert (expected.triangle >= 0).any()
    assert error.max() <= 40
