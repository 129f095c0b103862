"""Contract calls on a node, over JSON-RPC, with or without contracts that are deployed there."""

from __future__ import annotations

import threading
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from ..artifacts import RENDERER, artifact
from ..errors import (
    ChainError,
    NoAnswerError,
    NodeError,
    OutOfGasError,
    RenderError,
    RevertError,
    TooLargeError,
    WrongChainError,
)
from ..ethereum._encoding import checksum_address, intrinsic_gas, to_hex, word
from ._address_book import AddressBook
from ._chain import ContractCaller, NodeResult
from ._connection import Connection
from ._embedded import DEFAULT_GAS_LIMIT, EmbeddedChain
from ._engines import ANTIALIASED, engines
from ._failures import SAID, TOO_LITTLE_GAS, out_of_gas, revert_error

#: Maximum size of the data of a call that creates a contract (EIP-3860).
MAX_INIT_CODE = 49152

#: Address at which a state override places the contract Meter, which counts gas.
METER = bytes.fromhex("5ac61ed000000000000000000000000000000002")

#: A program that returns the remaining gas: GAS PUSH0 MSTORE, an empty MCOPY, PUSH1 32 PUSH0 RETURN.
#: Like the contracts, it needs the rules of Cancun.
GAS_LEFT = bytes.fromhex("5a5f525f5f5f5e60205ff3")


