"""shackled deploy"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..chain._connection import PATIENCE, Connection
from ..deploy._contract import CONTRACTS, STANDARD, Deployment, deployments, write_verification
from ..deploy._deployer import Deployer, Plan
from ..deploy._quote import current_fees
from ..deploy._transactor import Receipt
from ..errors import InputError
from ..ethereum._amounts import GWEI, at_most, rounded
from ..ethereum._encoding import checksum_address
from .chain_options import CALLDATA, NodeOptions, PayerOptions, print_rollup_fee, print_step, wallet_calls, write_calls
from .option import option
from .output import print_json, print_line, print_note, print_table


def deploy(
    node: NodeOptions,
    payer: PayerOptions,
    contracts: str | None = option(
        "--contracts",
        "Comma-separated names: Engine, FragmentEngine, AntialiasedEngine, AntialiasedFragmentEngine, "
        "AntialiasedSmoothEngine, EffectsEngine, Effects, Renderer, Original, Genesis, PngEncoder, Turntable, "
        "GlbEncoder, Studio, Library, Web, Editions, GenesisMetadata. Default: all but GenesisMetadata. "
        "Required contracts are added.",
        "NAMES",
    ),
    calldata: Path | None = CALLDATA,
    as_json: bool = option("--json", "Print one JSON object instead of text."),
    standard_json: Path | None = option(
        "--standard-json", "Folder for the source verification files; default: deployed-CHAIN.", "DIR"
    ),
    rpc_timeout: float = option("--rpc-timeout", "Timeout of a call to the node.", "SECONDS", default=PATIENCE),
) -> None:
    """Deploy the contracts, at the same addresses on every chain. Prints the price first and skips what exists."""
    node.check()
    payer.check()
    names = STANDARD if contracts is None else [name.strip() for name in contracts.split(",") if name.strip()]
    if not names:
        raise InputError(f"--contracts is empty: name one or more of {', '.join(CONTRACTS)}")
    wanted = deployments(names)
    connection = node.connect(rpc_timeout)
    deployer = Deployer(connection)
    deployer.book.entries(connection.chain_id)  # report a damaged file before anything is paid
    plan = deployer.plan(wanted, current_fees(connection, payer.max_fee))
    folder = standard_json or Path(f"deployed-{connection.chain_id}")
    receipts: list[Receipt] = []
    if plan.missing:
        _print_plan(plan, connection)
        if calldata is not None:
            write_calls(calldata, connection.chain_id, wallet_calls(plan), as_json)
            return
        transactor = payer.transactor(connection)
        transactor.on_delay = print_note
        transactor.wait_for_pending()
        # only what was quoted may be paid
        plan = deployer.refresh(plan)
        if plan.missing:
            payer.confirm(transactor)
        # while nothing is paid yet
        deployer.book.check()
        _write_verification(folder, connection.chain_id, wanted)
        receipts = deployer.execute(plan, transactor, print_step)
    else:
        deployer.record(wanted)
        _write_verification(folder, connection.chain_id, wanted)
    if as_json:
        print_json(_document(plan, receipts, connection, str(deployer.book.path), str(folder)))
        return
    if not receipts:
        print_line("all contracts are deployed already: nothing was sent")
        for step in plan.steps:
            print_line(f"{step.name:10} {checksum_address(step.address)}")
    print_line(f"addresses: {deployer.book.path}")
    print_line(f"input of source verification: {folder}")


def _write_verification(folder: Path, chain_id: int, wanted: Sequence[Deployment]) -> None:
    """Write the files for explorers, with one note for the contracts that are left out."""
    left_out = write_verification(folder, chain_id, wanted)
    if left_out:
        print_note(
            f"{folder} has no files for {', '.join(left_out)}: {next(iter(left_out.values()))}, and deploy again"
        )


def _print_plan(plan: Plan, connection: Connection) -> None:
    price = f"{plan.fees.likely / GWEI:.6g} gwei per unit of gas"
    print_note(f"on chain {connection.chain_id}, through the {connection.name}, at {price}:")
    rows = []
    for step in plan.steps:
        row = [step.name, checksum_address(step.address)]
        if step.quote is None:
            rows.append([*row, "deployed", "", "", ""])
            continue
        quote = step.quote
        estimated = "unknown" if quote.estimate is None else f"{quote.estimate:,}"
        rows.append([*row, f"{quote.call.gas:,}", estimated, rounded(quote.likely), at_most(quote.ceiling)])
    rows.append(["total", "", f"{plan.gas:,}", "", rounded(plan.cost), at_most(plan.ceiling)])
    print_table(("contract", "address", "gas", "estimate", "ether", "at most"), rows, to_stderr=True)
    print_rollup_fee(plan.quotes)


def _document(plan: Plan, receipts: list[Receipt], connection: Connection, book: str, folder: str) -> dict[str, Any]:
    return {
        "chain_id": connection.chain_id,
        "node": connection.name,
        "contracts": [
            {"name": step.name, "address": checksum_address(step.address), "deployed_now": not step.is_deployed}
            for step in plan.steps
        ],
        "transactions": [receipt.hash for receipt in receipts],
        "gas": sum(receipt.gas for receipt in receipts),
        "wei": sum(receipt.fee for receipt in receipts),
        "address_book": book,
        "standard_json": folder,
    }
