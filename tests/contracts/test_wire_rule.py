"""Which pixels a wire covers: the nearest to the line in each column, or in each row if it is steeper than 45 degrees.

The expected pixels come from that sentence of docs/explain.md and from fractions: where exactly a line between two
whole numbers of 1/256 of a pixel crosses the middle of a column or row. Where two pixels are equally near, or an end of
the line is exactly in the middle of a column or row, either will do.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from attrs import evolve

from pictures import covered, on_pixel_grid, pixel_grid_camera, soup, unlit_scene
from test_fill_rule import KINDS as FILLED
from test_fill_rule import Integers, random_triangle

Places = set[tuple[int, int]]
Point = tuple[Fraction, Fraction]

KINDS = FILLED | {"reaching far": (-3.0, 4.0, 1 / 256)}


def nearest(value: Fraction) -> set[int]:
    """The pixels whose middle is nearest to a place: one, or the two on both sides of a border."""
    whole = value.numerator // value.denominator
    return {whole - 1, whole} if value == whole else {whole}


def along(start: Point, end: Point, axis: int) -> list[tuple[Places, bool]]:
    """For each column (axis 0) or row (axis 1) whose middle the line crosses: the pixels of which one is drawn, as
    (column, row), and whether one must be, which is open where the line ends there.
    """
    if start[axis] > end[axis]:
        start, end = end, start
    low, high = start[axis], end[axis]
    found = []
    for number in range(int(low) - 2, int(high) + 2):
        middle = number + Fraction(1, 2)
        if low <= middle <= high:
            part = (middle - low) / (high - low) if high != low else Fraction(0)
            across = nearest(start[1 - axis] + (end[1 - axis] - start[1 - axis]) * part)
            places = {(number, other) if axis == 0 else (other, number) for other in across}
            found.append((places, low < middle < high))
    return found


def wrong(drawn: Places, corners: Integers, width: int, height: int) -> tuple[Places, Places]:
    """The pixels of a wired triangle that are missing, and those that are too many."""
    points = [(Fraction(x, 256), Fraction(y, 256)) for x, y in corners.tolist()]
    canvas = {(column, row) for column in range(width) for row in range(height)}
    missing: Places = set()
    allowed: Places = set()
    for i in range(3):
        (px, py), (qx, qy) = start, end = points[i], points[(i + 1) % 3]
        across, down = abs(px - qx), abs(py - qy)
        # at 45 degrees either rule will do
        rules = [along(start, end, axis) for axis in [0] * (across >= down) + [1] * (down >= across)]
        lacks: list[Places] = []
        for rule in rules:
            musts = [places for places, must in rule if must and places <= canvas and not places & drawn]
            lacks.append(set().union(*musts))
            allowed |= set().union(*(places for places, _ in rule))
        missing |= min(lacks, key=len)
    return missing, drawn - allowed


def wires(corners: Integers, width: int, height: int) -> Places:
    scene = unlit_scene(soup(on_pixel_grid(corners, width, height)), pixel_grid_camera(height), width, height)
    scene = evolve(scene, objects=[evolve(scene.objects[0], wireframe=True)])
    return {(column, row) for row, column in np.argwhere(covered(scene)).tolist()}


def is_flat(corners: Integers) -> bool:
    (x0, y0), (x1, y1), (x2, y2) = corners.tolist()
    return bool((x2 - x0) * (y1 - y0) == (x1 - x0) * (y2 - y0))


@pytest.mark.parametrize("kind", KINDS)
def test_random_triangles(kind: str) -> None:
    rng = np.random.default_rng(1)
    pixels = 0
    for _ in range(60):
        width, height = (int(side) for side in rng.integers(1, 33, 2))
        corners = random_triangle(rng, KINDS[kind], width, height)
        if is_flat(corners):
            # nothing of it is drawn
            assert not wires(corners, width, height)
            continue
        drawn = wires(corners, width, height)
        pixels += len(drawn)
        assert wrong(drawn, corners, width, height) == (set(), set()), f"{corners.tolist()} on {width} x {height}"
    assert pixels > 200


def test_lines_along_columns_rows_and_diagonals() -> None:
    rng = np.random.default_rng(2)
    for _ in range(60):
        x, y, long, short = rng.integers(0, 24 * 256, 4).tolist()
        for dx, dy in ((long, 0), (0, long), (long, long), (long, -long), (long, short % 7), (short % 7, long)):
            corners = np.array([[x, y], [x + dx, y + dy], [x + short % 999 - 500, y + long % 777 - 300]])
            if not is_flat(corners):
                assert wrong(wires(corners, 24, 24), corners, 24, 24) == (set(), set()), corners.tolist()
