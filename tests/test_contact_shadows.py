"""Shadows where surfaces meet: each visible sample is lit or dark by itself, in any order of the objects."""

from __future__ import annotations

from itertools import permutations

import numpy as np
import pytest
from attrs import evolve

from judge import judge, random_scene
from pictures import draw
from shackled import Camera, Light, Material, Mesh, Object, Scene, Tone
from shackled.datasets.common.shapes import sphere
from shackled.scene import Rectangle, fit

MATTE = Material("flat", 0.2, 0.8, 0.0)
SUN = Light("directional", (0, 1, -1), shadow=True)
LAMP = Light("point", (0.5, 2.5, -2.5), shadow=True)
GRAY = (200, 200, 200)


def box(size: tuple[float, float, float], place: tuple[float, float, float] = (0, 0, 0)) -> Object:
    """A gray box with edges of this size."""
    unit = (np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)) / 2
    faces = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1)]
    faces += [(2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]
    return Object(Mesh(unit * size + place, faces, GRAY), material=MATTE)


BALL = Object(Mesh(sphere(15, 9).positions, sphere(15, 9).faces, GRAY), (0, 0.1, 0), scale=0.7, material=MATTE)
#: It is opaque as far as one sees.
GROUND = Object(
    Mesh([(-40, 0, -40), (-40, 0, 40), (40, 0, 40), (40, 0, -40)], [(0, 1, 2), (0, 2, 3)], GRAY),
    material=MATTE,
    fade=(30, 40),
)
PLATE, BLOCK, CROSSING = box((4, 0.4, 4)), box((1, 2, 1), (0, 0.3, 0)), box((0.8, 0.9, 0.7), (0.1, 0.3, 1.0))


def scene_of(objects: list[Object], light: Light = SUN) -> Scene:
    """The objects before black, seen from above."""
    return Scene(objects, Camera((0, 3, 4), (0, 0, 0)), [light], "#000000", width=64, height=64, antialias=True)


@pytest.mark.parametrize("objects", [[PLATE, BALL], [BALL, PLATE], [BALL, GROUND]], ids=["last", "first", "ground"])
def test_a_ball(objects: list[Object]) -> None:
    """Interior pixels, edges and the line where it enters."""
    assert judge("ball", scene_of(objects)).faults == []


@pytest.mark.parametrize("light", [SUN, LAMP], ids=["directional", "point"])
def test_any_order(light: Light) -> None:
    """A later object may hide samples of a fragment that is partly in shadow: the picture is the same in any order."""
    scenes = [scene_of(list(each), light) for each in permutations([PLATE, BLOCK, CROSSING])]
    pictures = [draw(fit(scene)) for scene in scenes]
    assert all((each == pictures[0]).all() for each in pictures[1:])
    assert judge("three", scenes[0]).faults == []


@pytest.mark.parametrize("tone", [Tone(gamma=True), Tone(filmic=True)], ids=["gamma", "filmic"])
def test_the_tone_curve_comes_first(tone: Tone) -> None:
    """Pixels at the edge of a shadow are means of what is displayed, as those at outlines are."""
    scene = evolve(scene_of([box((60, 0.4, 60)), box((1, 0.2, 1), (0.2, 6, -4.5))]), tone=tone)
    levels, numbers = np.unique(draw(fit(scene))[:, :, 0], return_counts=True)
    low, high = levels[numbers > 100].astype(float)
    assert high - low > 40
    means = np.linspace(low, high, 5)
    near = np.abs(levels[:, None] - means) <= 1
    assert near.any(axis=1).all()
    assert (numbers @ near > 4).all()


@pytest.mark.parametrize("seed", range(6))
def test_tiles(seed: int) -> None:
    scene = fit(evolve(random_scene("shadows", seed), antialias=True, width=32, height=32))
    assert (draw(scene, Rectangle(5, 9, 19, 13)) == draw(scene)[9:22, 5:24]).all()
