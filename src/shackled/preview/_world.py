"""An EVM that has the contracts of the package and the author's, with what the author's calls have changed."""

from __future__ import annotations

import re
import threading
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from itertools import count

from .._load import locate
from ..artifacts import known_errors
from ..chain._embedded import RevmChain
from ..chain._failures import describe_revert
from ..deploy._contract import CONTRACTS, deployments
from ..errors import InputError
from ..ethereum._abi import Errors, error_table
from ..ethereum._encoding import intrinsic_gas, keccak256, word
from ..evm._instance import Answer, Instance, Status
from ..scene._decode import read_call
from ..scene._scene import Scene
from ..studio._storage import STUDIO, store_scene
from ..tokens._icons import scene_to_store
from ._arguments import Call, constructor_arguments, contract_of
from ._project import Compiled

#: Of a deployment or a call that changes something, and of one that only reads; it ends endless loops.
MOST_GAS = 1_000_000_000
#: The gas of one transaction on Ethereum (EIP-7825), and of a call on some nodes.
MAX_GAS = 1 << 24
#: Code that reverts with the data of its call, which contracts pass on.
RETURN_CALLDATA = bytes.fromhex("365f5f37365ffd")
#: The block of the deployment; each transaction has a block of its own.
FIRST_BLOCK = 20_000_000
SECONDS_PER_BLOCK = 12


