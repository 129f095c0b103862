"""The actions of the messages of the page, by name. The messages are untrusted: each value is checked."""

from __future__ import annotations

import math
import random
from collections.abc import Awaitable, Callable
from dataclasses import replace
from functools import partial
from typing import Any

from ...errors import InputError, ShackledError
from .. import _history as history
from .. import _orbit as orbit
from .._controls import GROUPS, control
from .._presets import PRESETS, apply_look, preset
from .._scene import filled
from .._state import Backdrop, Size, Source
from . import dialogs
from .edition import parse_terms
from .mint import offer_of
from .reveal import parse_collection
from .visitor import Message, Visitor


async def act(visitor: Visitor, message: object) -> None:
    """Execute a message. A wrong message changes nothing; the visitor is shown the error."""
    if not isinstance(message, dict) or not isinstance(message.get("do"), str) or message["do"] not in ACTIONS:
        return
    try:
        await ACTIONS[message["do"]](visitor, message)
    except ShackledError as error:
        await visitor.tell({"alert": str(error)})
        await visitor.refresh()


def _number(message: Message, key: str, reach: float = 100.0) -> float:
    value = message.get(key)
    # integers can be larger than any float: they are clamped before they are converted
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


# ---- camera and lights ----


async def _drag(change: Callable[..., Any], visitor: Visitor, message: Message) -> None:
    camera = change(filled(visitor.state, visitor.facts).camera, _number(message, "x"), _number(message, "y"))
    visitor.change(replace(visitor.state, camera=camera), change.__name__)


async def _zoom(visitor: Visitor, message: Message) -> None:
    camera = filled(visitor.state, visitor.facts).camera
    assert camera is not None
    visitor.change(replace(visitor.state, camera=orbit.zoom(camera, _number(message, "notches"))), "zoom")


async def _camera(visitor: Visitor, message: Message) -> None:
    camera, target = filled(visitor.state, visitor.facts).camera, message.get("target")
    assert camera is not None
    if not isinstance(target, list) or len(target) != 3:
        raise InputError(f"target must be three numbers, not {target!r:.60}")
    x, y, z = (_number({"target": each}, "target", 1e6) for each in target)
    azimuth, elevation, distance = (_number(message, key, 1e6) for key in ("azimuth", "elevation", "distance"))
    visitor.stamp = int(_number(message, "stamp", 2**53))
    visitor.change(replace(visitor.state, camera=orbit.moved(camera, azimuth, elevation, distance, (x, y, z))))


async def _fit(visitor: Visitor, message: Message) -> None:
    now = filled(visitor.state, visitor.facts)
    size = now.size or Size()
    assert now.camera is not None
    camera = orbit.fit(now.camera, visitor.state.pose, size.width / size.height)
    visitor.change(replace(visitor.state, camera=camera))


async def _lamp(visitor: Visitor, message: Message) -> None:
    number = int(_number(message, "number"))
    lamps = filled(visitor.state, visitor.facts).lights or ()
    if not 0 <= number < len(lamps):
        raise InputError(f"there is no light {number + 1}")
    camera = orbit.lamp_camera(visitor.state, visitor.facts)
    moved = orbit.lamp_from_disc(lamps[number], camera, _number(message, "x"), _number(message, "y"))
    lights = (*lamps[:number], moved, *lamps[number + 1 :])
    visitor.change(replace(visitor.state, lights=lights), f"lights.{number}.sphere")


async def _add_lamp(visitor: Visitor, message: Message) -> None:
    visitor.change(history.add_lamp(visitor.state, visitor.facts))


async def _remove_lamp(visitor: Visitor, message: Message) -> None:
    visitor.change(history.remove_lamp(visitor.state, visitor.facts, int(_number(message, "number"))))


# ---- controls ----


