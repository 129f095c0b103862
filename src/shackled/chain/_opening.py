"""Selection of a chain by name, or of a node by its URL."""

from __future__ import annotations

from functools import cache
from importlib.util import find_spec

from ..base.checks import choice
from ..errors import InputError
from ..ethereum._encoding import parse_address
from ._connection import PATIENCE, Connection
from ._embedded import DEFAULT_GAS_LIMIT, EmbeddedChain, PyEvmChain, PyrevmChain, RevmChain
from ._node import NodeChain

#: Names of chains, and the module that each needs.
CHAINS = {"revm": "wasmtime", "pyrevm": "pyrevm", "pyevm": "eth"}
_KINDS: dict[str, type[EmbeddedChain]] = {"revm": RevmChain, "pyrevm": PyrevmChain, "pyevm": PyEvmChain}


def open_node(url: str, address: str | None = None, timeout: float | None = None) -> NodeChain:
    """Return the chain of the node at a URL.

    address: of a deployed renderer; None uses the known one, or sends the contracts with each call. timeout: seconds
    for an answer. Raises InputError if a value is invalid.
    """
    renderer = None if address is None else parse_address(address, "`address`")
    return NodeChain(Connection(url, PATIENCE if timeout is None else timeout), open_chain(), renderer)


def check_chain(name: str, parameter: str) -> str:
    """Return the name of a chain; raise InputError, with the name of the parameter, if there is none."""
    return choice(name, parameter, CHAINS)


def open_chain(name: str | None = None, gas_limit: int | None = None) -> EmbeddedChain:
    """Return the chain of a name; None selects the embedded EVM. Raises InputError if it is unknown.

    gas_limit: of each call; None keeps the limit of the chain.
    """
    name = "revm" if name is None else check_chain(name, "the chain")
    if not find_spec(CHAINS[name]):
        package = {"pyevm": "py-evm", "pyrevm": "pyrevm, which has wheels for Python 3.11 and 3.12"}.get(name, name)
        raise InputError(f"the chain {name!r} needs a package that is not installed: {package}")
    return _opened(name, DEFAULT_GAS_LIMIT if gas_limit is None else gas_limit)


@cache
def _opened(name: str, gas_limit: int) -> EmbeddedChain:
    return _KINDS[name](gas_limit)
