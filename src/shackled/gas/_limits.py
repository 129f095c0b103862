"""Exact gas of a picture, the gas limit that its call needs, and which documented limits it fits."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

from .._load import Thing, load_picture
from ..base.values import listed
from ..chain._chain import ContractChain
from ..chain._opening import open_chain
from ..ethereum._encoding import intrinsic_gas
from ..scene._codec import render_call as render_call

#: EIP-150: a call passes on all but one 64th of the gas that is left.
KEPT = 64
#: Largest transaction that nodes relay, in bytes: geth's txMaxSize, four slots of 32 KiB.
MAX_TRANSACTION = 4 * 32 * 1024
#: Bytes of a transaction besides its data: signature, addresses, fees; rounded up.
ENVELOPE = 512
#: What requests are, as `Limit.kind` has it.
KINDS_OF_LIMITS = ("transaction", "call")


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
class KnownChain:
    """A chain, as chains.toml has it.

    id: as `fit` takes it. number: as EIP-155 has it. gas: of one transaction at most. currency: the symbol of what gas
    is paid in. date: of the source of `gas`. explorer: its address, or "". node: that of one that wallets can use, for
    test networks only.
    """

    id: str
    name: str
    number: int
    gas: int
    currency: str
    source: str
    date: str
    explorer: str = ""
    node: str = ""

    @property
    def is_test(self) -> bool:
        """Whether it is a test network, or a chain for development."""
        return bool(self.node)


@cache
def known_chains() -> tuple[KnownChain, ...]:
    """Return all known chains, test networks last."""
    table = _table("chains")
    ethereum = {name: table["ethereum"][name] for name in ("gas", "source", "date")}
    return tuple(KnownChain(id, **(ethereum if "node" in each else {}) | each) for id, each in table.items())


@dataclass(frozen=True)
class Limit:
    """The gas that one request may use.

    kind: "transaction" or "call". place: the chain of a transaction; the client or service that answers a call. date:
    of the source.
    """

    name: str
    gas: int
    source: str
    date: str
    place: str
    kind: str = "call"
    remark: str = ""


@cache
def limits() -> tuple[Limit, ...]:
    """Return the limits of transactions on chains other than test networks, and of read calls, the smallest first."""
    found = [Limit(**entry) for entry in _table("limits")["limit"]]
    for chain in known_chains():
        if not chain.is_test:
            name = f"one transaction on {chain.name}"
            found.append(Limit(name, chain.gas, chain.source, chain.date, chain.name, "transaction"))
    return tuple(sorted(found, key=lambda limit: limit.gas))


def _table(name: str) -> dict[str, Any]:
    return tomllib.loads(files(__package__).joinpath(f"{name}.toml").read_text("utf-8"))


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


def fits_as_json(fits: Sequence[Fit]) -> dict[str, list[str]]:
    """Return the object that `--json` prints: the chains on which a transaction can draw, and whose read calls can."""
    return {f"{kind}s": [e.limit.place for e in fits if e.fits and e.limit.kind == kind] for kind in KINDS_OF_LIMITS}


def headline(fits: Sequence[Fit]) -> str:
    """Return what the limits mean for a picture, such as "free to read on most nodes"; names only where they help."""
    all_of = {kind: [fit.limit.place for fit in fits if fit.limit.kind == kind] for kind in KINDS_OF_LIMITS}
    chains, nodes = fits_as_json(fits).values()
    if not nodes:
        return "too much for a read call of any usual node: draw it in tiles, or with fewer pixels or triangles"
    if len(nodes) < len(all_of["call"]):
        return f"free to read on {listed(nodes)}; on other nodes in tiles"
    if not chains:
        return "free to read on most nodes; too much for a contract to draw inside a transaction"
    where = "" if len(chains) == len(all_of["transaction"]) else f" on {listed(chains)}"
    return f"free to read on most nodes; a contract can draw it inside a transaction{where}"
