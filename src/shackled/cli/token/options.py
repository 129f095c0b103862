"""Options and steps that the commands of `shackled token` share: which collection, and a transaction to it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, ClassVar

from ...chain import AddressBook
from ...errors import InputError
from ...ethereum import checksum_address
from ...tokens import EDITIONS, KINDS
from ..chain_options import NodeOptions, PayerOptions, parse_checksum_address
from ..option import option
from ..output import print_note

if TYPE_CHECKING:
    from ...deploy import Receipt
    from ...tokens import Collection

#: The phases of a sale as they are typed, in the order of the contract's numbers.
PHASES = ("closed", "allow-list", "public")
#: The largest number of an argument.
MAX_NUMBER = 2**64 - 1


@dataclass(frozen=True)
class CollectionOptions(NodeOptions):
    """The collection that a command uses, and the node."""

    accepts_editions: ClassVar[bool] = False
    collection: Annotated[
        str, option("-c --collection", "Name in the address book, genesis or icons, or an ADDRESS.", "COLLECTION")
    ] = "genesis"

    def open(self) -> Collection:
        """Return the collection. InputError if there is none of that name or at that address."""
        from ...tokens import open_collection, open_editions

        name = self.collection
        if name == EDITIONS.name and not self.accepts_editions:
            raise InputError(
                "the collection of editions has no owner and no sale phases: see shackled token edition --help"
            )
        connection = self.connect()
        if name == EDITIONS.name:
            return open_editions(connection)
        if name.startswith("0x"):
            return open_collection(connection, parse_checksum_address(name, "--collection"), self.accepts_editions)
        if name not in KINDS:
            raise InputError(f"--collection must be {', '.join(KINDS)} or an address, not {name!r}")
        place = AddressBook().find(connection.chain_id, KINDS[name].contract)
        if place is None:
            raise InputError(
                f"the address book has no {name} collection on chain {connection.chain_id}: give --collection ADDRESS, "
                f"or run: shackled token deploy {name}"
            )
        try:
            return open_collection(connection, checksum_address(place))
        except InputError as error:
            raise InputError(
                f"{error}, although the address book lists it: deploy it, or give --collection ADDRESS"
            ) from None


@dataclass(frozen=True)
class AnyCollectionOptions(CollectionOptions):
    """Any collection, and the node: for commands that accept every token."""

    accepts_editions = True
    collection: Annotated[
        str,
        option("-c --collection", "editions; genesis or icons, from the address book; or an ADDRESS.", "COLLECTION"),
    ] = "genesis"


@dataclass(frozen=True)
class IconsOptions(CollectionOptions):
    """The collection of icons that a command uses, and the node."""

    collection: Annotated[
        str, option("-c --collection", "The name icons, from the address book, or an ADDRESS.", "COLLECTION")
    ] = "icons"

    def open(self) -> Collection:
        """Return the collection. InputError if it is missing or has no icons."""
        collection = super().open()
        if collection.kind.hidden:
            raise InputError(f"{collection.name} has no icons: give --collection icons, or the address of one that has")
        return collection


@dataclass(frozen=True)
class TokenPayerOptions(PayerOptions):
    """The account that signs and pays for transactions to a collection."""

    def send(
        self,
        collection: Collection,
        title: str,
        function: str,
        *arguments: Any,
        value: int = 0,
        gas: int | None = None,
    ) -> Receipt:
        """Print the price of a transaction, ask for consent, and send it.

        title: what it does. value: in wei. gas: see `plan`.
        """
        from ...tokens import plan

        transactor = self.transactor(collection.connection)
        quote = plan(transactor, collection.contract, function, *arguments, value=value, gas=gas)
        print_note(f"{collection.name} on chain {collection.connection.chain_id}: {title}")
        self.confirm(transactor, [quote])
        receipt = transactor.send(quote)
        # printed even if what follows fails
        print_note(f"done: transaction {receipt.hash}")
        return receipt
