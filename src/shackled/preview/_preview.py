"""One preview: the contract as its sources are now, and its tokens."""

from __future__ import annotations

import os
import re
from collections.abc import Generator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from itertools import islice
from typing import Any

from ..errors import InputError
from ..ethereum._abi import Interface
from ..ethereum._encoding import intrinsic_gas
from ..evm._instance import Status
from ..gas._quick_path import quick_path_note
from ._arguments import parse_call
from ._document import Document, judge, judge_picture, unicode_fault
from ._project import Compiled, Project
from ._world import MAX_GAS, MOST_GAS, World

#: The call of `totalSupply`.
SUPPLY = bytes.fromhex("18160ddd")
#: Numbers of tokens are below it.
END = 1 << 256
#: How many tokens are read where nothing else says it, and at most.
MOST_TOKENS = 256
#: Words in the errors of tokens that do not exist: ERC721NonexistentToken, TokenDoesNotExist, "invalid token ID".
NONEXISTENT = re.compile(r"non.?existent|not.?exist|not.?minted|unminted|invalid.?token|no.?such.?token", re.IGNORECASE)
#: Functions that are looked for, in this order.
FUNCTIONS = ("tokenURI", "uri", "image", "render", "svg")
#: Functions that return metadata; others return pictures.
METADATA = ("tokenURI", "uri")
#: What is said of a picture without an object.
EMPTY = (
    "the picture shows only the background: faces may be clockwise (swap two indices, or set object.flags = 0) "
    "or out of sight (call stage.fit last); see docs/building.md#visible-sides"
)


@dataclass(frozen=True)
class Request:
    """What the author asks for.

    contract: its name; None for the only one of the file. arguments: of its constructor. setup: calls before the
    first token is read. function: that is read; None for the first of `FUNCTIONS`. first: the first token; None
    for 0, or 1 where there is no token 0. count: how many tokens; None for as many as `totalSupply` says, up to 256.
    max_gas: of a read, with that of its data. stored: code of contracts that are there already, by address.
    allow_empty: whether pictures may show only the background.
    """

    contract: str | None = None
    arguments: tuple[str, ...] = ()
    setup: tuple[str, ...] = ()
    function: str | None = None
    first: int | None = None
    count: int | None = None
    max_gas: int = MAX_GAS
    stored: Mapping[bytes, bytes] = field(default_factory=dict)
    allow_empty: bool = False


@dataclass
class Token:
    """A token. gas: of the execution and the data of the call; None if it failed. bytes: of what it returned.

    notes: what costs gas that it need not, each in one line.
    """

    number: int
    gas: int | None = None
    bytes: int = 0
    document: Document = field(default_factory=Document)
    problems: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)


