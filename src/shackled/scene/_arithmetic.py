"""Arithmetic whose results are the same on each machine, and in web/src/scene/arithmetic.ts.

Rotations are quaternions (x, y, z, w); the identity is (0, 0, 0, 1).

NumPy's `@` and `norm` leave the order of sums to BLAS, and sines to the C library or the processor.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from ..base.checks import Floats, number, vector
from ..errors import InputError

#: Bits after the point of a series.
BITS = 106


def dot(a: Floats, b: Floats) -> Floats:
    """Return the scalar product along the last axis, summed from its first element to its last."""
    products = a * b
    total = products[..., 0]
    for index in range(1, products.shape[-1]):
        total = total + products[..., index]
    return np.asarray(total)


def cross(a: Floats, b: Floats) -> Floats:
    """Return the vector products of vectors, (3,) or (n, 3); for few of them faster than `np.cross`, which is equal."""
    (ax, ay, az), (bx, by, bz) = a.T, b.T
    return np.stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx], axis=-1)


def length(v: Floats) -> Floats:
    """Return the length along the last axis; infinite where a square is beyond what a float holds."""
    return np.asarray(np.sqrt(dot(v, v)))


def unit(v: Floats) -> Floats:
    """Return a vector, (n,), of any length but zero, as one of length 1."""
    v = v / np.abs(v).max()
    return np.asarray(v / length(v))


def units(v: Floats) -> Floats:
    """Return vectors, (..., n), as ones of length 1; those without a length are zero."""
    lengths = length(v)[..., None]
    return np.asarray(np.divide(v, lengths, out=np.zeros_like(v), where=lengths > 0))


def cosine(degrees: float) -> float:
    return _series(degrees)[0] / (1 << BITS)


def sine(degrees: float) -> float:
    return _series(degrees)[1] / (1 << BITS)


def tangent(degrees: float) -> float:
    """Return the tangent of an angle. ZeroDivisionError where it is infinite."""
    c, s = _series(degrees)
    return (s << BITS) // c / (1 << BITS)


def _series(degrees: float) -> tuple[int, int]:
    """Return cosine and sine, times 2^BITS, by their power series."""
    radians = math.radians(math.fmod(degrees, 360))
    x = int(abs(radians) * 2.0**BITS)
    sums, term, power = [0, 0], 1 << BITS, 0
    while term:
        sums[power % 2] += -term if power & 2 else term
        power += 1
        term = (term * x >> BITS) // power
    c, s = sums
    return c, -s if radians < 0 else s


IDENTITY = vector((0, 0, 0, 1), size=4)

#: By how much the columns of a matrix may be from unit vectors at right angles.
ORTHOGONAL = 1e-6


def from_euler(degrees: ArrayLike) -> Floats:
    """Return the rotation about the x, y, then z axis of the world, counter-clockwise seen from its end, in degrees."""
    angles = vector(degrees, "a rotation in degrees")
    x, y, z = (from_axis_angle(axis, angle) for axis, angle in zip(np.eye(3), angles, strict=True))
    return multiply(z, multiply(y, x))


def euler(x: float, y: float, z: float) -> Floats:
    """Return the rotation about the x, then the y, then the z axis of the world, each in degrees, as a quaternion."""
    return from_euler((x, y, z))


def from_axis_angle(axis: ArrayLike, degrees: float) -> Floats:
    """Return the rotation about an axis of any length but zero, counter-clockwise seen from where the axis points."""
    direction = vector(axis, "the axis of a rotation")
    if not direction.any():
        raise InputError("the axis of a rotation must not be zero")
    # whole turns off first, so that 360 degrees are exactly none
    half = math.remainder(number(degrees, "the angle of a rotation in degrees"), 360) / 2
    return np.append(unit(direction) * sine(half), cosine(half))


def multiply(second: ArrayLike, first: ArrayLike) -> Floats:
    """Return the rotation `first`, followed by `second`."""
    a, b = np.asarray(second, dtype=np.float64), np.asarray(first, dtype=np.float64)
    return np.append(a[3] * b[:3] + b[3] * a[:3] + np.cross(a[:3], b[:3]), a[3] * b[3] - dot(a[:3], b[:3]))


def rotate(quaternion: ArrayLike, points: ArrayLike) -> Floats:
    """Return the points, (3,) or (n, 3), turned by a quaternion of any length but zero."""
    q, p = unit(_rotation(quaternion)), np.asarray(points, dtype=np.float64)
    t = 2 * cross(q[:3], p)
    return np.asarray(p + q[3] * t + cross(q[:3], t))


def matrix_of(value: ArrayLike, size: int, name: str) -> Floats:
    """Return a square matrix of `size` rows of finite floats. InputError for anything else."""
    try:
        matrix = np.array(value, dtype=np.float64)
    except (TypeError, ValueError):
        matrix = np.zeros(0)
    if matrix.shape != (size, size) or not np.isfinite(matrix).all():
        raise InputError(f"{name} must be {size} x {size} finite numbers, not {value!r:.60}")
    return matrix


def quaternion_of(m: Floats) -> Floats:
    """Return the rotation of a matrix, (3, 3). InputError unless its columns are a right-handed orthonormal basis."""
    if np.abs(m.T @ m - np.eye(3)).max() > ORTHOGONAL or np.linalg.det(m) < 0:
        raise InputError("the matrix of a rotation must have unit columns at right angles, and must not mirror")
    # 4 q q^T, whose largest column has no small divisor
    trace = np.trace(m)
    squares = np.zeros((4, 4))
    squares[:3, :3] = m + m.T + (1 - trace) * np.eye(3)
    squares[3, :3] = squares[:3, 3] = (m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1])
    squares[3, 3] = 1 + trace
    largest = squares[:, np.argmax(np.diag(squares))]
    quaternion: Floats = largest / length(largest)
    return quaternion if quaternion[3] >= 0 else -quaternion


def rotation_of(value: ArrayLike, name: str = "a rotation") -> Floats:
    """Return the rotation that is meant, as a read-only quaternion (x, y, z, w).

    value: a quaternion of any length but zero, three angles in degrees about x, then y, then z, or a matrix, (3, 3).
    """
    try:
        shape = np.shape(value)
    except ValueError:  # rows of different lengths
        shape = ()
    if shape == (3,):
        value = from_euler(vector(value, name))
    elif shape == (3, 3):
        value = quaternion_of(matrix_of(value, 3, "the matrix of a rotation"))
    elif shape != (4,):
        raise InputError(
            f"{name} must be x, y, z in degrees, a quaternion x, y, z, w, or a 3 x 3 matrix, not {value!r:.60}"
        )
    return _rotation(value, name)


def _rotation(value: ArrayLike, name: str = "a rotation") -> Floats:
    quaternion = vector(value, name, 4)
    if not quaternion.any():
        raise InputError(f"{name} must not be the zero quaternion; the identity is (0, 0, 0, 1)")
    return quaternion
