"""shackled token deploy and demo: new collections"""

from __future__ import annotations

from collections.abc import Sequence
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
    print_json,
    print_step,
)
from ..option import argument, option
from ..output import print_line, print_note, print_table

if TYPE_CHECKING:
    from ...deploy import DeploymentStep, Receipt


def deploy(
    collection: Annotated[str, argument("genesis or icons.", "COLLECTION")],
    node: NodeOptions,
    payer: PayerOptions,
    price: Annotated[
        str | None, option("--price", "Price of a token, in ether. Default: 0.15, or 0.02 for icons.", "ETHER")
    ] = None,
    reserve: Annotated[
        int | None, option("--reserve", "Tokens reserved for the team. Default: 20, or 1 of each icon.", "N")
    ] = None,
    icons: Annotated[
        str | None, option("--icons", "Comma-separated names, such as heart,diamond. Default: all icons.", "NAMES")
    ] = None,
    supply: Annotated[int | None, option("--supply", "Tokens of each icon. Default: 100.", "N")] = None,
    per_transaction: Annotated[int, option("--per-transaction", "Maximum number of tokens per call.", "N")] = 5,
    royalty: Annotated[float, option("--royalty", "Share of the price of resales, 0 to 10.", "PERCENT")] = 5,
    royalty_receiver: Annotated[
        str | None, option("--royalty-receiver", "Receiver of royalties. Default: the owner.", "ADDRESS")
    ] = None,
    owner: Annotated[
        str | None, option("--owner", "Owner of the collection. Default: the paying account.", "ADDRESS")
    ] = None,
    allow_list: Annotated[
        Path | None,
        option("--allow-list", "Allow list: lines of account,quantity, or an OpenZeppelin tree as JSON.", "FILE"),
    ] = None,
    signer: Annotated[
        str | None, option("--signer", "Account that signs permissions to mint before the public sale.", "ADDRESS")
    ] = None,
    salt: Annotated[int, option("--salt", "Number that changes the address of the collection.", "N")] = 0,
    any_chain: Annotated[
        bool, option("--any-chain", "Deploy Genesis on a chain other than Ethereum, its test networks and anvil's.")
    ] = False,
    as_json: Json = False,
) -> None:
    """Deploy a collection and the contracts that it calls. Prints the price first and skips what exists."""
    from ...tokens import (
        CollectionTerms,
        SceneToStore,
        check_randomness,
        check_sale,
        chosen_pieces,
        launch,
        plan_launch,
        plan_setup,
        plan_storage,
        read_allow_list,
        store,
        token_scene,
    )

    kind = KINDS[choice(collection, "the collection", tuple(KINDS))]
    allowed = None if allow_list is None else read_allow_list(allow_list)
    trusted = None if signer is None else parse_checksum_address(signer, "--signer")
    wei = None if price is None else parse_ether(price, "--price")
    percent = number(royalty, "--royalty", 0, 10)
    if kind.hidden and (icons is not None or supply is not None):
        raise InputError("--icons and --supply are for collections of icons")
    of_each = (ICON_PRICE if wei is None else wei, 100 if supply is None else supply, 1 if reserve is None else reserve)
    chosen = [] if kind.hidden else chosen_pieces(icons)
    if not kind.hidden:
        check_sale(chosen, *of_each)
    parse_max_fee(payer.max_fee)
    connection = node.connect()
    if kind.hidden:
        check_randomness(connection, any_chain)
    mine = str(payer.signer.address)
    owned_by = mine if owner is None else parse_checksum_address(owner, "--owner")
    if owned_by != mine and (allowed is not None or trusted is not None):
        raise InputError(f"only the owner can set the allow list: leave out --owner, or let {owned_by} set it later")
    if owned_by != mine and chosen:
        raise InputError("only the owner can add icons: leave out --owner")
    defaults = CollectionTerms(owned_by, owned_by)
    receiver = owned_by if royalty_receiver is None else parse_checksum_address(royalty_receiver, "--royalty-receiver")
    terms = CollectionTerms(
        owner=owned_by,
        royalty_receiver=receiver,
        price=defaults.price if wei is None else wei,
        reserve=defaults.reserve if reserve is None or chosen else reserve,
        per_transaction=per_transaction,
        royalty=round(100 * percent),
        salt=salt,
    )
    transactor = payer.transactor(connection)
    transactor.wait_for_pending()
    fees = transactor.fees()
    plan = plan_launch(connection, kind, terms, fees)
    missing = [step.name for step in plan.parts.missing]
    before = f", after {', '.join(missing)}" if missing else ""
    if plan.quote is None:
        print_note(
            f"{kind.title}: this collection is deployed at {plan.address} on chain {connection.chain_id} already"
        )
    else:
        print_note(f"{kind.title} on chain {connection.chain_id}, at {plan.address}{before}")
    storage = None
    if chosen:
        storage = plan_storage(connection, [SceneToStore(piece.name, token_scene(piece)) for piece in chosen], fees)
    icons_wanted = [
        (piece.title, pointer, SCALE, *of_each)
        for piece, pointer in zip(chosen, () if storage is None else storage.pointers, strict=True)
    ]
    quotes = [*plan.quotes, *([] if storage is None else storage.quotes)]
    list_wanted = None
    if allowed is not None or trusted is not None:
        list_wanted = (bytes(32) if allowed is None else allowed.root, trusted)
    codes = {} if storage is None else storage.codes
    setup = plan_setup(connection, plan, fees, list_wanted, icons_wanted, codes, quotes)
    if chosen:
        print_note(f"with {len(chosen)} icons: {', '.join(piece.title for piece in chosen)}")
    quotes += [each.quote for each in setup]
    if quotes:
        payer.confirm(transactor, quotes)
    else:
        print_note("nothing is missing, and nothing was sent; another --salt makes another collection")

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
    if as_json:
        print_json(
            {
                "collection": kind.name,
                "address": deployed.address,
                "chain_id": connection.chain_id,
                "transaction": None if receipt is None else receipt.hash,
                "gas": sum(spent),
            }
        )
        return
    print_line(f"{kind.title}: {deployed.address}" + ("" if receipt is None else f", transaction {receipt.hash}"))
    if chosen:
        print_line("check the icons, then seal the collection: shackled token seal -c icons")
    print_line(f"the sale is closed; open it with: shackled token phase public -c {kind.name}")


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
