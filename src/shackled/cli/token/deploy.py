"""shackled token deploy and demo: new collections"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from ...checks import choice, number
from ...errors import InputError
from ...ethereum import parse_ether
from ...tokens import ICON_PRICE, KINDS, SCALE
from ...whole_file import check_output_folder
from ..chain_options import (
    Json,
    MaxFee,
    NodeOptions,
    PayerOptions,
    parse_checksum_address,
    parse_max_fee,
    print_step,
)
from ..option import argument, option
from ..output import print_json, print_line, print_note, print_table

if TYPE_CHECKING:
    from ...datasets import Piece
    from ...deploy import DeploymentStep, Receipt, Transactor
    from ...tokens import Collection, CollectionKind, CollectionTerms, Launch, SetupStep, StoragePlan


@dataclass(frozen=True)
class TermsOptions:
    """The terms of a new collection."""

    price: Annotated[
        str | None, option("--price", "Price of a token, in ether. Default: 0.15, or 0.02 for icons.", "ETHER")
    ] = None
    reserve: Annotated[
        int | None, option("--reserve", "Tokens reserved for the team. Default: 20, or 1 of each icon.", "N")
    ] = None
    icons: Annotated[
        str | None, option("--icons", "Comma-separated names, such as heart,diamond. Default: all icons.", "NAMES")
    ] = None
    supply: Annotated[int | None, option("--supply", "Tokens of each icon. Default: 100.", "N")] = None
    per_transaction: Annotated[int, option("--per-transaction", "Maximum number of tokens per call.", "N")] = 5
    royalty: Annotated[float, option("--royalty", "Share of the price of resales, 0 to 10.", "PERCENT")] = 5
    royalty_receiver: Annotated[
        str | None, option("--royalty-receiver", "Receiver of royalties. Default: the owner.", "ADDRESS")
    ] = None
    owner: Annotated[
        str | None, option("--owner", "Owner of the collection. Default: the paying account.", "ADDRESS")
    ] = None
    allow_list: Annotated[
        Path | None,
        option("--allow-list", "Allow list: lines of account,quantity, or an OpenZeppelin tree as JSON.", "FILE"),
    ] = None
    signer: Annotated[
        str | None, option("--signer", "Account that signs permissions to mint before the public sale.", "ADDRESS")
    ] = None
    salt: Annotated[int, option("--salt", "Number that changes the address of the collection.", "N")] = 0

    @property
    def wei(self) -> int | None:
        """The price in wei."""
        return None if self.price is None else parse_ether(self.price, "--price")

    @property
    def of_each_icon(self) -> tuple[int, int, int]:
        """The price in wei, the supply and the reserve of each icon."""
        given = ((self.wei, ICON_PRICE), (self.supply, 100), (self.reserve, 1))
        price, supply, reserve = (default if value is None else value for value, default in given)
        return price, supply, reserve

    def check(self) -> None:
        """Raise InputError for a price or a royalty that is none."""
        if self.price is not None:
            parse_ether(self.price, "--price")
        number(self.royalty, "--royalty", 0, 10)

    def pieces(self, kind: CollectionKind) -> list[Piece]:
        """Return the icons of a collection of icons. InputError for options of icons for another one."""
        from ...tokens import check_sale, chosen_pieces

        if kind.hidden:
            if self.icons is not None or self.supply is not None:
                raise InputError("--icons and --supply are for collections of icons")
            return []
        chosen = chosen_pieces(self.icons)
        check_sale(chosen, *self.of_each_icon)
        return chosen

    def list_wanted(self) -> tuple[bytes, str | None] | None:
        """Return the root of the allow list and who signs permissions; None for neither."""
        from ...tokens import read_allow_list

        if self.allow_list is None and self.signer is None:
            return None
        root = bytes(32) if self.allow_list is None else read_allow_list(self.allow_list).root
        return root, None if self.signer is None else parse_checksum_address(self.signer, "--signer")

    def terms(self, payer: str, has_list: bool, has_icons: bool) -> CollectionTerms:
        """Return the terms of the contract. InputError for another owner where the owner has to do more."""
        from ...tokens import CollectionTerms

        owner = payer if self.owner is None else parse_checksum_address(self.owner, "--owner")
        if owner != payer and has_list:
            raise InputError(f"only the owner can set the allow list: leave out --owner, or let {owner} set it later")
        if owner != payer and has_icons:
            raise InputError("only the owner can add icons: leave out --owner")
        to = self.royalty_receiver
        defaults, wei = CollectionTerms(owner, owner), self.wei
        return CollectionTerms(
            owner=owner,
            royalty_receiver=owner if to is None else parse_checksum_address(to, "--royalty-receiver"),
            price=defaults.price if wei is None else wei,
            reserve=defaults.reserve if self.reserve is None or has_icons else self.reserve,
            per_transaction=self.per_transaction,
            royalty=round(100 * number(self.royalty, "--royalty", 0, 10)),
            salt=self.salt,
        )


def deploy(
    collection: Annotated[str, argument("genesis or icons.", "COLLECTION")],
    node: NodeOptions,
    payer: PayerOptions,
    options: TermsOptions,
    any_chain: Annotated[
        bool, option("--any-chain", "Deploy Genesis on a chain other than Ethereum, its test networks and anvil's.")
    ] = False,
    as_json: Json = False,
) -> None:
    """Deploy a collection and the contracts that it calls. Prints the price first and skips what exists."""
    from ...tokens import SceneToStore, check_randomness, plan_launch, plan_setup, plan_storage, token_scene

    kind = KINDS[choice(collection, "the collection", tuple(KINDS))]
    options.check()
    list_wanted = options.list_wanted()
    chosen = options.pieces(kind)
    parse_max_fee(payer.max_fee)
    connection = node.connect()
    if kind.hidden:
        check_randomness(connection, any_chain)
    terms = options.terms(str(payer.signer.address), list_wanted is not None, bool(chosen))
    transactor = payer.transactor(connection)
    transactor.wait_for_pending()
    fees = transactor.fees()
    plan = plan_launch(connection, kind, terms, fees)
    _print_place(kind, plan, connection.chain_id)
    storage = None
    if chosen:
        storage = plan_storage(connection, [SceneToStore(piece.name, token_scene(piece)) for piece in chosen], fees)
    icons_wanted = [
        (piece.title, pointer, SCALE, *options.of_each_icon)
        for piece, pointer in zip(chosen, () if storage is None else storage.pointers, strict=True)
    ]
    quotes = [*plan.quotes, *([] if storage is None else storage.quotes)]
    codes = {} if storage is None else storage.codes
    setup = plan_setup(connection, plan, fees, list_wanted, icons_wanted, codes, quotes)
    if chosen:
        print_note(f"with {len(chosen)} icons: {', '.join(piece.title for piece in chosen)}")
    quotes += [each.quote for each in setup]
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


def _print_place(kind: CollectionKind, plan: Launch, chain_id: int) -> None:
    missing = [step.name for step in plan.parts.missing]
    before = f", after {', '.join(missing)}" if missing else ""
    if plan.quote is None:
        print_note(f"{kind.title}: this collection is deployed at {plan.address} on chain {chain_id} already")
    else:
        print_note(f"{kind.title} on chain {chain_id}, at {plan.address}{before}")


def _launch(
    plan: Launch, storage: StoragePlan | None, setup: Sequence[SetupStep], transactor: Transactor
) -> tuple[Collection, Receipt | None, int]:
    """Send what is missing; return the collection, the receipt of its deployment, and the gas of all."""
    from ...tokens import launch, store

    spent: list[int] = []

    def report(step: DeploymentStep, receipts: Sequence[Receipt]) -> None:
        spent.extend(each.gas for each in receipts)
        print_step(step, receipts)

    deployed, receipt = launch(plan, transactor, report)
    if storage is not None:
        store(storage, transactor, report)
    for each in setup:
        done = transactor.send(each.quote)
        spent.append(done.gas)
        print_note(f"{each.what}, {done.gas:,} gas, transaction {done.hash}")
    return deployed, receipt, sum(spent)


def demo(
    output: Annotated[Path, option("-o --output", "Folder for gallery.html and tokens.json.", "DIR")],
    rpc: Annotated[str | None, option("--rpc", "URL of a fresh anvil.", "URL", envvar="SHACKLED_RPC")] = None,
    max_fee: MaxFee = None,
) -> None:
    """Run both collections on a fresh anvil: deploy, mint as several users, reveal, read, transfer, withdraw.

    It uses the keys that anvil publishes, and refuses any other chain.
    """
    from ...tokens import comparison, run_demo

    check_output_folder(output)
    result = run_demo(NodeOptions(rpc).connect(), output, print_note, parse_max_fee(max_fee))
    head, *rows = comparison(result.costs)
    print_table(head, rows)
    print_line(f"{result.gallery}: {len(result.tokens)} tokens, read through tokenURI")
    print_line(f"{result.listing}")
