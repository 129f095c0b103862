"""shackled token edition: scenes that anyone can add to one collection"""

from __future__ import annotations

from dataclasses import dataclass

from ...base.values import plural
from ...deploy._contract import local_chain
from ...errors import VerificationError
from ...ethereum._amounts import amount, ether, parse_ether
from ...studio._storage import STUDIO, stored_codes
from ...tokens._collection import Collection
from ...tokens._contract import minted_tokens, withdrawn
from ...tokens._editions import (
    OPEN,
    EditionTerms,
    add_gas,
    added_number,
    edition_at,
    editions_of,
    open_editions,
    withdraw_call,
)
from ...tokens._verify import check_collection_code
from ..chain_options import JSON, NodeOptions, PayerOptions, address
from ..option import argument, option
from ..output import print_json, print_line, print_table
from ..progress import LateBar
from .options import MAX_NUMBER, POINTER, ROYALTY, SCALE

NUMBER = argument("Number of the edition.", "EDITION", min=0, max=MAX_NUMBER)


@dataclass(frozen=True)
class EditionsOptions(NodeOptions):
    """The collection of editions that a command uses, and the node."""

    collection: str | None = address("-c --collection", "Address of the collection. Default: the same on every chain.")

    def open(self, exact: bool = False) -> Collection:
        """Return the collection. InputError if it is not on the chain.

        exact: also compare its code, before something is added or paid. VerificationError if it differs.
        """
        collection = open_editions(self.connect(), self.collection)
        if exact:
            try:
                check_collection_code(collection)
            except VerificationError as error:
                raise VerificationError(f"nothing was sent to {collection.address}: {error}") from None
        return collection

    @property
    def again(self) -> str:
        """The option that names the same collection in another command."""
        return "" if self.collection is None else f" -c {self.collection}"


def add(
    which: EditionsOptions,
    payer: PayerOptions,
    pointer: str = POINTER,
    name: str = argument("Name of the edition, 1 to 64 bytes.", "NAME"),
    price: int = option("--price", "Price of a token, in ether; may be 0.", "ETHER", parse=parse_ether),
    supply: int | None = option("--supply", "Maximum number of tokens. Default: no limit.", "N"),
    royalty: int = ROYALTY,
    copies: int = option("--copies", "Tokens minted to you free of charge, 0 to 100.", "N", default=1),
    scale: int = SCALE,
    model: bool = option("--model", "Add the scene as a GLB model to the metadata (animation_url)."),
    as_json: bool = JSON,
) -> None:
    """Add a scene as an edition whose tokens anyone can mint. It cannot be changed later."""
    terms = EditionTerms(name, pointer, price, OPEN if supply is None else supply, royalty, copies, scale, model)
    collection = which.open(exact=True)
    scene, studio = bytes.fromhex(terms.scene[2:]), local_chain().address(STUDIO)
    # fails before the confirmation if the scene cannot be drawn
    gas = add_gas(terms, stored_codes(collection.connection, studio, scene))
    tokens = "any number of tokens" if supply is None else plural(supply, "token")
    title = f"add {name}, {tokens} at {ether(terms.price)}; this cannot be changed later"
    receipt = payer.send(collection, title, collection.contract.prepare("add", *terms.arguments, gas=gas))
    added = edition_at(collection, added_number(receipt.logs, collection.address))
    added.check(payer.address, terms)
    numbers = minted_tokens(receipt.logs, collection.address)
    if as_json:
        print_json(added.document() | {"tokens": numbers, "transaction": receipt.hash, "gas": receipt.gas})
        return
    print_line(f"edition {added.number}: {added.name}; {receipt.gas:,} gas")
    if numbers:
        print_line(f"yours: {', '.join(f'#{each}' for each in numbers)}")
    print_line(f"anyone can mint it: shackled token edition mint {added.number}{which.again}")


def mint(
    which: EditionsOptions,
    payer: PayerOptions,
    edition: int = NUMBER,
    quantity: int = argument("Number of tokens, 1 to 100.", "N", min=1, max=100, default=1),
    as_json: bool = JSON,
) -> None:
    """Mint tokens of an edition. Prints the price first."""
    collection = which.open(exact=True)
    chosen = edition_at(collection, edition)
    call = collection.contract.prepare("mint", edition, quantity, value=quantity * chosen.price)
    left = "" if chosen.supply == OPEN else f", {chosen.left} left"
    title = f"mint {quantity} of {chosen.name} by {chosen.artist}{left}"
    receipt = payer.send(collection, title, call)
    numbers = minted_tokens(receipt.logs, collection.address)
    if as_json:
        print_json({"tokens": numbers, "transaction": receipt.hash, "gas": receipt.gas, "wei": call.value})
        return
    names = ", ".join(f"#{each}" for each in numbers)
    print_line(f"minted {names}; {receipt.gas:,} gas, transaction {receipt.hash}")
    place = which.again or " -c editions"
    print_line(f"view it: shackled token show {numbers[0] if numbers else 'ID'}{place} -o FILE.png")


def list_(
    which: EditionsOptions,
    artist: str | None = address("--artist", "Only the editions of this account."),
    as_json: bool = JSON,
) -> None:
    """List the editions, with the amounts that their artists can withdraw."""
    collection = which.open()
    with LateBar("reading editions") as bar:
        found = editions_of(collection, artist, bar.set)
    if as_json:
        print_json(
            {
                "address": collection.address,
                "chain_id": collection.connection.chain_id,
                "editions": [each.document() for each in found],
            }
        )
        return
    tokens = plural(sum(each.minted for each in found), "token")
    print_line(f"{collection.name} at {collection.address}: {plural(len(found), 'edition')}, {tokens}")
    rows = [
        (
            str(each.number),
            each.name,
            amount(each.price),
            each.limit,
            str(each.minted),
            "closed" if each.closed else "sold out" if not each.left else "open",
            amount(each.proceeds),
            each.artist,
            each.scene,
        )
        for each in found
    ]
    if rows:
        print_table(("edition", "name", "ether", "supply", "minted", "sale", "to withdraw", "artist", "scene"), rows)


def close(which: EditionsOptions, payer: PayerOptions, edition: int = NUMBER) -> None:
    """Close an edition: no more tokens can be minted. Cannot be undone. For its artist."""
    collection = which.open()
    chosen = edition_at(collection, edition)
    title = f"close {chosen.name} with {plural(chosen.minted, 'token')}; this cannot be undone"
    receipt = payer.send(collection, title, collection.contract.prepare("close", edition))
    print_line(f"edition {edition} is closed; {receipt.gas:,} gas")


def withdraw(
    which: EditionsOptions,
    payer: PayerOptions,
    editions: tuple[int, ...] = argument("Editions; default: all of yours.", "EDITION", min=0),
    to: str | None = address("--to", "Receiver; default: you."),
) -> None:
    """Withdraw the proceeds of your editions."""
    receiver = to or payer.address
    collection = which.open()
    if editions:
        found = [edition_at(collection, each) for each in dict.fromkeys(editions)]
    else:
        with LateBar("reading editions") as bar:
            found = [each for each in editions_of(collection, payer.address, bar.set) if each.proceeds]
    total = sum(each.proceeds for each in found)
    if not total:
        print_line("there is nothing to withdraw")
        return
    numbers = [each.number for each in found]
    title = f"send {ether(total)} of {plural(len(found), 'edition')} to {receiver}"
    receipt = payer.send(collection, title, withdraw_call(collection, numbers, receiver))
    print_line(f"{ether(withdrawn(receipt.logs, collection.address))} sent to {receiver}; {receipt.gas:,} gas")
