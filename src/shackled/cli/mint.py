"""shackled mint"""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..errors import InputError
from ..ethereum import checksum_address
from ..image import FORMATS, one_of
from .option import option, parse_size
from .payer import PASSWORD, MaxFee, ask, open_signer, parse_max_fee, price
from .telling import say, tell

if TYPE_CHECKING:
    from ..deploy import Receipt, Step


def mint(
    input: Annotated[
        str, typer.Argument(help="A piece of a dataset, or a mesh or scene file of yours.", metavar="INPUT")
    ],
    rpc: Annotated[str | None, option("--rpc", "A node of the chain.", "URL", envvar="SHACKLED_RPC")] = None,
    account: Annotated[
        Path | None,
        option("--account", f"Who pays: a keystore file; its password is asked, or in {PASSWORD}.", "FILE"),
    ] = None,
    private_key_env: Annotated[
        str | None, option("--private-key-env", "Who pays: the environment variable with a private key.", "NAME")
    ] = None,
    max_fee: MaxFee = None,
    licence: Annotated[str | None, option("--licence", "Of a file: what you know its licence to be.", "TEXT")] = None,
    output: Annotated[
        str | None, option("-o --output", f"The picture as the chain draws it: {one_of(FORMATS)}.", "FILE")
    ] = None,
    size: Annotated[str | None, option("--size", "Pixels, as 128 or 320x200.", "SIZE")] = None,
    max_triangles: Annotated[int | None, option("--max-triangles", "Simplify meshes of more.", "N")] = None,
    position_bits: Annotated[
        int | None,
        option("--position-bits", "Cheaper: keep positions on a grid of 2^N steps, 4 to 16; else exactly.", "N"),
    ] = None,
    chain_id: Annotated[int | None, option("--chain-id", "Stop if the node belongs to another chain.", "N")] = None,
    yes: Annotated[bool, option("--yes -y", "Do not ask.")] = False,
    as_json: Annotated[bool, option("--json", "Print one JSON object instead of words.")] = False,
) -> None:
    """Put an object on a chain for ever, for every contract to draw. The price is told first."""

    from .._load import load, locate
    from ..chain import Connection
    from ..datasets import Piece
    from ..deploy import Transactor, current_fees
    from ..image import check_output
    from ..tokens import Wanted, licence_of, plan_storage, read_back, store

    path = None if output is None else check_output(output)
    pixels = None if size is None else parse_size(size)
    source = locate(input)
    terms = licence_of(source, licence)
    if rpc is None:
        raise InputError("--rpc is missing: the address of a node of the chain, as http://127.0.0.1:8545")
    scene = load(source, pixels, max_triangles=max_triangles)
    wanted = Wanted(input, scene, position_bits)
    connection = Connection(rpc, attempts=4)
    connection.expect_chain(chain_id)
    most = parse_max_fee(max_fee)
    storage = plan_storage(connection, [wanted], current_fees(connection, most))
    pointer = storage.pointers[0]
    if isinstance(source, Piece) and source.notice:
        say(source.notice)
    gas = 0
    if storage.missing or storage.parts.missing:
        triangles = scene.triangles
        say(
            f"{input}, {triangles:,} triangles, {sum(each.storing.size for each in storage.missing):,} bytes on chain "
            f"{connection.chain_id}; licence: {terms}"
        )
        if storage.parts.missing:
            say(f"first {', '.join(step.name for step in storage.parts.missing)}: {storage.parts.gas:,} gas")
        say(f"storing it: {storage.gas:,} gas; nothing undoes it")
        say(f"it costs {price([*storage.parts.quotes, *storage.quotes])}")
        transactor = Transactor(connection, open_signer(account, private_key_env), max_fee=most)
        if not yes:
            ask(transactor.name)

        def report(step: Step, receipts: Sequence[Receipt]) -> None:
            gas = sum(each.gas for each in receipts)
            say(f"{step.name}: at {checksum_address(step.address)}, {gas:,} gas, transaction {receipts[-1].hash}")

        gas = sum(receipt.gas for receipt in store(storage, transactor, report))
    else:
        say(f"{input} is on chain {connection.chain_id} already: nothing was sent")
    image = read_back(connection, storage.studio, pointer, wanted)
    if path is not None:
        image.save(path)
    if as_json:
        print(
            json.dumps(
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
        )
        return
    tell(f"pointer  {pointer}")
    tell(f"studio   {storage.studio}")
    drawing = "not told" if image.gas is None else f"{image.gas:,} gas"
    tell(f"drawing  {drawing}" + ("" if path is None else f", in {path}"))
    tell(f"in Solidity: Studio({storage.studio}).renderDataURI({pointer}, 4)")
    tell(f"from here:   shackled token picture {pointer} -o FILE.png")
