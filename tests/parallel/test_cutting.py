"""How a canvas is cut."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from shackled.parallel._tiles import SMALLEST, area, cut, grid, halves
from shackled.scene._codec import Rectangle

SIDES = st.integers(1, 300) | st.sampled_from([1024, 2047, 2048])


def covers(tiles: list[Rectangle], width: int, height: int) -> bool:
    """Return whether the tiles lie on the canvas and cover each pixel once."""
    seen = np.zeros((height, width), int)
    for tile in tiles:
        assert min(tile.x, tile.y) >= 0
        seen[tile.y : tile.y + tile.height, tile.x : tile.x + tile.width] += 1
    return bool((seen == 1).all()) and sum(map(area, tiles)) == width * height


@given(SIDES, SIDES, st.integers(1, 1 << 23), st.integers(1, 64))
@settings(max_examples=60, deadline=None)
def test_tiles_cover_each_pixel_once(width: int, height: int, pixels: int, at_least: int) -> None:
    pixels = max(pixels, width * height // 400, 1)
    tiles = cut(width, height, pixels, at_least)
    assert covers(tiles, width, height)
    assert max(map(area, tiles)) <= max(pixels, 1)
    assert len(tiles) >= min(at_least, height)


@given(SIDES, SIDES, st.integers(1, 3000), st.integers(1, 3000))
@settings(max_examples=40, deadline=None)
def test_grids_cover_each_pixel_once(width: int, height: int, columns: int, rows: int) -> None:
    columns, rows = max(columns, width // 40, 1), max(rows, height // 40, 1)
    tiles = list(grid(width, height, columns, rows))
    assert covers(tiles, width, height)
    assert all(tile.width <= columns and tile.height <= rows for tile in tiles)


@given(st.integers(0, 9), st.integers(0, 9), st.integers(1, 200), st.integers(1, 200))
@settings(max_examples=60, deadline=None)
def test_halves_are_the_whole(x: int, y: int, width: int, height: int) -> None:
    tile = Rectangle(x, y, width, height)
    parts = halves(tile)
    assert len(parts) == (2 if width * height >= 2 * SMALLEST else 1)
    moved = [Rectangle(part.x - x, part.y - y, part.width, part.height) for part in parts]
    assert covers(moved, width, height)


def test_strips_where_they_fit() -> None:
    assert cut(100, 50, 10_000) == [Rectangle(0, 0, 100, 50)]
    assert [tile.width for tile in cut(100, 50, 1000)] == [100] * 5
    assert [(tile.width, tile.height) for tile in cut(100, 8, 200)] == [(50, 4)] * 4
