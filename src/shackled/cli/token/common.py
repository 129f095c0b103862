"""What the commands of `shackled token` have in common: options, the collection that is meant, transactions."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from ...errors import InputError
from ...ethereum import checksum_address, parse_address
from ...tokens import KINDS
from ..option import option
from ..payer import PASSWORD, MaxFee, ask, open_signer, parse_max_fee, price
from ..telling import say, tell

if TYPE_CHECKING:
    from eth_account.signers.local import LocalAccount

    from ...chain import Connection
    from ...deploy import Receipt
    from ...tokens import Collection

__all__ = [
    "MOST",
    "PHASES",
    "Account",
    "Chain",
    "Json",
    "Key",
    "MaxFee",
    "Rpc",
    "Which",
    "Yes",
    "address",
    "connect",
    "do",
    "open_icons",
    "open_named",
    "send",
    "table",
]

#: What `phase` takes, in the order of the contract's numbers.
PHASES = ("closed", "allow-list", "public")
#: More than there will ever be of anything.
MOST = 2**64 - 1


Rpc = Annotated[str | None, option("--rpc", "A node of the chain.", "URL", envvar="SHACKLED_RPC")]
Chain = Annotated[int | None, option("--chain-id", "Stop if the node belongs to another chain.", "N")]
Which = Annotated[
    str, option("-c --collection", "genesis or icons, as the address book has them, or an ADDRESS.", "COLLECTION")
]
Account = Annotated[
    Path | None, option("--account", f"Whose it is: a keystore file; its password is asked, or in {PASSWORD}.", "FILE")
]
Key = Annotated[
    str | None, option("--private-key-env", "Whose it is: the environment variable with a private key.", "NAME")
]
Yes = Annotated[bool, option("--yes -y", "Do not ask.")]
Json = Annotated[bool, option("--json", "Print JSON instead of words.")]


def connect(rpc: str | None, chain_id: int | None) -> Connection:
    """The node that is meant. WrongChainError if it belongs to another chain than `chain_id`."""
    from ...chain import Connection

    if rpc is None:
        raise InputError("--rpc is missing: the address of a node of the chain, as http://127.0.0.1:8545")
    connection = Connection(rpc, attempts=4)
    connection.expect_chain(chain_id)
    return connection


def open_named(which: str, rpc: str | None, chain_id: int | None) -> Collection:
    """The collection of a name in the address book, or at an address."""
    from ...chain import AddressBook
    from ...tokens import open_collection

    connection = connect(rpc, chain_id)
    if which.startswith("0x"):
        return open_collection(connection, address(which, "--collection"))
    if which not in KINDS:
        raise InputError(f"--collection must be {', '.join(KINDS)} or an address, not {which!r}")
    kind = KINDS[which]
    place = AddressBook().find(connection.chain_id, kind.contract)
    if place is None:
        raise InputError(
            f"the address book has no {which} collection on chain {connection.chain_id}: give --collection ADDRESS, or "
            f"run: shackled token deploy {which}"
        )
    try:
        return open_collection(connection, checksum_address(place))
    except InputError as error:
        raise InputError(f"{error}, where the address book has it: deploy it, or give --collection ADDRESS") from None


def open_icons(which: str, rpc: str | None, chain_id: int | None) -> Collection:
    """The same, of a collection that has icons."""
    collection = open_named(which, rpc, chain_id)
    if collection.kind.hidden:
        raise InputError(
            f"{collection.name} has no icons: give --collection icons, or the address of such a collection"
        )
    return collection


def do(
    collection: Collection,
    account: Path | None,
    variable: str | None,
    max_fee: float | None,
    yes: bool,
    title: str,
    function: str,
    *arguments: Any,
    ours: int | None = None,
) -> Receipt:
    """As `send`, for the account of the options."""
    return send(collection, open_signer(account, variable), max_fee, yes, title, function, *arguments, ours=ours)


def send(
    collection: Collection,
    signer: LocalAccount,
    max_fee: float | None,
    yes: bool,
    title: str,
    function: str,
    *arguments: Any,
    value: int = 0,
    ours: int | None = None,
) -> Receipt:
    """Plans a transaction, tells its price, asks, and sends it. max_fee: of the option, in gwei. ours: see `plan`."""
    from ...deploy import Transactor
    from ...tokens import plan

    transactor = Transactor(collection.connection, signer, max_fee=parse_max_fee(max_fee))
    quote = plan(transactor, collection.contract, function, *arguments, value=value, ours=ours)
    say(f"{collection.name} on chain {collection.connection.chain_id}: {title}")
    say(f"it costs {price([quote])}")
    if not yes:
        ask(transactor.name)
    receipt = transactor.send(quote)
    # whatever fails from here on, it is known that this was done
    say(f"done: transaction {receipt.hash}")
    return receipt


def address(text: str, name: str) -> str:
    """What was typed as an address, with its checksum. InputError, which says `name`, if it is none."""
    return checksum_address(parse_address(text, name))


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Prints columns, all but the first to the right where they hold numbers."""
    widths = [max(len(row[column]) for row in (head, *rows)) for column in range(len(head))]
    for row in (head, *rows):
        cells = [
            cell.rjust(width) if column and cell[:1].isdigit() else cell.ljust(width)
            for column, (cell, width) in enumerate(zip(row, widths, strict=True))
        ]
        tell("  ".join(cells).rstrip())
