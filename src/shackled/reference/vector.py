"""Vectors, quaternions and matrices of Q32 fixed-point numbers: tuples of integers."""

from __future__ import annotations

from .roots import sqrt
from .words import divide_signed

Vector = tuple[int, int, int]
Quaternion = tuple[int, int, int, int]
#: The columns: the images of the three axes.
Matrix = tuple[Vector, Vector, Vector]


def subtract(a: Vector, b: Vector) -> Vector:
    """Return a - b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def scale(a: Vector, k: int) -> Vector:
    """Multiply a vector by a Q32 number, rounded down."""
    return (a[0] * k) >> 32, (a[1] * k) >> 32, (a[2] * k) >> 32


def dot(a: Vector, b: Vector) -> int:
    """Return the scalar product, with one rounding for the sum."""
    return (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) >> 32


def cross(a: Vector, b: Vector) -> Vector:
    """Return the cross product, each product rounded down."""
    return (
        (a[1] * b[2] >> 32) - (a[2] * b[1] >> 32),
        (a[2] * b[0] >> 32) - (a[0] * b[2] >> 32),
        (a[0] * b[1] >> 32) - (a[1] * b[0] >> 32),
    )


def normalize(a: Vector) -> Vector:
    """Return the unit vector along `a`; zero for zero."""
    x, y, z = a[0] << 60, a[1] << 60, a[2] << 60
    square = x * x + y * y + z * z
    root = sqrt(square)
    if root == 0:
        return a
    # one more step of Newton's method, for 32 bits
    length = (root + square // root) >> 1
    # rounded to nearest, so that the axes stay what they are
    x, y, z = (divide_signed(component << 36, length) + 8 >> 4 for component in (x, y, z))
    return x, y, z


def to_matrix(q: Quaternion) -> Matrix:
    """Return the rotation matrix of a quaternion of any length but zero."""
    x, y, z, w = q
    n = x * x + y * y + z * z + w * w

    def part(numerator: int) -> int:
        return divide_signed(numerator << 32, n)

    return (
        (part(n - 2 * (y * y + z * z)), part(2 * (x * y + z * w)), part(2 * (x * z - y * w))),
        (part(2 * (x * y - z * w)), part(n - 2 * (x * x + z * z)), part(2 * (y * z + x * w))),
        (part(2 * (x * z + y * w)), part(2 * (y * z - x * w)), part(n - 2 * (x * x + y * y))),
    )


def transposed_times(m: Matrix, v: Vector) -> Vector:
    """Return the inverse rotation of `v`."""
    return dot(m[0], v), dot(m[1], v), dot(m[2], v)
