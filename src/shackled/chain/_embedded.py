"""EVMs in this process that hold only the contracts, with the rules of Cancun.

Every call starts from the same state, so that the same call always costs the same gas.
"""

from __future__ import annotations

import threading
from abc import abstractmethod
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cached_property
from typing import Any
from weakref import WeakSet

import numpy as np
from numpy.typing import NDArray

from ..artifacts import artifact
from ..errors import ChainError, RenderError
from ..ethereum._encoding import create2_address, intrinsic_gas, to_hex, word
from ..evm._instance import Answer, Instance, Status
from ._chain import CallResult, ContractChain
from ._failures import out_of_gas, revert_error

#: Enough for pictures of 2048 x 2048 pixels; bounds the time of a call, and its memory to 130 MB.
DEFAULT_GAS_LIMIT = 30_000_000_000

#: What CHAINID returns.
CHAIN_ID = 1

SENDER = bytes.fromhex("5ac61ed000000000000000000000000000000001")


class EmbeddedChain(ContractChain):
    """A chain in this process. Contracts are created at their first call, after those that their constructors need."""

    def __init__(self, gas_limit: int = DEFAULT_GAS_LIMIT) -> None:
        self.gas_limit = gas_limit
        self._codes: dict[bytes, bytes] = {}
        self._addresses: dict[str, bytes] = {}

    def call(self, contract: str, data: bytes, gas_limit: int | None = None) -> CallResult:
        """Call a contract, as `ContractCaller.call`."""
        return self.run(self.address(contract), data, gas_limit)

    def address(self, contract: str) -> bytes:
        """Return the address of a contract, the same as `shackled deploy` gives it on every chain."""
        if contract not in self._addresses:
            creation = self.creation(contract)
            code = self.create(contract, creation) if artifact(contract).parts else artifact(contract).runtime
            address = create2_address(creation)
            self._codes[address] = code
            self._addresses[contract] = address
        return self._addresses[contract]

    def creation(self, contract: str) -> bytes:
        """Return the creation code of a contract, followed by the arguments of its constructor."""
        built = artifact(contract)
        return built.creation + b"".join(word(self.address(part)) for part in built.parts)

    def code(self, contract: str) -> bytes:
        """Return the runtime code of a contract."""
        return self._codes[self.address(contract)]

    def put(self, address: bytes, code: bytes) -> None:
        """Place any code at an address."""
        self._codes[address] = code

    def run(self, address: bytes, data: bytes, gas_limit: int | None = None) -> CallResult:
        """Call the code at an address."""
        return self._run(address, data, self.gas_limit if gas_limit is None else gas_limit)

    def codes(self) -> dict[bytes, bytes]:
        """Return the code of all contracts created so far, by address."""
        return dict(self._codes)

    @abstractmethod
    def create(self, name: str, creation: bytes) -> bytes:
        """Run creation code, with its arguments, and return the runtime code. ChainError, with `name`, if it fails."""

    @abstractmethod
    def _run(self, address: bytes, data: bytes, gas_limit: int) -> CallResult:
        """Call the code at an address."""


class RevmChain(EmbeddedChain):
    """The EVM of `shackled.evm`. Threads run calls at the same time, each in an instance of its own."""

    name = "embedded EVM (revm)"

    def __init__(self, gas_limit: int = DEFAULT_GAS_LIMIT, is_stoppable: bool = False) -> None:
        """Take the default gas limit of calls, and whether `stop` works, which makes them slower."""
        super().__init__(gas_limit)
        self.is_stoppable, self._is_stopped = is_stoppable, False
        self._all: WeakSet[Instance] = WeakSet()
        self._free: list[Instance] = []
        self._lock = threading.Lock()

    def stop(self) -> None:
        """End the calls that run in other threads, and all later ones, by ChainError."""
        with self._lock:
            self._is_stopped = True
            for evm in self._all:
                evm.stop()

    def create(self, name: str, creation: bytes) -> bytes:
        """Run creation code, with its arguments, and return the runtime code."""
        with self._instance() as evm:
            answer = evm.create(creation, DEFAULT_GAS_LIMIT)
        if answer.status != Status.SUCCESS:
            raise ChainError(f"the contract {name} could not be deployed: {_failed(answer, DEFAULT_GAS_LIMIT)}")
        return answer.output

    def _run(self, address: bytes, data: bytes, gas_limit: int) -> CallResult:
        with self._instance() as evm:
            answer = evm.call(address, data, gas_limit)
        if answer.status != Status.SUCCESS:
            raise _failed(answer, gas_limit)
        return CallResult(answer.output, answer.gas)

    def profile(
        self, contract: str, data: bytes, places: Callable[[str], bytes]
    ) -> tuple[CallResult, list[str], NDArray[np.uint32]]:
        """Call a contract, and count the gas of each instruction.

        places: returns the description of a contract for `Instance.describe`, by its name. Also returns the names of
        the contracts in the order of their numbers, and the table of `Instance.profile`.
        """
        address = self.address(contract)
        evm = Instance()
        for name, each in self._addresses.items():
            evm.put(each, self._codes[each])
            evm.describe(each, places(name))
        answer, table = evm.profile(address, data, self.gas_limit)
        if answer.status != Status.SUCCESS:
            raise _failed(answer, self.gas_limit)
        return CallResult(answer.output, answer.gas), list(self._addresses), table

    @contextmanager
    def _instance(self) -> Iterator[Instance]:
        """Lend an instance that has these contracts; one that failed is not used again."""
        with self._lock:
            if self._is_stopped:
                raise ChainError("the call was stopped")
            evm = self._free.pop() if self._free else self._new()
        evm.hold(self._codes.copy())
        yield evm
        self._free.append(evm)

    def _new(self) -> Instance:
        evm = Instance(self.is_stoppable)
        self._all.add(evm)
        return evm


