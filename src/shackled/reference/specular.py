"""The table of highlights of a material."""

from __future__ import annotations

from .registers import Registers
from .roots import sqrt
from .structs import Material
from .words import MASK


def set_table(coefficient: int, shininess: int, registers: Registers) -> None:
    """Tabulate coefficient * cos^shininess over cos^2, where it is at least half a level."""
    registers.specular_root = coefficient >> 16 if shininess == 1 else 0
    if coefficient == 0 or shininess == 1:
        # no square is greater than this
        registers.specular_begin = MASK
        return
    width = 13
    k = 1 << 32
    while k < coefficient:
        width += 2
        k <<= 1
    width = min((width << 24) // shininess, 1 << 24)
    begin = (1 << 24) - width
    registers.specular_begin = begin
    registers.specular_scale = (64 << 40) // width
    registers.specular_offset = begin * registers.specular_scale >> 16
    last = (coefficient * power(1 << 24, shininess)) >> 48
    table = [0] * 64 + [last << 128]
    for i in reversed(range(64)):
        value = (coefficient * power(begin + width * i // 64, shininess)) >> 48
        table[i] = ((value << 128) | ((last - value) & MASK)) & MASK
        last = value
    registers.specular_table = table


def power(square: int, exponent: int) -> int:
    """Return square^(exponent / 2), where square is Q24 and the result Q32."""
    base = square << 8
    result = sqrt(base << 32) if exponent & 1 else 1 << 32
    exponent >>= 1
    while exponent:
        if exponent & 1:
            result = (result * base) >> 32
        base = (base * base) >> 32
        exponent >>= 1
    return result


def half_reach(coefficient: int, shininess: int, focal: int) -> int:
    """Return up to which sum of the squares of two edges, in sub-pixels, half vectors may be interpolated.

    focal: in sub-pixels; 0 for an orthographic camera, for which they are constant. See the contract.
    """
    slope = (sqrt(shininess << 64) * coefficient) >> 32
    return (11 * focal * focal << 26) // slope if slope and focal else 1 << 60


def half_slope(coefficient: int, shininess: int) -> int:
    """Return the slope of the highlight at its maximum, in 84ths of a level of 255, Q10."""
    return (3109 * shininess * coefficient) >> 32


def is_broad(material: Material) -> bool:
    """Return whether the highlight is the cosine itself.

    Over its square, where the others are tabulated, it is too steep near zero to be interpolated, and each fragment
    takes the root.
    """
    return material.shininess == 1 and material.specular != 0
