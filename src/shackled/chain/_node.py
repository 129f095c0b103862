"""A node that is asked over JSON-RPC. Contracts need not be deployed there: a call can bring them along."""

from __future__ import annotations

import threading
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
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
from ..ethereum import checksum_address, intrinsic_gas, to_hex, word
from ..scene import Rectangle, Scene, encode
from ._address_book import AddressBook
from ._chain import Drawing, count_call, returned_bytes, returned_counts
from ._connection import Connection
from ._embedded import DEFAULT_GAS_LIMIT, EmbeddedChain
from ._refusal import out_of_gas, refusal

#: EIP-3860: the longest data of a call that creates a contract.
MAX_INIT_CODE = 49152

#: Where a call places the contract that counts gas.
METER = bytes.fromhex("5ac61ed000000000000000000000000000000002")

#: Says how much gas is left, in the words of the EVM: GAS PUSH0 MSTORE, an MCOPY of nothing, PUSH1 32 PUSH0 RETURN.
#: Like the contracts it needs the rules of Cancun.
GAS_LEFT = bytes.fromhex("5a5f525f5f5f5e60205ff3")


class Way(Enum):
    """How a node gets the contracts that it is to run."""

    DEPLOYED = "deployed"
    OVERRIDE = "state override"
    CREATION = "creation call"


@dataclass(frozen=True)
class NodeResult:
    """What a contract returned. gas: of its execution alone, as embedded EVMs count it; None where nothing tells."""

    output: bytes
    gas: int | None


