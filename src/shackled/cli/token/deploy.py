"""shackled token deploy and demo: new collections"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from ...base.checks import choice
from ...base.whole_file import check_output_folder
from ...datasets._pieces import Piece
from ...deploy._quote import Quote
from ...deploy._transactor import Receipt, Transactor
from ...errors import InputError
from ...ethereum._amounts import parse_ether
from ...tokens._allow_list import read_allow_list
from ...tokens._collection import KINDS, Collection, CollectionKind
from ...tokens._demo import run_demo
from ...tokens._icons import ICON_PRICE, SCALE, check_sale, chosen_pieces, token_scene
from ...tokens._launch import CollectionTerms, Launch, launch, plan_launch, plan_setup
from ...tokens._reveal import check_randomness
from ...tokens._storage import SceneToStore, StoragePlan, plan_storage, store
from ..chain_options import JSON, MAX_FEE, NodeOptions, PayerOptions, address, print_step
from ..option import argument, option
from ..output import print_json, print_line, print_note
from .options import ROYALTY


@dataclass(frozen=True)
class TermsOptions:
    """The terms of a new collection."""

    price: int | None = option(
        "--price", "Price of a token, in ether. Default: 0.15, or 0.02 for icons.", "ETHER", parse=parse_ether
    )
    reserve: int | None = option("--reserve", "Tokens reserved for the team. Default: 20, or 1 of each icon.", "N")
    icons: str | None = option("--icons", "Comma-separated names, such as heart,diamond. Default: all icons.", "NAMES")
    supply: int | None = option("--supply", "Tokens of each icon. Default: 100.", "N")
    per_transaction: int = option("--per-transaction", "Maximum number of tokens per call.", "N", default=5)
    royalty: int = ROYALTY
    royalty_receiver: str | None = address("--royalty-receiver", "Receiver of royalties. Default: the owner.")
    owner: str | None = address("--owner", "Owner of the collection. Default: the paying account.")
    allow_list: Path | None = option("--allow-list", "Allow list: lines of account,quantity.", "FILE")
    signer: str | None = address("--signer", "Account that signs permissions to mint before the public sale.")
    salt: int = option("--salt", "Number that changes the address of the collection.", "N", default=0)

    @property
    def of_each_icon(self) -> tuple[int, int, int]:
        """The price in wei, the supply and the reserve of each icon."""
        given = ((self.price, ICON_PRICE), (self.supply, 100), (self.reserve, 1))
        price, supply, reserve = (default if value is None else value for value, default in given)
        return price, supply, reserve

    def pieces(self, kind: CollectionKind) -> list[Piece]:
        """Return the icons of a collection of icons. InputError for options of icons for another one."""
        if kind.hidden:
            if self.icons is not None or self.supply is not None:
                raise InputError("--icons and --supply are for collections of icons")
            return []
        chosen = chosen_pieces(self.icons)
        check_sale(*self.of_each_icon[1:])
        return chosen

    def list_wanted(self) -> tuple[bytes, str | None] | None:
        """Return the root of the allow list and who signs permissions; None for neither."""
        if self.allow_list is None:
            return None if self.signer is None else (bytes(32), self.signer)
        return read_allow_list(self.allow_list).root, self.signer

    def terms(self, payer: str, has_list: bool, has_icons: bool) -> CollectionTerms:
        """Return the terms of the contract. InputError for another owner where the owner has to do more."""
        owner = self.owner or payer
        if owner != payer and has_list:
            raise InputError(f"only the owner can set the allow list: leave out --owner, or let {owner} set it later")
        if owner != payer and has_icons:
            raise InputError("only the owner can add icons: leave out --owner")
        receiver = self.royalty_receiver or owner
        given = {"price": self.price, "reserve": None if has_icons else self.reserve}
        others = {name: value for name, value in given.items() if value is not None}
        limits = {"per_transaction": self.per_transaction, "royalty": self.royalty, "salt": self.salt}
        return CollectionTerms(owner, receiver, **limits, **others)


def deploy(
    node: NodeOptions,
    payer: PayerOptions,
    options: TermsOptions,
    collection: str = argument("genesis or icons.", "COLLECTION", parse=partial(choice, choices=tuple(KINDS))),
    any_chain: bool = option(
        "--any-chain", "Deploy Genesis on a chain other than Ethereum, its test networks and anvil."
    ),
    as_json: bool = JSON,
) -> None:
    """Deploy a collection and the contracts that it calls. Prints the price first and skips what exists."""
    kind = KINDS[collection]
    list_wanted, chosen = options.list_wanted(), options.pieces(kind)
    connection = node.connect()
    if kind.hidden:
        check_randomness(connection, any_chain)
    terms = options.terms(payer.address, list_wanted is not None, bool(chosen))
    transactor = payer.transactor(connection)
    transactor.wait_for_pending()
    fees = transactor.fees()
    plan = plan_launch(connection, kind, terms, fees)
    missing = ", ".join(step.name for step in plan.parts.missing)
    if plan.quote is None:
        print_note(
            f"{kind.title}: this collection is deployed at {plan.address} on chain {connection.chain_id} already"
        )
    else:
        after = f", after {missing}" if missing else ""
        print_note(f"{kind.title} on chain {connection.chain_id}, at {plan.address}{after}")
    storage, quotes, icons_wanted = None, [*plan.quotes], []
    if chosen:
        storage = plan_storage(connection, [SceneToStore(piece.name, token_scene(piece)) for piece in chosen], fees)
        quotes += storage.quotes
        icons_wanted = [
            (piece.title, pointer, SCALE, *options.of_each_icon)
            for piece, pointer in zip(chosen, storage.pointers, strict=True)
        ]
    setup = plan_setup(connection, plan, fees, list_wanted, icons_wanted, storage.codes if storage else {}, quotes)
    if chosen:
        print_note(f"with {len(chosen)} icons: {', '.join(piece.title for piece in chosen)}")
    quotes += setup.values()
    if quotes:
        payer.confirm(transactor, quotes)
    else:
        print_note("nothing is missing, and nothing was sent; another --salt makes another collection")
    deployed, receipt, gas = _launch(plan, storage, setup, transactor)
    if as_json:
        print_json(
            {
                "collection": kind.name,
                "address": deployed.address,
                "chain_id": connection.chain_id,
                "transaction": None if receipt is None else receipt.hash,
                "gas": gas,
            }
        )
        return
    print_line(f"{kind.title}: {deployed.address}" + ("" if receipt is None else f", transaction {receipt.hash}"))
    if chosen:
        print_line("check the icons, then seal the collection: shackled token seal -c icons")
    print_line(f"the sale is closed; open it with: shackled token phase public -c {kind.name}")


def _launch(
    plan: Launch, storage: StoragePlan | None, setup: Mapping[str, Quote], transactor: Transactor
) -> tuple[Collection, Receipt | None, int]:
    """Send what is missing; return the collection, the receipt of its deployment, and the gas of all."""
    spent: list[int] = []

    def report(name: str, address: bytes, receipt: Receipt) -> None:
        spent.append(receipt.gas)
        print_step(name, address, receipt)

    deployed, receipt = launch(plan, transactor, report)
    if storage is not None:
        store(storage, transactor, report)
    for what, quote in setup.items():
        done = transactor.send(quote)
        spent.append(done.gas)
        print_note(f"{what}, {done.gas:,} gas, transaction {done.hash}")
    return deployed, receipt, sum(spent)


def demo(
    output: Path = option("-o --output", "Folder for gallery.html and tokens.json.", "DIR"),
    rpc: str | None = option("--rpc", "URL of a fresh anvil.", "URL", envvar="SHACKLED_RPC"),
    max_fee: int | None = MAX_FEE,
) -> None:
    """Run both collections on a fresh anvil: deploy, mint as several users, reveal, read, transfer, withdraw.

    It uses the keys that anvil publishes, and refuses any other chain.
    """
    check_output_folder(output)
    tokens = run_demo(NodeOptions(rpc).connect(), output, print_note, max_fee)
    print_line(f"{output / 'gallery.html'}: {len(tokens)} tokens, read through tokenURI")
    print_line(f"{output / 'tokens.json'}")
