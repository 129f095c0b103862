"""Finds nodes that answer wrongly: what they drew is drawn once more in this process, and compared.

The EVM that is compiled draws it, and where there is none, the NumPy reference: the same bytes, and no gas.
"""

from __future__ import annotations

import random

from ..chain import Drawing, PyrevmChain, open_chain
from ..scene import Rectangle, Scene
from ._part import draw_part

#: Where not all parts are compared: one in so many, besides the first one of each place.
SAMPLE = 8


class Referee:
    """Draws parts again. The same calls of the same contracts must return the same bytes everywhere."""

    def __init__(self, every: bool) -> None:
        """every: whether each part is compared, or a sample that no node can know."""
        self._every = every
        self._chain = open_chain(None)
        if isinstance(self._chain, PyrevmChain):
            self._chain.address("Renderer")  # set up here, before several threads ask for it
        else:
            self._chain = open_chain("reference")

    def wants(self, first: bool) -> bool:
        """Whether a part shall be compared. first: it is the first one of its place."""
        return self._every or first or random.randrange(SAMPLE) == 0

    def draw(self, scene: Scene, tile: Rectangle) -> Drawing:
        """The part as it should be. RenderError if the contracts refuse it."""
        return draw_part(self._chain, scene, tile)
