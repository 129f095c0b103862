"""Binary search for the lowest sufficient gas limit of a call."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from ..chain import DEFAULT_GAS_LIMIT
from ..errors import InputError, OutOfGasError

#: The first limit without an upper one; it is doubled until it suffices.
FIRST_LIMIT = 1 << 20


class Caller(Protocol):
    """An object that calls contracts, and raises OutOfGasError if the gas limit is too low."""

    def call(self, contract: str, data: bytes, gas_limit: int | None = None) -> object:
        """Call a contract, by the name of its artifact."""


@dataclass(frozen=True)
class Step:
    """One call of a search: its gas limit, whether it was enough, and the bracket after it.

    lower: the highest limit that is known to be too low, or the lower limit of the search.
    upper: the lowest limit that is known to be enough, or None.
    """

    limit: int
    enough: bool
    lower: int
    upper: int | None


@dataclass(frozen=True)
class Search:
    """The result of a search: the lowest sufficient gas limit, and the calls."""

    gas: int
    steps: tuple[Step, ...]

    @property
    def calls(self) -> int:
        """Number of calls."""
        return len(self.steps)


def search(
    enough: Callable[[int], bool],
    lower: int = 0,
    upper: int | None = None,
    report: Callable[[Step], None] | None = None,
    most: int = DEFAULT_GAS_LIMIT,
) -> Search:
    """Return the lowest limit above `lower` that is enough.

    enough: makes the call with a limit and says whether it was enough; must be monotonic.
    lower: a limit that is assumed to be too low.
    upper: a limit that should be enough; None doubles the limit until it is, up to `most`.
    report: receives each step.

    Raises InputError unless 0 <= lower < upper, OutOfGasError if the upper limit is not enough.
    """
    last = most if upper is None else upper
    if not 0 <= lower < last:
        raise InputError(f"the search needs limits 0 <= lower < upper, not {lower:,} and {last:,}")
    steps: list[Step] = []
    known: int | None = None

    def attempt(limit: int) -> bool:
        nonlocal lower, known
        sufficed = enough(limit)
        if sufficed:
            known = limit
        else:
            lower = limit
        steps.append(Step(limit, sufficed, lower, known))
        if report is not None:
            report(steps[-1])
        return sufficed

    least = last if upper is not None else min(last, max(FIRST_LIMIT, 2 * lower))
    while not attempt(least):
        if least == last:
            raise OutOfGasError(f"the call ran out of gas: {last:,}, the upper limit of the search, did not suffice")
        least = min(2 * least, last)
    while least - lower > 1:
        middle = (lower + least) // 2
        if attempt(middle):
            least = middle
    return Search(least, tuple(steps))


def suffices(chain: Caller, contract: str, data: bytes) -> Callable[[int], bool]:
    """Return a function that says whether a call succeeds with a gas limit; other failures raise ChainError."""

    def call(limit: int) -> bool:
        try:
            chain.call(contract, data, limit)
        except OutOfGasError:
            return False
        return True

    return call
