"""The contracts' colours, against the judge: see accuracy.py."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from attrs import evolve
from benchmarks.shared import FOLDER

import judge
from accuracy import (
    LEVELS,
    MEAN_BOUND,
    SHARE_WITHIN,
    Accuracy,
    interior,
    made_scenes,
    measure,
    scenes_of_the_original,
    smooth,
    solid,
    unlit,
)
from pictures import call_data, draw
from random_scenes import Kind, plain, random_case
from shackled import Camera, ChainError, Light, Material, Mesh, Object, Scene, load

ORIGINAL, MADE = scenes_of_the_original(), made_scenes()


def check(accuracy: Accuracy) -> None:
    assert accuracy.pixels > 0
    assert accuracy.mean <= MEAN_BOUND
    assert accuracy.within >= SHARE_WITHIN, f"up to {accuracy.worst} levels off"


@pytest.mark.parametrize("name", MADE)
def test_scenes_made_by_hand(name: str) -> None:
    check(measure(MADE[name]()))


@pytest.mark.parametrize("name", ORIGINAL)
def test_scenes_of_the_original(name: str) -> None:
    check(measure(ORIGINAL[name]()))


@pytest.mark.parametrize("change", [solid, smooth, unlit])
def test_models_of_the_original(change: Callable[[Scene], Scene]) -> None:
    paths = sorted(FOLDER.glob("obj_*.json"))
    if not paths:
        pytest.skip(f"there are no scenes of the original in {FOLDER}: set SHACKLED_SHARED")
    for path in paths:
        check(measure(change(load(path))))


def test_faces_that_a_lamp_and_the_eye_meet_at_small_angles() -> None:
    """The walls of the box, along which a pixel is a long way."""
    accuracy = measure(load("cornell-box"))
    check(accuracy)
    assert accuracy.worst <= LEVELS


@pytest.mark.parametrize(("kind", "seeds"), [("tame", range(200)), ("close", range(100))])
def test_random_scenes_together(kind: Kind, seeds: range) -> None:
    """All pixels of many small pictures taken together."""
    errors = [np.empty((0, 3))]
    for seed in seeds:
        scene = plain(random_case(seed, (kind,)).scene)
        scene = evolve(scene, objects=[evolve(o, wireframe=False) for o in scene.objects])
        try:
            pixels = draw(scene)
        except ChainError:
            continue
        expected = judge.render(call_data("render", scene))
        errors.append(np.abs(pixels.astype(int) - expected.pixels)[interior(expected)])
    error = np.concatenate(errors)
    assert len(error) > 5000
    assert error.mean() <= MEAN_BOUND
    assert (error.max(axis=1) <= LEVELS).mean() >= SHARE_WITHIN


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
