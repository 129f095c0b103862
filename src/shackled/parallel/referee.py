"""Finds nodes that answer wrongly: what they drew is drawn once more in the EVM of this process, and compared.

Where only the slow EVM of Python is installed, other nodes are asked first, and it decides where they disagree.
"""

from __future__ import annotations

import random

import numpy as np

from ..chain import open_chain
from ..chain.embedded import EmbeddedChain, PyrevmChain
from ..scene.codec import Rectangle
from ..scene.scene import Scene
from .part import Piece, draw_part

#: One in so many parts is checked, besides the first one of each place.
SAMPLE = 8
#: What the slow EVM of Python is asked to check at most.
SLOW_PIXELS, SLOW_FACES = 64 * 64, 1000


class Referee:
    """Draws parts again. The same calls of the same contracts must return the same bytes everywhere."""

    def __init__(self) -> None:
        """Its EVM is the fastest that is installed."""
        self._chain = open_chain(None)
        if isinstance(self._chain, EmbeddedChain):
            self._chain.address("Renderer")  # set up here, before several threads ask for it
        self.fast = isinstance(self._chain, PyrevmChain)

    def wants(self, scene: Scene, tile: Rectangle, first: bool, peers: bool) -> bool:
        """Whether a part shall be checked: the first one of a place, and some that no node can know.

        peers: whether there are other nodes to ask.
        """
        if self.fast or peers:
            return first or random.randrange(SAMPLE) == 0
        faces = sum(len(np.asarray(o.mesh.faces)) for o in scene.objects)
        return first and tile.width * tile.height <= SLOW_PIXELS and faces <= SLOW_FACES

    def agrees(self, scene: Scene, tile: Rectangle, piece: Piece) -> bool:
        """Whether a part is right."""
        return self.draw(scene, tile, piece.lit_pixels is not None).same(piece)

    def draw(self, scene: Scene, tile: Rectangle, count: bool) -> Piece:
        """The part as it should be. RenderError if the contracts refuse it."""
        return draw_part(self._chain, scene, tile, count)
