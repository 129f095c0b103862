"""The parts of a picture equal the whole, byte for byte."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
import pytest
from attrs import evolve
from numpy.random import Generator

from made_scenes import big_triangles, flat, ground, screen_triangle, teapot_scene
from pictures import Pixels, chain
from shackled import Background, Light, Material, Scene
from shackled.image import decode_bmp
from shackled.scene import Rectangle

LAMP = Light("point", (3, 5, -18), (255, 200, 150))
SHINY = Material("flat", 0.2, 0.6, 0.6, 40)


def wired(scene: Scene) -> Scene:
    return evolve(scene, objects=[evolve(o, wireframe=True, cull=False) for o in scene.objects])


SCENES: dict[str, Callable[[], Scene]] = {
    "smooth, one sun": lambda: teapot_scene(1),
    "smooth, one lamp": lambda: teapot_scene(1, 1),
    "smooth, four lights": lambda: teapot_scene(4),
    "flat, one sun": lambda: flat(teapot_scene(1)),
    "flat, four lights": lambda: flat(teapot_scene(4)),
    "flat, inverted": lambda: evolve(flat(teapot_scene(1)), invert=True),
    "wireframe": lambda: wired(teapot_scene(1)),
    "wireframe of clipped triangles": lambda: wired(big_triangles(SHINY, [LAMP])),
    "large flat faces with a lamp": lambda: ground(SHINY, [LAMP]),
    "large smooth faces with a lamp": lambda: ground(evolve(SHINY, shading="smooth"), [LAMP]),
    "clipped, flat": lambda: big_triangles(SHINY, [LAMP]),
    "clipped, smooth": lambda: big_triangles(evolve(SHINY, shading="smooth"), [LAMP]),
    "clipped, unlit": lambda: big_triangles(Material("unlit"), []),
    "steep perspective": lambda: screen_triangle(
        ((60, 5), (5, 100), (120, 100)), (1000, 9000, 300), ((0, 128, 255), (255, 0, 0), (0, 255, 0))
    ),
    "nothing": lambda: Scene([], background=Background((250, 10, 30), (5, 200, 90))),
}

SIZES = [(64, 64), (37, 53), (61, 5), (3, 40), (1, 1)]


def whole(scene: Scene) -> Pixels:
    return decode_bmp(chain().draw(scene).bmp, scene.width, scene.height)


def part(scene: Scene, tile: Rectangle) -> Pixels:
    return decode_bmp(chain().draw(scene, tile).bmp, tile.width, tile.height)


def cut(rng: Generator, tile: Rectangle, depth: int) -> Iterator[Rectangle]:
    """A random tiling of a rectangle."""
    x, y, width, height = tile.x, tile.y, tile.width, tile.height
    across = rng.random() < width / (width + height)
    if depth == 0 or (width if across else height) < 2:
        yield tile
    elif across:
        at = int(rng.integers(1, width))
        yield from cut(rng, Rectangle(x, y, at, height), depth - 1)
        yield from cut(rng, Rectangle(x + at, y, width - at, height), depth - 1)
    else:
        at = int(rng.integers(1, height))
        yield from cut(rng, Rectangle(x, y, width, at), depth - 1)
        yield from cut(rng, Rectangle(x, y + at, width, height - at), depth - 1)


def assert_tiles_are_parts(scene: Scene, tiles: Iterator[Rectangle]) -> None:
    picture = whole(scene)
    left = np.ones(picture.shape[:2], bool)
    for tile in tiles:
        window = np.s_[tile.y : tile.y + tile.height, tile.x : tile.x + tile.width]
        assert (part(scene, tile) == picture[window]).all(), tile
        left[window] = False
    assert not left.any()


@pytest.mark.parametrize("name", SCENES)
def test_random_tilings(name: str) -> None:
    rng = np.random.default_rng(1)
    for width, height in SIZES:
        scene = evolve(SCENES[name](), width=width, height=height)
        assert_tiles_are_parts(scene, cut(rng, Rectangle(0, 0, width, height), 4))


@pytest.mark.parametrize("name", SCENES)
def test_the_whole_as_a_tile(name: str) -> None:
    scene = evolve(SCENES[name](), width=45, height=33)
    assert chain().draw(scene, Rectangle(0, 0, 45, 33)).bmp == chain().draw(scene).bmp


def test_every_pixel_as_a_tile() -> None:
    scene = evolve(flat(teapot_scene(2)), width=13, height=11)
    assert_tiles_are_parts(scene, (Rectangle(x, y, 1, 1) for x in range(13) for y in range(11)))


@pytest.mark.parametrize(("width", "height"), [(64, 1024), (1024, 40), (200, 130), (1024, 17), (1, 1024), (1024, 1)])
@pytest.mark.parametrize("name", ["smooth, one lamp", "flat, four lights", "wireframe of clipped triangles"])
def test_pictures_of_several_bands(name: str, width: int, height: int) -> None:
    """The contract draws a picture of more than 16384 pixels in bands of rows."""
    scene = evolve(SCENES[name](), width=width, height=height)
    scene = evolve(scene, camera=evolve(scene.camera, half_height=0.3))
    rows = [Rectangle(0, y, width, min(97, height - y)) for y in range(0, height, 97)]
    assert_tiles_are_parts(scene, iter(rows))


def test_two_objects_in_bands() -> None:
    scene = flat(teapot_scene(2))
    (thing,) = scene.objects
    second = evolve(thing, position=(1, -1, 1), wireframe=True)
    scene = evolve(scene, objects=[thing, second], width=160, height=250)
    assert_tiles_are_parts(scene, cut(np.random.default_rng(3), Rectangle(0, 0, 160, 250), 3))
