"""Compare a picture with the documented limits of requests."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from ..values import listed
from ._exact import Limit, floor_gas, limits, needed_for

#: Largest transaction that nodes relay, in bytes: geth's txMaxSize, four slots of 32 KiB.
MAX_TRANSACTION = 4 * 32 * 1024
#: Bytes of a transaction besides its data: signature, addresses, fees; rounded up.
ENVELOPE = 512


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

    @property
    def share(self) -> float:
        """Needed gas over the limit."""
        return self.needed / self.limit.gas

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


def fits_of(
    gas: int, intrinsic_gas: int, calldata: bytes, suffices: Callable[[int], bool] | None = None
) -> tuple[Fit, ...]:
    """Return how a picture fits into each known limit, the smallest first.

    gas: of the execution. suffices: whether the call succeeds with a given gas for the execution. It is called only
    where the bounds do not decide, since a call must be given a little more gas than it uses; without it such a limit
    counts as too small.
    """
    return tuple(fit_of(limit, gas, intrinsic_gas, calldata, suffices) for limit in limits())


def fit_of(
    limit: Limit, gas: int, intrinsic_gas: int, calldata: bytes, suffices: Callable[[int], bool] | None = None
) -> Fit:
    """Return how a picture fits into one limit, as `fits_of`."""
    floor, size = floor_gas(calldata), len(calldata)
    needed = max(intrinsic_gas + needed_for(gas), floor)
    fits = needed <= limit.gas
    if not fits and max(intrinsic_gas + gas, floor) <= limit.gas and suffices is not None:
        fits = suffices(limit.gas - intrinsic_gas)
        needed = limit.gas if fits else needed
    reason = ""
    if limit.kind == "transaction" and size + ENVELOPE > MAX_TRANSACTION:
        fits, reason = False, f"its data of {size:,} bytes is more than the {MAX_TRANSACTION:,} that nodes relay"
    return Fit(limit, needed, fits, reason)


def headline(fits: Sequence[Fit]) -> str:
    """Return the result in a few words, such as "fits one transaction, and any node's read call"."""
    in_transaction = all(fit.fits for fit in fits if fit.limit.kind == "transaction")
    calls = [fit for fit in fits if fit.limit.kind == "call"]
    nodes = [fit.limit.node for fit in calls if fit.fits]
    if not nodes:
        return "fits no usual node: take fewer pixels or triangles"
    where = "any node's read call" if len(nodes) == len(calls) else f"calls of {listed(nodes)}"
    return f"fits one transaction, and {where}" if in_transaction else f"fits {where}; no transaction"
