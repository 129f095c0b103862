"""The messages to a page: all that has changed since the last one, and the figures below the picture."""

from __future__ import annotations

from typing import Any

from ...gas import headline
from ...scene import MAX_LIGHTS
from .._controls import CONTROLS, MAX_OPACITIES, Control, lamp_controls
from .._history import History, at, differs
from .._orbit import lamp_camera, lamp_on_disc
from .._picture import Frame
from .._presets import PRESETS
from .._scene import Facts, filled
from .._state import Orbit, State

_NOTHING = "the object is out of view"


class Shown:
    """The values that one page shows already."""

    def __init__(self) -> None:
        """Begin with a page that shows nothing yet."""
        self.link = ""
        self._parts: dict[str, Any] = {}
        self._facts: Facts | None = None

    def changes(self, history: History, facts: Facts) -> dict[str, Any]:
        """Return the message that brings the page to the current state. It is empty if nothing has changed."""
        if facts is not self._facts:
            # the pressed buttons do not depend on the object
            self._parts = {name: self._parts[name] for name in ("look", "piece") if name in self._parts}
            self._facts = facts
        state = history.state
        now, own = filled(state, facts), filled(State(state.source), facts)
        values: dict[str, Any] = {}
        lamps = [of for number, _ in enumerate(now.lights or ()) for of in lamp_controls(number)]
        for of in (*CONTROLS, *lamps):
            value = {"value": _rounded(at(now, of), of), "changed": differs(of, state, now, own, facts)}
            if of.path in facts.mixed and not value["changed"]:
                value["mixed"] = True
            if self._is_new(of.path, value):
                values[of.path] = value
        message: dict[str, Any] = {"values": values} if values else {}
        camera = lamp_camera(now, facts)
        if self._is_new("spheres", (now.lights, camera.azimuth, camera.elevation, camera.roll)):
            message["spheres"] = _spheres(now, camera)
        assert now.size is not None
        if self._is_new("aspect", now.size):
            message["aspect"] = f"{now.size.width} / {now.size.height}"
        texts = {"title": facts.title, "notice": facts.notice}
        if self._is_new("texts", texts):
            message["texts"] = texts
        attributes = self._buttons(history, now)
        if self._is_new("objects", facts.objects):
            for number in range(MAX_OPACITIES):
                shown = 1 < facts.objects <= MAX_OPACITIES and number < facts.objects
                attributes[f"opacities.{number}"] = {"hidden": None if shown else ""}
        if attributes:
            message["attributes"] = attributes
        return message

    def _buttons(self, history: History, now: State) -> dict[str, Any]:
        attributes: dict[str, Any] = {}
        for name, allowed in (
            ("undo", history.can_undo),
            ("redo", history.can_redo),
            ("add-lamp", len(now.lights or ()) < MAX_LIGHTS),
        ):
            if self._is_new(name, allowed):
                attributes[name] = {"disabled": None if allowed else ""}
        for kind, pressed in (("look", _look(history.state)), ("piece", history.state.source.name)):
            before = self._parts.get(kind)
            if self._is_new(kind, pressed):
                for each in filter(None, (before, pressed)):
                    attributes[f"{kind}-{each}"] = {"aria-pressed": "true" if each == pressed else "false"}
        return attributes

    def _is_new(self, name: str, value: Any) -> bool:
        if name in self._parts and self._parts[name] == value:
            return False
        self._parts[name] = value
        return True


def figures(frame: Frame, facts: Facts, draft: bool) -> dict[str, Any]:
    """Return the message with the figures of a picture. draft: whether it is smaller than the requested picture."""
    gas = "not counted" if frame.gas is None else f"{frame.gas:,}"
    size = f"{frame.width} x {frame.height}"
    texts = {"gas": gas, "gas-label": f"Gas, at {size}" if draft else "Gas"}
    if draft:
        return {"texts": texts}
    fits = headline(frame.fits) if frame.fits else "gas is not counted here"
    hint = "" if frame.triangles != 0 else f" · {_NOTHING}: press F to fit it"
    texts |= {
        "triangles": "" if frame.triangles is None else f"{frame.triangles:,}",
        "triangles-label": f"Triangles drawn, of {facts.triangles:,}",
        "bytes": f"{frame.calldata_bytes:,}",
        "fits": fits[0].upper() + fits[1:],
        "size": f"{size} pixels · {frame.seconds * 1000:.0f} ms in the EVM{hint}",
    }
    drawn = (
        "" if frame.triangles is None else f"{frame.triangles:,} triangles, " if frame.triangles else f"{_NOTHING}, "
    )
    return {
        "texts": texts,
        "attributes": {
            **{name: {"data-place": place(frame)} for name in ("figures", "strip")},
            "picture": {"aria-label": f"{facts.title}, {size} pixels, rendered by the contract"},
        },
        "say": f"{facts.title}: {gas} gas, {drawn}{fits}",
    }


def place(frame: Frame) -> str:
    """Return the most demanding place where the picture fits: "transaction", "call" or "none"."""
    kinds = {fit.limit.kind for fit in frame.fits if fit.fits}
    transactions = [fit for fit in frame.fits if fit.limit.kind == "transaction"]
    if transactions and all(fit.fits for fit in transactions):
        return "transaction"
    return "call" if "call" in kinds else "none"


def merged(first: dict[str, Any], second: dict[str, Any]) -> dict[str, Any]:
    """Return two messages as one."""
    message = dict(first)
    for key, value in second.items():
        message[key] = {**message[key], **value} if isinstance(message.get(key), dict) else value
    return message


def _rounded(value: Any, of: Control) -> Any:
    """Return a number with the digits for which there is room; the state keeps all."""
    return round(value, 1 if of.step >= 1 else 2) if isinstance(value, float) else value


def _spheres(now: State, camera: Orbit) -> list[dict[str, Any] | None]:
    spheres: list[dict[str, Any] | None] = [None] * MAX_LIGHTS
    for number, lamp in enumerate(now.lights or ()):
        x, y, front = lamp_on_disc(lamp, camera)
        spheres[number] = {"x": round(x, 4), "y": round(y, 4), "front": front, "color": lamp.color}
    return spheres


def _look(state: State) -> str | None:
    """Return the name of the look of a state, whatever its lights."""
    mine = state.surface, state.background, bool(state.wireframe), bool(state.invert)
    return next((p.name for p in PRESETS if (p.surface, p.background, p.wireframe, p.invert) == mine), None)
