"""What the messages of the page do, by name. They come from strangers: each value is checked."""

from __future__ import annotations

import asyncio
import math
import random
from collections.abc import Awaitable, Callable
from dataclasses import replace
from typing import Any

from ...errors import InputError, ShackledError
from .. import change, orbit
from ..controls import GROUPS, control
from ..presets import PRESETS, apply, preset
from ..scene import filled
from ..state import Backdrop, Size, Source
from .mint import Offer, mint, offer_of
from .visitor import Message, Visitor
from .waiting import DeclinedError
from .wallet import Wallet


async def act(visitor: Visitor, message: object) -> None:
    """Does what a message says. What is wrong with it is told to the visitor, and changes nothing."""
    if not isinstance(message, dict) or not isinstance(message.get("do"), str) or message["do"] not in ACTIONS:
        return
    try:
        await ACTIONS[message["do"]](visitor, message)
    except ShackledError as error:
        await visitor.tell({"alert": str(error)})
        await visitor.refresh()


def _number(message: Message, key: str, reach: float = 100.0) -> float:
    value = message.get(key)
    # whole numbers may have more digits than any float: they are compared before they become one
    if isinstance(value, bool) or not isinstance(value, int | float) or not -math.inf < value < math.inf:
        raise InputError(f"{key} must be a number, not {value!r:.60}")
    return float(max(-reach, min(reach, value)))


def _text(message: Message, key: str) -> str:
    value = message.get(key)
    if not isinstance(value, str) or len(value) > 200:
        raise InputError(f"{key} must be a short text, not {value!r:.60}")
    return value


def _path(message: Message) -> str:
    path = _text(message, "path")
    try:
        control(path)
    except KeyError:
        raise InputError(f"there is no control {path!r}") from None
    return path


def _camera(visitor: Visitor) -> Any:
    return filled(visitor.state, visitor.facts).camera


async def _orbit(visitor: Visitor, message: Message) -> None:
    camera = orbit.drag(_camera(visitor), _number(message, "x"), _number(message, "y"))
    visitor.change(replace(visitor.state, camera=camera), "orbit")


async def _pan(visitor: Visitor, message: Message) -> None:
    camera = orbit.pan(_camera(visitor), _number(message, "x"), _number(message, "y"))
    visitor.change(replace(visitor.state, camera=camera), "pan")


async def _zoom(visitor: Visitor, message: Message) -> None:
    camera = orbit.zoom(_camera(visitor), _number(message, "notches"))
    visitor.change(replace(visitor.state, camera=camera), "zoom")


async def _fit(visitor: Visitor, message: Message) -> None:
    size = filled(visitor.state, visitor.facts).size or Size()
    camera = orbit.fit(_camera(visitor), visitor.state.pose, size.width / size.height)
    visitor.change(replace(visitor.state, camera=camera))


async def _put(visitor: Visitor, message: Message) -> None:
    path = _path(message)
    value = message.get("value")
    of = control(path)
    if of.kind == "number" and isinstance(value, int | float) and not isinstance(value, bool) and not of.turn:
        asked, value = value, max(of.low, min(of.high, value))
        if value != asked:
            await visitor.tell({"note": f"{of.label} goes from {of.low:g} to {of.high:,g} {of.unit}".strip()})
    merge = path if of.kind in ("number", "color") else None
    visitor.change(change.put(visitor.state, visitor.facts, path, value), merge)


async def _lamp(visitor: Visitor, message: Message) -> None:
    number = int(_number(message, "number"))
    lamps = filled(visitor.state, visitor.facts).lights or ()
    if not 0 <= number < len(lamps):
        raise InputError(f"there is no light {number + 1}")
    camera = orbit.lamp_camera(visitor.state, visitor.facts)
    moved = orbit.lamp_from_disc(lamps[number], camera, _number(message, "x"), _number(message, "y"))
    visitor.change(
        replace(visitor.state, lights=(*lamps[:number], moved, *lamps[number + 1 :])), f"lights.{number}.sphere"
    )


async def _add_lamp(visitor: Visitor, message: Message) -> None:
    visitor.change(change.add_lamp(visitor.state, visitor.facts))


async def _remove_lamp(visitor: Visitor, message: Message) -> None:
    visitor.change(change.remove_lamp(visitor.state, visitor.facts, int(_number(message, "number"))))


async def _reset(visitor: Visitor, message: Message) -> None:
    visitor.change(change.reset_one(visitor.state, visitor.facts, _path(message)))


async def _reset_group(visitor: Visitor, message: Message) -> None:
    group = _text(message, "group")
    if group not in {key for key, _ in GROUPS}:
        raise InputError(f"there is no group of controls {group!r}")
    visitor.change(change.reset(visitor.state, group))


async def _reset_all(visitor: Visitor, message: Message) -> None:
    visitor.change(change.reset(visitor.state))


async def _size(visitor: Visitor, message: Message) -> None:
    side = int(_number(message, "side", 1024))
    visitor.change(replace(visitor.state, size=Size(side, side)))


async def _one_color(visitor: Visitor, message: Message) -> None:
    background = filled(visitor.state, visitor.facts).background or Backdrop()
    visitor.change(replace(visitor.state, background=Backdrop(background.top, background.top)))


async def _cycle(visitor: Visitor, message: Message) -> None:
    path = _path(message)
    of, value = control(path), change.get(visitor.state, visitor.facts, path)
    if of.kind == "switch":
        following: Any = not value
    elif of.kind != "choice":
        raise InputError(f"{path} is not one of a few")
    else:
        values = [each for each, _ in of.choices]
        following = values[(values.index(value) + 1) % len(values)]
    visitor.change(change.put(visitor.state, visitor.facts, path, following))