class Preview:
    """A contract that is compiled and deployed, and set up for its tokens to be read."""

    def __init__(self, project: Project, request: Request) -> None:
        """Compile, deploy, and send the calls. InputError with the reason if a step fails."""
        self.request = request
        self.contract, self.function = _chosen(project.compile(), request)
        self._interface = Interface([self.function])
        setup = [parse_call(text, self.contract) for text in request.setup]
        self.world = World(self.contract, request.arguments, setup, request.stored)
        #: What is wrong with the deployment and the calls, each in one line.
        self.problems = self.world.problems
        #: Whether the tokens have numbers.
        self.is_numbered = bool(self.function["inputs"])
        #: Whether a token took so much gas that the others get only what they may take.
        self._is_endless = False
        self.first = self._first() if request.first is None else request.first
        if not 0 <= self.first < END:
            raise InputError(f"the first token must be from 0 to 2^256 - 1, not {self.first}")
        wanted = self._supply() if request.count is None else request.count
        self.count = min(wanted, END - self.first) if self.is_numbered else 1

    def hint(self, tokens: Sequence[Token]) -> str | None:
        """Return what the author may have forgotten, if no token could be read."""
        if self.request.setup or not self.is_numbered or not tokens or any(token.gas is not None for token in tokens):
            return None
        return "no token could be read: if they must be minted first, call the contract with `setup`, as in 'mint(3)'"

    def tokens(self) -> Generator[Token, None, None]:
        """Yield the tokens in the order of their numbers; several are read at the same time."""
        numbers = iter(range(self.first, self.first + self.count))
        size = os.cpu_count() or 1
        threads = ThreadPoolExecutor(size)
        try:
            # as many waiting as are read: who stops early waits for few
            waiting = [threads.submit(self.token, number) for number in islice(numbers, 2 * size)]
            while waiting:
                token = waiting.pop(0).result()
                following = next(numbers, None)
                if following is not None:
                    waiting.append(threads.submit(self.token, following))
                yield token
        finally:
            threads.shutdown(cancel_futures=True)

    def token(self, number: int) -> Token:
        """Read one token, and judge it."""
        data = self._data(number)
        intrinsic, name = intrinsic_gas(data), self.function["name"]
        limit = self.request.max_gas
        answer = self.world.call(data, max(0, limit - intrinsic))
        problems = []
        if answer.status != Status.SUCCESS:
            # with more gas: does the limit fail, or the contract?
            free = answer if self._is_endless else self.world.call(data, MOST_GAS)
            if free.status != Status.SUCCESS:
                is_short = self._is_endless and free.status == Status.OUT_OF_GAS
                self._is_endless |= free.gas > MOST_GAS // 2
                reason = f"more than {limit:,} gas are needed" if is_short else self.world.reason(free)
                return Token(number, problems=[f"{name}{self._shown(number)} fails: {reason}"])
            answer = free
            problems = [f"{name}{self._shown(number)} takes {answer.gas + intrinsic:,} gas, more than {limit:,} allow"]
        try:
            value = self._interface.decode(name, answer.output)
        except ValueError as error:
            fault = f"{name}{self._shown(number)} returns {_output_fault(answer.output, error)}"
            return Token(number, answer.gas + intrinsic, problems=[*problems, fault])
        document = judge(value) if name in METADATA else judge_picture(value)
        files = (document.image, document.animation)
        if not self.request.allow_empty and any(file and file.is_empty for file in files):
            problems.append(EMPTY)
        size = len(value.encode() if isinstance(value, str) else value)
        scene = self.world.scene(data)
        note = "" if scene is None else quick_path_note(scene)
        return Token(
            number, answer.gas + intrinsic, size, document, problems + document.problems, [note] if note else []
        )

    def _first(self) -> int:
        """Return 1 where there is no token 0, but a token 1."""
        return int(self.is_numbered and self._is_missing(0) and not self._is_missing(1))

    def _is_missing(self, number: int) -> bool:
        """Return whether a call fails as calls for tokens do that do not exist; other failures are to be shown."""
        # a token that is too expensive would also revert without a reason, where a call inside runs out of gas
        answer = self.world.call(self._data(number), MOST_GAS)
        is_told = not answer.output or NONEXISTENT.search(self.world.reason(answer)) is not None
        return answer.status == Status.REVERT and answer.gas <= MAX_GAS and is_told

    def _supply(self) -> int:
        """Return how many tokens there are, up to `MOST_TOKENS`; also that many where nobody knows."""
        if any(each["type"] == "function" and each["name"] == "totalSupply" for each in self.contract.abi):
            answer = self.world.call(SUPPLY)
            if answer.status == Status.SUCCESS and len(answer.output) == 32:
                return min(int.from_bytes(answer.output), MOST_TOKENS) or MOST_TOKENS
        return MOST_TOKENS

    def _data(self, number: int) -> bytes:
        return self._interface.encode(self.function["name"], *([number] if self.is_numbered else []))

    def _shown(self, number: int) -> str:
        return f"({number})" if self.is_numbered else "()"


def _output_fault(output: bytes, error: ValueError) -> str:
    """Return what is wrong with the output of a function that returns text or bytes."""
    if not output:
        return "nothing"
    if isinstance(error.__cause__, UnicodeDecodeError):
        return f"no valid {unicode_fault(error.__cause__)}"
    return f"{len(output)} bytes that are not text or bytes as the ABI encodes them"


def _chosen(contracts: list[Compiled], request: Request) -> tuple[Compiled, dict[str, Any]]:
    """Return the contract to show, the named one or the only one that can be shown, and the function to read."""
    names = ", ".join(each.name for each in contracts) or "none"
    if request.contract is not None:
        contracts = [each for each in contracts if each.name == request.contract]
        if not contracts:
            raise InputError(f"there is no contract {request.contract!r} in the file, but {names}")
    shown = [(each, found[0]) for each in contracts if (found := _functions(each, request.function))]
    if len(shown) > 1:
        raise InputError(f"choose one of {', '.join(each.name for each, _ in shown)} with `contract`")
    if not shown:
        raise InputError(
            f"no contract of the file has a function {request.function or 'tokenURI'} of one number or none that "
            f"returns text or bytes; its contracts: {', '.join(each.name for each in contracts) or 'none'}"
        )
    return shown[0]


def _functions(contract: Compiled, name: str | None) -> list[dict[str, Any]]:
    """Return the functions of a name, or of `FUNCTIONS`, that take one number or nothing, and return text or bytes."""
    wanted = FUNCTIONS if name is None else (name,)
    fitting = [
        each
        for each in contract.abi
        if each["type"] == "function"
        and each["name"] in wanted
        and [given["type"] for given in each["inputs"]] in ([], ["uint256"])
        and [given["type"] for given in each["outputs"]] in (["string"], ["bytes"])
    ]
    return sorted(fitting, key=lambda each: (wanted.index(each["name"]), -len(each["inputs"])))
