"""Selection of a chain by name, a node by URL, or the NumPy reference renderer."""

from __future__ import annotations

from functools import cache
from importlib.util import find_spec

from ..errors import InputError
from ..ethereum import parse_address
from ..scene import Rectangle, Scene
from ._chain import Chain, Drawing
from ._connection import PATIENCE, Connection
from ._embedded import EmbeddedChain, PyEvmChain, PyrevmChain, RevmChain
from ._node import NodeChain


class ReferenceChain:
    """The NumPy reference renderer."""

    name = "NumPy reference"

    def draw(self, scene: Scene, tile: Rectangle | None = None) -> Drawing:
        """Render a scene, or a tile of its canvas."""
        from .. import reference

        return Drawing(reference.render(scene, tile), None, None)

    def count(self, scene: Scene, tile: Rectangle | None = None) -> tuple[int, int]:
        """Count the triangles left after culling and clipping, and the pixels of the canvas or tile that they cover."""
        from .. import reference

        return reference.count(scene, tile)


#: Names of chains, and the module that each needs.
CHAINS = {"revm": "wasmtime", "pyrevm": "pyrevm", "pyevm": "eth", "reference": "numpy"}
_KINDS = {"revm": RevmChain, "pyrevm": PyrevmChain, "pyevm": PyEvmChain, "reference": ReferenceChain}


def open_node(url: str, address: str | None = None, timeout: float | None = None) -> NodeChain:
    """Return the chain of the node at a URL.

    address: of a deployed renderer; None uses the known one, or sends the contracts with each call. timeout: seconds
    for an answer. Raises InputError if a value is invalid.
    """
    local = open_chain(None)
    assert isinstance(local, EmbeddedChain)
    renderer = None if address is None else parse_address(address, "`address`")
    return NodeChain(Connection(url, PATIENCE if timeout is None else timeout), local, renderer)


@cache
def open_chain(name: str | None = None) -> Chain:
    """Return the chain of a name; None selects the embedded EVM. Raises InputError if it is unknown."""
    if name is None:
        name = "revm"
    if name not in CHAINS:
        raise InputError(f"there is no chain {name!r}; the chains are {', '.join(CHAINS)}")
    if not find_spec(CHAINS[name]):
        package = {"pyevm": "py-evm", "pyrevm": "pyrevm, which has wheels for Python 3.11 and 3.12"}.get(name, name)
        raise InputError(f"the chain {name!r} needs a package that is not installed: {package}")
    chain: Chain = _KINDS[name]()
    return chain
