"""What a page shows already, so that only what changes is sent."""

from __future__ import annotations

from typing import Any

from ..controls import CONTROLS, MAX_LAMPS, Control, lamp_controls
from ..history import History
from ..orbit import lamp_camera, lamp_on_disc
from ..presets import PRESETS
from ..scene import Facts, filled
from ..state import Orbit, State

_AXES = {"x": 0, "y": 1, "z": 2}


class Shown:
    """The state of one page."""

    def __init__(self) -> None:
        """A page that shows nothing yet."""
        self.link = ""
        self._parts: dict[str, Any] = {}
        self._facts: Facts | None = None

    def changes(self, history: History, facts: Facts) -> dict[str, Any]:
        """The message that brings the page to the state of the history."""
        if facts is not self._facts:
            # which buttons are pressed does not depend on the object
            self._parts = {name: self._parts[name] for name in ("look", "piece") if name in self._parts}
            self._facts = facts
        state = history.state
        now, own = filled(state, facts), filled(State(state.source), facts)
        values: dict[str, Any] = {}
        for control in CONTROLS:
            self._value(values, control, state, now, own, facts)
        for number, _ in enumerate(now.lights or ()):
            for control in lamp_controls(number):
                self._value(values, control, state, now, own, facts)
        message: dict[str, Any] = {}
        if values:
            message["values"] = values
        camera = now.camera
        assert camera is not None
        size = now.size
        assert size is not None
        camera = lamp_camera(now, facts)
        seen = (now.lights, camera.azimuth, camera.elevation, camera.roll)
        if self._new("spheres", seen):
            message["spheres"] = _spheres(now, camera)
        if self._new("aspect", (size.width, size.height)):
            message["aspect"] = f"{size.width} / {size.height}"
        texts = {"title": facts.title, "notice": facts.notice}
        if self._new("texts", texts):
            message["texts"] = texts
        attributes = self._buttons(history, now)
        if attributes:
            message["attributes"] = attributes
        return message

    def _value(
        self, values: dict[str, Any], control: Control, state: State, now: State, own: State, facts: Facts
    ) -> None:
        path = control.path
        value = _at(now, path)
        # where objects differ, the value of the first, if it was chosen, is a change of the others
        mixed = path in facts.mixed and _at(state, path) is None
        try:
            changed = value != _at(own, path) or (path in facts.mixed and not mixed)
        except IndexError:  # a light more than the source has
            changed = False
        shown = {"value": _rounded(value, control), "changed": changed}
        if mixed:
            shown["mixed"] = True
        if self._new(path, shown):
            values[path] = shown

    def _buttons(self, history: History, now: State) -> dict[str, Any]:
        attributes: dict[str, Any] = {}
        state = history.state

        def allow(name: str, allowed: bool) -> None:
            if self._new(name, allowed):
                attributes[name] = {"disabled": None if allowed else ""}

        allow("undo", history.can_undo)
        allow("redo", history.can_redo)
        allow("add-lamp", len(now.lights or ()) < MAX_LAMPS)
        look, before = _look(state), self._parts.get("look")
        if look != before:
            self._parts["look"] = look
            for name, pressed in ((before, "false"), (look, "true")):
                if name:
                    attributes[f"look-{name}"] = {"aria-pressed": pressed}
        piece, old = state.source.name, self._parts.get("piece")
        if piece != old:
            self._parts["piece"] = piece
            for name, pressed in ((old, "false"), (piece, "true")):
                if name:
                    attributes[f"piece-{name}"] = {"aria-pressed": pressed}
        return attributes

    def _new(self, name: str, value: Any) -> bool:
        if name in self._parts and self._parts[name] == value:
            return False
        self._parts[name] = value
        return True


def _at(state: State, path: str) -> Any:
    value: Any = state
    for key in path.split("."):
        value = value[int(key)] if key.isdigit() else value[_AXES[key]] if key in _AXES else getattr(value, key)
    return value


def _rounded(value: Any, control: Control) -> Any:
    """Numbers with as many digits as there is room for; the state keeps them all."""
    return round(value, 1 if control.step >= 1 else 2) if isinstance(value, float) else value


def _spheres(now: State, camera: Orbit) -> list[dict[str, Any] | None]:
    spheres: list[dict[str, Any] | None] = [None] * MAX_LAMPS
    for number, lamp in enumerate(now.lights or ()):
        x, y, front = lamp_on_disc(lamp, camera)
        spheres[number] = {"x": round(x, 4), "y": round(y, 4), "front": front, "color": lamp.color}
    return spheres


def _look(state: State) -> str | None:
    """The look that the state is in, wherever its lights have been left."""
    mine = state.surface, state.background, bool(state.wireframe), bool(state.invert)
    return next((p.name for p in PRESETS if (p.surface, p.background, p.wireframe, p.invert) == mine), None)


def merged(first: dict[str, Any], second: dict[str, Any]) -> dict[str, Any]:
    """Two messages as one."""
    message = dict(first)
    for key, value in second.items():
        message[key] = {**message[key], **value} if isinstance(message.get(key), dict) else value
    return message
