"""The parts of a picture equal the whole, byte for byte."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from attrs import evolve
from numpy.random import Generator

from pictures import draw
from random_scenes import KINDS, random_case
from shackled import Camera, Light, Material, Mesh, Object, Scene
from shackled.scene._codec import Rectangle
from shackled.scene._in_range import in_range


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
    picture = draw(scene)
    left = np.ones(picture.shape[:2], bool)
    for tile in tiles:
        window = np.s_[tile.y : tile.y + tile.height, tile.x : tile.x + tile.width]
        assert (draw(scene, tile) == picture[window]).all(), tile
        left[window] = False
    assert not left.any()


@pytest.mark.parametrize("kind", KINDS)
def test_random_tilings(kind: str) -> None:
    rng = np.random.default_rng(1)
    for seed in range(1, 6):
        scene = random_case(seed, kind).scene
        assert_tiles_are_parts(scene, cut(rng, Rectangle(0, 0, scene.width, scene.height), 4))
        assert np.array_equal(draw(scene, Rectangle(0, 0, scene.width, scene.height)), draw(scene))


def test_a_tile_of_a_fan() -> None:
    """Of the 58 faces around a vertex, those in the tile have the borders that they have in the whole picture."""
    scene = random_case(1, "slivers").scene
    assert np.array_equal(draw(scene, Rectangle(11, 0, 25, 8)), draw(scene)[:8, 11:36])


@pytest.mark.xfail(strict=True, reason="the contract keeps 16 edges of vertices that have 13 triangles each")
def test_a_tile_of_a_fan_of_fans() -> None:
    """Around a vertex are 20 others, each with 13 more faces."""
    count, rng = 20, np.random.default_rng(1)
    turns = [2 * np.pi * np.arange(count) / count + each for each in (0, 0, 0.06)]
    radii = (500, 900, 900)
    rings = [radius * np.stack([np.cos(t), np.sin(t), 0 * t], 1) for radius, t in zip(radii, turns, strict=True)]
    points = np.rint([(0, 0, 0), *np.concatenate(rings)])
    k = np.arange(count)
    outer = np.repeat(np.stack([1 + k, 1 + count + k, 1 + 2 * count + k], 1), 13, axis=0)
    faces = [*outer, *np.stack([0 * k, 1 + k, 1 + (k + 1) % count], 1)]
    mesh = Mesh(points, faces, rng.integers(0, 256, points.shape), np.tile([0, 0, 1], (len(points), 1)))
    thing = Object(mesh, (0, 0, -2500), material=Material("smooth"))
    lights = [Light.directional(toward=(1, 2, 3))]
    scene = in_range(Scene([thing], Camera(), lights, "black", width=96, height=96, antialias=True))
    assert_tiles_are_parts(scene, (Rectangle(x, y, 16, 16) for x in range(0, 96, 16) for y in range(0, 96, 16)))


def test_every_pixel_as_a_tile() -> None:
    scene = evolve(random_case(1, "plain").scene, width=13, height=11)
    assert_tiles_are_parts(scene, (Rectangle(x, y, 1, 1) for x in range(13) for y in range(11)))


@pytest.mark.parametrize(("width", "height"), [(64, 1024), (200, 130), (1024, 17), (1, 1024)])
@pytest.mark.parametrize("kind", ["plain", "wires", "glass"])
def test_pictures_of_several_bands(kind: str, width: int, height: int) -> None:
    """The contract draws a picture of more than 16384 pixels in bands of rows."""
    scene = evolve(random_case(1, kind).scene, width=width, height=height)
    rows = [Rectangle(0, y, width, min(97, height - y)) for y in range(0, height, 97)]
    assert_tiles_are_parts(scene, iter(rows))
