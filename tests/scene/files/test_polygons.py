import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from shackled.errors import InputError
from shackled.scene._files.polygons import cut, fans

Array = NDArray[np.float64]


def flat(points: list[tuple[float, float]]) -> Array:
    return np.array([(x, y, 0.0) for x, y in points])


def ring(corners: int) -> Array:
    """A thin ring, cut open where it begins, so that it is one polygon without a hole."""
    turns = np.linspace(0, 2 * np.pi, corners // 2)
    outer = np.stack([np.cos(turns), np.sin(turns), 0 * turns], axis=1)
    return np.concatenate([outer, 0.98 * outer[::-1]])


def star(distances: list[float]) -> Array:
    turns = np.linspace(0, 2 * np.pi, len(distances), endpoint=False)
    return np.asarray(np.stack([np.cos(turns), np.sin(turns), 0 * turns], axis=1) * np.array(distances)[:, None])


def check_filled(points: Array) -> None:
    """The triangles have the area of the polygon, however it is cut, and all turn as it does."""
    whole = np.cross(points, np.roll(points, -1, axis=0)).sum(axis=0) / 2
    triangles = cut(points, [len(points)], np.arange(len(points)))
    assert (triangles[:, 3] == 0).all()
    a, b, c = np.moveaxis(points[triangles[:, :3]], 1, 0)
    areas, size = np.cross(b - a, c - a) / 2, float(np.linalg.norm(whole))
    np.testing.assert_allclose(areas.sum(axis=0), whole, atol=1e-9 * size)
    assert np.linalg.norm(areas, axis=1).sum() == pytest.approx(size, rel=1e-6)


def test_fans_cut_polygons() -> None:
    wanted = [[0, 1, 2, 0], [3, 4, 5, 1], [3, 5, 6, 1], [3, 6, 7, 1], [10, 11, 12, 3]]
    assert fans([3, 5, 2, 3]).tolist() == wanted
    assert fans([]).tolist() == []


CONCAVE = {
    "ring": ring(66),
    "letter": flat([(0, 0), (3, 0), (3, 1), (1, 1), (1, 2), (2, 2), (2, 3), (1, 3), (1, 4), (3, 4), (3, 5), (0, 5)]),
    "star": star([1, 0.3] * 9),
    "comb": flat([(0, -1), *((x, 0.1 if x % 2 else 5) for x in range(40)), (39, -1)]),
    "spiral": flat(
        [(r * np.cos(r), r * np.sin(r)) for r in np.arange(1, 20, 0.2)]
        + [((r + 1) * np.cos(r), (r + 1) * np.sin(r)) for r in np.arange(1, 20, 0.2)[::-1]]
    ),
}
PLACES = {
    "flat": (np.eye(3), 0.0),
    "upright": (np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]]), 0.0),
    "mirrored": (np.diag([-1, 1, 1]), 0.0),
    "turned, far off": (np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0], 1000.0),
    "tiny": (np.eye(3) * 1e-120, 0.0),
    "huge": (np.eye(3) * 1e120, 0.0),
}


@pytest.mark.parametrize("shape", CONCAVE)
@pytest.mark.parametrize("place", PLACES)
def test_concave_polygons_are_filled(shape: str, place: str) -> None:
    matrix, offset = PLACES[place]
    points = CONCAVE[shape] @ matrix.T + offset
    for start in (0, len(points) // 3, len(points) - 1):
        turned = np.roll(points, start, axis=0)
        check_filled((turned - offset) / np.abs(matrix).max() if place in ("tiny", "huge") else turned - offset)
        cut_there = cut(turned, [len(points)], np.arange(len(points)))
        assert len(cut_there) == len(points) - 2


@settings(max_examples=60, deadline=None)
@given(st.lists(st.floats(0.05, 1), min_size=4, max_size=40), st.integers(0, 39), st.booleans())
def test_stars_of_any_distances_are_filled(distances: list[float], start: int, backward: bool) -> None:
    points = np.roll(star(distances), start, axis=0)
    check_filled(points[::-1] if backward else points)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.tuples(st.integers(-3, 3), st.integers(-3, 3), st.integers(-1, 1)), min_size=3, max_size=12))
def test_polygons_of_any_kind_are_cut(corners: list[tuple[int, int, int]]) -> None:
    """Crossing, folded, without an area: nothing to check but that there are triangles of these corners."""
    triangles = cut(np.array(corners, dtype=float), [len(corners)], np.arange(len(corners)))
    assert 0 <= len(triangles) <= len(corners) - 2
    assert ((triangles[:, :3] >= 0) & (triangles[:, :3] < len(corners))).all()


@settings(max_examples=40, deadline=None)
@given(st.integers(3, 30), st.integers(0, 2**32 - 1))
def test_convex_polygons_are_cut_as_fans(corners: int, seed: int) -> None:
    random = np.random.default_rng(seed)
    turns = np.sort(random.random(corners)) * 2 * np.pi
    points = np.stack([3 * np.cos(turns), np.sin(turns), 0 * turns], axis=1)
    points = points @ np.linalg.qr(random.normal(size=(3, 3)))[0] + random.normal(size=3)
    assert cut(points, [corners], np.arange(corners)).tolist() == fans([corners]).tolist()


def test_many_polygons_keep_their_order() -> None:
    arrow = [(0, 2), (-1, 0), (0, 1), (1, 0)]
    points = flat([*arrow, (5, 5), (6, 5), (6, 6)])
    triangles = cut(points, [3, 4, 2, 3], [4, 5, 6, 1, 2, 3, 0, 4, 5, 4, 5, 6])
    assert triangles[:, 3].tolist() == [0, 1, 1, 3]
    assert triangles[0].tolist() == [0, 1, 2, 0]
    assert triangles[3].tolist() == [9, 10, 11, 3]
    assert all(3 <= corner < 7 for corner in triangles[1:3, :3].reshape(-1))


def test_a_polygon_of_too_many_corners_is_refused_unless_it_is_convex(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shackled.scene._files.polygons.MAX_CORNERS", 60)
    with pytest.raises(InputError, match=r"^face 0 is not convex and has 66 corners; up to 60 are cut$"):
        cut(ring(66), [66], np.arange(66))
    assert len(cut(star([1.0] * 66), [66], np.arange(66))) == 64
