"""shackled deploy"""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..chain import PATIENCE, Connection
from ..errors import InputError
from ..ethereum import checksum_address
from .option import option
from .payer import PASSWORD, MaxFee, ask, open_signer, parse_max_fee
from .telling import say, tell

if TYPE_CHECKING:
    from ..deploy import Plan, Receipt, Step


def deploy(
    rpc: Annotated[
        str | None,
        typer.Option("--rpc", help="A node of the chain.", metavar="URL", envvar="SHACKLED_RPC", show_default=False),
    ] = None,
    account: Annotated[
        Path | None,
        option("--account", f"Who pays: a keystore file; its password is asked, or in {PASSWORD}.", "FILE"),
    ] = None,
    private_key_env: Annotated[
        str | None, option("--private-key-env", "Who pays: the environment variable with a private key.", "NAME")
    ] = None,
    max_fee: MaxFee = None,
    contracts: Annotated[
        str | None,
        option(
            "--contracts",
            "Which, with commas, of Engine, FragmentEngine, Renderer, Original, Genesis, PngEncoder, Studio and "
            "GenesisMetadata; else the first five. Those that they call are added.",
            "NAMES",
        ),
    ] = None,
    chain_id: Annotated[int | None, option("--chain-id", "Stop if the node belongs to another chain.", "N")] = None,
    yes: Annotated[bool, option("--yes -y", "Do not ask.")] = False,
    as_json: Annotated[bool, option("--json", "Print one JSON object instead of words.")] = False,
    standard_json: Annotated[
        Path | None,
        option("--standard-json", "The folder for what verifies the sources; else deployed-CHAIN, in this one.", "DIR"),
    ] = None,
    rpc_timeout: Annotated[
        float, option("--rpc-timeout", f"Seconds that the node may take for an answer; else {PATIENCE:g}.", "SECONDS")
    ] = PATIENCE,
) -> None:
    """Put the contracts on a chain, at the same addresses as on every chain. What is there already is left alone."""
    from ..deploy import CONTRACTS, STANDARD, Deployer, Transactor, current_fees, deployments, write_verification

    if rpc is None or not rpc.strip():
        raise InputError("--rpc is missing: the address of a node of the chain, as http://127.0.0.1:8545")
    if account is not None and private_key_env is not None:
        raise InputError("--account and --private-key-env both say who pays: give one of them")
    names = STANDARD if contracts is None else [name.strip() for name in contracts.split(",") if name.strip()]
    if not names:
        raise InputError(f"--contracts names none; the contracts are {', '.join(CONTRACTS)}")
    most = parse_max_fee(max_fee)
    wanted = deployments(names)
    connection = Connection(rpc.split()[0], rpc_timeout, attempts=4)
    connection.expect_chain(chain_id)
    deployer = Deployer(connection)
    deployer.book.entries(connection.chain_id)  # a broken book is told before anything is paid
    plan = deployer.plan(wanted, current_fees(connection, most))
    folder = standard_json or Path(f"deployed-{connection.chain_id}")
    receipts: list[Receipt] = []
    if plan.missing:
        _show(plan, connection, as_json)
        transactor = Transactor(connection, open_signer(account, private_key_env), max_fee=most)
        transactor.late = say
        transactor.settle()
        # nothing is paid for that was not told
        plan = deployer.look_again(plan)
        if plan.missing and not yes:
            ask(transactor.name)
        # while nothing is paid yet
        deployer.book.check()
        write_verification(folder, connection.chain_id, wanted)
        receipts = deployer.carry_out(plan, transactor, None if as_json else _tell)
    else:
        deployer.note(wanted)
        write_verification(folder, connection.chain_id, wanted)
    if as_json:
        print(json.dumps(_object(plan, receipts, connection, str(deployer.book.path), str(folder))))
        return
    if not receipts:
        tell("everything is there already: nothing was sent")
        for step in plan.steps:
            tell(f"{step.name:10} {checksum_address(step.address)}")
    tell(f"addresses: {deployer.book.path}")
    tell(f"for the verification of the sources: {folder}")


def _show(plan: Plan, connection: Connection, quiet: bool) -> None:
    from rich.console import Console
    from rich.table import Table

    from ..ethereum import GWEI, at_most, rounded

    console = Console(file=sys.stderr if quiet else sys.stdout, width=None if sys.stdout.isatty() else 120)
    table = Table("contract", "address", "gas", "the node's", "ether", "at most", box=None, header_style="bold")
    for column in table.columns[2:]:
        column.justify = "right"
    for step in plan.steps:
        if step.there:
            table.add_row(step.name, checksum_address(step.address), "is there")
            continue
        estimate = None if step.quote is None else step.quote.estimate
        told = "not told" if estimate is None else f"{estimate:,}"
        row = (f"{step.gas:,}", told, rounded(step.cost), at_most(step.ceiling))
        table.add_row(step.name, checksum_address(step.address), *row)
    table.add_row("together", "", f"{plan.gas:,}", "", rounded(plan.cost), at_most(plan.ceiling))
    price = f"{plan.fees.likely / GWEI:.6g} gwei a gas"
    console.print(f"on chain {connection.chain_id}, by the {connection.name}, at {price}:", highlight=False)
    console.print(table)


def _tell(step: Step, receipts: Sequence[Receipt]) -> None:
    gas = sum(receipt.gas for receipt in receipts)
    tell(f"{step.name}: at {checksum_address(step.address)}, {gas:,} gas, transaction {receipts[-1].hash}")


def _object(plan: Plan, receipts: Sequence[Receipt], connection: Connection, book: str, folder: str) -> dict[str, Any]:
    return {
        "chain_id": connection.chain_id,
        "node": connection.name,
        "contracts": [
            {"name": step.name, "address": checksum_address(step.address), "deployed_now": not step.there}
            for step in plan.steps
        ],
        "transactions": [receipt.hash for receipt in receipts],
        "gas": sum(receipt.gas for receipt in receipts),
        "wei": sum(receipt.fee for receipt in receipts),
        "address_book": book,
        "standard_json": folder,
    }
