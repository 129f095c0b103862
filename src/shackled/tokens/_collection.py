"""A collection on a chain, as anyone can read it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from ..chain import GAS_LEFT, Connection, describe
from ..errors import ChainError, InputError, NodeError, OutOfGasError, RevertError
from ..ethereum import checksum_address, to_hex
from ._contract import Contract
from ._kinds import KINDS, Kind
from ._metadata import Metadata, read_token_uri
from ._refusals import PHASES

#: Requests under way at once.
AT_ONCE = 6


@dataclass(frozen=True)
class Terms:
    """How a collection stands.

    allow_list_root: zeros if there is none. royalty: in hundredths of a percent. balance: in wei, not withdrawn yet.
    """

    name: str
    symbol: str
    owner: str
    phase: int
    minted: int
    per_transaction: int
    allow_list_root: bytes
    allow_list_signer: str
    royalty_receiver: str
    royalty: int
    balance: int

    @property
    def phase_words(self) -> str:
        """The phase, for people."""
        return PHASES[self.phase]


@dataclass(frozen=True)
class Token:
    """A token that was minted."""

    number: int
    owner: str
    revealed: bool


class Collection:
    """A collection at an address."""

    def __init__(self, connection: Connection, kind: Kind, address: str) -> None:
        """Take a collection of a known kind; `open_collection` asks what kind it is."""
        self.connection, self.kind, self.address = connection, kind, address
        self.contract = Contract(connection, kind.contract, address)

    @cached_property
    def name(self) -> str:
        """As the contract says it."""
        return str(self.contract.call("name"))

    def minted(self) -> int:
        """Return how many tokens there are; they are numbered from 0."""
        return int(self.contract.call("totalSupply"))

    def owner_of(self, token: int) -> str:
        """Whose a token is. InputError if there is none of that number."""
        return self._address(self._of_token("ownerOf", token))

    def token(self, number: int) -> Token:
        """Return a token. InputError if there is none of that number."""
        return Token(number, self.owner_of(number), self.is_revealed(number))

    def tokens(self, numbers: Iterable[int] | None = None) -> Iterator[Token]:
        """Tokens in the order of their numbers; all of them if none are named."""
        wanted = range(self.minted()) if numbers is None else numbers
        with ThreadPoolExecutor(AT_ONCE) as pool:
            yield from pool.map(self.token, wanted)

    def is_revealed(self, token: int) -> bool:
        """Return whether a token has its picture."""
        return not self.kind.hidden or any(self.contract.call("randomnessOf", self.round_of(token)))

    def round_of(self, token: int) -> int:
        """Return the round in which a token was minted."""
        return int(self._of_token("roundOf", token))

    def token_uri(self, token: int) -> str:
        """Return the whole `tokenURI`, in one call with the node's limit of gas. OutOfGasError if that is too low."""
        try:
            return str(self._of_token("tokenURI", token))
        except RevertError as error:
            if error.data and describe(error.data) != "OutOfGas()":
                raise
            # a call within a call that runs out of gas says nothing, unless it is the renderer's to the engine
            raise OutOfGasError(
                f"the {self.connection.name} gives a read call too little gas for tokenURI{self._given()}: raise its "
                "limit, or take another node"
            ) from None

    def _given(self) -> str:
        """Return how much gas the node gives a call, for people; nothing if it does not tell."""
        try:
            left = int.from_bytes(self.connection.data("eth_call", {"data": to_hex(GAS_LEFT)}, "latest"), "big")
        except ChainError:
            return ""
        return f", about {left:,}" if 0 < left < 1 << 64 else ""

    def metadata(self, token: int) -> Metadata:
        """Return what a token says of itself."""
        return read_token_uri(self.token_uri(token))

    def terms(self) -> Terms:
        """Return how the collection stands now."""
        call = self.contract.call
        receiver, royalty = call("royaltyInfo", 0, 10_000)
        return Terms(
            name=self.name,
            symbol=call("symbol"),
            owner=self._address(call("owner")),
            phase=self._phase(),
            minted=self.minted(),
            per_transaction=call("perTransaction"),
            allow_list_root=call("allowListRoot"),
            allow_list_signer=self._address(call("allowListSigner")),
            royalty_receiver=self._address(receiver),
            royalty=royalty,
            balance=self.connection.balance(bytes.fromhex(self.address[2:])),
        )

    def _phase(self) -> int:
        phase = int(self.contract.call("phase"))
        if phase >= len(PHASES):
            raise NodeError(
                f"the contract at {self.address} says that its sale is in phase {phase}, which there is not"
            )
        return phase

    def _of_token(self, function: str, token: int) -> Any:
        try:
            return self.contract.call(function, token)
        except RevertError as error:
            if str(error) == "there is no such token":
                raise InputError(self._unknown(token)) from None
            raise

    def _unknown(self, token: int) -> str:
        minted = self.minted()
        there = f"they are numbered 0 to {minted - 1}" if minted else "none was minted yet"
        return f"there is no token {token} of {self.name}: {there}"

    @staticmethod
    def _address(value: Any) -> str:
        return checksum_address(bytes.fromhex(value[2:]))


def open_collection(connection: Connection, address: str) -> Collection:
    """Return the collection at an address, of whichever kind it is. InputError if there is none."""
    for kind in KINDS.values():
        try:
            if Contract(connection, kind.contract, address).call("name") == kind.title:
                return Collection(connection, kind, address)
        except RevertError:
            continue
        except NodeError as error:
            if "is no " in str(error):
                continue
            raise
    raise InputError(f"there is no collection of ours at {address} on chain {connection.chain_id}")
