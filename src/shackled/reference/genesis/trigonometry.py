"""Rotations by whole degrees, with the sine that the generator has always used: interpolated in a table of 256 steps a
quarter turn, with its own small errors, which every piece shows.

As contracts/src/genesis/Trigonometry.sol, which has the few values that occur as constants.
"""

from __future__ import annotations

import math

#: What stands for 1.
ONE = 10**18
PI = 3141592653589793238
TWO_PI = 2 * PI
HALF_PI = 1570796326794896619

STEPS = 256
PEAK = 2**31 - 1
TABLE = [round(math.sin(math.pi / 2 * k / STEPS) * PEAK) for k in range(STEPS + 1)]

Point = tuple[int, int]
Point3 = tuple[int, int, int]


def quotient(a: int, b: int) -> int:
    """Return a / b, rounded toward zero."""
    size = abs(a) // abs(b)
    return size if (a < 0) == (b < 0) else -size


def sine_of_angle(x: int) -> int:
    """Return the sine, times ONE, of an angle in radians, times ONE, from 0."""
    turn = 2**30 * (x % TWO_PI) // TWO_PI
    negative, falling = turn >> 29 & 1, turn >> 28 & 1
    index, fraction = turn >> 20 & 255, turn >> 4 & 0xFFFF
    if falling:
        index = 255 - index
    low, high = TABLE[index], TABLE[index + 1]
    part = (high - low) * fraction >> 16
    value = high - part if falling else low + part
    return quotient((-value if negative else value) * ONE, PEAK)


def sine(degrees: int) -> int:
    """Return the sine times ONE."""
    return sine_of_angle(degrees % 360 * PI // 180)


def cosine(degrees: int) -> int:
    """Return the cosine times ONE."""
    return sine_of_angle(degrees % 360 * PI // 180 + HALF_PI)


def rotate(x: int, y: int, degrees: int) -> Point:
    """Rotate a point of the plane about the origin."""
    c, s = cosine(degrees), sine(degrees)
    return quotient(x * c - y * s, ONE), quotient(x * s + y * c, ONE)


def rotate_x(p: Point3, degrees: int) -> Point3:
    """Rotate a point about the x axis."""
    return p[0], *rotate(p[1], p[2], degrees)


def rotate_y(p: Point3, degrees: int) -> Point3:
    """Rotate a point about the y axis, in the opposite of the usual direction."""
    x, z = rotate(p[0], p[2], degrees)
    return x, p[1], z
