"""Collections on a chain, and what can be read from them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from ..chain import GAS_LEFT, Connection, describe_revert, read_all
from ..errors import ChainError, InputError, NodeError, OutOfGasError, RevertError
from ..ethereum import checksum_address, to_hex
from ._contract import PHASES, Contract
from ._metadata import MAX_LENGTH, Metadata, read_token_uri

#: Maximum size in bytes of the `tokenURI` of an edition: a call of 2^24 gas cannot return more.
LONGEST = 3_000_000


@dataclass(frozen=True)
class CollectionKind:
    """A kind of collection.

    name: for the command line. title: name of the contract's tokens. contract: name of the artifact.
    hidden: whether tokens are minted without a picture, and revealed later. terms: fields of CollectionTerms that its
    constructor takes before the struct Terms.
    """

    name: str
    title: str
    contract: str
    hidden: bool
    terms: tuple[str, ...]


KINDS = {
    "genesis": CollectionKind(
        "genesis", "Shackled Genesis", "GenesisCollection", hidden=True, terms=("price", "reserve")
    ),
    "icons": CollectionKind("icons", "Shackled Icons", "IconsCollection", hidden=False, terms=()),
}
#: The collection to which anyone can add scenes: it has neither an owner nor a sale.
EDITIONS = CollectionKind("editions", "Shackled Editions", "Editions", hidden=False, terms=())


@dataclass(frozen=True)
class CollectionState:
    """The state of a collection.

    allow_list_root: zeros if there is none. royalty: in hundredths of a percent. balance: ether of the sale, in wei.
    """

    name: str
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
    def phase_name(self) -> str:
        """Description of the phase."""
        return PHASES[self.phase]


@dataclass(frozen=True)
class Token:
    """A minted token."""

    number: int
    owner: str
    revealed: bool


class Collection:
    """A collection at an address."""

    def __init__(self, connection: Connection, kind: CollectionKind, address: str) -> None:
        """Create a collection of a known kind; `open_collection` determines the kind."""
        self.connection, self.kind, self.address = connection, kind, address
        self.contract = Contract(connection, kind.contract, address)

    @cached_property
    def name(self) -> str:
        """Name of the collection, from the contract."""
        return str(self.contract.call("name"))

    def minted(self) -> int:
        """Return the number of tokens, which are numbered from 0."""
        return int(self.contract.call("totalSupply"))

    def owner_of(self, token: int) -> str:
        """Return the owner of a token. Raises InputError if it does not exist."""
        return self._address(self._of_token("ownerOf", token))

    def token(self, number: int) -> Token:
        """Return a token. Raises InputError if it does not exist."""
        return Token(number, self.owner_of(number), self.is_revealed(number))

    def tokens(self, numbers: Sequence[int] | None = None) -> Iterator[Token]:
        """Yield tokens by their numbers, in order; by default all."""
        wanted = range(self.minted()) if numbers is None else numbers
        yield from read_all(self.token, wanted)

    def is_revealed(self, token: int) -> bool:
        """Return whether a token shows its picture."""
        return not self.kind.hidden or any(self.contract.call("randomnessOf", self.round_of(token)))

    def round_of(self, token: int) -> int:
        """Return the round in which a token was minted."""
        return int(self._of_token("roundOf", token))

    def token_uri(self, token: int) -> str:
        """Return the `tokenURI`, from one call with the node's gas limit. Raises OutOfGasError if that is too low."""
        try:
            return str(self._of_token("tokenURI", token))
        except RevertError as error:
            if error.data and describe_revert(error.data) != "OutOfGas()":
                raise
            # an inner call that runs out of gas reverts without data, except that of the renderer to its engine
            raise OutOfGasError(
                f"the {self.connection.name} allows a read call too little gas for tokenURI{self._allowed_gas()}: "
                "raise its limit, or use another node"
            ) from None

    def _allowed_gas(self) -> str:
        """Return how much gas the node allows a call, for a message; empty if that is unknown."""
        try:
            left = int.from_bytes(self.connection.data("eth_call", {"data": to_hex(GAS_LEFT)}, "latest"), "big")
        except ChainError:
            return ""
        return f", about {left:,}" if 0 < left < 1 << 64 else ""

    def metadata(self, token: int) -> Metadata:
        """Return the metadata of a token, from its `tokenURI`."""
        return self.parse(self.token_uri(token))

    def parse(self, uri: str) -> Metadata:
        """Parse a `tokenURI` of the collection. Raises VerificationError if it is invalid or too long.

        Anyone adds editions, so theirs may be longer than marketplaces show.
        """
        return read_token_uri(uri, LONGEST if self.kind is EDITIONS else MAX_LENGTH)

    def state(self) -> CollectionState:
        """Return the current state of the collection."""
        call = self.contract.call
        receiver, royalty = call("royaltyInfo", 0, 10_000)
        return CollectionState(
            name=self.name,
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
            raise NodeError(f"the contract at {self.address} returned an unknown phase of its sale, {phase}")
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
        known = f"they are numbered 0 to {minted - 1}" if minted else "none was minted yet"
        return f"there is no token {token} of {self.name}: {known}"

    @staticmethod
    def _address(value: Any) -> str:
        return checksum_address(bytes.fromhex(value[2:]))


def open_collection(node: Connection | str, address: str, editions: bool = False) -> Collection:
    """Return the collection at an address. Raises InputError if there is none.

    node: a node, or its URL. editions: also accept the collection of editions, which has no sale.
    """
    connection = Connection(node) if isinstance(node, str) else node
    for kind in (*KINDS.values(), *([EDITIONS] if editions else [])):
        try:
            if Contract(connection, kind.contract, address).call("name") == kind.title:
                return Collection(connection, kind, address)
        except RevertError:
            continue
        except NodeError as error:
            # the message of a node may contain anything: compare the whole phrase of `Contract.call`
            if f"the address {address} is not a {kind.contract} " in str(error):
                continue
            raise
    raise InputError(f"there is no Shackled collection at {address} on chain {connection.chain_id}")
