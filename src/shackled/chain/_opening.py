"""Choosing where contracts run, or the NumPy renderer in their place."""

from __future__ import annotations

from functools import cache
from importlib.util import find_spec

from ..errors import ChainError, InputError
from ..ethereum import parse_address
from ..scene import Rectangle, Scene
from ._chain import Chain, Drawing
from ._connection import PATIENCE, Connection
from ._embedded import EmbeddedChain, PyEvmChain, PyrevmChain
from ._node import NodeChain


class ReferenceChain:
    """The NumPy reference renderer."""

    name = "NumPy reference"

    def draw(self, scene: Scene, tile: Rectangle | None = None) -> Drawing:
        """Return the picture of a scene, or of a part of its canvas."""
        from .. import reference

        return Drawing(reference.render(scene, tile), None, None)

    def count(self, scene: Scene, tile: Rectangle | None = None) -> tuple[int, int]:
        """Count the triangles left after culling and clipping, and the pixels of the canvas or tile that they cover."""
        from .. import reference

        return reference.count(scene, tile)


#: The names of chains, and the module that each needs.
CHAINS = {"pyrevm": "pyrevm", "pyevm": "eth", "reference": "numpy"}
_KINDS = {"pyrevm": PyrevmChain, "pyevm": PyEvmChain, "reference": ReferenceChain}


def open_node(url: str, address: str | None = None, timeout: float | None = None) -> NodeChain:
    """Return the node at an address.

    address: of a renderer that is deployed there; None takes the one that is known, or brings it along. timeout:
    seconds for an answer. InputError for what is none.
    """
    local = open_chain(None)
    assert isinstance(local, EmbeddedChain)
    renderer = None if address is None else parse_address(address, "`address`")
    return NodeChain(Connection(url, PATIENCE if timeout is None else timeout), local, renderer)


@cache
def open_chain(name: str | None = None) -> Chain:
    """Return the chain of that name; None takes the fastest EVM that is installed."""
    if name is None:
        name = next((each for each in ("pyrevm", "pyevm") if find_spec(CHAINS[each])), None)
        if name is None:
            raise ChainError("there is no EVM to run the contracts: install pyrevm or py-evm")
    if name not in CHAINS:
        raise InputError(f"there is no chain {name!r}; the chains are {', '.join(CHAINS)}")
    if not find_spec(CHAINS[name]):
        raise InputError(f"the chain {name!r} needs a package that is not installed: {name.replace('pyevm', 'py-evm')}")
    chain: Chain = _KINDS[name]()
    return chain
