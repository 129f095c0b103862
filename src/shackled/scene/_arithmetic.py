"""Arithmetic whose results are the same on each machine, and in web/src/scene/arithmetic.ts.

NumPy's `@` and `norm` leave the order of sums to BLAS, and sines to the C library or the processor.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Bits after the point of a series.
BITS = 106


def dot(a: Array, b: Array) -> Array:
    """Return the scalar product along the last axis, summed from its first element to its last."""
    products = a * b
    total = products[..., 0]
    for index in range(1, products.shape[-1]):
        total = total + products[..., index]
    return np.asarray(total)


def cross(a: Array, b: Array) -> Array:
    """Return the vector products of vectors, (3,) or (n, 3); for few of them faster than `np.cross`, which is equal."""
    (ax, ay, az), (bx, by, bz) = a.T, b.T
    return np.stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx], axis=-1)


def length(v: Array) -> Array:
    """Return the length along the last axis; infinite where a square is beyond what a float holds."""
    return np.asarray(np.sqrt(dot(v, v)))


def unit(v: Array) -> Array:
    """Return a vector, (n,), of any length but zero, as one of length 1."""
    v = v / np.abs(v).max()
    return np.asarray(v / length(v))


def cosine(degrees: float) -> float:
    """Return the cosine of an angle."""
    return _series(degrees)[0] / (1 << BITS)


def sine(degrees: float) -> float:
    """Return the sine of an angle."""
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
