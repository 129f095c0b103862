"""An EVM that has the contracts of the package and the author's, with what the author's calls have changed."""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from ..artifacts import known_errors
from ..chain import RevmChain, describe_revert
from ..deploy import CONTRACTS
from ..errors import InputError
from ..ethereum import Errors, error_table
from ..evm import Answer, Instance, Status
from ._arguments import Call, constructor_arguments
from ._project import Compiled

#: Of a deployment or a call that changes something, and of one that only reads; it ends endless loops.
MOST_GAS = 1_000_000_000


class World:
    """The contract, deployed and set up. Threads call it at the same time, each in an instance of its own."""

    def __init__(self, contract: Compiled, given: Sequence[str] = (), setup: Sequence[Call] = ()) -> None:
        """Deploy the contract and send the calls. given: as of `constructor_arguments`.

        InputError if the constructor or a call fails.
        """
        self.contract, self.setup = contract, setup
        chain = RevmChain()
        addresses = {name: chain.address(name) for name in CONTRACTS}
        self._codes = chain.codes()
        self._creation = contract.creation + constructor_arguments(contract, given, addresses)
        self.errors: Errors = {**known_errors(), **error_table(contract.abi)}
        self._free: list[Instance] = []
        self._lock = threading.Lock()
        self.address = b""
        with self._instance():
            pass

    def call(self, data: bytes, gas: int = MOST_GAS) -> Answer:
        """Call the contract with at most so much gas for the execution."""
        with self._instance() as evm:
            return evm.call(self.address, data, gas)

    def reason(self, answer: Answer) -> str:
        """Return why a call was not successful."""
        if answer.status == Status.REVERT:
            return describe_revert(answer.output, self.errors) if answer.output else "reverted without a reason"
        if answer.status == Status.OUT_OF_GAS:
            return f"out of gas: {MOST_GAS:,} do not suffice"
        said = answer.output.decode(errors="replace")
        if said in ("OpcodeNotFound", "NotActivated"):
            return "the embedded EVM has the rules of Cancun, and does not know an instruction: compile for cancun"
        return f"failed: {said}"

    @contextmanager
    def _instance(self) -> Iterator[Instance]:
        """Lend an instance; there are as many as calls at the same time."""
        with self._lock:
            evm = self._free.pop() if self._free else None
        evm = evm or self._new()
        yield evm
        self._free.append(evm)

    def _new(self) -> Instance:
        evm = Instance()
        evm.hold(self._codes)
        made = evm.deploy(self._creation, MOST_GAS)
        if made.status != Status.SUCCESS:
            reason = self.reason(made)
            if reason == "failed: CreateContractSizeLimit":
                reason = "its code has more than 24,576 bytes (EIP-170): turn the optimizer on, or split it"
            raise InputError(f"{self.contract.name} cannot be deployed: {reason}")
        self.address = made.output
        for call in self.setup:
            for number in range(call.times):
                answer = evm.send(self.address, call.data, MOST_GAS, call.value)
                if answer.status != Status.SUCCESS:
                    which = f" (number {number + 1} of {call.times})" if call.times > 1 else ""
                    raise InputError(f"the call {call.text}{which} failed: {self.reason(answer)}")
        return evm


def workers() -> int:
    """Return how many calls run at the same time."""
    return os.cpu_count() or 1