class World:
    """The contract, deployed and set up. Threads call it at the same time, each in an instance of its own."""

    def __init__(
        self,
        contract: Compiled,
        given: Sequence[str] = (),
        setup: Sequence[Call] = (),
        stored: Mapping[bytes, bytes] | None = None,
    ) -> None:
        """Deploy the contract and send the calls.

        given: as of `constructor_arguments`. stored: code of further contracts, by address. InputError if the
        constructor or a call fails.
        """
        self.contract, self.setup = contract, setup
        self._now = int(time.time())
        chain = RevmChain()
        self._renderer = chain.address("Renderer")
        addresses = {name: chain.address(name) for name in CONTRACTS}
        #: Code of the contracts of the package and of what the Studio stores, by address.
        self.codes = {**chain.codes(), **(stored or {})}
        if _needs_library(contract, addresses["Library"]):
            from ..library import items

            self.codes |= {part.pointer: part.code for item in items() for part in item.transactions}
        self._creation = contract.creation + constructor_arguments(contract, given, addresses)
        self.errors: Errors = {**known_errors(), **error_table(contract.abi)}
        #: Transactions that take more gas than one may, each in one line.
        self.problems: list[str] = []
        self._free: list[Instance] = []
        self._lock = threading.Lock()
        self.address = b""
        with self._instance():
            pass

    def call(self, data: bytes, gas: int = MOST_GAS) -> Answer:
        """Call the contract with at most so much gas for the execution."""
        with self._instance() as evm:
            return evm.call(self.address, data, gas)

    def scene(self, data: bytes) -> Scene | None:
        """Return the scene that a call has the Renderer draw; None if there is none, or Python does not read it."""
        with self._instance() as evm:
            evm.put(self._renderer, RETURN_CALLDATA)
            try:
                output = evm.call(self.address, data, MOST_GAS).output
            finally:
                evm.put(self._renderer, self.codes[self._renderer])
        try:
            return read_call(output)
        except InputError:
            return None

    def reason(self, answer: Answer) -> str:
        """Return why a call was not successful."""
        if answer.status == Status.REVERT:
            said = describe_revert(answer.output, self.errors) if answer.output else "reverted without a reason"
            return in_units(said)
        if answer.status == Status.OUT_OF_GAS:
            return f"out of gas: {MOST_GAS:,} do not suffice; is there an endless loop?"
        said = answer.output.decode(errors="replace").removeprefix('Custom("').removesuffix('")')
        if said in ("OpcodeNotFound", "NotActivated"):
            return "the embedded EVM has the rules of Cancun, and does not know an instruction: compile for cancun"
        return said

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
        evm.hold(self.codes)
        blocks = count(FIRST_BLOCK)
        self._begin_block(evm, next(blocks))
        made = evm.deploy(self._creation, MOST_GAS)
        if made.status != Status.SUCCESS:
            reason = self.reason(made)
            if reason == "CreateContractSizeLimit":
                reason = "its code has more than 24,576 bytes (EIP-170): turn the optimizer on, or split it"
            raise InputError(f"{self.contract.name} cannot be deployed: {reason}")
        self.address = made.output
        problems = []
        # of the transaction, before the execution (EIP-2, EIP-3860)
        gas = made.gas + intrinsic_gas(self._creation) + 32_000 + 2 * -(-len(self._creation) // 32)
        if gas > MAX_GAS:
            problems.append(_too_expensive(f"the deployment of {self.contract.name}", gas))
        for call in self.setup:
            most = 0
            for number in range(call.times):
                self._begin_block(evm, next(blocks))
                answer = evm.send(self.address, call.data, MOST_GAS, call.value)
                if answer.status != Status.SUCCESS:
                    which = f" (number {number + 1} of {call.times})" if call.times > 1 else ""
                    raise InputError(f"the call {call.text}{which} failed: {self.reason(answer)}")
                most = max(most, answer.gas + intrinsic_gas(call.data))
            if most > MAX_GAS:
                problems.append(_too_expensive(f"the call {call.text}", most))
        self._begin_block(evm, next(blocks))
        self.problems = problems
        return evm

    def _begin_block(self, evm: Instance, number: int) -> None:
        """Set the block of the following calls: seconds pass, and the random value follows from the number."""
        seconds = SECONDS_PER_BLOCK * (number - FIRST_BLOCK)
        evm.set_block(number, self._now + seconds, keccak256(b"shackled preview" + word(number)))


def stored_scene(input: str) -> dict[bytes, bytes]:
    """Return the code of the contracts in which the Studio stores a scene, by address; the last is the scene itself.

    input: a piece of a dataset, a mesh or a scene file. The scene is that of `shackled store`.
    """
    scene = scene_to_store(locate(input))
    return {each.pointer: each.code for each in store_scene(scene, deployments([STUDIO])[-1].address)}


def _needs_library(contract: Compiled, library: bytes) -> bool:
    """Return whether the contract may ask the library: it is given its address, or has it in its code."""
    taken = [part for entry in contract.abi if entry["type"] == "constructor" for part in entry["inputs"]]
    return library in contract.creation or "Library" in map(contract_of, taken)


def _too_expensive(what: str, gas: int) -> str:
    return f"{what} takes {gas:,} gas, more than {MAX_GAS:,}, the most of one transaction"


#: Fractional bits of the quantities in errors; of other errors the numbers are whole, or their scale is the fault.
FRACTIONAL_BITS = {"OpacityOutOfRange": 24, "ExposureOutOfRange": 16, "SpotAngles": 32}
FRACTIONAL_BITS |= {
    f"{name}OutOfRange": 32
    for name in (
        *("HalfHeight", "Near", "Camera", "Light", "Coefficient", "Scale", "Rotation", "Spot", "Fog", "Ground"),
        *("Angle", "SpotAngles", "FieldOfView", "Height"),
    )
}
ERROR_TEXT = re.compile(r"(\w+)\((.*)\)", re.DOTALL)
QUANTITY = re.compile(r"\b(?!object=|light=)(\w+=)(-?\d+)\b")


def in_units(error: str) -> str:
    """Return an error, such as "FogOutOfRange(near=4294967296, far=0)", with its quantities in units."""
    match = ERROR_TEXT.fullmatch(error)
    bits = FRACTIONAL_BITS.get(match[1], 0) if match else 0
    # the error of the scene builder, which has no object, has whole units
    if error.startswith("PositionOutOfRange(object="):
        bits = 32
    return QUANTITY.sub(lambda found: f"{found[1]}{int(found[2]) / (1 << bits):.12g}", error) if bits else error
