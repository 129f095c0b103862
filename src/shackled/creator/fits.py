"""Where a picture fits: in a transaction, and in the calls that nodes allow."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ..errors import OutOfGasError
from ..gas import KEPT, Limit, floor_gas, limits

#: Bytes of a transaction, at most, that nodes pass on to each other: geth's txMaxSize, four slots of 32 KiB.
MAX_TRANSACTION = 4 * 32 * 1024
#: Bytes of a transaction about its data: signature, addresses, fees; generously.
ENVELOPE = 512


@dataclass(frozen=True)
class Fit:
    """Whether a picture fits into one limit.

    kind: "transaction" or "call". limit: in gas. needed: the gas limit that the request needs, or a bound above it.
    share: needed over limit. reason: why it does not fit, if gas is not the reason, or "". source, date, remark: of the
    limit.
    """

    name: str
    kind: str
    limit: int
    needed: int
    fits: bool
    reason: str
    source: str
    date: str
    remark: str

    @property
    def share(self) -> float:
        """Of the limit, how much is needed; 1 is all."""
        return self.needed / self.limit


def places(
    gas: int, intrinsic_gas: int, calldata: bytes, suffices: Callable[[int], bool] | None = None
) -> tuple[Fit, ...]:
    """How a picture fits into each limit that is known, the smallest first.

    gas: of the execution. suffices: whether the call does with so much gas for the execution; it is asked only where
    the bounds leave that open, for a call must be given a little more than it uses. Without it such a place counts as
    too small.
    """
    floor = floor_gas(calldata)
    least, enough = gas, gas + gas // (KEPT - 1) + 1
    return tuple(_fit(limit, least, enough, intrinsic_gas, floor, len(calldata), suffices) for limit in limits())


def _fit(
    limit: Limit,
    least: int,
    enough: int,
    intrinsic: int,
    floor: int,
    size: int,
    suffices: Callable[[int], bool] | None,
) -> Fit:
    needed = max(intrinsic + enough, floor)
    fits = needed <= limit.gas
    if not fits and max(intrinsic + least, floor) <= limit.gas and suffices is not None:
        fits = suffices(limit.gas - intrinsic)
        needed = limit.gas if fits else needed
    reason = ""
    if limit.kind == "transaction" and size + ENVELOPE > MAX_TRANSACTION:
        fits, reason = False, f"its data of {size:,} bytes is more than the {MAX_TRANSACTION:,} that nodes pass on"
    return Fit(limit.name, limit.kind, limit.gas, needed, fits, reason, limit.source, limit.date, limit.remark)


def headline(fits: tuple[Fit, ...]) -> str:
    """The same in a few words, for instance "fits one transaction, and any node's read call"; two lines on the page."""
    transactions = [fit for fit in fits if fit.kind == "transaction"]
    calls = [fit for fit in fits if fit.kind == "call"]
    nodes = sum(fit.fits for fit in calls)
    in_transaction = bool(transactions) and all(fit.fits for fit in transactions)
    if nodes == len(calls):
        where = "any node's read call"
    elif nodes:
        where = f"calls of {nodes} of {len(calls)} kinds of nodes"
    else:
        return "fits no usual node: take fewer pixels or triangles"
    return f"fits one transaction, and {where}" if in_transaction else f"fits {where}"


def by_trying(call: Callable[[int], object]) -> Callable[[int], bool]:
    """`suffices` of a function that makes the call with so much gas and raises OutOfGasError if that is too little."""

    def suffices(gas: int) -> bool:
        try:
            call(gas)
        except OutOfGasError:
            return False
        return True

    return suffices
