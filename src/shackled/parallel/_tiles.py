"""Cut a canvas into tiles.

Tiles are strips as wide as the canvas wherever that is possible: the estimate of what a tile costs is made of strips.
Up to eight strips cost as much as squares (1 x 8 as 2 x 4). Of more tiles, squares show fewer faces each, and the
contract leaves the others out: at 512 x 512 pixels 16 strips cost 3 % more than 2 x 8 tiles, 32 strips 7 % more than
4 x 8.
"""

from __future__ import annotations

from collections.abc import Iterator

from ..scene._codec import Rectangle
from ..scene._scene import Scene

#: From so many pixels on, pictures are cut into strips to save gas: a fifth of that of plain flat models at 1024 x 1024
#: pixels, half at 2048 x 2048, but less than a tenth at 768 x 768, where a picture of one call is worth more.
LARGE = 1024 * 1024
#: Smaller tiles, in pixels, are not cut: their cost is the geometry, not the pixels.
SMALLEST = 64
#: Strips of fewer rows are cut into columns first.
FEWEST_ROWS = 4


def is_large(scene: Scene) -> bool:
    """Return whether a picture is cut into strips because that is cheaper."""
    return scene.width * scene.height >= LARGE


def cut(width: int, height: int, pixels: int, at_least: int = 1) -> list[Rectangle]:
    """Return tiles of a canvas, rows from the top.

    pixels: of a tile at most, 1 or more. at_least: so many tiles, if there are so many rows.
    """
    rows = max(1, min(height // max(1, at_least), pixels // width))
    columns = width
    if pixels < min(height, FEWEST_ROWS) * width:
        rows = max(1, min(FEWEST_ROWS, height, pixels))
        columns = pixels // rows
    return list(grid(width, height, columns, rows))


def grid(width: int, height: int, tile_width: int, tile_height: int) -> Iterator[Rectangle]:
    """Yield tiles of at most that size, as equal as possible."""
    for y, rows in _shares(height, tile_height):
        for x, columns in _shares(width, tile_width):
            yield Rectangle(x, y, columns, rows)


def halves(tile: Rectangle) -> list[Rectangle]:
    """Return the two halves of a tile, or the tile alone where it is too small to be cut."""
    x, y, width, height = tile.x, tile.y, tile.width, tile.height
    if width * height < 2 * SMALLEST:
        return [tile]
    if height >= 2 * FEWEST_ROWS or height >= width:
        half = height // 2
        return [Rectangle(x, y, width, half), Rectangle(x, y + half, width, height - half)]
    half = width // 2
    return [Rectangle(x, y, half, height), Rectangle(x + half, y, width - half, height)]


def area(tile: Rectangle) -> int:
    """Return the number of pixels of a tile."""
    return tile.width * tile.height


def _shares(whole: int, largest: int) -> Iterator[tuple[int, int]]:
    """Yield begin and length of equal shares, none above `largest`."""
    count = -(-whole // largest)
    for i in range(count):
        begin = whole * i // count
        yield begin, whole * (i + 1) // count - begin
