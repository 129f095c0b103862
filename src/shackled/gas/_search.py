"""How much gas a call needs, from nothing but whether a limit sufficed: a search by halves between two gas limits."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from ..chain import DEFAULT_GAS_LIMIT
from ..errors import InputError, OutOfGasError

#: The first limit that is tried where no upper one is given; it is doubled until it suffices.
FIRST_LIMIT = 1 << 20


class Caller(Protocol):
    """Whatever makes calls of contracts and raises OutOfGasError where the limit does not suffice."""

    def call(self, contract: str, data: bytes, gas_limit: int | None = None) -> object:
        """Calls a contract, by the name of its artifact."""


@dataclass(frozen=True)
class Step:
    """One call: the limit that was tried, whether it sufficed, and what is known after it.

    lower: the largest limit that is known not to suffice, or the lower limit of the search. upper: the smallest that
    is known to; None while there is none.
    """

    limit: int
    enough: bool
    lower: int
    upper: int | None


@dataclass(frozen=True)
class Search:
    """What a search found: the least gas limit that suffices, and the calls that led there."""

    gas: int
    steps: tuple[Step, ...]

    @property
    def calls(self) -> int:
        """How many calls were made."""
        return len(self.steps)


def search(
    enough: Callable[[int], bool],
    lower: int = 0,
    upper: int | None = None,
    report: Callable[[Step], None] | None = None,
    most: int = DEFAULT_GAS_LIMIT,
) -> Search:
    """Return the least limit above `lower` that is enough.

    enough: makes the call with this limit; what is enough stays enough with more. lower: taken not to suffice.
    upper: a limit that should; None doubles until one does, up to `most`. report: is told every step.
    InputError if the limits are the wrong way round, OutOfGasError if the upper one does not suffice.
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
    """Return whether a call succeeds with a gas limit. Raises ChainError if it fails for another reason."""

    def call(limit: int) -> bool:
        try:
            chain.call(contract, data, limit)
        except OutOfGasError:
            return False
        return True

    return call
