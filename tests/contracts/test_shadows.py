"""Shadows of one light, and a ground that catches them."""

from __future__ import annotations

from itertools import permutations
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from attrs import evolve

from pictures import draw
from shackled import Camera, Ground, InputError, Light, Material, Mesh, Object, Scene, Tone, load
from shackled.datasets.common import shapes
from shackled.scene._in_range import in_range
from shackled.scene._staging import painted

SIZE = 40


def still_life(**changes: Any) -> Scene:
    """A smooth torus and a flat box on a ground."""
    ring, ball = shapes.torus(across=14, down=7), shapes.sphere(10, 7)
    objects = [
        Object(painted(ring, "#d0803a"), (0, 0.4, 0), material=Material("smooth", specular=0.4)),
        Object(painted(ball, "#4a90d0"), (0.2, 1.1, 0), scale=0.4, material=Material("flat")),
    ]
    scene = Scene(
        objects,
        Camera((3.4, 3.0, 5.0), (0.2, 0.4, 0), half_height=0.33),
        [Light("directional", (-0.6, 1.0, 0.5), (255, 243, 226), shadow=True), Light("point", (3, 2, 4), "#405060")],
        ("#24292f", "#6c7586"),
        width=SIZE,
        height=SIZE,
        ground="#b9b4a8",
    )
    return evolve(scene, **changes)


SUN, LAMP = Light("directional", (-0.6, 1.0, 0.5), shadow=True), Light("point", (2, 3, 2), shadow=True)


def test_a_ground_fades() -> None:
    """It hides the background in its middle only, and nothing of it is left at its radius."""
    floor = Ground("#ffffff", height=0.0, radius=2.0)
    camera = Camera((0, 10, 0.001), (0, 0, 0), half_height=3, projection="orthographic")
    scene = Scene([], camera, [SUN], "#000000", ground=floor, width=61, height=61)
    row = draw(in_range(scene))[30, :, 0].astype(int)
    assert row[30] > 200
    assert (np.diff(row[:31]) >= 0).all()
    assert row[9] == 0 < row[12]


def test_scene_files(tmp_path: Path) -> None:
    scene = still_life(ground=Ground("#b9b4a8", -0.5, 7))
    path = tmp_path / "scene.json"
    path.write_bytes(scene.encode())
    assert load(path) == scene
    assert load(path, shadow=False, ground="none") == evolve(
        scene, ground=None, lights=[evolve(light, shadow=False) for light in scene.lights]
    )


def test_wrong_values() -> None:
    with pytest.raises(InputError, match="one light of a scene may cast shadows"):
        still_life(lights=[SUN, LAMP])
    with pytest.raises(InputError, match="radius of a ground must be above 0"):
        Ground("red", radius=0)
    with pytest.raises(InputError, match="must be 0 <= first < second"):
        Object(Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]), fade=(2, 1))


# ---- where surfaces meet ----


def box(size: tuple[float, float, float], place: tuple[float, float, float] = (0, 0, 0)) -> Object:
    """A gray box with edges of this size."""
    corners = np.sign(shapes.cube().positions) / 2 * size + place
    return Object(Mesh(corners, shapes.cube().faces, "#c8c8c8"), material=Material("flat", 0.2, 0.8, 0.0))


def scene_of(objects: list[Object], light: Light) -> Scene:
    """The objects before black, seen from above."""
    return Scene(objects, Camera((0, 3, 4), (0, 0, 0)), [light], "#000000", width=64, height=64, antialias=True)


@pytest.mark.parametrize("light", [SUN, LAMP], ids=["directional", "point"])
def test_any_order(light: Light) -> None:
    """A later object may hide samples of a fragment that is partly in shadow: the picture is the same in any order."""
    objects = [box((4, 0.4, 4)), box((1, 2, 1), (0, 0.3, 0)), box((0.8, 0.9, 0.7), (0.1, 0.3, 1.0))]
    first, *others = (draw(in_range(scene_of(list(each), light))) for each in permutations(objects))
    assert all((each == first).all() for each in others)


@pytest.mark.parametrize("tone", [Tone(gamma=True), Tone(filmic=True)], ids=["gamma", "filmic"])
def test_the_tone_curve_comes_first(tone: Tone) -> None:
    """Pixels at the edge of a shadow are means of what is displayed, as those at outlines are."""
    light = Light("directional", (0, 1, -1), shadow=True)
    scene = evolve(scene_of([box((60, 0.4, 60)), box((1, 0.2, 1), (0.2, 6, -4.5))], light), tone=tone)
    levels, numbers = np.unique(draw(in_range(scene))[:, :, 0], return_counts=True)
    low, high = levels[numbers > 100].astype(float)
    assert high - low > 40
    near = np.abs(levels[:, None] - np.linspace(low, high, 5)) <= 1
    assert near.any(axis=1).all()
    assert (numbers @ near > 4).all()
