"""The same calls in the EVM of the package, in pyrevm and in py-evm: status, output and gas of each.

Names of failures are left out: they differ between versions of revm.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from functools import cache
from typing import Any

import pytest
import wasmtime

from shackled.chain._embedded import SENDER, PyEvmChain
from shackled.ethereum._encoding import intrinsic_gas, to_hex
from shackled.evm import _compiled
from shackled.evm._instance import Answer, Instance, Status
from shackled.evm._module import Kind, config

#: Where code under test is put.
ADDRESS = bytes(18) + b"\xc0\xde"

#: What runs a program: the interpreter, compiled regions of one instruction, and those that are shipped.
REGIONS = (None, 1, _compiled.REGION)

Codes = dict[bytes, bytes]

#: What other EVMs returned, by their name and the arguments: each program is compared several times.
_known: dict[tuple[Any, ...], Answer] = {}


def _once(
    ask: Callable[..., Answer],
    codes: Codes,
    address: bytes,
    data: bytes,
    gas: int,
    block: tuple[int, int, bytes] | None,
) -> Answer:
    key = (ask, tuple(codes.items()), address, data, gas, block)
    if key not in _known:
        _known[key] = ask(codes, address, data, gas, block)
    return _known[key]


class Ours:
    """The EVM of the package, one instance for all calls. region: of compiled code; None for the interpreter.

    interpreted: codes that are not compiled.
    """

    def __init__(self, region: int | None = None, interpreted: Collection[bytes] = ()) -> None:
        with pytest.MonkeyPatch.context() as patch:
            patch.setenv("SHACKLED_EVM", "interpreter")
            self.instance = Instance()
        self.region = region
        self._done: set[bytes] = {b"", *interpreted}

    def put(self, address: bytes, code: bytes) -> None:
        """Set the code of a contract, and compile it."""
        self.instance.put(address, code)
        if self.region is not None and code not in self._done:
            module = wasmtime.Module(_compiler(self.instance._kind), self.instance.translate(code, self.region))
            assert self.instance._link(address, wasmtime.Module.deserialize(self.instance._engine, module.serialize()))
            self._done.add(code)

    def call(self, codes: Codes, address: bytes, data: bytes, gas: int) -> Answer:
        for each, code in codes.items():
            self.put(each, code)
        answer = self.instance.call(address, data, gas)
        return answer._replace(output=b"") if answer.status == Status.FAILURE else answer


@cache
def _compiler(kind: Kind) -> wasmtime.Engine:
    """What compiles programs in one thread, as fast as it can: most of them are run a few times."""
    settings = config(kind)
    settings.parallel_compilation, settings.cranelift_opt_level = False, "none"
    return wasmtime.Engine(settings)


def pyrevm_call(
    codes: Codes, address: bytes, data: bytes, gas: int, block: tuple[int, int, bytes] | None = None
) -> Answer:
    """Call in a new EVM of pyrevm; skip the test where it is not installed. block: the arguments of `set_block`."""
    return _once(_pyrevm_call, codes, address, data, gas, block)


def _pyrevm_call(codes: Codes, address: bytes, data: bytes, gas: int, block: tuple[int, int, bytes] | None) -> Answer:
    pyrevm: Any = pytest.importorskip("pyrevm")
    evm = pyrevm.EVM(spec_id="Cancun")
    if block is not None:
        evm.set_block_env(pyrevm.BlockEnv(number=block[0], timestamp=block[1], prevrandao=block[2]))
    for each, code in codes.items():
        evm.insert_account_info(to_hex(each), pyrevm.AccountInfo(code=code))
    intrinsic = intrinsic_gas(data)
    try:
        output = bytes(evm.message_call(to_hex(SENDER), to_hex(address), data, None, gas + intrinsic))
        status = Status.SUCCESS
    except RuntimeError as error:
        reason, output = evm.result.reason, b""
        if reason == "Revert":
            status, output = Status.REVERT, bytes.fromhex(str(error).partition("output: 0x")[2].rstrip(" }"))
        elif reason.startswith("OutOfGas"):
            status = Status.OUT_OF_GAS
        else:
            status = Status.FAILURE
    return Answer(status, output, evm.result.gas_used - intrinsic)


def pyevm_call(codes: Codes, address: bytes, data: bytes, gas: int) -> Answer:
    """Call in py-evm; skip the test where it is not installed."""
    return _once(_pyevm_call, codes, address, data, gas, None)


def _pyevm_call(codes: Codes, address: bytes, data: bytes, gas: int, _: None) -> Answer:
    exceptions: Any = pytest.importorskip("eth.exceptions")
    chain = PyEvmChain()
    for each, code in codes.items():
        chain.put(each, code)
    computation = chain.execute(address, data, gas)
    status = Status.SUCCESS
    if computation.is_error:
        kinds = {exceptions.Revert: Status.REVERT, exceptions.OutOfGas: Status.OUT_OF_GAS}
        status = next((kinds[kind] for kind in kinds if isinstance(computation.error, kind)), Status.FAILURE)
    return Answer(status, bytes(computation.output), computation.get_gas_used())
