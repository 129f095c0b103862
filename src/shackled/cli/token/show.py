"""shackled token show, list, picture and verify: commands that read"""

from __future__ import annotations

from itertools import chain
from pathlib import Path
from typing import Any

from ...animation import DURATION
from ...base.whole_file import check_output_file, write_output
from ...deploy._contract import local_chain
from ...errors import InputError, VerificationError
from ...ethereum._amounts import amount, ether
from ...image import check_output, one_of
from ...studio._storage import ANIMATE, STUDIO
from ...tokens._collection import EDITIONS
from ...tokens._contract import PHASES, Contract
from ...tokens._icons import icons_of
from ...tokens._launch import address_of
from ...tokens._verify import check_code, check_token
from ...tokens._view import read_view, read_views
from ..chain_options import JSON, NodeOptions
from ..look_options import parse_size
from ..option import argument, need, option
from ..output import print_json, print_line, print_table
from ..progress import LateBar
from .options import POINTER, SCALE, TOKEN, CollectionOptions


def show(
    which: CollectionOptions,
    token_id: int = TOKEN,
    output: Path | None = option(
        "-o --output", "File for the picture; written unchanged if it has the token's format.", "FILE"
    ),
    as_json: bool = JSON,
) -> None:
    """Show the traits of a token, and save its picture, both from its `tokenURI`."""
    if output is not None:
        check_output(output)
    view = read_view(which.open(or_editions=True), token_id, measured=True)
    metadata = view.metadata
    if output is not None:
        metadata.save(output)
    if as_json:
        print_json(view.document() | {"document": metadata.document})
        return
    height, width = metadata.pixels.shape[:2]
    rows = [
        ("token", f"{metadata.name}" + ("" if view.revealed else ", not revealed yet")),
        ("owner", view.owner),
        *((key.lower(), str(value)) for key, value in metadata.traits.items()),
        ("gas", "unknown" if view.gas is None else f"{view.gas:,} for the whole tokenURI, {metadata.length:,} bytes"),
        ("picture", f"{width} x {height} pixels" + ("" if output is None else f", in {output}")),
    ]
    width = max(len(key) for key, _ in rows)
    for key, value in rows:
        print_line(f"{key:{width}}  {value}")


def list_(which: CollectionOptions, as_json: bool = JSON) -> None:
    """List the tokens with owners and traits, and the state of the collection."""
    if which.collection == EDITIONS.name:
        raise InputError("editions have no sale phases: shackled token edition list lists them")
    collection = which.open()
    owner, phase, balance = collection.contract.account("owner"), collection.phase(), collection.balance()
    with LateBar("reading tokens") as bar:
        icons = [] if collection.kind.hidden else icons_of(collection)
        views = list(read_views(collection, bar.set))
    if as_json:
        print_json(
            {
                "collection": collection.name,
                "address": collection.address,
                "chain_id": collection.connection.chain_id,
                "owner": owner,
                "phase": phase,
                "minted": len(views),
                "balance": amount(balance),
                "icons": [each.document() for each in icons],
                "tokens": [each.summary() for each in views],
            }
        )
        return
    print_line(f"{collection.name} at {collection.address}: {PHASES[phase]}, {len(views):,} minted")
    royalty = collection.contract.call("royaltyInfo", 0, 10_000)[1]
    print_line(f"owner {owner}, {ether(balance)} to withdraw, royalties {royalty / 100:g} %")
    if icons:
        print()
        rows = [(str(e.number), e.name, amount(e.price), str(e.supply), str(e.left), e.scene) for e in icons]
        print_table(("icon", "name", "ether", "supply", "left", "scene"), rows)
        print()
    traits = list(dict.fromkeys(key for each in views if each.revealed for key in each.metadata.traits))
    print_table(("token", "owner", "revealed", *traits), [each.row(traits) for each in views])


def picture(
    node: NodeOptions,
    pointer: str = POINTER,
    output: Path = option("-o --output", "Output file: a picture, .png or .svg, or a 3D model, .glb.", "FILE"),
    scale: int = SCALE,
    turntable: int | None = option(
        "--turntable", "Animated PNG of a full turn in this many frames.", "FRAMES", min=2, max=360
    ),
    duration: int = option("--duration", "Duration of a frame.", "MILLISECONDS", min=20, max=10_000, default=DURATION),
    size: tuple[int, int] | None = option("--size", "Pixels of a frame, as 64 or 80x60.", "SIZE", parse=parse_size),
) -> None:
    """Render a stored scene on a chain."""
    calls: dict[str, tuple[Any, ...]] = {
        ".png": ("renderPNG(address,uint256)", pointer, scale),
        ".svg": ("renderSVG(address,uint256)", pointer, scale),
        ".glb": ("glb(address)", pointer),
    }
    kind = output.suffix.lower()
    if kind not in calls:
        raise InputError(f"the picture {output} must end in {one_of(calls)}")
    need("--turntable: a stored scene has its size", turntable, {"--size": size})
    if turntable is not None:
        if kind != ".png":
            raise InputError(f"the turntable {output} must end in .png")
        # the axis (0, 1, 0) as Q32, the camera moved back; changes of the canvas only
        spin = (turntable, duration, scale, (0, 1 << 32, 0), True)
        changes = (16 if size else 0, (0, 0, 0, 0), 0, (0, 0), 0, size or (0, 0))
        calls[kind] = (ANIMATE, pointer, spin, changes)
    check_output_file(output, "picture")
    studio = Contract(node.connect(), STUDIO, address_of(STUDIO))
    content = studio.call(*calls[kind])
    content = content.encode() if isinstance(content, str) else content
    write_output(output, content)
    gas = studio.gas(*calls[kind])
    print_line(f"{output}: {len(content):,} bytes" + ("" if gas is None else f", {gas:,} gas"))


def verify(which: CollectionOptions, numbers: tuple[int, ...] = argument("Tokens; default: all.", "ID")) -> None:
    """Compare the code, the seeds and the pictures of a collection with those computed locally."""
    collection, local = which.open(or_editions=True), local_chain()
    failed = unread = 0
    for each in numbers or ():
        collection.owner_of(each)
    wanted = numbers or range(collection.minted())
    for check in chain(check_code(collection), (check_token(collection, each, local) for each in wanted)):
        failed += bool(check.failure)
        unread += bool(check.unread)
        verdict = "WRONG" if check.failure else "unread" if check.unread else "ok"
        reason = check.failure or check.unread
        print_line(f"{verdict:6} {check.what}" + (f": {reason}" if reason else ""))
    not_read = f"{unread} of the tokens could not be read, so they were not checked"
    if failed:
        raise VerificationError(f"{failed} of the checks failed" + (f", and {not_read}" if unread else ""))
    if unread:
        raise VerificationError(f"no check failed, but {not_read}: use a node with a higher gas limit for calls")
