"""Convert colours between sRGB (IEC 61966-2-1) and linear values, by tables with linear interpolation."""

from __future__ import annotations


def linear(value: float) -> float:
    """Return the linear value of a level, both 0..1."""
    return float(value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4)


def level(value: float) -> float:
    """Return the level of a linear value, both 0..1."""
    return float(12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055)


#: 255 times the linear value of the levels 0, 4, 8 ... 256, Q7.
DECODE = [round(128 * 255 * linear(4 * i / 255)) for i in range(65)]
#: The levels, Q8, of the linear values 2^(7 + i / 8) * (1 + (i mod 8) / 8), Q16; the last once more.
ENCODE = [round(256 * 255 * level(2 ** (7 + i // 8) * (1 + i % 8 / 8) / 65536)) for i in range(73)]
ENCODE.append(ENCODE[-1])


def decode(value: int) -> int:
    """Return the linear level of a level, both Q10, 0..255."""
    first, second = DECODE[value >> 12], DECODE[(value >> 12) + 1]
    return (first + ((second - first) * (value & 0xFFF) >> 12)) << 3


def encode(value: int) -> int:
    """Return the level, Q8, of a linear value, Q16, 0..1."""
    if value < 128:
        return value * 3295 >> 8
    shift = value.bit_length() - 4
    entry = value >> shift
    rest = value - (entry << shift)
    index = 8 * (shift - 4) + entry - 8
    return ENCODE[index] + ((ENCODE[index + 1] - ENCODE[index]) * rest >> shift)
