"""shackled store"""

from __future__ import annotations

from typing import Annotated

from ..errors import InputError
from ..image import FORMATS, one_of
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
from .look_options import parse_size
from .option import argument, option
from .output import print_line, print_note
from .progress import LateBar


def store(
    input: Annotated[str, argument("A dataset piece, or a mesh or scene file.", "INPUT")],
    node: NodeOptions,
    payer: PayerOptions,
    licence: Annotated[
        str | None, option("--licence", "Licence of a mesh or scene file; check it yourself.", "TEXT")
    ] = None,
    output: Annotated[
        str | None, option("-o --output", f"Write the picture as rendered on the chain: {one_of(FORMATS)}.", "FILE")
    ] = None,
    size: Annotated[str | None, option("--size", "Pixels, as 128 or 320x200.", "SIZE")] = None,
    max_triangles: Annotated[
        int | None, option("--max-triangles", "Simplify meshes of more triangles than this.", "N")
    ] = None,
    position_bits: Annotated[
        int | None,
        option("--position-bits", "Round positions to a grid of 2^N steps, 4 to 16, to save gas. Default: exact.", "N"),
    ] = None,
    calldata: Calldata = None,
    as_json: Annotated[bool, option("--json", "Print one JSON object instead of text.")] = False,
) -> None:
    """Store an object on a chain; any contract can then draw it.

    Prints the price first; cannot be undone.
    """

    from .._load import load, locate
    from ..datasets import Piece
    from ..deploy import current_fees
    from ..image import check_output
    from ..scene import ALL, READERS
    from ..tokens import SceneToStore, licence_of, plan_storage, read_back, token_scene
    from ..tokens import store as send

    if calldata is not None and output is not None:
        raise InputError(
            "--calldata sends nothing, so no chain can draw the picture that --output writes: leave one out"
        )
    path = None if output is None else check_output(output)
    check_calldata(calldata)
    pixels = None if size is None else parse_size(size)
    source = locate(input)
    terms = licence_of(source, licence)
    node.check()
    payer.check()
    # a token is drawn by nodes of all kinds, of which many allow a call too little gas for antialiased meshes
    is_mesh = not isinstance(source, Piece) and source.suffix.lower() in READERS
    thing = (token_scene(source) if pixels is None else source.make()) if isinstance(source, Piece) else source
    # what is stored can be drawn at any size
    scene = load(thing, pixels, max_triangles=max_triangles or ALL, antialias=False if is_mesh else None)
    wanted = SceneToStore(input, scene, position_bits)
    connection = node.connect()
    with LateBar("reading the chain"):
        storage = plan_storage(connection, [wanted], current_fees(connection, payer.max_wei))
    pointer = storage.pointers[0]
    if isinstance(source, Piece) and source.notice:
        print_note(source.notice)
    gas = 0
    if storage.missing or storage.parts.missing:
        size_in_bytes = sum(each.transaction.size for each in storage.missing)
        print_note(
            f"{input}: {scene.triangles:,} triangles, {size_in_bytes:,} bytes on chain {connection.chain_id}; "
            f"licence: {terms}"
        )
        if storage.parts.missing:
            names = ", ".join(step.name for step in storage.parts.missing)
            print_note(f"deploying {names} first: {storage.parts.gas:,} gas")
        print_note(f"storing it: {storage.gas:,} gas; it cannot be undone")
        # before the account is opened, so that the price is shown without one
        print_price([*storage.parts.quotes, *storage.quotes])
        if calldata is not None:
            parts = {
                f"store part {number} of {each.name}": each.quote for number, each in enumerate(storage.missing, 1)
            }
            calls = wallet_calls(storage.parts) | parts
            write_calls(calldata, connection.chain_id, calls, as_json, pointer=pointer)
            if not as_json:
                print_line(f"pointer  {pointer}")
            return
        transactor = payer.transactor(connection)
        payer.confirm(transactor)
        gas = sum(receipt.gas for receipt in send(storage, transactor, print_step))
    else:
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