async def _put(visitor: Visitor, message: Message) -> None:
    path = _path(message)
    value = message.get("value")
    of = control(path)
    if of.kind == "number" and isinstance(value, int | float) and not isinstance(value, bool) and not of.turn:
        asked, value = value, max(of.low, min(of.high, value))
        if value != asked:
            await visitor.tell({"note": f"{of.label} must be from {of.low:g} to {of.high:,g} {of.unit}".strip()})
    merge = path if of.kind in ("number", "color") else None
    visitor.change(history.set_value(visitor.state, visitor.facts, path, value), merge)


async def _cycle(visitor: Visitor, message: Message) -> None:
    path = _path(message)
    of, value = control(path), history.get_value(visitor.state, visitor.facts, path)
    if of.kind == "switch":
        following: Any = not value
    elif of.kind == "choice":
        values = [each for each, _ in of.choices]
        following = values[(values.index(value) + 1) % len(values)]
    else:
        raise InputError(f"{path} is neither a switch nor a choice")
    visitor.change(history.set_value(visitor.state, visitor.facts, path, following))


async def _reset(visitor: Visitor, message: Message) -> None:
    visitor.change(history.reset_value(visitor.state, visitor.facts, _path(message)))


async def _reset_group(visitor: Visitor, message: Message) -> None:
    group = _text(message, "group")
    if group not in {key for key, _ in GROUPS}:
        raise InputError(f"there is no group of controls {group!r}")
    visitor.change(history.reset_state(visitor.state, group))


async def _reset_all(visitor: Visitor, message: Message) -> None:
    visitor.change(history.reset_state(visitor.state))


async def _size(visitor: Visitor, message: Message) -> None:
    side = int(_number(message, "side", 1024))
    visitor.change(replace(visitor.state, size=Size(side, side)))


async def _one_color(visitor: Visitor, message: Message) -> None:
    background = filled(visitor.state, visitor.facts).background or Backdrop()
    visitor.change(replace(visitor.state, background=Backdrop(background.top, background.top)))


async def _look(visitor: Visitor, message: Message) -> None:
    name = _text(message, "name")
    look = preset(name)
    if look is None:
        raise InputError(f"there is no look {name!r}")
    visitor.change(apply_look(look, visitor.state, visitor.facts))


async def _next_look(visitor: Visitor, message: Message) -> None:
    looks = [apply_look(look, visitor.state, visitor.facts) for look in PRESETS]
    at = looks.index(visitor.state) if visitor.state in looks else -1
    visitor.change(looks[(at + 1) % len(looks)])


async def _rest(visitor: Visitor, message: Message) -> None:
    visitor.rest()


# ---- objects and history ----


async def _piece(visitor: Visitor, message: Message) -> None:
    await visitor.open(Source("piece", _text(message, "name")))


async def _seed(visitor: Visitor, message: Message) -> None:
    from ...datasets.genesis import parse_seed

    text = _text(message, "text").strip()
    parse_seed(text)  # raises the error
    await visitor.open(Source("piece", f"genesis/{text.lower().removeprefix('0x')}"))


async def _any_genesis(visitor: Visitor, message: Message) -> None:
    from ...datasets.genesis import COUNT

    await visitor.open(Source("piece", f"genesis/{random.randrange(COUNT)}"))


async def _undo(visitor: Visitor, message: Message) -> None:
    try:
        await visitor.go(visitor.history.undo())
    except ShackledError:  # the upload of that state is not in memory any more
        visitor.history.redo()
        raise


async def _redo(visitor: Visitor, message: Message) -> None:
    try:
        await visitor.go(visitor.history.redo())
    except ShackledError:
        visitor.history.undo()
        raise


# ---- dialogs ----


async def _takeaway(visitor: Visitor, message: Message) -> None:
    visitor.job("takeaway", lambda: dialogs.takeaway(visitor))


async def _stages(visitor: Visitor, message: Message) -> None:
    visitor.job("stages", lambda: dialogs.stages(visitor))


async def _node(visitor: Visitor, message: Message) -> None:
    visitor.job("node", lambda: dialogs.compare(visitor))


