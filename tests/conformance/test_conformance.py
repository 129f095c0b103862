"""The part of `make conformance` that is quick enough for every run of the tests, and what it rests on."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from attrs import evolve

from judge import Verdict, render
from judge.verdict import LEAST_RUN, MOST
from made_scenes import flat, teapot_scene
from pictures import call_data
from random_scenes import random_scene
from shackled import Material, Mesh, Object, Scene
from shackled.datasets._pieces import require
from shackled.scene._in_range import in_range
from shackled.scene._look import resize

from . import compare as comparison
from . import opengl
from .__main__ import SIZES
from .compare import Drawing, compare, interior, picture
from .world import before_camera

SEEDS = range(200, 240)
PIECES = (
    "teapot",
    "cornell-box",
    "icons/ethereum",
    "icons/shackle",
    "genesis/5",
    "genesis/63",
    "genesis/100",
    "genesis/1011",
)


@pytest.fixture(autouse=True)
def _opengl() -> None:
    try:
        opengl.context()
    except opengl.Unavailable as error:
        pytest.skip(str(error))


def test_random_scenes() -> None:
    found = [compare(f"random scene {seed}", random_scene("plain", seed)) for seed in SEEDS]
    whole = sum(found, Verdict())
    assert whole.faults + whole.faults_of_run() == []
    assert whole.interior > LEAST_RUN
    assert sum(each.lit == 0 for each in found) < len(SEEDS) / 5


@pytest.mark.parametrize("name", PIECES)
def test_built_in_pieces(name: str) -> None:
    for size in SIZES:
        assert compare(f"{name} at {size}", resize(require(name).make(), (size, size)), is_piece=True).faults == []


@pytest.mark.parametrize("scene", [teapot_scene(4), flat(teapot_scene(3, 1))], ids=["smooth", "flat"])
def test_opengl_and_the_judge_agree(scene: Scene) -> None:
    """Two programs that share nothing with the contracts, but the formula."""
    scene = evolve(scene, width=256, height=256)
    theirs, exact = opengl.draw(before_camera(scene)), render(call_data("render", in_range(scene)))
    assert (theirs.triangle != exact.triangle).mean() < 0.001
    same = interior(theirs.triangle) & (theirs.triangle == exact.triangle)
    assert same.sum() > 500
    # the contracts' grid of the mesh is between them
    assert np.abs(theirs.color - exact.exact)[same].max() < 0.25


# ---- it finds what is wrong ----


def brighter(scene: Scene) -> Scene:
    return evolve(scene, ambient_light=(255, 255, 255), lights=[])


def moved(scene: Scene) -> Scene:
    """By a tenth of a pixel."""
    way = np.array([0.1 * 9.0 * scene.camera.half_height / 64, 0, 0])
    return evolve(scene, objects=[evolve(o, position=o.position + way) for o in scene.objects])


@pytest.mark.parametrize(
    ("change", "words"),
    [(brighter, f"off by more than {MOST:g} levels; pixel ("), (moved, "show a wrong triangle; pixel (")],
)
def test_another_scene_is_found(monkeypatch: pytest.MonkeyPatch, change: Callable[[Scene], Scene], words: str) -> None:
    """If the contracts draw it."""
    scene = flat(teapot_scene(2))
    other = picture(change(scene))
    monkeypatch.setattr(comparison, "picture", lambda _: other)
    assert any(words in fault for fault in compare("teapot", scene).faults)


def test_one_wrong_pixel_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = flat(teapot_scene(2))
    right = picture(scene)
    row, column = np.argwhere(interior(right.triangle))[7]
    pixels = right.pixels.copy()
    pixels[row, column] ^= 16
    monkeypatch.setattr(comparison, "picture", lambda _: Drawing(pixels, right.triangle))
    assert [f"pixel ({column}, {row})" in fault for fault in compare("teapot", scene).faults] == [True]


SQUARE = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]


def squares(*depths: float) -> Scene:
    """Squares one behind the other, at these distances nearer than the origin, of two triangles each."""
    look = Material("unlit")
    objects = [Object(Mesh(SQUARE, [[0, 1, 2], [0, 2, 3]]), (0, 0, z), material=look, cull=False) for z in depths]
    camera = evolve(teapot_scene().camera, eye=(0, 0, 10), target=(0, 0, 0), half_height=0.2)
    return Scene(objects, camera, width=64, height=64)


def test_what_a_pixel_may_show() -> None:
    # 32 pixels to a unit of the world at a distance of 10, so the square of 2 units is 64 / 2 pixels wide
    judged = render(call_data("render", in_range(squares(0.0, 1.0))))
    # in the middle of a half: the nearer of the two; its number is 2 or 3
    assert judged.may_show(36, 30).tolist() == [2]
    assert judged.may_show(28, 34).tolist() == [3]
    assert judged.may_show(0, 0).tolist() == [-1]
    # on the diagonal that both halves share
    assert judged.may_show(31, 32).tolist() == [2, 3]
    # at equal depth any
    assert render(call_data("render", in_range(squares(0.0, 0.0)))).may_show(36, 30).tolist() == [0, 2]