def _failed(answer: Answer, gas_limit: int) -> ChainError:
    if answer.status == Status.REVERT:
        return revert_error(answer.output, gas_limit)
    if answer.status == Status.OUT_OF_GAS:
        return out_of_gas(gas_limit)
    return RenderError(f"the call failed: {answer.output.decode()}")


class PyrevmChain(RevmChain):
    """The EVM of the package pyrevm, with the contracts that `RevmChain` creates."""

    name = "embedded EVM (pyrevm)"

    def _run(self, address: bytes, data: bytes, gas_limit: int) -> CallResult:
        import pyrevm

        # a new one for each call: it keeps addresses warm between calls, and fails all calls after one that failed
        evm: Any = pyrevm.EVM(spec_id="Cancun")
        for each, code in self._codes.items():
            evm.insert_account_info(to_hex(each), pyrevm.AccountInfo(code=code))
        intrinsic = intrinsic_gas(data)
        try:
            output = bytes(evm.message_call(to_hex(SENDER), to_hex(address), data, None, gas_limit + intrinsic))
        except RuntimeError as error:
            raise pyrevm_error(str(error), gas_limit) from None
        return CallResult(output, evm.result.gas_used - intrinsic)


def pyrevm_error(message: str, gas_limit: int) -> ChainError:
    """Return the error for a failure of pyrevm, by its message."""
    if message.startswith("Revert"):
        return revert_error(bytes.fromhex(message.partition("output: 0x")[2].rstrip(" }")), gas_limit)
    if "OutOfGas" in message:
        return out_of_gas(gas_limit)
    return RenderError(f"the call failed: {message}")


class PyEvmChain(EmbeddedChain):
    """The EVM of py-evm, in pure Python: several hundred times slower, a witness for the others."""

    name = "embedded EVM (py-evm)"

    def create(self, name: str, creation: bytes) -> bytes:
        """Run creation code, with its arguments, and return the runtime code."""
        from eth.constants import CREATE_CONTRACT_ADDRESS

        address = bytes.fromhex("c0de") + bytes(18)
        state = self._state()
        message = self._message(creation, b"", CREATE_CONTRACT_ADDRESS, DEFAULT_GAS_LIMIT, create_address=address)
        computation = state.computation_class.apply_create_message(state, message, self._transaction)
        if computation.is_error:
            raise ChainError(f"the contract {name} could not be deployed: {computation.error!r}")
        return bytes(state.get_code(address))

    def _run(self, address: bytes, data: bytes, gas_limit: int) -> CallResult:
        from eth.exceptions import OutOfGas, Revert

        computation = self.execute(address, data, gas_limit)
        if computation.is_error:
            if isinstance(computation.error, Revert):
                raise revert_error(bytes(computation.output), gas_limit)
            if isinstance(computation.error, OutOfGas):
                raise out_of_gas(gas_limit)
            raise RenderError(f"the call failed: {computation.error!r}")
        return CallResult(bytes(computation.output), computation.get_gas_used())

    def execute(self, address: bytes, data: bytes, gas_limit: int) -> Any:
        """Call the code at an address, and return the computation of py-evm."""
        state = self._state()
        for warm in (SENDER, address):
            state.mark_address_warm(warm)
        message = self._message(self._codes[address], data, address, gas_limit)
        return state.computation_class.apply_message(state, message, self._transaction)

    def _state(self) -> Any:
        from eth.constants import BLANK_ROOT_HASH
        from eth.db.atomic import AtomicDB
        from eth.vm.execution_context import ExecutionContext
        from eth.vm.forks.cancun.state import CancunState
        from eth_typing import Address, BlockNumber, Hash32

        context = ExecutionContext(
            coinbase=Address(bytes(20)),
            timestamp=1,
            block_number=BlockNumber(1),
            difficulty=0,
            mix_hash=Hash32(bytes(32)),
            gas_limit=DEFAULT_GAS_LIMIT,
            prev_hashes=(),
            chain_id=CHAIN_ID,
            base_fee_per_gas=0,
            excess_blob_gas=0,
        )
        state = CancunState(AtomicDB(), context, BLANK_ROOT_HASH)
        for address, code in self._codes.items():
            state.set_code(Address(address), code)
        return state

    def _message(self, code: bytes, data: bytes, to: bytes, gas: int, **options: Any) -> Any:
        from eth.vm.message import Message
        from eth_typing import Address

        return Message(gas=gas, to=Address(to), sender=Address(SENDER), value=0, data=data, code=code, **options)

    @cached_property
    def _transaction(self) -> Any:
        from eth.vm.transaction_context import BaseTransactionContext
        from eth_typing import Address

        return BaseTransactionContext(gas_price=0, origin=Address(SENDER))