async def _gif(visitor: Visitor, message: Message) -> None:
    frames = max(4, min(120, int(_number(message, "frames", 120))))
    scale = max(1, min(8, int(_number(message, "scale"))))
    visitor.job("gif", lambda: dialogs.turntable(visitor, frames, scale))


async def _stop_gif(visitor: Visitor, message: Message) -> None:
    visitor.stop("gif")


async def _wallets(visitor: Visitor, message: Message) -> None:
    names = message.get("names")
    if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
        raise InputError("the names of wallets must be a list of texts")
    visitor.wallets = [name[:40] for name in names[:8]]
    await dialogs.show_offer(visitor)
    await dialogs.show_reveal(visitor)


async def _answer(visitor: Visitor, message: Message) -> None:
    answer = (message.get(key) for key in ("id", "result", "error", "code"))
    visitor.waiting.answer(*answer)


async def _mint(visitor: Visitor, message: Message) -> None:
    offer, number = offer_of(visitor.state.source), _wallet(visitor, message)
    if offer is None:
        raise InputError("there is nothing to mint")
    _check_not_at(visitor, "mint", "a token is being minted")
    visitor.job("mint", lambda: dialogs.mint_token(visitor, offer, number))


async def _edition(visitor: Visitor, message: Message) -> None:
    number, terms = _wallet(visitor, message), parse_terms(message.get("fields"), visitor.state.source)
    _check_not_at(visitor, "mint", "a token is being minted")
    visitor.job("mint", lambda: dialogs.make_edition(visitor, terms, number))


async def _reveal_open(visitor: Visitor, message: Message) -> None:
    await visitor.tell({"open": "reveal"})


async def _reveal(visitor: Visitor, message: Message) -> None:
    number, collection = _wallet(visitor, message), parse_collection(message.get("fields"))
    _check_not_at(visitor, "reveal-send", "tokens are being revealed")
    visitor.collection = collection
    # it may wait for a block: another search replaces it
    visitor.job("reveal", lambda: dialogs.find_tokens(visitor, collection, number))


async def _reveal_send(visitor: Visitor, message: Message) -> None:
    reveal = visitor.reveal
    if reveal is None:
        raise InputError("there is no transaction to send: look for tokens to reveal first")
    _check_not_at(visitor, "reveal-send", "tokens are being revealed")
    visitor.job("reveal-send", lambda: dialogs.reveal_tokens(visitor, reveal))


def _wallet(visitor: Visitor, message: Message) -> int:
    """Return the place in the list of the wallet that a message names."""
    number = int(_number(message, "wallet"))
    if not 0 <= number < len(visitor.wallets):
        raise InputError("there is no such wallet")
    return number


def _check_not_at(visitor: Visitor, job: str, what: str) -> None:
    if visitor.is_at(job):
        raise InputError(f"{what}: answer in your wallet, or wait until it is done")


ACTIONS: dict[str, Callable[[Visitor, Message], Awaitable[None]]] = {
    "orbit": partial(_drag, orbit.drag),
    "pan": partial(_drag, orbit.pan),
    "zoom": _zoom,
    "camera": _camera,
    "fit": _fit,
    "lamp": _lamp,
    "add-lamp": _add_lamp,
    "remove-lamp": _remove_lamp,
    "put": _put,
    "cycle": _cycle,
    "reset": _reset,
    "reset-group": _reset_group,
    "reset-all": _reset_all,
    "size": _size,
    "one-color": _one_color,
    "look": _look,
    "next-look": _next_look,
    "rest": _rest,
    "piece": _piece,
    "seed": _seed,
    "any-genesis": _any_genesis,
    "undo": _undo,
    "redo": _redo,
    "takeaway": _takeaway,
    "stages": _stages,
    "node": _node,
    "gif": _gif,
    "stop-gif": _stop_gif,
    "wallets": _wallets,
    "answer": _answer,
    "mint": _mint,
    "edition": _edition,
    "reveal-open": _reveal_open,
    "reveal": _reveal,
    "reveal-send": _reveal_send,
}
