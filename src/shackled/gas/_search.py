"""Find the gas that a call needs by bisection, from nothing but whether a limit suffices."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ..chain._chain import ContractChain
from ..chain._embedded import DEFAULT_GAS_LIMIT
from ..chain._node import NodeChain
from ..errors import OutOfGasError

#: The first limit that is tried; it is doubled until it suffices.
FIRST_LIMIT = 1 << 20


@dataclass(frozen=True)
class SearchStep:
    """One call: the limit that was tried, whether it sufficed, and the bracket after it.

    lower: the largest limit that is known not to suffice. upper: the smallest that is known to suffice, if any is.
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
        return len(self.steps)


def search(enough: Callable[[int], bool], report: Callable[[SearchStep], None] | None = None) -> Search:
    """Return the least limit that is enough.

    enough: makes the call with this limit. report: called after every step. OutOfGasError if `DEFAULT_GAS_LIMIT` does
    not suffice.
    """
    steps: list[SearchStep] = []
    limit, lower, upper = FIRST_LIMIT, 0, None
    while upper is None or upper - lower > 1:
        sufficed = enough(limit)
        lower, upper = (lower, limit) if sufficed else (limit, upper)
        steps.append(SearchStep(limit, sufficed, lower, upper))
        if report is not None:
            report(steps[-1])
        if lower == DEFAULT_GAS_LIMIT:
            raise OutOfGasError(f"the call ran out of gas: {lower:,} gas, the most that is tried, is not enough")
        limit = min(2 * limit, DEFAULT_GAS_LIMIT) if upper is None else (lower + upper) // 2
    return Search(upper, tuple(steps))


def suffices(chain: ContractChain | NodeChain, contract: str, data: bytes) -> Callable[[int], bool]:
    """Return a function that tells whether a call succeeds with a gas limit; it raises ChainError on other failures."""

    def call(limit: int) -> bool:
        try:
            chain.call(contract, data, limit)
        except OutOfGasError:
            return False
        return True

    return call
