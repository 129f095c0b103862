"""The exact gas of a picture, and the gas limit that its call needs."""

from __future__ import annotations

from dataclasses import dataclass

from ..artifacts import artifact
from ..chain import Chain, ContractChain
from ..errors import InputError
from ..scene import Scene, encode
from ._runs import engine_calls

#: EIP-150: a call passes on all but a 64th of the remaining gas.
KEPT = 64


@dataclass(frozen=True)
class Exact:
    """The gas of a render.

    gas: gas of the execution.
    intrinsic_gas: gas that a transaction pays before it.
    engine_gas: the part of `gas` used by the calls to engines.
    dearest_call: gas of the most expensive of these calls.
    floor_gas: minimum of a transaction with this calldata, by EIP-7623.
    """

    gas: int
    intrinsic_gas: int
    engine_gas: int
    dearest_call: int
    floor_gas: int

    @property
    def transaction_gas(self) -> int:
        """Gas that a transaction is charged."""
        return max(self.intrinsic_gas + self.gas, self.floor_gas)

    def limit(self, searched: int) -> int:
        """Return the gas limit of a request whose execution needs a limit of `searched`."""
        return max(self.intrinsic_gas + searched, self.floor_gas)


def counting(chain: Chain) -> ContractChain:
    """Return the chain. InputError if it does not count gas."""
    if not isinstance(chain, ContractChain):
        raise InputError(f"gas is counted where contracts run, not by the {chain.name}: take `chain` pyrevm or pyevm")
    return chain


def render_call(scene: Scene) -> bytes:
    """Return the calldata of `Renderer.render`."""
    return encode(artifact("Renderer").selectors["render"], scene)


def measure(scene: Scene, chain: ContractChain) -> Exact:
    """Measure the gas of a render, and of its engine calls."""
    data = render_call(scene)
    result = chain.call("Renderer", data)
    gas = [call.result.gas for call in engine_calls(scene, chain)]
    return Exact(result.gas, result.intrinsic_gas, sum(gas), max(gas), floor_gas(data))


def floor_gas(data: bytes) -> int:
    """Return the minimum gas of a transaction with this calldata, since Prague."""
    return 21000 + 10 * (4 * len(data) - 3 * data.count(0))


def needed_for(gas: int) -> int:
    """Return the lowest amount of which all but a 64th is at least `gas`."""
    return gas + (gas - 1) // (KEPT - 1) if gas else 0


@dataclass(frozen=True)
class Margin:
    """The difference between the lowest sufficient gas limit and the gas used.

    kept: gas that the Renderer retains during the most expensive engine call, because a 64th is not passed on.
    after: gas that the Renderer uses after that call, paid from what it retained.
    """

    kept: int
    after: int

    @property
    def gas(self) -> int:
        """Gas by which the limit exceeds the gas used."""
        return self.kept - self.after


def margin(exact: Exact, searched: int) -> Margin:
    """Return the difference between the lowest sufficient limit, `searched`, and the gas used."""
    kept = needed_for(exact.dearest_call) - exact.dearest_call
    return Margin(kept, kept - (searched - exact.gas))
