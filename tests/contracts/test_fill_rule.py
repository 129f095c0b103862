"""Which pixels a triangle covers: those whose centre is inside, by the top-left rule, exactly.

The triangles have whole coordinates in 1/256 of a pixel, and the expected pixels come from the signs of edge functions
in whole numbers.
"""

from __future__ import annotations

import numpy as np
import pytest
from attrs import evolve
from numpy.typing import NDArray

from pictures import covered, on_pixel_grid, pixel_grid_camera, soup, unlit_scene

Integers = NDArray[np.int64]
Mask = NDArray[np.bool_]
#: (n, 3, 2), corners in 1/256 of a pixel.
Triangles = NDArray[np.int64]

#: How corners are chosen on a canvas of some pixels: low, high, and the step that they are multiples of, in pixels.
KINDS = {
    "within": (0.0, 1.0, 1 / 256),
    "across the borders": (-0.5, 1.5, 1 / 256),
    "on centres and corners of pixels": (-0.2, 1.2, 1 / 2),
    "on quarters of pixels": (0.0, 1.0, 1 / 4),
    "reaching far": (-40.0, 40.0, 1 / 256),
}


def edge_functions(corners: Integers, width: int, height: int) -> Integers:
    """(3, H, W), each positive on one side of an edge of corners (3, 2), in 1/256 of a pixel."""
    (x0, y0), (x1, y1), (x2, y2) = corners.tolist()
    column, row = 256 * np.arange(width)[None] + 128, 256 * np.arange(height)[:, None] + 128
    ends = (((x0, y0), (x1, y1)), ((x1, y1), (x2, y2)), ((x2, y2), (x0, y0)))
    return np.array([(column - px) * (qy - py) - (row - py) * (qx - px) for (px, py), (qx, qy) in ends])


def expected_pixels(corners: Integers, width: int, height: int) -> Mask:
    """(H, W): what the triangle covers, whichever way round it goes."""
    (x0, y0), (x1, y1), (x2, y2) = corners.tolist()
    area = (x2 - x0) * (y1 - y0) - (x1 - x0) * (y2 - y0)
    if area == 0:
        return np.zeros((height, width), bool)
    if area < 0:
        corners = corners[::-1]
    inside = np.ones((height, width), bool)
    for i, value in enumerate(edge_functions(corners, width, height)):
        dx, dy = (corners[(i + 1) % 3] - corners[i]).tolist()
        # the inside of an edge that goes down is on its right, that of one that goes left below it
        inside &= value >= 0 if dy > 0 or (dy == 0 and dx < 0) else value > 0
    return inside


def random_triangle(rng: np.random.Generator, kind: tuple[float, float, float], width: int, height: int) -> Integers:
    low, high, step = kind
    corners = rng.uniform(low, high, (3, 2)) * [width, height]
    return np.asarray((np.rint(corners / step) * (256 * step)).astype(np.int64))


def drawn(corners: Integers, width: int, height: int, cull: bool = False) -> Mask:
    scene = unlit_scene(soup(on_pixel_grid(corners, width, height)), pixel_grid_camera(height), width, height)
    return covered(evolve(scene, objects=[evolve(scene.objects[0], cull=cull)]))


@pytest.mark.parametrize("kind", KINDS)
def test_random_triangles(kind: str) -> None:
    rng = np.random.default_rng(1)
    covering = 0
    for _ in range(150):
        width, height = (int(side) for side in rng.integers(1, 33, 2))
        corners = random_triangle(rng, KINDS[kind], width, height)
        expected = expected_pixels(corners, width, height)
        covering += bool(expected.any())
        assert (drawn(corners, width, height) == expected).all(), f"{corners.tolist()} on {width} x {height}"
    assert covering > 30


def test_beyond_the_guard_band_only_edges_through_centres_differ() -> None:
    """Corners up to 100,000 pixels away: the cut puts new ones on the border of the guard band, to 1/256 of a pixel."""
    rng = np.random.default_rng(6)
    covering = 0
    for _ in range(150):
        # an edge through the picture
        middle, way = rng.uniform(0, 24, 2), rng.normal(size=2)
        way *= 10 ** rng.uniform(3, 4.4) / np.linalg.norm(way)
        corners = np.array([middle - way, middle + way * rng.uniform(0.1, 1), rng.uniform(-3e4, 3e4, 2)])
        corners = np.rint(256 * corners).astype(np.int64)
        different = drawn(corners, 24, 24) != (expected := expected_pixels(corners, 24, 24))
        covering += bool(expected.any() and not expected.all())
        lengths = np.linalg.norm(corners - np.roll(corners, -1, axis=0), axis=1)
        pixels_from_edge = np.abs(edge_functions(corners, 24, 24)).T / np.maximum(lengths, 1) / 256
        nearest = pixels_from_edge.min(axis=2).T
        assert (nearest[different] < 1 / 64).all(), corners.tolist()
    assert covering > 20


