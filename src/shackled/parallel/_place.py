"""A place where parts are rendered, several at a time if it has several seats."""

from __future__ import annotations

from typing import Protocol

from ..chain import Chain, Drawing, out_of_gas
from ..scene import Rectangle, Scene
from ._part import draw_part


class Place(Protocol):
    """Where parts are rendered.

    seats: how many parts at a time. distant: whether its answers come from somewhere that could be wrong.
    gas: what a call may use; None where there is no such limit.
    """

    seats: int
    distant: bool
    gas: int | None

    @property
    def name(self) -> str:
        """What it is, for people."""

    def work(self, seat: int, scene: Scene, tile: Rectangle) -> Drawing:
        """Renders a part; seats are numbered from 0, and each does one part at a time."""

    def close(self) -> None:
        """Stops what still runs. It may be called while seats work, and more than once."""


class ChainPlace:
    """A chain: in this process, or a node, with so many calls at a time."""

    def __init__(self, chain: Chain, seats: int = 1, distant: bool = False, gas: int | None = None) -> None:
        """See `Place`."""
        self.chain, self.seats, self.distant, self.gas = chain, seats, distant, gas

    @property
    def name(self) -> str:
        """That of the chain."""
        return self.chain.name

    def work(self, seat: int, scene: Scene, tile: Rectangle) -> Drawing:
        """Renders a part."""
        piece = draw_part(self.chain, scene, tile)
        if self.gas is not None and piece.gas is not None and piece.gas > self.gas:
            raise out_of_gas(self.gas)
        return piece

    def close(self) -> None:
        """Nothing runs on."""
