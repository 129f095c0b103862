"""Arithmetic that is the same on each machine."""

from __future__ import annotations

import hashlib
import math
import struct

import pytest

from shackled.scene._arithmetic import cosine, sine, tangent

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