class NodeChain:
    """Makes calls by `eth_call`: of contracts that are deployed, or else with their code in a state override, or else,
    where a node refuses those, by a call that creates them first. Which it is, is found out once and kept.

    Several threads may use it at once.
    """

    def __init__(
        self,
        connection: Connection,
        local: EmbeddedChain,
        address: bytes | None = None,
        book: AddressBook | None = None,
    ) -> None:
        """Prepare calls; nothing is asked yet.

        local: sets up the contracts whose code is sent or compared. address: of a deployed renderer that is to be
        called. book: where addresses are looked up; None takes the user's.
        """
        self.connection = connection
        self._local = local
        self._address = address
        self._book = AddressBook() if book is None else book
        self._places: dict[str, bytes | None] = {}
        self._ways: set[Way] = set()
        self._lock = threading.RLock()
        self._answers_creations = True
        local.address("Renderer")  # set up here, before several threads ask for it

    @property
    def name(self) -> str:
        """What it is, for people, and how it got the contracts, as soon as it was called."""
        ways = ", ".join(way.value for way in Way if way in self._ways)
        return self.connection.name + (f" ({ways})" if ways else "")

    def draw(self, scene: Scene, tile: Rectangle | None = None) -> Drawing:
        """Return the picture of a scene, or of a part of its canvas."""
        data = encode(artifact("Renderer").selectors["render" if tile is None else "renderTile"], scene, tile)
        result = self.call("Renderer", data)
        return Drawing(returned_bytes(result.output, 0), result.gas, intrinsic_gas(data))

    def count(self, scene: Scene, tile: Rectangle | None = None) -> tuple[int, int]:
        """Count the triangles left after culling and clipping, and the pixels of the canvas or tile that they cover."""
        return returned_counts(self.call("Renderer", count_call(scene, tile)).output)

    def call(self, contract: str, data: bytes, gas_limit: int | None = None) -> NodeResult:
        """Calls a contract, by the name of its artifact, with at most `gas_limit` gas for the execution.

        None leaves the limit to the node.
        ChainError of the kind that says what failed: the contract, the gas, or the node.
        """
        try:
            place = self.place(contract)
            if self._probed.overrides:
                result = self._metered(contract, place, data, gas_limit)
            elif place is not None:
                result = self._plain(place, data, gas_limit)
            else:
                result = self._created(contract, data, gas_limit)
        except RevertError as error:
            raise self._refused(error.data, gas_limit) from None
        except OutOfGasError:
            raise (self._refused(None, gas_limit) if self.gas_limit else self.too_little()) from None
        self._ways.add(Way.DEPLOYED if place is not None else Way.OVERRIDE if self._probed.overrides else Way.CREATION)
        return result

    @property
    def gas_limit(self) -> int:
        """The gas that a render may use, asked once: for its execution and what is paid before that, `Drawing.gas` and
        `Drawing.intrinsic_gas`. 0 if a call has too little even for what comes along.
        """
        # a call hands on all but a 64th
        return max(0, self._probed.gas * 63 // 64 - 30_000 - self._carried_gas)

    def too_little(self) -> OutOfGasError:
        """Return the error of a node whose calls have too little gas for any render."""
        said = f"the {self.connection.name} allows a call too little gas for this: {self._probed.gas:,}"
        if not self._carried_gas:
            return OutOfGasError(f"{said}; raise its limit, or take another node")
        return OutOfGasError(
            f"{said}, and it knows no state overrides: to bring the contracts along takes up to {self._carried_gas:,}; "
            "run shackled deploy, raise its limit, or take another node"
        )

    def place(self, contract: str) -> bytes | None:
        """Return where a contract is deployed on the node's chain, as it is here; None if it is not.

        RenderError if a renderer was named and what is there is none.
        """
        with self._lock:
            if contract not in self._places:
                self._places[contract] = self._named(contract) if self._address else self._find(contract)
            return self._places[contract]

    def _named(self, contract: str) -> bytes | None:
        """Return the renderer that was named, or one of its engines."""
        assert self._address is not None
        if contract not in RENDERER:
            return None
        where = f"{checksum_address(self._address)} on chain {self.connection.chain_id} (the {self.connection.name})"
        code = self._code(self._address)
        if not code:
            raise RenderError(
                f"there is no contract at {where}: put one there with shackled deploy, or leave out `address`"
            )
        parts = self._parts("Renderer", code)
        if parts is None or any(self._code(place) != self._local.code(part) for part, place in parts.items()):
            raise RenderError(
                f"the contract at {where} is not the renderer of this version of shackled: "
                "name another one, or leave out `address`"
            )
        return parts.get(contract, self._address)

    def _find(self, contract: str) -> bytes | None:
        known = self._book.find(self.connection.chain_id, contract)
        for address in {self._local.address(contract): None, known: None}:
            if address is not None and self._stands(contract, address):
                return address
        return None

    def _stands(self, contract: str, address: bytes) -> bool:
        """Return whether the contract, and those that it calls, are there."""
        parts = self._parts(contract, self._code(address))
        return parts is not None and all(self._stands(part, place) for part, place in parts.items())

    def _parts(self, contract: str, code: bytes) -> dict[str, bytes] | None:
        """Return the addresses of those that it calls, from the code of a contract; None if the code is not its own."""
        expected, parts = self._local.code(contract), {}
        for part in artifact(contract).parts:
            here = word(self._local.address(part))
            at = expected.find(here)
            there = code[at : at + 32]
            if at >= 0 and len(there) == 32:
                expected = expected.replace(here, there)
                parts[part] = there[12:]
        return parts if code == expected else None

    def _code(self, address: bytes) -> bytes:
        return self.connection.code(address)

    def _metered(self, contract: str, place: bytes | None, data: bytes, gas_limit: int | None) -> NodeResult:
        """Call a contract through the Meter, with the contracts that are not deployed in the same state override."""
        codes = {}
        if place is None:
            place = self._local.address(contract)
            for name in [contract, *self._below(contract)]:
                codes[self._local.address(name)] = self._local.code(name)
        return metered(self.connection, place, data, gas_limit, codes, self._probed.field)

    def _plain(self, place: bytes, data: bytes, gas_limit: int | None) -> NodeResult:
        """Call what is deployed, by a creation that counts its gas if that is possible."""
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
        """Call a contract by a creation that makes the contracts first."""
        names = [*reversed(self._below(contract)), contract]
        codes = [artifact(name).creation for name in names]
        packed = b"".join(len(code).to_bytes(4, "big") + code for code in codes) + data
        head = artifact("CreationCall").creation + _limit(gas_limit) + word(len(codes))
        # as it is if there is room, since what is packed has to be unpacked, for gas
        for level in (0, 9):
            deflate = zlib.compressobj(level, zlib.DEFLATED, -15, 9)
            init = head + _bytes(deflate.compress(packed) + deflate.flush(), 96)
            if len(init) <= MAX_INIT_CODE:
                return self._carried(init)
        raise NodeError(
            f"the {self.connection.name} knows no state overrides, and the scene of {len(data):,} bytes is too large "
            f"for a creation call with the contracts: {len(init):,} bytes packed, of {MAX_INIT_CODE:,} allowed; "
            "run shackled deploy, take a smaller `max_triangles`, or another node"
        )

    def _carried(self, init: bytes) -> NodeResult:
        """Make a creation call that brings the contracts along, and return what it says."""
        try:
            return self._answer_of(init)
        except (NoAnswerError, TooLargeError, WrongChainError):
            raise
        except NodeError as error:
            if not self._probed.creations:
                raise NodeError(
                    f"{error}: it takes neither state overrides nor creation calls, and the contracts are not deployed "
                    "on its chain; run shackled deploy, or take another node"
                ) from None
            if not self.gas_limit:
                # a creation that runs out of gas may say nothing
                raise self.too_little() from None
            raise

    def _answer_of(self, init: bytes) -> NodeResult:
        """Make a creation call that ends by a revert, and return what it says of the call that it made."""
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
        raise NodeError(
            f"the {self.connection.name} knows no state overrides, and keeps back what a creation call says: "
            "take another node, or one where the contracts are deployed"
        )

    def _below(self, contract: str) -> list[str]:
        """Return the contracts that a contract needs, the nearest first."""
        parts = artifact(contract).parts
        return parts + [each for part in parts for each in self._below(part)]

    def _refused(self, data: bytes | None, gas_limit: int | None) -> ChainError:
        """Return the error of a call whose contract said this, or, with None, that had too little gas."""
        failure = out_of_gas(gas_limit or 0) if data is None else refusal(data, gas_limit or 0)
        if isinstance(failure, OutOfGasError) and gas_limit is None:
            hint = "take a smaller `size`, or raise its limit"
            return OutOfGasError(f"the {self.connection.name} allows a call too little gas for this: {hint}")
        return failure

    @cached_property
    def _probed(self) -> _Probed:
        with self._lock:
            return _probe(self.connection)

    @property
    def _carried_gas(self) -> int:
        """Above what it costs to bring the contracts along beside the render: unpacking, and each byte of code."""
        if self._probed.overrides or self.place("Renderer") is not None:
            return 0
        sizes = [(len(self._local.code(name)), len(artifact(name).creation)) for name in RENDERER]
        return 6_000_000 + sum(200 * code + 200 * packed for code, packed in sizes)


@dataclass(frozen=True)
class _Probed:
    """What a node allows. gas: of a call, and whether a call has to name it to get as much. creations: whether it was
    seen to answer a call that creates a contract, where it knows no overrides.
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
    """Call a contract through the Meter, which counts gas and which a state override puts on the chain for that long.

    codes: more code for the override, by its address. fields: more fields of the request, such as its gas.
    """
    codes = {METER: artifact("Meter").runtime, **(codes or {})}
    overrides = {to_hex(address): {"code": to_hex(code)} for address, code in codes.items()}
    request = {"to": to_hex(METER), "data": to_hex(word(place) + _limit(gas_limit) + data), **(fields or {})}
    output = connection.data("eth_call", request, "latest", overrides)
    return NodeResult(output[32:], int.from_bytes(output[:32], "big"))


def _probe(connection: Connection) -> _Probed:
    """Find out whether a node knows state overrides, and how much gas a call gets that asks for much or for none."""
    override = {to_hex(METER): {"code": to_hex(GAS_LEFT)}}
    for overrides in (True, False):
        found = []
        for named in (True, False):
            request = {"to": to_hex(METER)} if overrides else {"data": to_hex(GAS_LEFT)}
            if named:
                request["gas"] = hex(DEFAULT_GAS_LIMIT)
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
            # what need not be named is better not named
            return max(found, key=lambda each: (each.gas, not each.named))
    # it makes no creation calls, and what is deployed has to do
    return _Probed(False, connection.block_gas_limit(), False, creations=False)


def _limit(gas: int | None) -> bytes:
    """Encode a limit as the contracts take it: 0 is none."""
    return word(0 if gas is None else max(1, gas))


def _bytes(data: bytes, offset: int) -> bytes:
    """Return the last argument, of type bytes, which begins so many bytes behind the first."""
    return word(offset) + word(len(data)) + data + bytes(-len(data) % 32)
