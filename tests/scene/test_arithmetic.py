"""Arithmetic that is the same on each machine, and rotations."""

from __future__ import annotations

import hashlib
import math
import struct

import numpy as np
import pytest

from shackled.errors import InputError
from shackled.scene._arithmetic import cosine, from_axis_angle, from_euler, rotate, sine, tangent

#: Hundredths of degrees.
ANGLES = [number / 100 for number in range(-18_000, 36_001, 9)]


def test_sines_are_those_of_the_c_library() -> None:
    """But for the last bit."""
    for degrees in ANGLES:
        radians = math.radians(math.fmod(degrees, 360))
        assert cosine(degrees) == pytest.approx(math.cos(radians), rel=3e-16)
        assert sine(degrees) == pytest.approx(math.sin(radians), rel=3e-16)
    for degrees in ANGLES:
        if 0 < degrees < 90:
            assert tangent(degrees) == pytest.approx(math.tan(math.radians(degrees)), rel=3e-16)


def test_sines_are_the_same_everywhere() -> None:
    """web/tests/arithmetic.test.ts has the same digest."""
    values = [function(degrees) for degrees in ANGLES for function in (cosine, sine)]
    digest = hashlib.sha256(struct.pack(f"<{len(values)}d", *values)).hexdigest()
    assert digest == "09b289884fccdccc9c83d0b0c41e5232a81eab62795a58379e427efbb34ef9bf"


@pytest.mark.parametrize("turns", [1, -1, 1000, -(2**40)])
def test_whole_turns_change_nothing(turns: int) -> None:
    assert cosine(math.copysign(40, turns) + 360.0 * turns) == cosine(40)
    assert sine(math.copysign(40, turns) + 360.0 * turns) == math.copysign(sine(40), turns)


def test_euler_angles_equal_the_product_of_matrices() -> None:
    a, b, c = np.radians([20, -75, 130])
    about_x = np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])
    about_y = np.array([[np.cos(b), 0, np.sin(b)], [0, 1, 0], [-np.sin(b), 0, np.cos(b)]])
    about_z = np.array([[np.cos(c), -np.sin(c), 0], [np.sin(c), np.cos(c), 0], [0, 0, 1]])
    np.testing.assert_allclose(rotate(from_euler((20, -75, 130)), np.eye(3)).T, about_z @ about_y @ about_x, atol=1e-12)


def test_whole_turns_are_none() -> None:
    assert from_euler((360, -720, 0)).tolist() == [0, 0, 0, 1]


def test_axis_and_quaternion_of_any_length() -> None:
    rotation = from_axis_angle((0, 0, 7), 90)
    np.testing.assert_allclose(rotate(1e9 * rotation, [[1, 0, 0], [0, 1, 5]]), [[0, 1, 0], [-1, 0, 5]], atol=1e-12)


def test_zero_is_refused() -> None:
    with pytest.raises(InputError, match=r"^the axis of a rotation must not be zero$"):
        from_axis_angle((0, 0, 0), 3)
    with pytest.raises(InputError, match=r"^a rotation must not be the zero quaternion; the identity is"):
        rotate((0, 0, 0, 0), (1, 0, 0))
