"""shackled store, library list and library store: scenes in the Studio"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from .._load import locate
from ..chain._connection import Connection, read_all
from ..datasets._pieces import Piece
from ..deploy._quote import Quote, current_fees
from ..errors import InputError
from ..ethereum._encoding import checksum_address
from ..image import FORMATS, check_output, one_of
from ..library import chosen_items, items
from ..scene._settings import ALL
from ..tokens._icons import licence_of, scene_to_store
from ..tokens._storage import SceneToStore, StoragePlan, plan_storage, read_back
from ..tokens._storage import store as send
from .chain_options import CALLDATA, JSON, NodeOptions, PayerOptions, print_price, print_step, wallet_calls, write_calls
from .look_options import parse_size
from .option import argument, exclude, option
from .output import print_json, print_line, print_note, print_table
from .progress import LateBar


def store(
    node: NodeOptions,
    payer: PayerOptions,
    input: str = argument("A dataset piece, or a mesh or scene file.", "INPUT"),
    licence: str | None = option("--licence", "Licence of a mesh or scene file; check it yourself.", "TEXT"),
    output: str | None = option(
        "-o --output", f"Write the picture as rendered on the chain: {one_of(FORMATS)}.", "FILE"
    ),
    size: tuple[int, int] | None = option(
        "--size", "Width and height in pixels, as 128 or 320x200.", "SIZE", parse=parse_size
    ),
    max_triangles: int | None = option("--max-triangles", "Simplify meshes with more triangles than this.", "N"),
    position_bits: int | None = option(
        "--position-bits", "Round positions to a grid of 2^N steps, 4 to 16, to save gas. Default: exact.", "N"
    ),
    calldata: Path | None = CALLDATA,
    as_json: bool = JSON,
) -> None:
    """Store an object on a chain; any contract can then draw it.

    Prints the price first; cannot be undone.
    """
    exclude("--calldata", calldata, {"--output": output})
    path = None if output is None else check_output(output)
    source = locate(input)
    terms = licence_of(source, licence)
    node.check()
    payer.check()
    # what is stored can be drawn at any size
    scene = scene_to_store(source, size, max_triangles or ALL)
    wanted = SceneToStore(input, scene, position_bits)
    connection = node.connect()
    with LateBar("reading the chain"):
        storage = plan_storage(connection, [wanted], current_fees(connection, payer.max_fee))
    pointer = storage.pointers[0]
    if isinstance(source, Piece) and source.notice:
        print_note(source.notice)
    named = {f"store part {number} of {each.name}": each.quote for number, each in enumerate(storage.missing, 1)}
    if storage.missing or storage.parts.missing:
        size_in_bytes = sum(each.transaction.size for each in storage.missing)
        print_note(
            f"{input}: {scene.triangles:,} triangles, {size_in_bytes:,} bytes on chain {connection.chain_id}; "
            f"licence: {terms}"
        )
        gas = _send(storage, connection, payer, "it", named, calldata, as_json, pointer=pointer)
        if gas is None:
            if not as_json:
                print_line(f"pointer  {pointer}")
            return
    else:
        gas = 0
        print_note(f"{input} is on chain {connection.chain_id} already: nothing was sent")
    image = read_back(connection, storage.studio, pointer, wanted)
    if path is not None:
        image.save(path)
    if as_json:
        print_json(
            {
                "input": input,
                "chain_id": connection.chain_id,
                "studio": storage.studio,
                "pointer": pointer,
                "gas": gas,
                "render_gas": image.gas,
                "licence": terms,
                "output": None if path is None else str(path),
            }
        )
        return
    print_line(f"pointer  {pointer}")
    print_line(f"studio   {storage.studio}")
    drawing = "gas unknown" if image.gas is None else f"{image.gas:,} gas"
    print_line(f"drawing  {drawing}" + ("" if path is None else f", in {path}"))
    print_line(f"in Solidity:  Studio({storage.studio}).renderDataURI({pointer}, 4)")
    print_line(f"command line: shackled token picture {pointer} -o FILE.png")
    print_line(f"as tokens:    shackled token edition add {pointer} NAME --price ETHER")


def list_(node: NodeOptions, as_json: bool = JSON) -> None:
    """List the items: bounds, triangles, bytes, gas to store, pointers; with --rpc, whether they are stored."""
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


def store_items(
    node: NodeOptions,
    payer: PayerOptions,
    names: tuple[str, ...] = argument("Items to store; default: all.", "NAME"),
    calldata: Path | None = CALLDATA,
    as_json: bool = JSON,
) -> None:
    """Store items of the library on a chain. Skips stored items; prints the price first; cannot be undone."""
    node.check()
    payer.check()
    with LateBar("reading items"):
        wanted = chosen_items(names or ())
        connection = node.connect()
        scenes = [SceneToStore(each.name, each.scene) for each in wanted]
        plan = plan_storage(connection, scenes, current_fees(connection, payer.max_fee))
    if plan.pointers != tuple(checksum_address(each.pointer) for each in wanted):
        raise InputError("the Studio of this chain is not that of this version: see `shackled deploy`")
    gas: int | None = 0
    if plan.missing or plan.parts.missing:
        named = {f"{each.name}, {each.transaction.what}": each.quote for each in plan.missing}
        count = len({each.name for each in plan.missing})
        gas = _send(plan, connection, payer, f"{count} of {len(wanted)} items", named, calldata, as_json)
        if gas is None:
            return
    else:
        print_note("all items are stored already: nothing was sent")
    pointers = {each.name: pointer for each, pointer in zip(wanted, plan.pointers, strict=True)}
    if as_json:
        print_json({"chain_id": connection.chain_id, "studio": plan.studio, "gas": gas, "pointers": pointers})
        return
    for name, pointer in pointers.items():
        print_line(f"{name:16} {pointer}")


def _send(
    storage: StoragePlan,
    connection: Connection,
    payer: PayerOptions,
    what: str,
    named: dict[str, Quote],
    calldata: Path | None,
    as_json: bool,
    **more: str,
) -> int | None:
    """Print the price of what is missing, and send it; return its gas, or None if it was written for a wallet.

    named: the transactions by their purpose, for a wallet. more: of the JSON.
    """
    if storage.parts.missing:
        names = ", ".join(step.name for step in storage.parts.missing)
        print_note(f"deploying {names} first: {storage.parts.gas:,} gas")
    print_note(f"storing {what}: {storage.gas:,} gas; it cannot be undone")
    # before the account is opened, so that the price is shown without one
    print_price([*storage.parts.quotes, *storage.quotes])
    if calldata is not None:
        write_calls(calldata, connection.chain_id, wallet_calls(storage.parts) | named, as_json, **more)
        return None
    transactor = payer.transactor(connection)
    payer.confirm(transactor)
    return sum(receipt.gas for receipt in send(storage, transactor, print_step))
