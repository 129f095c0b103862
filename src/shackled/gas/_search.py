"""Find the gas that a call needs by bisection, from nothing but whether a limit suffices."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ..chain import DEFAULT_GAS_LIMIT, ContractChain, NodeChain
from ..errors import InputError, OutOfGasError

#: The first limit that is tried where no upper one is given; it is doubled until it suffices.
FIRST_LIMIT = 1 << 20


@dataclass(frozen=True)
class SearchStep:
    """One call: the limit that was tried, whether it sufficed, and the bracket after it.

    lower: the largest limit that is known not to suffice, or the lower bound of the search. upper: the smallest limit
    that is known to suffice; None while there is none.
    """

    limit: int
    enough: bool
    lower: int
    upper: int | None


@dataclass(frozen=True)
class Search:
    """The result of a search: the least gas limit that suffices, and the calls that were made."""

    gas: int
    steps: tuple[SearchStep, ...]

    @property
    def calls(self) -> int:
        """Return the number of calls."""
        return len(self.steps)


def search(
    enough: Callable[[int], bool],
    lower: int = 0,
    upper: int | None = None,
    report: Callable[[SearchStep], None] | None = None,
) -> Search:
    """Return the least limit above `lower` that is enough.

    enough: makes the call with this limit. lower: taken not to suffice. upper: a limit that should; None doubles until
    one does, up to `DEFAULT_GAS_LIMIT`. report: called after every step. Raises InputError if the bounds are in the
    wrong order, OutOfGasError if the upper one does not suffice.
    """
    last = DEFAULT_GAS_LIMIT if upper is None else upper
    if not 0 <= lower < last:
        raise InputError(f"the search needs limits 0 <= lower < upper, not {lower:,} and {last:,}")
    steps: list[SearchStep] = []
    known: int | None = None

    def attempt(limit: int) -> bool:
        nonlocal lower, known
        sufficed = enough(limit)
        if sufficed:
            known = limit
        else:
            lower = limit
        steps.append(SearchStep(limit, sufficed, lower, known))
        if report is not None:
            report(steps[-1])
        return sufficed

    least = last if upper is not None else min(last, max(FIRST_LIMIT, 2 * lower))
    while not attempt(least):
        if least == last:
            raise OutOfGasError(f"the call ran out of gas: {last:,} gas, the upper limit of the search, is not enough")
        least = min(2 * least, last)
    while least - lower > 1:
        middle = (lower + least) // 2
        if attempt(middle):
            least = middle
    return Search(least, tuple(steps))


def suffices(chain: ContractChain | NodeChain, contract: str, data: bytes) -> Callable[[int], bool]:
    """Return a function that tells whether a call succeeds with a gas limit; it raises ChainError on other failures."""

    def call(limit: int) -> bool:
        try:
            chain.call(contract, data, limit)
        except OutOfGasError:
            return False
        return True

    return call
