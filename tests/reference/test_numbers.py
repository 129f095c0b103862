"""The arithmetic of words, roots and vectors."""

from __future__ import annotations

import math

import numpy as np

from shackled.reference.roots import sqrt
from shackled.reference.vector import cross, dot, normalize, scale, to_matrix, transposed_times
from shackled.reference.words import MASK, divide, divide_signed, signed

ONE = 1 << 32


def test_roots_keep_their_bound() -> None:
    rng = np.random.default_rng(1)
    numbers = [*range(300), *(1 << bit for bit in range(256)), *((1 << bit) - 1 for bit in range(1, 257))]
    numbers += [int.from_bytes(rng.bytes(32), "big") >> int(rng.integers(256)) for _ in range(2000)]
    for number in numbers:
        # compared as squares: the root of a word has more bits than a float
        root, bound = sqrt(number), max(1, math.isqrt(number) >> 22)
        assert max(root - bound, 0) ** 2 <= number <= (root + bound) ** 2


def test_division_is_that_of_the_machine() -> None:
    assert [divide(7, 2), divide(7, 0), divide(-1, 2), divide(5, 1 << 256)] == [3, 0, MASK >> 1, 0]
    assert [divide_signed(a, b) for a, b in ((7, 2), (-7, 2), (7, -2), (-7, -2), (1, 0))] == [3, -3, -3, 3, 0]
    assert [signed(MASK), signed(1 << 255), signed((1 << 256) + 5)] == [-1, -(1 << 255), 5]


def test_vectors() -> None:
    i, j, k = (ONE, 0, 0), (0, ONE, 0), (0, 0, ONE)
    assert (cross(i, j), dot(i, j), dot(i, i), scale(j, 3 * ONE)) == (k, 0, ONE, (0, 3 * ONE, 0))
    assert normalize((0, 0, 0)) == (0, 0, 0)
    rng = np.random.default_rng(2)
    for _ in range(100):
        v = rng.normal(size=3) * 2.0 ** rng.uniform(-20, 20)
        x, y, z = exact = [round(each) for each in (v * ONE).tolist()]
        unit = np.array(normalize((x, y, z)), np.float64) / ONE
        np.testing.assert_allclose(unit, np.array(exact) / np.linalg.norm(exact), atol=2**-21)


def test_a_rotation_and_its_inverse() -> None:
    half = math.sqrt(0.5)
    # a quarter turn about z takes x to y
    matrix = to_matrix((0, 0, round(half * ONE), round(half * ONE)))
    np.testing.assert_allclose(matrix[0], (0, ONE, 0), atol=8)
    np.testing.assert_allclose(transposed_times(matrix, (0, ONE, 0)), (ONE, 0, 0), atol=8)
    assert to_matrix((0, 0, 0, 5 * ONE)) == ((ONE, 0, 0), (0, ONE, 0), (0, 0, ONE))
