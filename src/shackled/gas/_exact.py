"""The gas of a picture, exactly, and what a call must be given for it."""

from __future__ import annotations

from dataclasses import dataclass

from ..artifacts import artifact
from ..chain import Chain, ContractChain
from ..errors import InputError
from ..scene import Scene, encode
from ._runs import engine_calls

#: EIP-150: of the gas left, a call is handed all but one 64th.
KEPT = 64


@dataclass(frozen=True)
class Exact:
    """What a render costs.

    gas: of the execution. intrinsic_gas: what a transaction costs before it. engine_gas: the part of `gas` that the
    Renderer's calls of its engines use; dearest_call: that of the one that uses most. floor_gas: the least that a
    transaction with this data costs, by EIP-7623.
    """

    gas: int
    intrinsic_gas: int
    engine_gas: int
    dearest_call: int
    floor_gas: int

    @property
    def transaction_gas(self) -> int:
        """What a transaction is charged."""
        return max(self.intrinsic_gas + self.gas, self.floor_gas)

    def limit(self, searched: int) -> int:
        """Return the gas limit that a request needs, if its execution needs `searched`."""
        return max(self.intrinsic_gas + searched, self.floor_gas)


def counting(chain: Chain) -> ContractChain:
    """Return the chain, if it counts gas; otherwise InputError."""
    if not isinstance(chain, ContractChain):
        raise InputError(f"gas is counted where contracts run, not by the {chain.name}: take `chain` pyrevm or pyevm")
    return chain


def render_call(scene: Scene) -> bytes:
    """Return the data of the call `Renderer.render`."""
    return encode(artifact("Renderer").selectors["render"], scene)


def measure(scene: Scene, chain: ContractChain) -> Exact:
    """Renders the scene, and its part in the engines."""
    data = render_call(scene)
    result = chain.call("Renderer", data)
    gas = [call.result.gas for call in engine_calls(scene, chain)]
    return Exact(result.gas, result.intrinsic_gas, sum(gas), max(gas), floor_gas(data))


def floor_gas(data: bytes) -> int:
    """Return what a transaction with this data costs at least, since Prague."""
    return 21000 + 10 * (4 * len(data) - 3 * data.count(0))


def needed_for(gas: int) -> int:
    """Return the least gas of which all but a 64th is at least `gas`."""
    return gas + (gas - 1) // (KEPT - 1) if gas else 0


@dataclass(frozen=True)
class Margin:
    """Why a limit of exactly the gas that is used does not suffice.

    kept: gas that must be left when an engine is called for the dearest run of objects, because a 64th of what is there
        is not handed on.
    after: gas that the Renderer uses behind that call, which comes out of what was kept.
    """

    kept: int
    after: int

    @property
    def gas(self) -> int:
        """By how much the limit exceeds what is used."""
        return self.kept - self.after


def margin(exact: Exact, searched: int) -> Margin:
    """Return the account of the difference between what a call uses and the least limit that it needs."""
    kept = needed_for(exact.dearest_call) - exact.dearest_call
    return Margin(kept, kept - (searched - exact.gas))
