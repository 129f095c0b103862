"""shackled token show, list, picture and verify: what anyone can see"""

from __future__ import annotations

import json
from itertools import chain
from pathlib import Path
from typing import Annotated

import typer

from ...errors import InputError, VerificationError
from ...ethereum import amount, ether
from ..option import option
from ..telling import tell
from .common import MOST, PHASES, Chain, Json, Rpc, Which, address, connect, open_named, table


def show(
    token_id: Annotated[int, typer.Argument(help="Of the token.", metavar="ID", min=0, max=MOST)],
    output: Annotated[
        Path | None, option("-o --output", "Where the picture is kept, in the format that the token has.", "FILE")
    ] = None,
    which: Which = "genesis",
    rpc: Rpc = None,
    chain_id: Chain = None,
    as_json: Json = False,
) -> None:
    """Show a token: its traits, and its picture as a file, both from its `tokenURI`."""
    from ...tokens import Shown, check_picture_file, save_picture

    if output is not None:
        check_picture_file(output)
    collection = open_named(which, rpc, chain_id)
    found = collection.token(token_id)
    metadata = collection.metadata(token_id)
    gas = collection.contract.gas("tokenURI", token_id)
    shown = Shown(collection.name, collection.address, token_id, found.owner, found.revealed, metadata, gas)
    if output is not None:
        save_picture(metadata, output)
    if as_json:
        print(json.dumps(shown.document() | {"document": metadata.document}, ensure_ascii=False))
        return
    height, width = metadata.pixels.shape[:2]
    rows = [
        ("token", f"{metadata.name}" + ("" if found.revealed else ", not revealed yet")),
        ("owner", found.owner),
        *((key.lower(), str(value)) for key, value in metadata.traits.items()),
        ("gas", "not told" if gas is None else f"{gas:,} for the whole tokenURI, {metadata.length:,} bytes"),
        ("picture", f"{width} x {height} pixels" + ("" if output is None else f", in {output}")),
    ]
    width = max(len(key) for key, _ in rows)
    for key, value in rows:
        tell(f"{key:{width}}  {value}")


def list_(
    which: Which = "genesis",
    rpc: Rpc = None,
    chain_id: Chain = None,
    as_json: Json = False,
) -> None:
    """List the tokens with owners and traits, and how the collection stands."""
    from ...tokens import icons_of, read_all, trait_columns

    collection = open_named(which, rpc, chain_id)
    terms = collection.terms()
    icons = [] if collection.kind.hidden else icons_of(collection)
    tokens = list(read_all(collection))
    if as_json:
        print(
            json.dumps(
                {
                    "collection": terms.name,
                    "address": collection.address,
                    "chain_id": collection.connection.chain_id,
                    "owner": terms.owner,
                    "phase": PHASES[terms.phase],
                    "minted": terms.minted,
                    "balance": amount(terms.balance),
                    "icons": [each.document() for each in icons],
                    "tokens": [each.document() for each in tokens],
                },
                ensure_ascii=False,
            )
        )
        return
    tell(f"{terms.name} at {collection.address}: {terms.phase_words}, {terms.minted:,} minted")
    tell(f"owner {terms.owner}, {ether(terms.balance)} to withdraw, royalties {terms.royalty / 100:g} %")
    if icons:
        print()
        head = ("icon", "name", "ether", "supply", "left", "scene")
        table(
            head,
            [
                (str(each.number), each.name, amount(each.price), str(each.supply), str(each.left), each.scene)
                for each in icons
            ],
        )
        print()
    columns = trait_columns(tokens)
    table(("token", "owner", "revealed", *columns), [each.row(columns) for each in tokens])


def picture(
    pointer: Annotated[str, typer.Argument(help="Of a scene, as `shackled mint` prints it.", metavar="POINTER")],
    output: Annotated[Path, option("-o --output", "Where the picture is kept, .png.", "FILE")],
    scale: Annotated[int, option("--scale", "Pixels that each pixel becomes, 1 to 8; else 4.", "N", min=1, max=8)] = 4,
    rpc: Rpc = None,
    chain_id: Chain = None,
) -> None:
    """Have a chain draw a scene that is kept there, as a PNG file that contracts make."""
    from ...studio import STUDIO
    from ...tokens import Contract, address_of, check_picture_file, parts_of, write_picture

    place = address(pointer, "the pointer")
    if output.suffix.lower() != ".png":
        raise InputError(f"the picture {output} must end in .png")
    check_picture_file(output)
    studio = Contract(connect(rpc, chain_id), STUDIO, address_of(parts_of(STUDIO, itself=True), STUDIO))
    content = studio.call("renderPNG(address,uint256)", place, scale)
    write_picture(output, content)
    gas = studio.gas("renderPNG(address,uint256)", place, scale)
    tell(f"{output}: {len(content):,} bytes" + ("" if gas is None else f", {gas:,} gas"))


def verify(
    numbers: Annotated[list[int] | None, typer.Argument(help="Tokens; else all.", metavar="[ID]...")] = None,
    which: Which = "genesis",
    rpc: Rpc = None,
    chain_id: Chain = None,
) -> None:
    """Compare the code, the seeds and the pictures of a collection with what is computed here."""
    from ...deploy import local_chain
    from ...tokens import check_code, check_token

    collection = open_named(which, rpc, chain_id)
    local = local_chain()
    failures = unread = 0
    wanted = range(collection.minted()) if not numbers else [collection.token(each).number for each in numbers]
    for check in chain(check_code(collection), (check_token(collection, each, local) for each in wanted)):
        failures += bool(check.failure)
        unread += bool(check.unread)
        verdict = "WRONG" if check.failure else "unread" if check.unread else "ok"
        why = check.failure or check.unread
        tell(f"{verdict:6} {check.what}" + (f": {why}" if why else ""))
    not_read = f"{unread} of the tokens could not be read, which says nothing against them"
    if failures:
        raise VerificationError(f"{failures} of the checks failed" + (f", and {not_read}" if unread else ""))
    if unread:
        raise VerificationError(f"nothing is wrong, but {not_read}: take a node that gives calls more gas")
