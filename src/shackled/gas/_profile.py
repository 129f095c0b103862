"""Where the gas of a picture goes: by stage, by function of the contracts, and by line of their sources."""

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
    """Gas of one line in one function, called in one way, for one stage.

    calls: the functions that led there, the outermost first, the last of which the line stands in. file, line: line is
    from 1; the file is empty where the compiler names none.
    """

    stage: str
    calls: tuple[str, ...]
    file: str
    line: int
    gas: int

    @property
    def function(self) -> str:
        """The function in which the line stands."""
        return self.calls[-1]

    @property
    def place(self) -> str:
        """Such as pipeline/View.sol:12."""
        return f"{self.file}:{self.line}" if self.file else "(compiler)"


@dataclass(frozen=True)
class FunctionCost:
    """The gas of a function: its own, and with that of what it calls."""

    name: str
    own: int
    total: int


@dataclass(frozen=True)
class Profile:
    """The costs of a call; they add up to its gas."""

    costs: tuple[Cost, ...]

    @property
    def gas(self) -> int:
        """All of it."""
        return sum(cost.gas for cost in self.costs)

    def stages(self) -> dict[str, int]:
        """Gas by stage, in the order in which a picture is made; stages that need none are there with 0."""
        gas = _sums((cost.stage, cost.gas) for cost in self.costs)
        return {stage: gas[stage] for stage in STAGES}

    def functions(self) -> list[FunctionCost]:
        """Gas by function, those first that use most themselves."""
        own = _sums((cost.function, cost.gas) for cost in self.costs)
        # once for each cost, however often a function is among its callers
        total = _sums((name, cost.gas) for cost in self.costs for name in set(cost.calls))
        return [FunctionCost(name, own[name], gas) for name, gas in sorted(total.items(), key=lambda e: -own[e[0]])]

    def lines(self) -> list[tuple[str, str, int]]:
        """Place, function and gas of each line, the dearest first."""
        gas = _sums(((cost.place, cost.function), cost.gas) for cost in self.costs)
        return [(place, function, each) for (place, function), each in gas.most_common()]


def profile(scene: Scene, report: Callable[[int], None] | None = None) -> Profile:
    """Return the profile of a render, made in py-evm: some two million gas a second.

    report: is told now and then how much gas has been used. InputError if py-evm is not installed.
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
            # functions that were inlined have no calls of their own, but their instructions say where they are from
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
    """Return whether a place belongs to the function of the frame: one within assembly lies in one of Solidity."""
    entered = mapped.places.get(frame.entry)
    return entered is not None and frame.entry > 0 and entered.function == place.function


def _line(frame: Frame, mapped: SourceMap, place: Place | None) -> tuple[str, int]:
    if place is None or not place.file:
        return "", 0
    if place.block and frame.entry in mapped.entry_lines and _is_own(frame, mapped, place):
        # of assembly only the function within it is known
        return place.file, max(place.line, mapped.entry_lines[frame.entry])
    return place.file, place.line


def _sums(pairs: Iterable[tuple[_Key, int]]) -> Counter[_Key]:
    sums: Counter[_Key] = Counter()
    for key, gas in pairs:
        sums[key] += gas
    return sums
