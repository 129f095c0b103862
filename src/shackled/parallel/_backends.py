"""Backends: where the parts of pictures are rendered, and how their answers are verified."""

from __future__ import annotations

import random
from dataclasses import dataclass
from typing import Protocol

from ..chain._chain import Chain, Drawing
from ..chain._embedded import RevmChain
from ..chain._failures import out_of_gas
from ..chain._opening import open_chain
from ..scene._codec import Rectangle
from ..scene._scene import Scene

#: Where a sample is verified: one part in so many, besides the first one of each backend.
SAMPLE = 8


@dataclass(frozen=True)
class Part:
    """A tile of a frame, rendered by one call; frames are numbered from 0."""

    frame: int
    tile: Rectangle


def draw_part(chain: Chain, scene: Scene, tile: Rectangle) -> Drawing:
    """Render a tile of a frame."""
    is_whole = (tile.width, tile.height) == (scene.width, scene.height)
    return chain.draw(scene, None if is_whole else tile)


class Backend(Protocol):
    """Renders parts.

    slots: how many parts at a time. untrusted: whether its answers may be wrong.
    gas: limit of a call; None where there is none.
    """

    slots: int
    untrusted: bool
    gas: int | None

    @property
    def name(self) -> str:
        """Return the name that messages show."""

    def render(self, scene: Scene, tile: Rectangle) -> Drawing:
        """Render a part; as many threads as there are slots may call this."""

    def check(self) -> list[str]:
        """Return what is to be told while parts are rendered, here nothing; RenderError if none can be any more."""
        return []

    def close(self) -> None:
        """Stop what still runs; may be called while it renders, and more than once."""


class ChainBackend(Backend):
    """A chain: an EVM in this process, or a node, with so many calls at a time."""

    def __init__(self, chain: Chain, slots: int = 1, untrusted: bool = False, gas: int | None = None) -> None:
        self.chain, self.slots, self.untrusted, self.gas = chain, slots, untrusted, gas

    @property
    def name(self) -> str:
        """Return the name of the chain, and the number of threads where several call the embedded EVM."""
        is_threaded = self.slots > 1 and isinstance(self.chain, RevmChain)
        return self.chain.name + (f", {self.slots} threads" if is_threaded else "")

    def render(self, scene: Scene, tile: Rectangle) -> Drawing:
        """Render a part; raise OutOfGasError if it took more gas than the limit."""
        piece = draw_part(self.chain, scene, tile)
        if self.gas is not None and piece.gas is not None and piece.gas > self.gas:
            raise out_of_gas(self.gas)
        return piece

    def close(self) -> None:
        """End the calls of several threads, where the chain can be stopped; one slot may be a caller's chain."""
        if self.slots > 1 and isinstance(self.chain, RevmChain) and self.chain.is_stoppable:
            self.chain.stop()


class Verifier:
    """Renders parts again in the embedded EVM, to compare them with the answers of untrusted backends."""

    def __init__(self, every: bool) -> None:
        """Open the chain. every: whether each part is compared, or a random sample."""
        self._every = every
        self._chain = open_chain()
        self._chain.address("Renderer")  # set up here, before several threads ask for it

    def selects(self, first: bool) -> bool:
        """Return whether to compare a part. first: whether it is the first one of its backend."""
        return self._every or first or random.randrange(SAMPLE) == 0

    def draw(self, scene: Scene, tile: Rectangle) -> Drawing:
        """Render the part; raise RenderError if the contracts refuse it."""
        return draw_part(self._chain, scene, tile)
