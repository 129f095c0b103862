"""Choosing where contracts run."""

from __future__ import annotations

from functools import cache
from importlib.util import find_spec

from ..errors import InputError, RenderError
from .chain import Chain
from .embedded import EmbeddedChain, PyEvmChain, PyrevmChain
from .node import NodeChain
from .reference import ReferenceChain

#: The names of chains, and the module that each needs.
CHAINS = {"pyrevm": "pyrevm", "pyevm": "eth", "reference": "numpy"}
_KINDS = {"pyrevm": PyrevmChain, "pyevm": PyEvmChain, "reference": ReferenceChain}


def open_place(chain: str | None, rpc: str | None) -> Chain:
    """The node at the address `rpc`, or the chain of that name."""
    if rpc is None:
        return open_chain(chain)
    if chain is not None:
        raise InputError("--rpc is a place of its own: leave out --chain")
    return open_node(rpc)


def open_node(url: str) -> NodeChain:
    """The node at an address; an EVM here makes the code that it is sent."""
    local = open_chain(None)
    assert isinstance(local, EmbeddedChain)
    return NodeChain(url, local)


@cache
def open_chain(name: str | None = None) -> Chain:
    """The chain of that name; None takes the fastest EVM that is installed."""
    if name is None:
        name = next((each for each in ("pyrevm", "pyevm") if find_spec(CHAINS[each])), None)
        if name is None:
            raise RenderError("there is no EVM to run the contracts: install pyrevm or py-evm")
    if name not in CHAINS:
        raise InputError(f"there is no chain {name!r}; the chains are {', '.join(CHAINS)}")
    if not find_spec(CHAINS[name]):
        raise InputError(f"the chain {name!r} needs a package that is not installed: {name.replace('pyevm', 'py-evm')}")
    chain: Chain = _KINDS[name]()
    return chain
