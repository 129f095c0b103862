"""Compute square roots."""

from __future__ import annotations


def sqrt(x: int) -> int:
    """Return the square root of a word, with an error below one and below 2^-22 of it.

    A line that is within 3 % of the root, then two steps of Newton's method. Where the contract remembers the magnitude
    `h` of the root before, it uses it only if it is the one that would be found here.
    """
    if x == 0:
        return 0
    h = (x.bit_length() - 1) >> 1
    r = (351 * ((x >> h) + (2 << h))) >> 10
    r = (r + x // r) >> 1
    return (r + x // r) >> 1