class NodeChain(ContractCaller):
    """A chain that is accessed through a node, with `eth_call`.

    It calls deployed contracts if there are any; otherwise code in a state override; otherwise, if the node does not
    support overrides, contracts that are created within the call. Safe for several threads.
    """

    def __init__(self, connection: Connection, local: EmbeddedChain, address: bytes | None = None) -> None:
        """Prepare calls. local: an EVM with the code of the contracts. address: of the deployed renderer to call."""
        self.connection = connection
        self._local = local
        self._address = address
        self._book = AddressBook()
        self._places: dict[str, bytes | None] = {}
        self._ways: set[str] = set()
        self._lock = threading.RLock()
        self._answers_creations = True
        local.address("Renderer")  # created now, before several threads need it

    @property
    def name(self) -> str:
        """Description for reports; after the first call, with how the node got the contracts."""
        return self.connection.name + (f" ({', '.join(sorted(self._ways))})" if self._ways else "")

    def call(self, contract: str, data: bytes, gas_limit: int | None = None) -> NodeResult:
        """Call a contract, by the name of its artifact, with at most `gas_limit` gas for the execution.

        None uses the node's limit. Raises a ChainError whose class says what failed: contract, gas, or node.
        """
        try:
            place = self.place(contract)
            if self._probed.overrides:
                way, result = "state override", self._metered(contract, place, data, gas_limit)
            elif place is not None:
                way, result = "deployed", self._plain(place, data, gas_limit)
            else:
                way, result = "creation call", self._created(contract, data, gas_limit)
        except RevertError as error:
            failure = revert_error(error.data, gas_limit or 0)
            if isinstance(failure, OutOfGasError) and gas_limit is None:
                failure = OutOfGasError(f"the {self.connection.name} {SAID[TOO_LITTLE_GAS][1]}")
            raise failure from None
        except OutOfGasError:
            if not self.gas_limit:
                raise self.too_little() from None
            if gas_limit is None:
                raise
            raise out_of_gas(gas_limit) from None
        self._ways.add(way if place is None else "deployed")
        return result

    @property
    def gas_limit(self) -> int:
        """Gas that a render may use, `Drawing.gas` and `Drawing.intrinsic_gas` together, requested once.

        0 if a call has too little gas even for the contracts that it brings.
        """
        # a call passes on all but a 64th
        return max(0, self._probed.gas * 63 // 64 - 30_000 - self._carried_gas)

    def too_little(self) -> OutOfGasError:
        """Return the error for a node whose calls have too little gas for any render."""
        why, deploy = "", ""
        if self._carried_gas:
            why = f", and it has no state overrides: creating the contracts takes up to {self._carried_gas:,}"
            deploy = "run shackled deploy, "
        return OutOfGasError(
            f"the {self.connection.name} allows a call too little gas for this: {self._probed.gas:,}{why}; "
            f"{deploy}raise its limit, or use another node"
        )

    def place(self, contract: str) -> bytes | None:
        """Return the address at which a contract of this version is deployed; None if it is not deployed.

        Raises RenderError if `address` was given and is not that of a renderer.
        """
        with self._lock:
            if contract in self._places:
                return self._places[contract]
            if self._address is None:
                known = self._book.find(self.connection.chain_id, contract)
                places = [each for each in (self._local.address(contract), known) if each is not None]
                found = next((each for each in places if self._stands(contract, each)), None)
            else:
                found = self._named(contract, self._address) if contract in RENDERER else None
            self._places[contract] = found
            return found

    def _named(self, contract: str, renderer: bytes) -> bytes:
        """Return the address of the given renderer, or of one of its engines."""
        where = f"{checksum_address(renderer)} on chain {self.connection.chain_id} (the {self.connection.name})"
        code = self.connection.code(renderer)
        if not code:
            raise RenderError(f"there is no contract at {where}: run shackled deploy, or leave out `address`")
        if not self._stands("Renderer", renderer):
            raise RenderError(
                f"the contract at {where} is not the renderer of this version of shackled: "
                "give another address, or leave out `address`"
            )
        return (self._parts("Renderer", code) or {}).get(contract, renderer)

    def _stands(self, contract: str, address: bytes) -> bool:
        """Return whether a contract, and those that it calls, are deployed."""
        parts = self._parts(contract, self.connection.code(address))
        return parts is not None and all(self._stands(part, place) for part, place in parts.items())

    def _parts(self, contract: str, code: bytes) -> dict[str, bytes] | None:
        """Return the addresses of the contracts that a contract calls, from its code; None if the code differs."""
        expected, parts = self._local.code(contract), {}
        for part in artifact(contract).parts:
            here = word(self._local.address(part))
            at = expected.find(here)
            there = code[at : at + 32]
            if at >= 0 and len(there) == 32:
                expected = expected.replace(here, there)
                parts[part] = there[12:]
        return parts if code == expected else None

    def _metered(self, contract: str, place: bytes | None, data: bytes, gas_limit: int | None) -> NodeResult:
        """Call a contract through the Meter, with the contracts that are not deployed in the same state override."""
        codes: dict[bytes, bytes] = {}
        if place is None:
            place = self._local.address(contract)
            names = [contract, *self._below(contract, data)]
            # the first engine draws the background where nothing is seen; any of them can
            codes = {
                self._local.address(ANTIALIASED[0]): self._local.code(each) for each in names if each in ANTIALIASED
            }
            codes |= {self._local.address(name): self._local.code(name) for name in names}
        return metered(self.connection, place, data, gas_limit, codes, self._probed.field)

    def _plain(self, place: bytes, data: bytes, gas_limit: int | None) -> NodeResult:
        """Call a deployed contract, through a creation call that counts its gas if the node supports that."""
        init = artifact("DeployedCall").creation + word(place) + _limit(gas_limit) + _bytes(data, 96)
        if len(init) <= MAX_INIT_CODE and self._answers_creations:
            try:
                return self._answer_of(init)
            except (RevertError, OutOfGasError, NoAnswerError):
                raise
            except NodeError:
                self._answers_creations = False
        field = self._probed.field if gas_limit is None else {"gas": hex(gas_limit + intrinsic_gas(data))}
        request = {"to": to_hex(place), "data": to_hex(data)} | field
        return NodeResult(self.connection.data("eth_call", request, "latest"), None)

    def _created(self, contract: str, data: bytes, gas_limit: int | None) -> NodeResult:
        """Call a contract through a creation call that creates the contracts first."""
        names = list(dict.fromkeys([*reversed(self._below(contract, data)), contract]))
        numbers = {name: number for number, name in enumerate(names)}
        # in place of those that do not draw: every engine counts triangles
        any_engine = max((number for name, number in numbers.items() if name.endswith("Engine")), default=0)
        packed = b""
        for built in map(artifact, names):
            arguments = bytes(numbers.get(part, any_engine) for part in built.parts)
            packed += len(built.creation).to_bytes(4, "big") + arguments.ljust(8, b"\0") + built.creation
        packed += data
        head = artifact("CreationCall").creation + _limit(gas_limit) + word(len(names))
        # uncompressed if it fits, since decompression costs gas
        for level in (0, 9):
            # blocks of memory level 6 are short, and their codes suit code and meshes better than those of 9: 2 % less
            deflate = zlib.compressobj(level, zlib.DEFLATED, -15, 6)
            init = head + _bytes(deflate.compress(packed) + deflate.flush(), 96)
            if len(init) <= MAX_INIT_CODE:
                return self._carried(init)
        raise NodeError(
            f"the {self.connection.name} has no state overrides, and the scene of {len(data):,} bytes is too large for "
            f"a creation call with the contracts: {len(init):,} bytes compressed, of {MAX_INIT_CODE:,} allowed; "
            "run shackled deploy, use a smaller `max_triangles`, or another node"
        )

    def _carried(self, init: bytes) -> NodeResult:
        """Make a creation call that brings the contracts, and return its result."""
        try:
            return self._answer_of(init)
        except (NoAnswerError, TooLargeError, WrongChainError):
            raise
        except NodeError as error:
            if self._probed.creations and not self.gas_limit:
                # a creation that runs out of gas may return nothing
                raise self.too_little() from None
            raise NodeError(
                f"{error}: it has no state overrides, and the contracts are not deployed on its chain; "
                "run shackled deploy, or use another node"
            ) from None

    def _answer_of(self, init: bytes) -> NodeResult:
        """Make a creation call, which ends with a revert, and return the result in the data of that."""
        try:
            self.connection.request("eth_call", {"data": to_hex(init)} | self._probed.field, "latest")
        except RevertError as error:
            flag, gas, output = error.data[:32], int.from_bytes(error.data[32:64], "big"), error.data[64:]
            if flag == word(1):
                return NodeResult(output, gas)
            if flag == word(0):
                raise RevertError(str(error), output) from None
            if error.data[:4] in artifact("CreationCall").errors:
                # NotCreated: one of the contracts ran out of gas
                raise self.too_little() from None
        raise NodeError(f"the {self.connection.name} does not return the data of a reverted creation call")

    def _below(self, contract: str, data: bytes) -> list[str]:
        """Return the contracts that a call needs, each before those that it needs; engines only if they draw."""
        parts = artifact(contract).parts
        if contract == "Renderer":
            parts = list(engines(data[4 + int.from_bytes(data[4:36], "big") :], self._local))
        # whose calls have a scene in the same place
        below = data if contract == "Turntable" else b""
        return parts + [each for part in parts for each in self._below(part, below)]

    @cached_property
    def _probed(self) -> _Probed:
        with self._lock:
            return _probe(self.connection)

    @property
    def _carried_gas(self) -> int:
        """An upper bound of the gas that a creation call uses to decompress and create the contracts."""
        if self._probed.overrides or self.place("Renderer") is not None:
            return 0
        sizes = [(len(self._local.code(name)), len(artifact(name).creation)) for name in (*ANTIALIASED, "Renderer")]
        return 6_000_000 + sum(200 * code + 200 * packed for code, packed in sizes)


@dataclass(frozen=True)
class _Probed:
    """What a node supports.

    overrides: state overrides. gas: the maximum of a call. named: whether a call gets that only if it asks for it.
    creations: whether it answers creation calls; only tested without overrides.
    """

    overrides: bool
    gas: int
    named: bool
    creations: bool = True

    @property
    def field(self) -> dict[str, str]:
        return {"gas": hex(self.gas)} if self.named else {}


def metered(
    connection: Connection,
    place: bytes,
    data: bytes,
    gas_limit: int | None = None,
    codes: Mapping[bytes, bytes] | None = None,
    fields: Mapping[str, str] | None = None,
) -> NodeResult:
    """Call a contract through the contract Meter, in a state override, which counts the gas of the execution.

    codes: more code for the override, by address. fields: more fields of the request, such as its gas.
    """
    codes = {METER: artifact("Meter").runtime, **(codes or {})}
    overrides = {to_hex(address): {"code": to_hex(code)} for address, code in codes.items()}
    request = {"to": to_hex(METER), "data": to_hex(word(place) + _limit(gas_limit) + data), **(fields or {})}
    output = connection.data("eth_call", request, "latest", overrides)
    return NodeResult(output[32:], int.from_bytes(output[:32], "big"))


def _probe(connection: Connection) -> _Probed:
    """Test whether a node supports state overrides, and how much gas a call gets that asks for much or for none."""
    override = {to_hex(METER): {"code": to_hex(GAS_LEFT)}}
    for overrides in (True, False):
        found = []
        for named in (True, False):
            request = {"to": to_hex(METER)} if overrides else {"data": to_hex(GAS_LEFT)}
            request |= {"gas": hex(DEFAULT_GAS_LIMIT)} if named else {}
            try:
                output = connection.data("eth_call", request, "latest", *([override] if overrides else []))
            except (NoAnswerError, WrongChainError):
                raise
            except ChainError:
                continue
            if len(output) == 32:
                left = int.from_bytes(output, "big")
                found.append(_Probed(overrides, left + intrinsic_gas(b"" if overrides else GAS_LEFT), named))
        if found:
            # prefer calls that do not ask for an amount
            return max(found, key=lambda each: (each.gas, not each.named))
    # without creation calls, only deployed contracts can be called
    return _Probed(False, connection.block_gas_limit(), False, creations=False)


def _limit(gas: int | None) -> bytes:
    """Encode a gas limit for the contracts: 0 for none."""
    return word(0 if gas is None else max(1, gas))


def _bytes(data: bytes, offset: int) -> bytes:
    """Encode the last argument, of type bytes, at an offset."""
    return word(offset) + word(len(data)) + data + bytes(-len(data) % 32)
