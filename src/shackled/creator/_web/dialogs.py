"""The dialogs of the page and their long tasks: downloads, gas and stages, wallets, comparison with a node."""

from __future__ import annotations

import asyncio
import base64
from collections.abc import Awaitable, Callable

from ...errors import ShackledError
from ...tokens import EditionTerms
from .._link import LOCAL
from .._pool import gif_pixels
from .._scene import filled
from .._state import Size
from .._takeaway import MAX_PNG, SCALES
from .edition import can_be_sold, mint_edition
from .mint import Offer, mint, offer_of
from .page import SNIPPETS, TURNTABLES, fragment
from .reveal import COMMAND, Reveal, find_reveal, known_collection, send_reveal
from .visitor import Message, Visitor
from .wallet import DeclinedError, Tell, Wallet

#: Number of characters of a snippet that are shown; copies are complete.
SHOWN = 1500
_LOCAL = f"{LOCAL} Send others the page or the scene file."
_UPLOAD = "The file that you opened is kept in the memory of this server only."


async def takeaway(visitor: Visitor) -> None:
    """Open the dialog of downloads, with snippets of the current picture."""
    is_upload = visitor.state.source.kind == "upload"
    notes = [_LOCAL] if visitor.is_local else []
    notes += [_UPLOAD] if is_upload else []
    size = filled(visitor.state, visitor.facts).size or Size()
    most = visitor.pool.limits.gif_pixels
    gifs = {each: gif_pixels(size.width * size.height, *each) <= most for each in TURNTABLES}
    too_large = f"The picture is too large for a GIF, which is limited to {most:,} pixels: choose a smaller size."
    attributes: dict[str, dict[str, str | None]] = {"take-file": {"hidden": None if is_upload else ""}}
    attributes |= {f"gif-{frames}-{scale}": {"hidden": None if fits else ""} for (frames, scale), fits in gifs.items()}
    for scale in SCALES:
        attributes[f"take-png-{scale}"] = {
            "title": f"{scale * size.width} x {scale * size.height} pixels",
            "hidden": "" if scale * max(size.width, size.height) > MAX_PNG else None,
        }
    texts = {"link-note": " ".join(notes), "gif-note": "" if any(gifs.values()) else too_large}
    await visitor.tell({"open": "takeaway", "texts": texts, "attributes": attributes})
    for kind in SNIPPETS:
        try:
            text = (await visitor.pool.take(visitor.name, visitor.state, kind)).data.decode()
        except ShackledError as error:
            text = str(error)
        if len(text) > SHOWN:
            text = f"{text[:SHOWN]}…\n\n{len(text):,} characters; Copy and Save take all of them"
        await visitor.tell({"texts": {f"snippet-{kind}": text}})


async def turntable(visitor: Visitor, frames: int, scale: int) -> None:
    """Make a GIF and let the page download it."""

    def progress(done: int, total: int) -> Message:
        bar = {"value": str(done), "max": str(total)}
        return {"attributes": {"gif-bar": bar}, "texts": {"gif-words": f"{done} of {total} frames"}}

    await visitor.tell({"attributes": {"gif-job": {"hidden": None}, "gif-start": {"disabled": ""}}})
    try:
        visitor.turntable = await visitor.pool.turntable(
            visitor.name, visitor.state, frames=frames, scale=scale, progress=visitor.progress(progress)
        )
        await visitor.tell({"download": f"/take/{visitor.name}/turntable", "note": "The GIF is done"})
    except asyncio.CancelledError:
        await visitor.tell({"note": "The GIF was cancelled"})
        raise
    finally:
        await visitor.tell({"attributes": {"gif-job": {"hidden": ""}, "gif-start": {"disabled": None}}})


async def stages(visitor: Visitor) -> None:
    """Open the dialog of limits, stage pictures and gas by stage."""
    fits = visitor.frame.fits if visitor.frame is not None else ()
    html = {
        "fits": fragment("fits", fits=fits),
        "stages": fragment("waiting"),
        "gas": fragment("waiting"),
    }
    await visitor.tell({"open": "stages", "html": html})
    state = visitor.state
    made = await visitor.pool.stages(visitor.name, state)
    pictures = [(stage.title, stage.detail, base64.b64encode(stage.png).decode()) for stage in made]
    await visitor.tell({"html": {"stages": fragment("stages", pictures=pictures)}})
    try:
        gas = await visitor.pool.stage_gas(visitor.name, state)
        await visitor.tell({"html": {"gas": fragment("gas", gas=gas)}})
    except ShackledError as error:
        await visitor.tell({"html": {"gas": fragment("sentence", text=str(error))}})


