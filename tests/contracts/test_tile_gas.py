"""What a picture costs is the work on its canvas, and what a tile costs is the work on the tile."""

from __future__ import annotations

import numpy as np
import pytest
from attrs import evolve

from pictures import call, covered
from random_scenes import random_case
from shackled import Camera, Light, Material, Mesh, Object, Scene, load
from shackled.parallel._tiles import grid
from shackled.scene._codec import Rectangle
from shackled.scene._in_range import in_range

SIZE = 64
LAMP = Light("point", (300, 200, -600))
LOOKS = {
    "unlit": Material("unlit"),
    "flat": Material("flat", 0.3, 0.6, 0.3, 20),
    "smooth": Material("smooth", 0.3, 0.6, 0.3, 20),
}
#: Gas of a pixel of such a wall, at most.
PIXEL = {"unlit": 2_800, "flat": 2_800, "smooth": 3_200}


def gas(scene: Scene, tile: Rectangle | None = None) -> int:
    return call("render" if tile is None else "renderTile", scene, tile).gas


def tilted_walls(rng: np.random.Generator, material: Material, count: int = 1) -> Scene:
    """Walls that cover the whole canvas and reach far beyond it, each turned by up to 70 degrees."""
    square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    objects = []
    for i in range(count):
        axis = rng.normal(size=3) * [1, 1, 0]
        axis *= np.tan(np.radians(rng.uniform(0, 35))) / np.linalg.norm(axis)
        mesh = Mesh(20000 * square, [[0, 1, 2], [0, 2, 3]], rng.integers(0, 256, (4, 3)), [[0, 0, 1]] * 4)
        objects.append(Object(mesh, (0, 0, -3000 + 10 * i), (*axis, 1.0), material=material, cull=False))
    objects = [evolve(o, rotation=tuple(np.rint(o.rotation * 2**32) / 2**32)) for o in objects]
    return Scene(objects, Camera(near=1), [LAMP], width=SIZE, height=SIZE)


@pytest.mark.parametrize("look", LOOKS)
def test_walls_that_leave_the_canvas(look: str) -> None:
    """Two triangles cost no more than exact shading of each pixel of the canvas, wherever else they are."""
    rng = np.random.default_rng(1)
    costs = [gas(tilted_walls(rng, LOOKS[look])) for _ in range(60)]
    assert max(costs) <= PIXEL[look] * SIZE**2


@pytest.mark.parametrize("look", LOOKS)
def test_tiles_of_walls_cost_their_share(look: str) -> None:
    """Of pictures that cost the same everywhere: a share and a fifth of it, and what every tile needs."""
    rng = np.random.default_rng(2)
    for _ in range(12):
        scene = tilted_walls(rng, LOOKS[look])
        whole = gas(scene)
        away = evolve(scene, objects=[evolve(o, position=(0, 0, 3000)) for o in scene.objects])
        alone = gas(away, Rectangle(0, 0, 1, 1))
        for width, height in ((64, 16), (32, 32), (32, 64)):
            for _ in range(2):
                x, y = rng.integers(SIZE - width + 1), rng.integers(SIZE - height + 1)
                tile = Rectangle(int(x), int(y), width, height)
                assert gas(scene, tile) <= 1.2 * whole * width * height / SIZE**2 + alone + SET_UP, tile


#: Gas of two triangles before their first pixels, and of the colours of the patches that they cut, of which a tile
#: pays all.
SET_UP = 100_000


#: The colours of a patch or two, where the whole has each fragment shaded for itself; the search for the faces of a
#: small mesh that a tile shows.
PATCHES = 48_000


@pytest.mark.parametrize("kind", ["plain", "bent"])
def test_a_tile_costs_no_more_than_the_whole(kind: str) -> None:
    for seed in range(1, 61):
        scene = random_case(seed, kind).scene
        # of a mesh of 48 faces or more, a tile first finds out which of them it shows
        most = (1.02 if scene.triangles < 48 else 1.35) * gas(scene) + PATCHES
        for tile in grid(scene.width, scene.height, (scene.width + 1) // 2, (scene.height + 1) // 2):
            assert gas(scene, tile) <= most, f"seed {seed}, {tile}"


#: Gas of the colours of the patches that a tile cuts: two triangles, two cells each, nine colours, two lights.
CUT = 2 * 2 * 9 * 2 * 2_500


def test_parts_cost_the_whole_and_what_each_needs() -> None:
    """A tile and the four around it: pixels may be of different cost, but all are shaded once."""
    rng = np.random.default_rng(3)
    for _ in range(60):
        reach, left = rng.integers(1, 41), rng.integers(-150, -49)
        corners = reach * np.array([[left, -100, 0], [left + 300, -100, 0], [left, 200, 0]])
        look, turn = list(LOOKS.values())[rng.integers(3)], (*rng.integers(-20, 21, 2).tolist(), 0, 40)
        mesh = Mesh(corners, [[0, 1, 2]], normals=[(0, 0, 1)] * 3)
        wall = Object(mesh, (0, 0, -200), turn, material=look, cull=False)
        lights = [Light("point", rng.integers(-4000, 4001, 3)) for _ in range(rng.integers(1, 3))]
        scene = Scene([wall], Camera(near=1.0), lights, width=96, height=64)
        width, height = int(rng.integers(1, 97)), int(rng.integers(1, 65))
        x, y = int(rng.integers(97 - width)), int(rng.integers(65 - height))
        around = [
            (0, 0, 96, y),
            (0, y, x, height),
            (x + width, y, 96 - x - width, height),
            (0, y + height, 96, 64 - y - height),
        ]
        tiles = [Rectangle(*tile) for tile in [(x, y, width, height), *around] if tile[2] and tile[3]]
        # of a tile where nothing is; where the wall is all of the picture, one of a pixel needs all the more
        outside = np.argwhere(~covered(scene))
        row, column = outside[0].tolist() if len(outside) else (0, 0)
        least = gas(scene, Rectangle(column, row, 1, 1))
        assert sum(gas(scene, tile) for tile in tiles) <= 1.02 * gas(scene) + len(tiles) * (least + CUT)


@pytest.mark.parametrize("side", [32, 64, 128])
def test_a_tile_of_nearly_all_costs_hardly_more_than_the_whole(side: int) -> None:
    scene = in_range(evolve(load("teapot"), width=side, height=side))
    assert gas(scene, Rectangle(0, 0, side, side - 1)) <= 1.08 * gas(scene)