def test_slivers() -> None:
    rng = np.random.default_rng(2)
    for _ in range(150):
        start, end = rng.integers(-2000, 10000, (2, 2))
        corners = np.array([start, end, (start + end) // 2 + rng.integers(-40, 41, 2)])
        assert (drawn(corners, 31, 31) == expected_pixels(corners, 31, 31)).all(), corners.tolist()


def test_culling_goes_by_the_sense_of_rotation() -> None:
    rng = np.random.default_rng(3)
    sides = set()
    for _ in range(60):
        corners = random_triangle(rng, KINDS["within"], 24, 24)
        (x0, y0), (x1, y1), (x2, y2) = corners.tolist()
        # rows run down
        is_front = (x2 - x0) * (y1 - y0) - (x1 - x0) * (y2 - y0) > 0
        sides.add(is_front)
        expected = expected_pixels(corners, 24, 24) & is_front
        assert (drawn(corners, 24, 24, cull=True) == expected).all(), corners.tolist()
    assert sides == {False, True}


def test_the_same_pixels_in_any_order_of_corners() -> None:
    rng = np.random.default_rng(4)
    for _ in range(20):
        corners = random_triangle(rng, KINDS["on quarters of pixels"], 16, 16)
        pictures = [drawn(corners[order], 16, 16) for order in ([0, 1, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0])]
        assert all((picture == pictures[0]).all() for picture in pictures)


def test_a_pixel_on_each_kind_of_edge() -> None:
    """A square whose edges go through centres of pixels has those of its left and top edge."""
    low, high = 2 * 256 + 128, 6 * 256 + 128
    square = np.array([[[low, low], [low, high], [high, high]], [[low, low], [high, high], [high, low]]])
    scene = unlit_scene(soup(on_pixel_grid(square, 9, 9)), pixel_grid_camera(9), 9)
    expected = np.zeros((9, 9), bool)
    expected[2:6, 2:6] = True
    assert (covered(scene) == expected).all()


# ---- shapes of many triangles, each alone and all together ----


def fan(rng: np.random.Generator) -> Triangles:
    """Triangles around a point that is shifted by parts of a pixel."""
    sides = int(rng.integers(3, 12))
    angles = np.sort(rng.uniform(0, 2 * np.pi, sides))
    hub = 12 * 256 + rng.integers(-256, 257, 2)
    rim = hub + np.rint(np.stack([np.cos(angles), np.sin(angles)], axis=1) * rng.uniform(300, 4000, (sides, 1)))
    return np.stack([np.tile(hub, (sides, 1)), rim, np.roll(rim, -1, axis=0)], axis=1).astype(np.int64)


def grid(rng: np.random.Generator) -> Triangles:
    """Squares whose corners are centres of pixels, or corners, or half way between them."""
    step, count = int(rng.choice([128, 256, 384, 512, 1280])), int(rng.integers(1, 5))
    x, y = np.meshgrid(*[128 * rng.integers(0, 12) + step * np.arange(count + 1) for _ in range(2)], indexing="ij")
    points = np.stack([x, y], axis=-1)
    a, b, c, d = points[:-1, :-1], points[:-1, 1:], points[1:, 1:], points[1:, :-1]
    if rng.random() < 0.5:
        a, b, c, d = b, c, d, a
    return np.concatenate([np.stack([a, b, c], axis=2), np.stack([a, c, d], axis=2)]).reshape(-1, 3, 2)


def strip(rng: np.random.Generator) -> Triangles:
    """Triangles in a row, long and thin."""
    count = int(rng.integers(3, 12))
    points = np.stack([np.linspace(-500, 6500, count), 3000 + rng.integers(-40, 41, count)], axis=1)
    points[::2, 1] += rng.integers(1, 300)
    points = np.rint(points).astype(np.int64)
    return np.stack([points[:-2], points[1:-1], points[2:]], axis=1)


def huge(rng: np.random.Generator) -> Triangles:
    """The plane in three parts that meet on the canvas, to the ends of the guard band."""
    hub = rng.integers(0, 24 * 256, 2)
    # 4,096 pixels around the canvas are not cut
    reach = 4000 * 256
    x, y = rng.integers(-reach, reach, 2)
    rim = np.array([[-reach, y], [x, reach], [reach, -y], [-x, -reach]])
    return np.stack([np.tile(hub, (4, 1)), rim, np.roll(rim, -1, axis=0)], axis=1)


SHAPES = {"fan": fan, "grid": grid, "strip": strip, "huge": huge}


@pytest.mark.parametrize("kind", SHAPES)
def test_each_triangle_of_a_shape_alone(kind: str) -> None:
    """Each has its pixels exactly, and so two that share an edge leave no gap and have no pixel in common."""
    rng = np.random.default_rng(7)
    pixels = 0
    for _ in range(12):
        triangles = SHAPES[kind](rng)
        together = np.zeros((24, 24), np.int64)
        for corners in triangles:
            covering = drawn(corners, 24, 24)
            assert (covering == expected_pixels(corners, 24, 24)).all(), corners.tolist()
            together += covering
        pixels += int(together.sum())
        if kind in ("fan", "grid", "huge"):
            assert together.max() <= 1
        if kind == "huge":
            assert together.min() == 1
    assert pixels > 100
