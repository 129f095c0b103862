"""Arithmetic on words of 256 bits where Python's differs.

The renderer packs several numbers into a word and lets a signed number borrow from the lane above it, so the reference
keeps the packed words too: they are Python integers, taken modulo 2^256 wherever the bits above matter.
"""

from __future__ import annotations

MASK = (1 << 256) - 1


def signed(word: int) -> int:
    """Return a word (any integer, taken modulo 2^256) as a two's complement number."""
    word &= MASK
    return word - (word >> 255 << 256)


def divide(a: int, b: int) -> int:
    """Divide words without sign; zero if the divisor is zero modulo 2^256."""
    b &= MASK
    return (a & MASK) // b if b else 0


def divide_signed(a: int, b: int) -> int:
    """Divide, rounding toward zero; zero if `b` is."""
    if b == 0:
        return 0
    quotient = abs(a) // abs(b)
    return quotient if (a < 0) == (b < 0) else -quotient


def color_lanes(color: int) -> int:
    """Spread 0xRRGGBB to three lanes."""
    return (color & 0xFF) | ((color & 0xFF00) << 48) | ((color & 0xFF0000) << 96)
