"""Tracing of a call: the gas of each instruction by function, call stack and stage."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable
from dataclasses import dataclass, field
from importlib.util import find_spec
from typing import Any

from ..chain import CallResult, PyEvmChain
from ..errors import InputError
from ._source_map import source_map
from ._stages import REST, stages_of

_JUMPS, _FIRST_CALL = (0x56, 0x57), 0xF0

#: Instructions between two reports of progress.
_STRIDE = 1 << 16


@dataclass(eq=False)
class Frame:
    """A function with a call stack; all calls with the same stack share a frame.

    contract: name of the artifact.
    entry: position at which the function begins; 0 for the contract itself.
    costs: gas by stage and position of the instruction, without calls.
    """

    contract: str
    entry: int
    parent: Frame | None
    costs: defaultdict[str, defaultdict[int, int]] = field(
        default_factory=lambda: defaultdict(lambda: defaultdict(int))
    )
    calls: dict[tuple[str, int], Frame] = field(default_factory=dict)

    def call(self, contract: str, entry: int) -> Frame:
        """Return the frame of a function that this one calls."""
        key = contract, entry
        if key not in self.calls:
            self.calls[key] = Frame(contract, entry, self)
        return self.calls[key]

    def frames(self) -> list[Frame]:
        """Return this frame and all below it."""
        return [self, *(frame for each in self.calls.values() for frame in each.frames())]

    def gas(self) -> int:
        """Return the gas of this frame, without calls."""
        return sum(sum(costs.values()) for costs in self.costs.values())


#: What tracing needs, for messages.
TRACER = "the package py-evm: pip install 'shackled[profile]'"


def can_trace() -> bool:
    """Return whether py-evm is installed."""
    return find_spec("eth") is not None


def trace(contract: str, data: bytes, report: Callable[[int], None] | None = None) -> tuple[Frame, CallResult]:
    """Trace a call in py-evm; return the frame of the contract, and the result.

    report: receives the gas used so far, from time to time.

    Raises InputError if py-evm is not installed.
    """
    if not can_trace():
        raise InputError(f"gas by stage and line needs {TRACER}")
    chain = _Tracer(report)
    result = chain.call(contract, data)
    assert chain.root is not None
    assert sum(frame.gas() for frame in chain.root.frames()) == result.gas
    return chain.root, result


class _Tracer(PyEvmChain):
    """An EVM that records the costs of its last call."""

    def __init__(self, report: Callable[[int], None] | None) -> None:
        super().__init__()
        self.root: Frame | None = None
        self._report = report

    def _state(self) -> Any:
        state = super()._state()
        self.root = None
        #: The calling frame and its stage; the gas of the last finished call.
        self._caller: tuple[Frame | None, str] = None, REST
        self._called = 0
        tracer, base = self, state.computation_class

        def apply_computation(cls: Any, state: Any, message: Any, *rest: Any, **named: Any) -> Any:
            if message.is_create or message.code_address not in tracer._addresses.values():
                return base.apply_computation.__func__(cls, state, message, *rest, **named)
            with cls(state, message, *rest) as computation:
                computation.contracts_created = []
                tracer._run_code(computation)
            return computation

        members = {"apply_computation": classmethod(apply_computation)}
        state.computation_class = type("TracedComputation", (base,), members)
        return state

    def _run_code(self, computation: Any) -> None:
        """Run the interpreter loop of py-evm, and record the gas of each instruction."""
        from eth.exceptions import Halt
        from eth.vm.logic.invalid import InvalidOpcode

        address = computation.msg.code_address
        contract = next(name for name, each in self._addresses.items() if each == address)
        mapped = source_map(contract)
        stages = stages_of(mapped)
        jumps = {at: place.jump for at, place in mapped.places.items() if place.jump in "io"}
        caller, stage = self._caller
        frame = Frame(contract, 0, None) if caller is None else caller.call(contract, 0)
        if self.root is None:
            self.root = frame
        #: Frame, stage and return position of each open call.
        returns: list[tuple[Frame, str, int]] = []
        costs = frame.costs[stage]
        code, meter, opcodes = computation.code, computation._gas_meter, computation.opcodes
        start = before = meter.gas_remaining
        countdown = _STRIDE
        for opcode in code:
            at = code.program_counter - 1
            new = stages.get(at, stage)
            if new != stage:
                stage = new
                costs = frame.costs[stage]
            operation = opcodes.get(opcode) or InvalidOpcode(opcode)
            halted = False
            if opcode >= _FIRST_CALL:
                self._caller, self._called = (frame, stage), 0
            try:
                operation(computation=computation)
            except Halt:
                halted = True
            after = meter.gas_remaining
            costs[at] += before - after
            before = after
            if opcode >= _FIRST_CALL:
                # the called contract records its own costs
                costs[at] -= self._called
            if halted:
                break
            if opcode in _JUMPS and at in jumps and code.program_counter != at + 1:
                target = code.program_counter
                if jumps[at] == "i":
                    returns.append((frame, stage, at + 1))
                    frame = frame.call(contract, target)
                elif any(target == back for _, _, back in returns):
                    back = -1
                    while back != target:
                        frame, stage, back = returns.pop()
                elif returns and mapped.places[target].function not in (None, mapped.entries.get(frame.entry)):
                    frame, stage, _ = returns.pop()
                # else a shared end of several functions, made by the compiler: stay in this frame
                costs = frame.costs[stage]
            countdown -= 1
            if not countdown:
                countdown = _STRIDE
                if self._report is not None:
                    self._report(start - after)
        self._called = start - before
