"""The gas of a picture by stage, by function of the contracts, and by line of their sources."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TypeVar

from ..scene import Scene
from ._exact import render_call
from ._source_map import Place, SourceMap, source_map
from ._stages import STAGES
from ._trace import Frame, trace

_Key = TypeVar("_Key")


@dataclass(frozen=True)
class Cost:
    """Gas of one line for one stage and one call stack.

    calls: the call stack, outermost function first; the last one contains the line.
    file: path of the source; "" if the compiler names none.
    line: line number from 1.
    """

    stage: str
    calls: tuple[str, ...]
    file: str
    line: int
    gas: int

    @property
    def function(self) -> str:
        """The function that contains the line."""
        return self.calls[-1]

    @property
    def place(self) -> str:
        """File and line, such as pipeline/View.sol:12."""
        return f"{self.file}:{self.line}" if self.file else "(compiler)"


@dataclass(frozen=True)
class FunctionCost:
    """The gas of a function, without (`own`) and with (`total`) the functions that it calls."""

    name: str
    own: int
    total: int


@dataclass(frozen=True)
class Profile:
    """The costs of a call; their sum is its gas."""

    costs: tuple[Cost, ...]

    @property
    def gas(self) -> int:
        """The gas of the call."""
        return sum(cost.gas for cost in self.costs)

    def stages(self) -> dict[str, int]:
        """Return the gas of each stage, in the order in which a picture is made; 0 for stages without gas."""
        gas = _sums((cost.stage, cost.gas) for cost in self.costs)
        return {stage: gas[stage] for stage in STAGES}

    def functions(self) -> list[FunctionCost]:
        """Return the gas of each function, sorted by their own gas, the highest first."""
        own = _sums((cost.function, cost.gas) for cost in self.costs)
        # once per cost, even if a function occurs several times in its call stack
        total = _sums((name, cost.gas) for cost in self.costs for name in set(cost.calls))
        return [FunctionCost(name, own[name], gas) for name, gas in sorted(total.items(), key=lambda e: -own[e[0]])]

    def lines(self) -> list[tuple[str, str, int]]:
        """Return place, function and gas of each line, the most expensive first."""
        gas = _sums(((cost.place, cost.function), cost.gas) for cost in self.costs)
        return [(place, function, each) for (place, function), each in gas.most_common()]


def profile(scene: Scene, report: Callable[[int], None] | None = None) -> Profile:
    """Profile a render in py-evm, at about two million gas a second.

    report: receives the gas used so far, from time to time.

    Raises InputError if py-evm is not installed.
    """
    root, result = trace("Renderer", render_call(scene), report)
    gas: Counter[tuple[str, tuple[str, ...], str, int]] = Counter()
    _collect(root, (), gas)
    found = Profile(tuple(Cost(*key, each) for key, each in gas.items() if each))
    assert found.gas == result.gas
    return found


def _collect(frame: Frame, callers: tuple[str, ...], gas: Counter[tuple[str, tuple[str, ...], str, int]]) -> None:
    mapped = source_map(frame.contract)
    name = _name(frame, mapped)
    calls = callers if callers and callers[-1] == name else (*callers, name)
    for stage, costs in frame.costs.items():
        for at, each in costs.items():
            place = mapped.places.get(at)
            line = _line(frame, mapped, place)
            # inlined functions make no calls, but the source map has the place of their instructions
            inlined = place.function if place is not None and not _is_own(frame, mapped, place) else None
            key = stage, (*calls, inlined) if inlined and inlined != name else calls, line[0], line[1]
            gas[key] += each
    for called in frame.calls.values():
        _collect(called, calls, gas)


def _name(frame: Frame, mapped: SourceMap) -> str:
    if not frame.entry:
        return frame.contract
    place = mapped.places.get(frame.entry)
    return mapped.entries.get(frame.entry) or (place and place.function) or f"{frame.contract}@{frame.entry}"


def _is_own(frame: Frame, mapped: SourceMap, place: Place) -> bool:
    """Return whether a place is in the function of the frame; a function in assembly is inside a Solidity function."""
    entered = mapped.places.get(frame.entry)
    return entered is not None and frame.entry > 0 and entered.function == place.function


def _line(frame: Frame, mapped: SourceMap, place: Place | None) -> tuple[str, int]:
    if place is None or not place.file:
        return "", 0
    if place.block and frame.entry in mapped.entry_lines and _is_own(frame, mapped, place):
        # within assembly only the function is known
        return place.file, max(place.line, mapped.entry_lines[frame.entry])
    return place.file, place.line


def _sums(pairs: Iterable[tuple[_Key, int]]) -> Counter[_Key]:
    sums: Counter[_Key] = Counter()
    for key, gas in pairs:
        sums[key] += gas
    return sums
