"""Trace a call instruction by instruction: the gas by call stack, stage and position."""

from __future__ import annotations

from collections import Counter, defaultdict
from dataclasses import dataclass, field
from functools import cache

import numpy as np
from numpy.typing import NDArray

from ..artifacts import artifact
from ..chain._chain import CallResult
from ..chain._embedded import RevmChain
from ._source_map import source_map
from ._stages import REST, STAGES, stages_of

#: A place of evm/src/profile.rs. Numbers count from 1, 0 is none.
_PLACE = np.dtype([("stage", "u1"), ("jump", "u1"), ("function", "<u2"), ("entry", "<u2")])
_JUMPS = {"-": 0, "i": 1, "o": 2}
#: Words of a function, and of a position, in its table.
_FUNCTION, _POSITION = 3, 6


@dataclass(eq=False)
class CallFrame:
    """A function with its callers; one frame for all calls by the same way.

    contract: the name of its artifact. entry: the position at which it begins; 0 is the contract itself. costs: gas by
    stage and position of the instruction, without that of calls. counts: how often each position was executed.
    """

    contract: str
    entry: int
    costs: defaultdict[str, dict[int, int]] = field(default_factory=lambda: defaultdict(dict))
    counts: Counter[int] = field(default_factory=Counter)
    calls: list[CallFrame] = field(default_factory=list)

    def frames(self) -> list[CallFrame]:
        """Return this frame and all below it."""
        return [self, *(frame for each in self.calls for frame in each.frames())]

    def gas(self) -> int:
        """Return the gas of this frame without what it calls."""
        return sum(sum(costs.values()) for costs in self.costs.values())


def trace(contract: str, data: bytes) -> tuple[CallFrame, CallResult]:
    """Make a call in the embedded EVM; return the frame of the contract, and the result."""
    result, names, table = RevmChain().profile(contract, data, lambda name: places(name).tobytes())
    count = int(table[0])
    functions = table[1 : 1 + _FUNCTION * count].reshape(-1, _FUNCTION).tolist()
    frames = _frames([(parent, names[number], entry) for parent, number, entry in functions])
    for number, stage, at, times, low, high in table[1 + _FUNCTION * count :].reshape(-1, _POSITION).tolist():
        costs = frames[number].costs[STAGES[stage - 1] if stage else REST]
        costs[at] = costs.get(at, 0) + (low | high << 32)
        frames[number].counts[at] += times
    assert sum(frame.gas() for frame in frames[0].frames()) == result.gas
    return frames[0], result


def _frames(functions: list[tuple[int, str, int]]) -> list[CallFrame]:
    """Return the frame of each function: number of its caller, which comes before it, contract and entry."""
    frames: list[CallFrame] = []
    # the frames from the outermost to that of a function. No function calls itself: where one is entered below itself,
    # the compiler has joined the ends of several, so that its end was not seen
    ways: dict[CallFrame, list[CallFrame]] = {}
    for parent, contract, entry in functions:
        way = ways[frames[parent]] if parent < len(frames) else []
        siblings = way[-1].calls if way else []
        known = (each for each in [*way, *siblings] if (each.contract, each.entry) == (contract, entry))
        frame = next(known, None)
        if frame is None:
            frame = CallFrame(contract, entry)
            ways[frame] = [*way, frame]
            siblings.append(frame)
        frames.append(frame)
    return frames


@cache
def places(contract: str) -> NDArray[np.void]:
    """Return what evm/src/profile.rs wants to know of each position of a contract.

    stage: a number of STAGES from 1, or 0 for code that serves all. jump: 1 enters a function, 2 leaves one. function,
    entry: numbers of the function that contains the position, and of the one that begins there, or 0.
    """
    mapped = source_map(contract)
    stages = stages_of(mapped)
    numbers: dict[str, int] = {}
    found = np.zeros(len(artifact(contract).runtime), _PLACE)
    for at, place in mapped.places.items():
        stage, function, entry = stages.get(at), place.function, mapped.entries.get(at)
        found[at] = (
            0 if stage is None else STAGES.index(stage) + 1,
            _JUMPS[place.jump],
            0 if function is None else numbers.setdefault(function, len(numbers) + 1),
            0 if entry is None else numbers.setdefault(entry, len(numbers) + 1),
        )
    return found
