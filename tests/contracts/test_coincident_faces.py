"""Two faces in the same place: the one that is turned to the eye is seen, and hides the one that is turned away."""

from __future__ import annotations

from typing import Any, get_args

import numpy as np
import pytest
from attrs import evolve
from numpy.typing import NDArray

from pictures import draw
from shackled import Camera, Light, Material, Mesh, Object, Scene, Tone
from shackled.scene._codec import Rectangle
from shackled.scene._fields import Shading
from shackled.scene._in_range import in_range

Array = NDArray[np.float64]
Rng = np.random.Generator

#: The side that faces +z, and the other.
FRONT, BACK = (255, 0, 0), (0, 0, 255)
SIZE = 40


def plane(rng: Rng, n: int, color: tuple[int, int, int], shading: Shading) -> Object:
    """A square of n x n squares, each cut along one of its diagonals. That of BACK faces -z."""
    positions = [(x / n - 0.5, y / n - 0.5, 0) for y in range(n + 1) for x in range(n + 1)]
    faces = []
    for y, x in np.ndindex(n, n):
        a = y * (n + 1) + x
        b, c, d = a + 1, a + n + 1, a + n + 2
        faces += [(a, b, d), (a, d, c)] if rng.random() < 0.5 else [(a, b, c), (b, d, c)]
    way = 1 if color == FRONT else -1
    mesh = Mesh(positions, np.array(faces)[:, ::way], color, [(0, 0, way)] * len(positions))
    return Object(mesh, material=Material(shading, ambient=1.0, diffuse=0.0, specular=0.0), cull=False)


def two_sides(rng: Rng, shading: Shading, order: int, **more: Any) -> tuple[Scene, int]:
    """Both planes, seen from anywhere, and the channel that is seen: 0 for FRONT, 2 for BACK."""
    n = int(rng.integers(1, 5))
    objects = [plane(rng, n, color, shading) for color in (FRONT, BACK)]
    toward = rng.normal(size=3)
    toward /= np.linalg.norm(toward)
    camera = Camera(toward * rng.uniform(1, 3), (0, 0, 0), np.eye(3)[np.argmin(np.abs(toward))], half_height=0.4)
    light = Light("directional", (0, 0, 1))
    scene = Scene(objects[::order], camera, [light], "#000000", width=SIZE, height=SIZE, **more)
    return scene, 0 if toward[2] > 0 else 2


def assert_one_side(scene: Scene, channel: int) -> NDArray[np.uint8]:
    """Nothing of the other side is seen."""
    picture = draw(in_range(scene))
    assert picture[:, :, channel].any()
    assert not picture[:, :, 2 - channel].any()
    return picture


@pytest.mark.parametrize("order", [1, -1])
@pytest.mark.parametrize("projection", ["perspective", "orthographic"])
@pytest.mark.parametrize("antialias", [False, True])
@pytest.mark.parametrize("shading", get_args(Shading))
def test_any_way(shading: Shading, antialias: bool, projection: Any, order: int) -> None:
    """In any order, projection and triangulation; with a tone curve other contracts draw."""
    for seed in range(12):
        tone = Tone(gamma=True) if seed % 3 == 0 else None
        scene, channel = two_sides(np.random.default_rng([1, seed]), shading, order, antialias=antialias, tone=tone)
        half_height = 0.4 if projection == "perspective" else 0.8
        camera = evolve(scene.camera, projection=projection, half_height=half_height)
        assert_one_side(evolve(scene, camera=camera), channel)


@pytest.mark.parametrize("antialias", [False, True])
@pytest.mark.parametrize("order", [1, -1])
def test_cut_by_the_near_plane(order: int, antialias: bool) -> None:
    """A part of the planes is nearer than the near plane; and a tile is that part of the whole."""
    cut, tile = 0, Rectangle(7, 11, 22, 17)
    for seed in range(12):
        rng = np.random.default_rng([3, seed])
        scene, channel = two_sides(rng, get_args(Shading)[seed % 3], order, antialias=antialias)
        near = evolve(scene, camera=evolve(scene.camera, near=float(np.linalg.norm(scene.camera.eye))))
        picture = assert_one_side(near, channel)
        rows, columns = (slice(tile.y, tile.y + tile.height), slice(tile.x, tile.x + tile.width))
        assert (draw(in_range(near), tile) == picture[rows, columns]).all()
        cut += (picture != draw(in_range(scene))).any()
    assert cut > 6


def test_culled_faces_are_not_there() -> None:
    """Only one side is left, whichever plane is culled."""
    for seed in range(6):
        scene, channel = two_sides(np.random.default_rng([4, seed]), "flat", 1)
        culled = evolve(scene, objects=[evolve(o, cull=True) for o in scene.objects])
        assert (draw(in_range(scene)) == assert_one_side(culled, channel)).all()
