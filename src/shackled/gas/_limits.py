"""Exact gas of a picture, the gas limit that its call needs, and how it fits documented limits: see limits.toml."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

from .._load import Thing, load_picture
from ..chain import ContractChain, open_chain
from ..ethereum import intrinsic_gas
from ..scene import render_call as render_call
from ..values import listed

#: EIP-150: a call passes on all but one 64th of the gas that is left.
KEPT = 64
#: Largest transaction that nodes relay, in bytes: geth's txMaxSize, four slots of 32 KiB.
MAX_TRANSACTION = 4 * 32 * 1024
#: Bytes of a transaction besides its data: signature, addresses, fees; rounded up.
ENVELOPE = 512


@dataclass(frozen=True)
class ExactGas:
    """The gas of a render.

    gas: of the execution. intrinsic_gas: of the transaction before it. floor_gas: the least that a transaction with
    this data costs, by EIP-7623.
    """

    gas: int
    intrinsic_gas: int
    floor_gas: int

    @property
    def transaction_gas(self) -> int:
        """Return the gas that a transaction is charged."""
        return max(self.intrinsic_gas + self.gas, self.floor_gas)

    def limit(self, searched: int) -> int:
        """Return the gas limit that a request needs, if its execution needs `searched`."""
        return max(self.intrinsic_gas + searched, self.floor_gas)


def measure(thing: Thing, chain: ContractChain | None = None) -> ExactGas:
    """Measure the gas of a render. thing: as in `load`. chain: None for revm."""
    data = render_call(load_picture(thing))
    gas = (chain or open_chain()).call("Renderer", data).gas
    return ExactGas(gas, intrinsic_gas(data), floor_gas(data))


def floor_gas(data: bytes) -> int:
    """Return the least gas that a transaction with this data costs since Prague: EIP-7623."""
    return 21000 + 10 * (4 * len(data) - 3 * data.count(0))


def needed_for(gas: int) -> int:
    """Return the least gas of which all but a 64th is at least `gas`."""
    return gas + (gas - 1) // (KEPT - 1) if gas else 0


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


@dataclass(frozen=True)
class Fit:
    """The comparison of a picture with one limit.

    needed: gas limit that the request needs, or an upper bound of it. reason: why it does not fit, if gas is not the
    reason, or "".
    """

    limit: Limit
    needed: int
    fits: bool
    reason: str

    def to_json(self) -> dict[str, Any]:
        """Return the object that `--json` prints."""
        limit = self.limit
        return {
            "name": limit.name,
            "limit": limit.gas,
            "fits": self.fits,
            "source": limit.source,
            "date": limit.date,
            "remark": limit.remark,
        }


def fits_of(gas: int, calldata: bytes, suffices: Callable[[int], bool] | None = None) -> tuple[Fit, ...]:
    """Return how a picture fits into each known limit, the smallest first.

    gas: of the execution. suffices: whether the call succeeds with a given gas for the execution. It is called only
    where the bounds do not decide, since a call must be given a little more gas than it uses; without it such a limit
    counts as too small.
    """
    intrinsic, floor, size, found = intrinsic_gas(calldata), floor_gas(calldata), len(calldata), []
    for limit in limits():
        needed, reason = max(intrinsic + needed_for(gas), floor), ""
        fits = needed <= limit.gas
        if not fits and max(intrinsic + gas, floor) <= limit.gas and suffices is not None:
            fits = suffices(limit.gas - intrinsic)
            needed = limit.gas if fits else needed
        if limit.kind == "transaction" and size + ENVELOPE > MAX_TRANSACTION:
            fits, reason = False, f"its data of {size:,} bytes is more than the {MAX_TRANSACTION:,} that nodes relay"
        found.append(Fit(limit, needed, fits, reason))
    return tuple(found)


def headline(fits: Sequence[Fit]) -> str:
    """Return the result in a few words, such as "fits one transaction, and any node's read call"."""
    in_transaction = all(fit.fits for fit in fits if fit.limit.kind == "transaction")
    calls = [fit for fit in fits if fit.limit.kind == "call"]
    nodes = [fit.limit.node for fit in calls if fit.fits]
    if not nodes:
        return "fits no usual node: take fewer pixels or triangles"
    where = "any node's read call" if len(nodes) == len(calls) else f"calls of {listed(nodes)}"
    return f"fits one transaction, and {where}" if in_transaction else f"fits {where}; no transaction"