async def compare(visitor: Visitor) -> None:
    """Render the picture on the node and report whether it is the same."""
    await visitor.tell({"texts": {"node": "Rendering on the node …"}, "attributes": {"node": {"disabled": ""}}})
    try:
        result = await visitor.pool.compare(visitor.name, visitor.state)
        same = "the same bytes as here" if result.same else "NOT the same bytes as here"
        text = f"{result.node}: {same}, in {result.seconds:.2f} s"
        await visitor.tell({"note" if result.same else "alert": text})
    finally:
        await visitor.tell({"texts": {"node": "Render on the node"}, "attributes": {"node": {"disabled": None}}})


async def show_offer(visitor: Visitor) -> None:
    """Show what can be minted, and with which wallets."""
    source = visitor.state.source
    offer = offer_of(source)
    html = fragment(
        "mint",
        offer="" if offer is None else offer.words,
        edition=can_be_sold(source),
        title=visitor.facts.title,
        is_upload=source.kind == "upload",
        wallets=visitor.wallets,
        busy=visitor.is_at("mint"),
        status=visitor.status.get("mint", ""),
    )
    await visitor.tell({"html": {"mint": html}})


async def mint_token(visitor: Visitor, offer: Offer, number: int) -> None:
    """Mint a token. number: of the wallet."""
    await _with_wallet(visitor, number, "mint", lambda wallet, tell: mint(offer, wallet, tell))


async def make_edition(visitor: Visitor, terms: EditionTerms, number: int) -> None:
    """Add the current picture as an edition. number: of the wallet."""
    state = visitor.state

    async def make(wallet: Wallet, tell: Tell) -> str:
        await tell("Drawing the scene …")
        return await mint_edition(await visitor.pool.edition(visitor.name, state, terms), wallet, tell)

    await _with_wallet(visitor, number, "mint", make)


async def show_reveal(visitor: Visitor) -> None:
    """Show the dialog in which tokens are revealed, as it is now."""
    html = fragment(
        "reveal",
        collection=visitor.collection or known_collection(),
        command=COMMAND,
        wallets=visitor.wallets,
        status=visitor.status.get("reveal", ""),
    )
    await visitor.tell({"html": {"reveal": html}})
    await _show_transaction(visitor, visitor.reveal)


async def find_tokens(visitor: Visitor, collection: str, number: int) -> None:
    """Find what can be revealed, and show the transaction. number: of the wallet."""
    await _show_transaction(visitor, None)

    async def find(wallet: Wallet, tell: Tell) -> str:
        found = await find_reveal(collection, wallet, number, tell)
        if found is None:
            return "There is nothing to reveal: all tokens of the collection are revealed, or none was minted yet"
        await _show_transaction(visitor, found)
        return f"Ready: the transaction below reveals {found.words}. {found.later}".strip()

    await _with_wallet(visitor, number, "reveal", find, waits=False)


async def reveal_tokens(visitor: Visitor, reveal: Reveal) -> None:
    """Have the wallet send the transaction that the dialog shows."""

    async def send(wallet: Wallet, tell: Tell) -> str:
        words = await send_reveal(reveal, wallet, tell)
        await _show_transaction(visitor, None)
        return words

    await _with_wallet(visitor, reveal.wallet, "reveal", send)


async def _show_transaction(visitor: Visitor, reveal: Reveal | None) -> None:
    visitor.reveal = reveal
    html = fragment("transaction", reveal=reveal, wallets=visitor.wallets, busy=visitor.is_at("reveal-send"))
    await visitor.tell({"html": {"reveal-transaction": html}})


async def _with_wallet(
    visitor: Visitor, number: int, name: str, work: Callable[[Wallet, Tell], Awaitable[str]], waits: bool = True
) -> None:
    """Run a task that needs a wallet, and report its progress.

    name: of the status, and of the buttons that wait for the end.
    """

    async def tell(words: str) -> None:
        if words != visitor.status.get(name):
            visitor.status[name] = words
            await visitor.tell({"texts": {f"{name}-words": words}})

    await visitor.tell({"attributes": {f"{name}-start": {"disabled": ""}}} if waits else {})
    try:
        words = await work(Wallet(visitor.waiting, visitor.tell, number), tell)
        await tell(words)
        await visitor.tell({"note": words})
    except DeclinedError:
        await tell("Cancelled")
    except ShackledError as error:
        await tell(f"{'Not minted' if name == 'mint' else 'Not revealed'}: {error}")
        raise
    finally:
        await visitor.tell({"attributes": {f"{name}-start": {"disabled": None}}})
