"""The EVM in which a process renders its parts."""

from __future__ import annotations

from functools import cache

from ..chain import Chain, Drawing, EmbeddedChain, open_chain
from ..errors import InputError
from ..scene import Rectangle, Scene
from ._part import draw_part


@cache
def limited(chain: str | None, gas: int | None) -> Chain:
    """The chain of that name, of which each call gets that much gas; None leaves it as it is."""
    place = open_chain(chain)
    if gas is None:
        return place
    if not isinstance(place, EmbeddedChain):
        raise InputError(f"the chain {chain!r} counts no gas: leave out `gas_limit`")
    return type(place)(gas)


def draw_limited(chain: str | None, gas: int | None, scene: Scene, tile: Rectangle) -> Drawing:
    """Draw a part of a frame in this process, by `limited`."""
    return draw_part(limited(chain, gas), scene, tile)
