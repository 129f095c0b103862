"""Structures: the arrangements of the prisms of a piece.

As contracts/src/genesis/Structures.sol.
"""

from __future__ import annotations

from dataclasses import dataclass

from .random import Random

SWARM = 3
EXTRUDED = 5
UNIFORM = 6

#: The names, and the last of the draws 0..8000 that give each.
BOUNDS = {
    "Verticalized": 1000,
    "Adjoint": 3000,
    "Cetacean": 3500,
    "Swarm": 4500,
    "Isomorphic": 5000,
    "Extruded": 6000,
    "Uniform": 8000,
}


@dataclass(frozen=True)
class Structure:
    """The rules of a layout.

    first_radius: of the first triangle; None is drawn. sizes_vary: whether triangles differ in size.
    opposite: the chance in percent that a triangle is laid point to point with another one, not beside it.
    opposite_again, adjacent_again: the chances that another one of its kind follows.
    """

    index: int
    name: str
    first_radius: int | None
    max_prisms: int
    min_radius: int
    max_radius: int
    sizes_vary: bool
    opposite: int
    opposite_again: int
    adjacent_again: int


def choose_structure(random: Random) -> Structure:
    """Choose the structure of a piece."""
    value = random.draw("specId", low=0, high=8000)
    index, name = next((i, name) for i, (name, bound) in enumerate(BOUNDS.items()) if value <= bound)
    most = random.draw("maxPrisms", low=8, high=16)
    first, max_prisms, low, high, vary, opposite, opposite_again, adjacent_again = (
        (12000, most, 4800, 14400, True, 100, 100, 0),
        (12000, most, 4800, 14400, True, 0, 0, 100),
        (None, 8, 14400, 19200, True, 50, 50, 50),
        (None, 16, 4800, 9600, True, 50, 0, 0),
        (None, most, 4800, 14400, False, 50, 50, 50),
        (None, 10, 4800, 14400, True, 50, 50, 50),
        (None, 12, 4800, 14400, True, 50, 50, 50),
    )[index]
    return Structure(index, name, first, max_prisms, low, high, vary, opposite, opposite_again, adjacent_again)
