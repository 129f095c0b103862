"""Options that the commands of `shackled token` share: which collection."""

from __future__ import annotations

from dataclasses import dataclass

from ...base.checks import number
from ...chain._address_book import AddressBook
from ...errors import InputError
from ...ethereum._encoding import checksum_address
from ...tokens._collection import EDITIONS, KINDS, Collection, open_collection
from ...tokens._editions import open_editions
from ..chain_options import NodeOptions, parse_checksum_address
from ..option import argument, option

#: The largest number of an argument.
MAX_NUMBER = 2**64 - 1

TOKEN = argument("Number of the token.", "ID", min=0, max=MAX_NUMBER)
POINTER = argument("Address of the stored scene, from `shackled store`.", "POINTER", parse=parse_checksum_address)
SCALE = option("--scale", "Side of the square that each pixel becomes.", "N", min=1, max=8, default=4)


def parse_royalty(percent: float, name: str) -> int:
    """Return a share of the price of resales in hundredths of a percent. InputError if it is not from 0 to 10 %."""
    return round(100 * number(percent, name, 0, 10))


ROYALTY = option(
    "--royalty", "Share of the price of resales, 0 to 10.", "PERCENT", type=float, default=5, parse=parse_royalty
)


@dataclass(frozen=True)
class CollectionOptions(NodeOptions):
    """The collection that a command uses, and the node."""

    collection: str = option(
        "-c --collection",
        "genesis or icons, from the address book, or an ADDRESS; show, verify and transfer also accept editions.",
        "COLLECTION",
        default="genesis",
    )

    def open(self, or_editions: bool = False) -> Collection:
        """Return the collection. InputError if there is none of that name or at that address.

        or_editions: whether it may be that of the editions, which has no owner and no sale.
        """
        name = self.collection
        if name == EDITIONS.name and not or_editions:
            raise InputError(
                "the collection of editions has no owner and no sale phases: see shackled token edition --help"
            )
        connection = self.connect()
        if name == EDITIONS.name:
            return open_editions(connection)
        if name.startswith("0x"):
            return open_collection(connection, parse_checksum_address(name, "--collection"), or_editions)
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
class IconsOptions(CollectionOptions):
    """The collection of icons that a command uses, and the node."""

    collection: str = option(
        "-c --collection", "The name icons, from the address book, or an ADDRESS.", "COLLECTION", default="icons"
    )

    def open(self, or_editions: bool = False) -> Collection:
        """Return the collection. InputError if it is missing or has no icons."""
        collection = super().open()
        if collection.kind.hidden:
            raise InputError(f"{collection.name} has no icons: give --collection icons, or the address of one that has")
        return collection
