"""The gas of a picture by stage, by function of the contracts, by line of their sources, and by kind of opcode."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TypeVar

from ..artifacts import artifact
from ..scene import Scene
from ._limits import render_call
from ._source_map import SourceLocation, SourceMap, source_map
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
#: stage, calls, file and line of a `LineCost`.
_Line = tuple[str, tuple[str, ...], str, int]

_KINDS = {opcode: kind for kind, opcodes in _OPCODES.items() for opcode in opcodes}


@dataclass(frozen=True)
class LineCost:
    """The gas of one line in one function, called in one way, for one stage.

    calls: the call stack, the outermost function first; the line stands in the last. file, line: line counts from 1;
    the file is empty for code of the compiler.
    """

    stage: str
    calls: tuple[str, ...]
    file: str
    line: int
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
class OpcodeCost:
    """The gas of the opcodes of one kind of `KINDS` in one function, for one stage."""

    stage: str
    function: str
    kind: str
    gas: int


@dataclass(frozen=True)
class Profile:
    """The costs of a call; they sum to its gas, and so do those of the opcodes."""

    costs: tuple[LineCost, ...]
    opcode_costs: tuple[OpcodeCost, ...]

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
            for cost in self.opcode_costs
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
    kinds: Counter[tuple[str, str, str]] = Counter()
    _collect(root, (), gas, kinds)
    found = Profile(
        tuple(LineCost(*key, each) for key, each in gas.items() if each),
        tuple(OpcodeCost(*key, each) for key, each in kinds.items() if each),
    )
    assert found.gas == result.gas
    return found


def _collect(
    frame: CallFrame, callers: tuple[str, ...], gas: Counter[_Line], kinds: Counter[tuple[str, str, str]]
) -> None:
    mapped, code = source_map(frame.contract), artifact(frame.contract).runtime
    name = _name(frame, mapped)
    calls = callers if callers and callers[-1] == name else (*callers, name)
    for stage, costs in frame.costs.items():
        for at, each in costs.items():
            place = mapped.places.get(at)
            line = _line(frame, mapped, place)
            # inlined functions have no calls, but their instructions are mapped to them
            inlined = place.function if place is not None and not _is_own(frame, mapped, place) else None
            key = stage, (*calls, inlined) if inlined and inlined != name else calls, line[0], line[1]
            gas[key] += each
            kinds[stage, key[1][-1], _KINDS.get(code[at], OTHERS)] += each
    for called in frame.calls:
        _collect(called, calls, gas, kinds)


def _name(frame: CallFrame, mapped: SourceMap) -> str:
    if not frame.entry:
        return frame.contract
    place = mapped.places.get(frame.entry)
    return mapped.entries.get(frame.entry) or (place and place.function) or f"{frame.contract}@{frame.entry}"


def _is_own(frame: CallFrame, mapped: SourceMap, place: SourceLocation) -> bool:
    """Return whether a place belongs to the function of the frame: one within assembly lies in one of Solidity."""
    entered = mapped.places.get(frame.entry)
    return entered is not None and frame.entry > 0 and entered.function == place.function


def _line(frame: CallFrame, mapped: SourceMap, place: SourceLocation | None) -> tuple[str, int]:
    if place is None or not place.file:
        return "", 0
    if place.block and frame.entry in mapped.entry_lines and _is_own(frame, mapped, place):
        # in assembly only the function is known
        return place.file, max(place.line, mapped.entry_lines[frame.entry])
    return place.file, place.line


def _sums(pairs: Iterable[tuple[_Key, int]]) -> Counter[_Key]:
    sums: Counter[_Key] = Counter()
    for key, gas in pairs:
        sums[key] += gas
    return sums
