"""Rotations as quaternions (x, y, z, w); the identity is (0, 0, 0, 1)."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..checks import number, vector
from ..errors import InputError


def from_euler(degrees: ArrayLike) -> NDArray[np.float64]:
    """The rotation about the x, then the y, then the z axis of the world, each in degrees.

    Counter-clockwise as seen from the positive end of the axis.
    """
    x, y, z = vector(degrees, "a rotation in degrees")
    about_x, about_y, about_z = (
        from_axis_angle((1, 0, 0), x),
        from_axis_angle((0, 1, 0), y),
        from_axis_angle((0, 0, 1), z),
    )
    return multiply(about_z, multiply(about_y, about_x))


def from_axis_angle(axis: ArrayLike, degrees: float) -> NDArray[np.float64]:
    """The rotation about an axis of any length but zero, counter-clockwise as seen from where the axis points."""
    direction = vector(axis, "the axis of a rotation")
    length = np.linalg.norm(direction)
    if length == 0:
        raise InputError("the axis of a rotation must not be zero")
    # whole turns off first, so that 360 degrees are exactly none
    half = math.radians(math.remainder(number(degrees, "the angle of a rotation in degrees"), 360)) / 2
    return np.append(direction / length * math.sin(half), math.cos(half))


def multiply(second: ArrayLike, first: ArrayLike) -> NDArray[np.float64]:
    """The rotation `first`, followed by `second`."""
    a, b = np.asarray(second, dtype=np.float64), np.asarray(first, dtype=np.float64)
    return np.append(a[3] * b[:3] + b[3] * a[:3] + np.cross(a[:3], b[:3]), a[3] * b[3] - a[:3] @ b[:3])


def rotate(quaternion: ArrayLike, points: ArrayLike) -> NDArray[np.float64]:
    """The points, (3,) or (n, 3), turned by a quaternion of any length but zero."""
    q, p = vector(quaternion, "a rotation", 4), np.asarray(points, dtype=np.float64)
    if not q.any():
        raise InputError("a rotation must not be the zero quaternion; the identity is (0, 0, 0, 1)")
    q = q / np.abs(q).max()
    q = q / np.linalg.norm(q)
    t = 2 * np.cross(q[:3], p)
    return np.asarray(p + q[3] * t + np.cross(q[:3], t))