async def _look(visitor: Visitor, message: Message) -> None:
    name = _text(message, "name")
    look = preset(name)
    if look is None:
        raise InputError(f"there is no look {name!r}")
    visitor.change(apply(look, visitor.state, visitor.facts))


async def _next_look(visitor: Visitor, message: Message) -> None:
    looks = [apply(look, visitor.state, visitor.facts) for look in PRESETS]
    at = looks.index(visitor.state) if visitor.state in looks else -1
    visitor.change(looks[(at + 1) % len(looks)])


async def _piece(visitor: Visitor, message: Message) -> None:
    await visitor.open(Source("piece", _text(message, "name")))


async def _seed(visitor: Visitor, message: Message) -> None:
    from ...datasets.genesis import parse_seed

    text = _text(message, "text").strip()
    parse_seed(text)  # which says what is wrong
    await visitor.open(Source("piece", f"genesis/{text.lower().removeprefix('0x')}"))


async def _any_genesis(visitor: Visitor, message: Message) -> None:
    from ...datasets.genesis import COUNT

    await visitor.open(Source("piece", f"genesis/{random.randrange(COUNT)}"))


async def _undo(visitor: Visitor, message: Message) -> None:
    try:
        await visitor.go(visitor.history.undo())
    except ShackledError:  # what was drawn then is not here any more
        visitor.history.redo()
        raise


async def _redo(visitor: Visitor, message: Message) -> None:
    try:
        await visitor.go(visitor.history.redo())
    except ShackledError:
        visitor.history.undo()
        raise


async def _rest(visitor: Visitor, message: Message) -> None:
    visitor.rest()


async def _gif(visitor: Visitor, message: Message) -> None:
    frames = max(4, min(120, int(_number(message, "frames", 120))))
    scale = max(1, min(8, int(_number(message, "scale"))))
    visitor.job("gif", lambda: _turn(visitor, frames, scale))


async def _turn(visitor: Visitor, frames: int, scale: int) -> None:
    def progress(done: int, total: int) -> Message:
        bar = {"value": str(done), "max": str(total)}
        return {"attributes": {"gif-bar": bar}, "texts": {"gif-words": f"{done} of {total} pictures"}}

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


async def _stop_gif(visitor: Visitor, message: Message) -> None:
    visitor.stop("gif")


async def _stages(visitor: Visitor, message: Message) -> None:
    if (screen := visitor.screen) is not None:
        visitor.job("stages", lambda: screen.stages(visitor))


async def _takeaway(visitor: Visitor, message: Message) -> None:
    if (screen := visitor.screen) is not None:
        visitor.job("takeaway", lambda: screen.takeaway(visitor))


async def _node(visitor: Visitor, message: Message) -> None:
    if (screen := visitor.screen) is not None:
        visitor.job("node", lambda: screen.node(visitor))


async def _wallets(visitor: Visitor, message: Message) -> None:
    names = message.get("names")
    if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
        raise InputError("the names of wallets must be a list of texts")
    visitor.wallets = [name[:40] for name in names[:8]]
    if visitor.screen is not None:
        visitor.screen.wallets(visitor)


async def _answer(visitor: Visitor, message: Message) -> None:
    answer = (message.get(key) for key in ("id", "result", "error", "code"))
    visitor.waiting.answer(*answer)


async def _mint(visitor: Visitor, message: Message) -> None:
    offer, number = offer_of(visitor.state.source), int(_number(message, "wallet"))
    if offer is None or not 0 <= number < len(visitor.wallets):
        raise InputError("there is nothing to mint, or no such wallet")
    if visitor.is_at("mint"):
        raise InputError("a token is being minted: answer in your wallet, or wait until it is done")
    visitor.job("mint", lambda: _minting(visitor, offer, Wallet(visitor, number)))


async def _minting(visitor: Visitor, offer: Offer, wallet: Wallet) -> None:
    async def tell(words: str) -> None:
        visitor.minting = words
        await visitor.tell({"texts": {"mint-words": words}})

    await visitor.tell({"attributes": {"mint-start": {"disabled": ""}}})
    try:
        words = await mint(offer, wallet, tell)
        await tell(words)
        await visitor.tell({"note": words})
    except DeclinedError:
        await tell("Cancelled")
    except ShackledError as error:
        await tell(f"Not minted: {error}")
        raise
    finally:
        await visitor.tell({"attributes": {"mint-start": {"disabled": None}}})


ACTIONS: dict[str, Callable[[Visitor, Message], Awaitable[None]]] = {
    "orbit": _orbit,
    "pan": _pan,
    "zoom": _zoom,
    "fit": _fit,
    "put": _put,
    "lamp": _lamp,
    "add-lamp": _add_lamp,
    "remove-lamp": _remove_lamp,
    "reset": _reset,
    "reset-group": _reset_group,
    "reset-all": _reset_all,
    "size": _size,
    "one-color": _one_color,
    "cycle": _cycle,
    "look": _look,
    "next-look": _next_look,
    "piece": _piece,
    "seed": _seed,
    "any-genesis": _any_genesis,
    "undo": _undo,
    "redo": _redo,
    "rest": _rest,
    "gif": _gif,
    "stop-gif": _stop_gif,
    "stages": _stages,
    "takeaway": _takeaway,
    "node": _node,
    "wallets": _wallets,
    "answer": _answer,
    "mint": _mint,
}
