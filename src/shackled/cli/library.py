"""shackled library"""

from __future__ import annotations

from typing import Annotated, Any

from ..errors import InputError
from ..ethereum import checksum_address
from .chain_options import (
    Calldata,
    NodeOptions,
    PayerOptions,
    check_calldata,
    print_json,
    print_price,
    print_step,
    wallet_calls,
    write_calls,
)
from .option import argument, option
from .output import print_line, print_note, print_table
from .progress import LateBar


def list_(
    node: NodeOptions,
    as_json: Annotated[bool, option("--json", "Print one JSON object instead of a table.")] = False,
) -> None:
    """List the items: bounds, triangles, bytes, gas to store, pointers; with --rpc, whether they are stored."""
    from ..chain import read_all
    from ..library import items

    stored: dict[str, bool] = {}
    with LateBar("reading items") as bar:
        found = items()
        if node.rpc is not None:
            connection = node.connect()
            parts = [(each.name, part.pointer) for each in found for part in each.transactions]
            codes = read_all(lambda part: connection.code(part[1]), parts, bar.set)
            for (name, _), code in zip(parts, codes, strict=True):
                stored[name] = stored.get(name, True) and bool(code)
    rows = [
        {
            "name": each.name,
            "piece": each.piece,
            "triangles": each.scene.triangles,
            "low": each.low.tolist(),
            "high": each.high.tolist(),
            "bytes": each.size,
            "gas": each.gas,
            "meshes": [checksum_address(mesh) for mesh in each.meshes],
            "pointer": checksum_address(each.pointer),
            **({"stored": stored[each.name]} if stored else {}),
        }
        for each in found
    ]
    if as_json:
        print_json({"items": rows})
        return
    head = ["name", "triangles", "size", "bytes", "gas", "pointer", *(["stored"] if stored else [])]
    print_table(head, [_row(each) for each in rows])


def _row(item: dict[str, Any]) -> list[str]:
    sides = " x ".join(f"{high - low:,}" for low, high in zip(item["low"], item["high"], strict=True))
    row = [item["name"], f"{item['triangles']:,}", sides, f"{item['bytes']:,}", f"{item['gas']:,}", item["pointer"]]
    return [*row, "yes" if item["stored"] else "no"] if "stored" in item else row


def store(
    node: NodeOptions,
    payer: PayerOptions,
    names: Annotated[list[str] | None, argument("Items to store; default: all.", "[NAME]...")] = None,
    calldata: Calldata = None,
    as_json: Annotated[bool, option("--json", "Print one JSON object instead of text.")] = False,
) -> None:
    """Store items of the library on a chain. Skips stored items; prints the price first; cannot be undone."""
    from ..deploy import current_fees
    from ..library import chosen_items
    from ..tokens import SceneToStore, plan_storage
    from ..tokens import store as send

    node.check()
    payer.check()
    check_calldata(calldata)
    with LateBar("reading items"):
        wanted = chosen_items(names or ())
        connection = node.connect()
        scenes = [SceneToStore(each.name, each.scene) for each in wanted]
        plan = plan_storage(connection, scenes, current_fees(connection, payer.max_wei))
    if plan.pointers != tuple(checksum_address(each.pointer) for each in wanted):
        raise InputError("the Studio of this chain is not that of this version: see `shackled deploy`")
    gas = 0
    if plan.missing or plan.parts.missing:
        if plan.parts.missing:
            print_note(f"deploying {', '.join(s.name for s in plan.parts.missing)} first: {plan.parts.gas:,} gas")
        count = len({each.name for each in plan.missing})
        print_note(f"storing {count} of {len(wanted)} items: {plan.gas:,} gas; it cannot be undone")
        print_price([*plan.parts.quotes, *plan.quotes])
        if calldata is not None:
            parts = {f"{each.name}, {each.transaction.what}": each.quote for each in plan.missing}
            write_calls(calldata, connection.chain_id, wallet_calls(plan.parts) | parts, as_json)
            return
        transactor = payer.transactor(connection)
        payer.confirm(transactor)
        gas = sum(receipt.gas for receipt in send(plan, transactor, print_step))
    else:
        print_note("all items are stored already: nothing was sent")
    pointers = {each.name: pointer for each, pointer in zip(wanted, plan.pointers, strict=True)}
    if as_json:
        print_json({"chain_id": connection.chain_id, "studio": plan.studio, "gas": gas, "pointers": pointers})
        return
    for name, pointer in pointers.items():
        print_line(f"{name:16} {pointer}")
