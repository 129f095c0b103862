"""An instance of the EVM: contracts in memory, and calls of them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from enum import IntEnum
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..base.checks import integer
from ..errors import ChainError, InputError
from . import _compiled
from ._module import address_space, start

if TYPE_CHECKING:
    import wasmtime

#: The largest memory of an instance in bytes, which tools/build_evm.py writes into the module.
MEMORY = 1 << 30

#: Calls get at most this much gas, a day's work: from 2^45 on it would pay for more memory than the 32-bit
#: numbers of the module can address.
MOST_GAS = (1 << 45) - 1

#: As long as calls take less, nothing is done to make later ones faster.
MUCH_GAS = 1_000_000

#: Bytes of an address.
ADDRESS = 20


class Status(IntEnum):
    """How a call ended, as evm/src/calls.rs says."""

    SUCCESS = 0
    REVERT = 1
    OUT_OF_GAS = 2
    #: Any other exceptional halt; the output is its name.
    FAILURE = 3


class Answer(NamedTuple):
    """What a call returned, and the gas of its execution."""

    status: Status
    output: bytes
    gas: int


class Instance:
    """An EVM with the rules of Cancun. Every call starts from the state that `put`, `deploy` and `send` left.

    Calls run in the block that `set_block` set: at first number 0, timestamp 1, and a PREVRANDAO of zeros.

    For one thread at a time, but for `stop`. Addresses have 20 bytes, otherwise InputError.

    Calls release the lock of the interpreter. ChainError if a call needs more memory than `MEMORY`; the instance must
    not be used afterwards.
    """

    def __init__(self, is_stoppable: bool = False) -> None:
        """Start without contracts. is_stoppable: whether `stop` works, which makes calls slower."""
        self._mode = _compiled.mode()
        self._kind, self._engine, self._store, instance = start(is_stoppable)
        self._is_stopped = False
        self._exports: Any = instance.exports(self._store)
        self._memory: Any = self._exports["memory"]
        self._codes: dict[bytes, bytes] = {}
        #: Of the calls since the busiest contract was sought, and after how much it is sought again.
        self._gas, self._patience = 0, MUCH_GAS

    def stop(self) -> None:
        """End the call that runs in another thread, if any, and all later ones, by ChainError."""
        self._is_stopped = True
        self._engine.increment_epoch()

    def put(self, address: bytes, code: bytes) -> None:
        """Set the code of a contract."""
        if self._codes.get(address) is not code:
            self._pass("put", _checked(address), code)
            self._codes[address] = code
            if self._mode == "compiled" and code:
                self.compile(address)

    def hold(self, codes: Mapping[bytes, bytes]) -> None:
        """Set the code of these contracts, by address, and remove that of all others."""
        for address in self._codes.keys() - codes.keys():
            self.put(address, b"")
        for address, code in codes.items():
            self.put(address, code)

    def set_block(self, number: int, timestamp: int, prevrandao: bytes) -> None:
        """Set the block of later calls. timestamp: in seconds since 1970.

        InputError unless both numbers are from 0 to 2^64 - 1 and `prevrandao` has 32 bytes. The 256 blocks before it
        have hashes: that of block n is the Keccak-256 of n as decimal text, as in pyrevm.
        """
        for name, value in (("number", number), ("timestamp", timestamp)):
            # wasmtime would take the last 64 bits
            if integer(value) is None or not 0 <= value < 1 << 64:
                raise InputError(f"`{name}` must be a whole number from 0 to 2^64 - 1, not {value!r:.60}")
        if not isinstance(prevrandao, bytes) or len(prevrandao) != 32:
            raise InputError(f"`prevrandao` must be 32 bytes, not {prevrandao!r:.60}")
        with self._placed(prevrandao) as places:
            self._run("set_block", int(number), int(timestamp), *places)

    def call(self, address: bytes, data: bytes, gas: int) -> Answer:
        """Call a contract with at most `gas` for the execution."""
        if self._gas >= self._patience and self._mode != "interpreter":
            self._note_busiest()
        answer = self._answer(self._pass("call", _checked(address), data, gas=gas))
        self._gas += answer.gas
        return answer

    def create(self, creation: bytes, gas: int) -> Answer:
        """Run creation code, which is followed by the arguments of the constructor; the output is the runtime code."""
        return self._answer(self._pass("create", creation, gas=gas))

    def deploy(self, creation: bytes, gas: int) -> Answer:
        """Run creation code, and keep the contract; the output is its address."""
        return self._answer(self._pass("deploy", creation, gas=gas))

    def send(self, address: bytes, data: bytes, gas: int, value: int = 0) -> Answer:
        """Call a contract with a value in wei, and keep what the call changes."""
        return self._answer(self._pass("send", _checked(address), value.to_bytes(32, "big"), data, gas=gas))

    def describe(self, address: bytes, places: bytes) -> None:
        """Describe the code of a contract for `profile`, by 6 bytes for each position, as evm/src/profile.rs says."""
        self._pass("describe", _checked(address), places)

    def profile(self, address: bytes, data: bytes, gas: int) -> tuple[Answer, NDArray[np.uint32]]:
        """Call a contract, and return the table of evm/src/profile.rs: the gas of each instruction."""
        answer = self._answer(self._pass("profile", _checked(address), data, gas=gas))
        table = self._read("table", 4 * self._run("table_size"))
        return answer, np.frombuffer(table, "<u4")

    def translate(self, code: bytes, region: int) -> bytes:
        """Return a code as a module of WebAssembly, in regions of so many instructions; b"" if too large."""
        with self._placed(code) as places:
            size = self._run("compile", *places, len(code), region, 1)
        return self._read("module", size)

    def compile(self, address: bytes) -> bool:
        """Let the contract at an address run as machine code; return whether that is possible."""
        return self._link(address, _compiled.module_of(self._codes[address], self._engine, self._kind, _translated))

    def _note_busiest(self) -> None:
        """Let the contract that used most gas in the interpreter run as machine code, if there is some."""
        self._gas, self._patience = 0, 2 * self._patience
        with self._placed(bytes(ADDRESS)) as (place,):
            gas = self._run("busiest", place, MUCH_GAS)
            address = bytes(self._memory.read(self._store, place, place + ADDRESS))
        if gas and address in self._codes:
            self._patience = MUCH_GAS
            self._link(
                address, _compiled.busy_module_of(self._codes[address], gas, self._engine, self._kind, _translated)
            )

    def _link(self, address: bytes, module: wasmtime.Module | None) -> bool:
        """Let the contract at an address run in a module; return whether it does."""
        if module is None:
            return False
        import wasmtime

        try:
            instance = wasmtime.Instance(self._store, module, [self._exports[each.name] for each in module.imports])
        except (wasmtime.WasmtimeError, MemoryError):
            return False
        run = instance.exports(self._store)["run"]
        place = self._exports["__indirect_function_table"].grow(self._store, 1, run)
        with self._placed(address) as places:
            self._run("link", *places, place)
        return True

    def _pass(self, function: str, *values: bytes, gas: int | None = None) -> Any:
        """Call an exported function with values in memory, and the size of the last."""
        limit = [] if gas is None else [min(gas, MOST_GAS)]
        with self._placed(*values) as places:
            return self._run(function, *places, len(values[-1]), *limit)

    @contextmanager
    def _placed(self, *values: bytes) -> Iterator[list[int]]:
        """Keep values in memory; yield their places."""
        places = [self._run("allocate", len(value)) for value in values]
        for place, value in zip(places, values, strict=True):
            self._memory.write(self._store, value, place)
        yield places
        for place, value in zip(places, values, strict=True):
            self._run("release", place, len(value))

    def _answer(self, status: int) -> Answer:
        return Answer(Status(status), self._read("answer", self._run("answer_size")), self._run("gas_used"))

    def _read(self, function: str, size: int) -> bytes:
        place = self._run(function)
        return bytes(self._memory.read(self._store, place, place + size)) if size else b""

    def _run(self, function: str, *values: int) -> Any:
        try:
            return self._exports[function](self._store, *values)
        except Exception as error:
            import wasmtime

            if not isinstance(error, wasmtime.Trap):
                raise
            if self._is_stopped:
                raise ChainError("the call was stopped") from None
            why = f"the embedded EVM stopped: the call needs more than {MEMORY >> 20:,} MB of memory"
            if (limit := address_space()) is not None:
                why += f", or than this process has left of {limit >> 20:,} MB of address space (`ulimit -v`)"
            raise ChainError(why) from error


def _translated(code: bytes) -> bytes:
    """Translate a code in an instance of its own: that of a call may be in use."""
    return Instance().translate(code, _compiled.REGION)


def _checked(address: bytes) -> bytes:
    """Return an address; of any other size, the module would read what lies beside it."""
    if len(address) != ADDRESS:
        raise InputError(f"an address must have {ADDRESS} bytes, not {len(address):,}")
    return address
