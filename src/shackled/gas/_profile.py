"""The gas of a picture by stage, by function of the contracts, by line of their sources, and by kind of opcode."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TypeVar

from ..artifacts import artifact
from ..scene._scene import Scene
from ._limits import render_call
from ._source_map import source_map
from ._stages import STAGES
from ._trace import CallFrame, trace

_Key = TypeVar("_Key")

#: Kinds of opcodes: what moves values on the stack, jumps with their targets, multiplication and division, access to
#: memory and calldata with copies and the growth of memory, and all others, such as ADD, AND, SHR and LT.
STACK, JUMPS, MULTIPLY, MEMORY, OTHERS = KINDS = (
    "PUSH, DUP, SWAP, POP",
    "jumps",
    "MUL, DIV families",
    "memory, copies",
    "the rest",
)
_OPCODES = {
    STACK: (0x50, *range(0x5F, 0xA0)),
    # JUMP, JUMPI, PC, JUMPDEST
    JUMPS: (0x56, 0x57, 0x58, 0x5B),
    # MUL, DIV, SDIV, MOD, SMOD, ADDMOD, MULMOD, EXP
    MULTIPLY: (0x02, *range(0x04, 0x0B)),
    # CALLDATALOAD, CALLDATACOPY, CODECOPY, EXTCODECOPY, RETURNDATACOPY, MLOAD, MSTORE, MSTORE8, MSIZE, MCOPY
    MEMORY: (0x35, 0x37, 0x39, 0x3C, 0x3E, 0x51, 0x52, 0x53, 0x59, 0x5E),
}
#: stage, calls, file, line and kind of a `LineCost`.
_Line = tuple[str, tuple[str, ...], str, int, str]

_KINDS = {opcode: kind for kind, opcodes in _OPCODES.items() for opcode in opcodes}


@dataclass(frozen=True)
class LineCost:
    """The gas of the opcodes of one kind in one line of one function, called in one way, for one stage.

    calls: the call stack, the outermost function first; the line stands in the last. file, line: line counts from 1;
    the file is empty for code of the compiler. kind: of `KINDS`.
    """

    stage: str
    calls: tuple[str, ...]
    file: str
    line: int
    kind: str
    gas: int

    @property
    def function(self) -> str:
        """Return the function that contains the line."""
        return self.calls[-1]

    @property
    def place(self) -> str:
        """Return file and line, such as pipeline/View.sol:12."""
        return f"{self.file}:{self.line}" if self.file else "(compiler)"


@dataclass(frozen=True)
class FunctionCost:
    """The gas of a function: its own, and with that of the functions it calls."""

    name: str
    own: int
    total: int


@dataclass(frozen=True)
class Profile:
    """The costs of a call; they sum to its gas."""

    costs: tuple[LineCost, ...]

    @property
    def gas(self) -> int:
        """Return the gas of the whole call."""
        return sum(cost.gas for cost in self.costs)

    def stages(self) -> dict[str, int]:
        """Return the gas by stage, in the order in which a picture is made; stages without gas are there with 0."""
        gas = _sums((cost.stage, cost.gas) for cost in self.costs)
        return {stage: gas[stage] for stage in STAGES}

    def opcodes(self, stage: str | None = None, function: str | None = None) -> dict[str, int]:
        """Return the gas by kind of opcode, in the order of `KINDS`: of all, of a stage, or of a function alone."""
        gas = _sums(
            (cost.kind, cost.gas)
            for cost in self.costs
            if stage in (None, cost.stage) and function in (None, cost.function)
        )
        return {kind: gas[kind] for kind in KINDS}

    def functions(self) -> list[FunctionCost]:
        """Return the gas by function, those first that use most themselves."""
        own = _sums((cost.function, cost.gas) for cost in self.costs)
        # once for each cost, even if the function is recursive
        total = _sums((name, cost.gas) for cost in self.costs for name in set(cost.calls))
        return [FunctionCost(name, own[name], gas) for name, gas in sorted(total.items(), key=lambda e: -own[e[0]])]

    def lines(self) -> list[tuple[str, str, int]]:
        """Return place, function and gas of each line, the most expensive first."""
        gas = _sums(((cost.place, cost.function), cost.gas) for cost in self.costs)
        return [(place, function, each) for (place, function), each in gas.most_common()]


def profile(scene: Scene) -> Profile:
    """Profile a render in the embedded EVM."""
    root, result = trace("Renderer", render_call(scene))
    gas: Counter[_Line] = Counter()
    _collect(root, (), gas)
    found = Profile(tuple(LineCost(*key, each) for key, each in gas.items() if each))
    assert found.gas == result.gas
    return found


def _collect(frame: CallFrame, callers: tuple[str, ...], gas: Counter[_Line]) -> None:
    mapped, code = source_map(frame.contract), artifact(frame.contract).runtime
    entered = mapped.places[frame.entry].function if frame.entry else None
    name = frame.contract
    if frame.entry:
        name = mapped.entries.get(frame.entry) or entered or f"{frame.contract}@{frame.entry}"
    calls = callers if callers and callers[-1] == name else (*callers, name)
    for stage, costs in frame.costs.items():
        for at, each in costs.items():
            place = mapped.places[at]
            # a function within assembly lies in one of Solidity
            is_own = frame.entry > 0 and entered == place.function
            # in assembly only the function is known
            line = max(place.line, mapped.entry_lines.get(frame.entry, 0)) if place.block and is_own else place.line
            # inlined functions have no calls, but their instructions are mapped to them
            inlined = None if is_own else place.function
            way = (*calls, inlined) if inlined and inlined != name else calls
            gas[stage, way, place.file, line, _KINDS.get(code[at], OTHERS)] += each
    for called in frame.calls:
        _collect(called, calls, gas)


def _sums(pairs: Iterable[tuple[_Key, int]]) -> Counter[_Key]:
    sums: Counter[_Key] = Counter()
    for key, gas in pairs:
        sums[key] += gas
    return sums
