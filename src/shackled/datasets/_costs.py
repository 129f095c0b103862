"""Triangles of the pieces, and their gas at 128 x 128 pixels.

The pieces of the package were measured by tools/dataset_costs.py, in gas.json beside this file. Others are rendered on
request.
"""

from __future__ import annotations

import json
from functools import cache
from importlib.resources import files
from typing import NamedTuple

from ..errors import InputError
from ._piece import Piece


class Cost(NamedTuple):
    """Triangles and gas of a piece; both None if it has not been downloaded."""

    triangles: int | None
    gas: int | None


@cache
def table() -> dict[str, Cost]:
    """Return the measured costs, by the names of the pieces."""
    content = json.loads(files(__package__).joinpath("gas.json").read_text("utf-8"))
    return {name: Cost(*cost) for name, cost in content.items()}


def cost(piece: Piece) -> Cost:
    """Return the cost of a piece."""
    if piece.name in table():
        return table()[piece.name]
    if not piece.ready():
        return Cost(None, None)
    from ._drawing import draw

    try:
        drawing = draw(piece)
    except InputError:  # what was kept of it is damaged; whoever renders it is told
        return Cost(None, None)
    return Cost(drawing.triangles, drawing.gas)
