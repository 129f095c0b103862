"""Exact gas of a picture, the gas limit that its call needs, and documented limits: see limits.toml."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from .._load import Thing, load_picture
from ..chain import Chain, ContractChain, open_chain
from ..errors import InputError
from ..scene import render_call as render_call
from ._runs import engine_calls

#: EIP-150: a call passes on all but one 64th of the gas that is left.
KEPT = 64


@dataclass(frozen=True)
class ExactGas:
    """The gas of a render.

    gas: of the execution. intrinsic_gas: of the transaction before it. engine_gas: the part of `gas` that calls of
    engines use; dearest_call: that of the most expensive call. floor_gas: the least that a transaction with this data
    costs, by EIP-7623.
    """

    gas: int
    intrinsic_gas: int
    engine_gas: int
    dearest_call: int
    floor_gas: int

    @property
    def transaction_gas(self) -> int:
        """Return the gas that a transaction is charged."""
        return max(self.intrinsic_gas + self.gas, self.floor_gas)

    def limit(self, searched: int) -> int:
        """Return the gas limit that a request needs, if its execution needs `searched`."""
        return max(self.intrinsic_gas + searched, self.floor_gas)


def counting(chain: Chain) -> ContractChain:
    """Return the chain if it counts gas; otherwise raise InputError."""
    if not isinstance(chain, ContractChain):
        raise InputError(f"the {chain.name} counts no gas: use `chain` revm, pyrevm or pyevm")
    return chain


def measure(thing: Thing, chain: ContractChain | None = None) -> ExactGas:
    """Measure the gas of a render, and of its calls of the engines. thing: as in `load`. chain: None for revm."""
    scene, where = load_picture(thing), chain or open_chain()
    assert isinstance(where, ContractChain)
    data = render_call(scene)
    result = where.call("Renderer", data)
    gas = [call.result.gas for call in engine_calls(scene, where)]
    return ExactGas(result.gas, result.intrinsic_gas, sum(gas), max(gas), floor_gas(data))


def floor_gas(data: bytes) -> int:
    """Return the least gas that a transaction with this data costs since Prague: EIP-7623."""
    return 21000 + 10 * (4 * len(data) - 3 * data.count(0))


def needed_for(gas: int) -> int:
    """Return the least gas of which all but a 64th is at least `gas`."""
    return gas + (gas - 1) // (KEPT - 1) if gas else 0


@dataclass(frozen=True)
class Margin:
    """Why a limit of exactly the gas that is used does not suffice.

    kept: gas that must be left when an engine is called for the most expensive run, because a 64th is not passed on.
    after: gas that the Renderer uses after that call, which comes out of what was kept.
    """

    kept: int
    after: int

    @property
    def gas(self) -> int:
        """Return the difference between the limit that is needed and the gas that is used."""
        return self.kept - self.after


def margin(exact: ExactGas, searched: int) -> Margin:
    """Return the account of the difference between what a call uses and the least limit that it needs."""
    kept = needed_for(exact.dearest_call) - exact.dearest_call
    return Margin(kept, kept - (searched - exact.gas))


@dataclass(frozen=True)
class Limit:
    """The gas that one request may use.

    kind: "transaction" or "call". node: the client or service that has it; "" for a transaction. date: of the source.
    """

    name: str
    gas: int
    kind: str
    source: str
    date: str
    node: str = ""
    remark: str = ""


@cache
def limits() -> tuple[Limit, ...]:
    """Return all known limits, the smallest first."""
    data = tomllib.loads(files(__package__).joinpath("limits.toml").read_text("utf-8"))
    return tuple(sorted((Limit(**entry) for entry in data["limit"]), key=lambda limit: limit.gas))
