"""Collections on a chain, and what can be read from them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ..artifacts import artifact
from ..chain._connection import Connection
from ..chain._failures import describe_revert
from ..errors import InputError, NodeError, RevertError
from ..ethereum._encoding import checksum_address, to_hex
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


class Collection:
    """A collection at an address. name: of the contract's tokens."""

    def __init__(self, connection: Connection, kind: CollectionKind, address: str) -> None:
        """Create a collection of a known kind; `open_collection` determines the kind."""
        self.connection, self.kind, self.name, self.address = connection, kind, kind.title, address
        self.contract = Contract(connection, kind.contract, address)

    def minted(self) -> int:
        """Return the number of tokens, which are numbered from 0."""
        return int(self.contract.call("totalSupply"))

    def owner_of(self, token: int) -> str:
        """Return the owner of a token. Raises InputError if it does not exist."""
        return checksum_address(bytes.fromhex(self._of_token("ownerOf", token)[2:]))

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
            raise self.contract.too_little_gas("tokenURI") from None

    def metadata(self, token: int) -> Metadata:
        """Return the metadata of a token, from its `tokenURI`. Raises VerificationError if it is invalid or too long.

        Anyone adds editions, so theirs may be longer than marketplaces show.
        """
        return read_token_uri(self.token_uri(token), LONGEST if self.kind is EDITIONS else MAX_LENGTH)

    def phase(self) -> str:
        """Return the phase of the sale, a key of `PHASES`."""
        phase = int(self.contract.call("phase"))
        if phase >= len(PHASES):
            raise NodeError(f"the contract at {self.address} returned an unknown phase of its sale, {phase}")
        return list(PHASES)[phase]

    def balance(self) -> int:
        """Return the ether of the sale, in wei."""
        return self.connection.balance(self.contract.place)

    def _of_token(self, function: str, token: int) -> Any:
        try:
            return self.contract.call(function, token)
        except RevertError as error:
            if str(error) != "there is no such token":
                raise
            minted = self.minted()
            known = f"they are numbered 0 to {minted - 1}" if minted else "none was minted yet"
            raise InputError(f"there is no token {token} of {self.name}: {known}") from None


def open_collection(node: Connection | str, address: str, editions: bool = False) -> Collection:
    """Return the collection at an address. Raises InputError if there is none.

    node: a node, or its URL. editions: also accept the collection of editions, which has no sale.
    """
    connection = Connection(node) if isinstance(node, str) else node
    interface = artifact(EDITIONS.contract).interface
    try:
        answer = connection.data("eth_call", {"to": address, "data": to_hex(interface.encode("name"))}, "latest")
        title = interface.decode("name", answer)
    except (RevertError, ValueError):
        title = ""
    for kind in (*KINDS.values(), *([EDITIONS] if editions else [])):
        if kind.title == title:
            return Collection(connection, kind, address)
    raise InputError(f"there is no Shackled collection at {address} on chain {connection.chain_id}")
