"""Square roots."""

from __future__ import annotations


def sqrt(x: int) -> int:
    """The square root of a word, with an error below one and below 2^-22 of it: a line, then two steps of Newton's method."""
    if x == 0:
        return 0
    h = (x.bit_length() - 1) >> 1
    r = (351 * ((x >> h) + (2 << h))) >> 10
    r = (r + x // r) >> 1
    return (r + x // r) >> 1
