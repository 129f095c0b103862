"""Changes of a state: one value by the path of its control, and undo and redo."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import replace
from typing import Any

from ..errors import InputError
from ..scene import MAX_LIGHTS
from ._controls import CONTROLS, Control, around, control, tidy
from ._orbit import lamp_camera
from ._scene import Facts, direction, filled
from ._state import Lamp, Pose, State, Surface

#: Number of steps that can be undone.
MAX_STEPS = 200
#: Places of new lights, in degrees to the right of the viewer and above the horizon; the first free one is taken.
_LAMP_PLACES = ((45.0, 30.0), (-45.0, 30.0), (0.0, 80.0), (180.0, 30.0), (90.0, -20.0))
#: Cosine of 35 degrees, the least angle between a new light and the others.
_APART = 0.82


def get_value(state: State, facts: Facts, path: str) -> Any:
    """Return the value that a control shows: the state's, or else the source's. None where that is allowed.

    InputError for a light that the picture does not have.
    """
    now, of = filled(state, facts), control(path)
    if of.keys[0] == "lights":
        _check_light(of.keys[1], now.lights or ())
    return at(now, of)


def at(state: State, of: Control) -> Any:
    """Return the value of a control in a state."""
    part: Any = state
    for key in of.keys:
        part = part[key] if isinstance(key, int) else getattr(part, key)
    return part


def set_value(state: State, facts: Facts, path: str, value: Any) -> State:
    """Return the state with another value. InputError if the control does not take it.

    Angles wrap around; numbers keep 6 digits. The first change of a part, such as the camera, takes the other values of
    this part from the source.
    """
    of = control(path)
    value = _tidy(of, value)
    if len(of.keys) == 1:
        return replace(state, **{path: value})
    group = str(of.keys[0])
    part = getattr(state, group)
    if part is None:
        part = getattr(facts.defaults, group)
    return replace(state, **{group: _with(part, of.keys[1:], value)})


def is_changed(state: State, facts: Facts, path: str) -> bool:
    """Return whether a control shows another value than the source's; any value does where the objects differ."""
    return differs(control(path), state, filled(state, facts), filled(State(state.source), facts), facts)


def differs(of: Control, state: State, now: State, own: State, facts: Facts) -> bool:
    """Do the same as `is_changed` with the filled state (now) and the filled state of the source (own)."""
    if of.path in facts.mixed:
        return at(state, of) is not None
    try:
        return bool(at(now, of) != at(own, of))
    except IndexError:  # a light that the source does not have
        return False


def reset_state(state: State, group: str | None = None) -> State:
    """Return the state with the source's values for all controls of a group, or for all controls."""
    plain = State(state.source)
    if group is None:
        return plain
    names = {each.keys[0] for each in CONTROLS if each.group == group} | ({"lights"} & {group})
    if not names:
        raise InputError(f"there is no group of controls {group!r}")
    return replace(state, **{str(name): getattr(plain, str(name)) for name in names})


def reset_value(state: State, facts: Facts, path: str) -> State:
    """Return the state with the source's value for one control."""
    of = control(path)
    plain = State(state.source)
    if len(of.keys) == 1:
        return replace(state, **{path: getattr(plain, path)})
    group, key = str(of.keys[0]), of.keys[1]
    if group == "opacities":
        return set_value(state, facts, path, None)
    if group == "surface":
        return replace(state, surface=replace(state.surface, **{str(key): getattr(Surface(), str(key))}))
    if group == "pose":
        return set_value(state, facts, path, at(replace(plain, pose=Pose()), of))
    if group == "lights" and int(key) >= len(facts.defaults.lights or ()):
        own = replace(plain, lights=(Lamp(),) * MAX_LIGHTS)
        return set_value(state, facts, path, at(own, of))
    return set_value(state, facts, path, get_value(plain, facts, path))


def add_lamp(state: State, facts: Facts) -> State:
    """Return the state with one more light, in a direction without one. InputError if there are four."""
    lamps = filled(state, facts).lights or ()
    if len(lamps) >= MAX_LIGHTS:
        raise InputError(f"a picture has up to {MAX_LIGHTS} lights")
    camera = lamp_camera(state, facts)
    there = [direction(lamp.azimuth, lamp.elevation) for lamp in lamps]

    def closeness(lamp: Lamp) -> float:
        return max((float(direction(lamp.azimuth, lamp.elevation) @ each) for each in there), default=-1.0)

    places = [
        Lamp(azimuth=round(around(camera.azimuth + side)), elevation=elevation) for side, elevation in _LAMP_PLACES
    ]
    free = [lamp for lamp in places if closeness(lamp) < _APART]
    return replace(state, lights=(*lamps, free[0] if free else min(places, key=closeness)))


def remove_lamp(state: State, facts: Facts, number: int) -> State:
    """Return the state without one of its lights. number: from 0."""
    lamps = filled(state, facts).lights or ()
    _check_light(number, lamps)
    return replace(state, lights=(*lamps[:number], *lamps[number + 1 :]))


def _check_light(number: Any, lamps: Sequence[Lamp]) -> None:
    if not 0 <= number < len(lamps):
        raise InputError(f"there is no light {number + 1}; the picture has {len(lamps)}")


def _tidy(of: Control, value: Any) -> Any:
    if of.kind != "number" or isinstance(value, bool) or not isinstance(value, int | float):
        return value
    if not abs(value) < 1e9:  # too large for every control, or not a number
        return value
    if of.turn and abs(value) < 1e6:
        value = around(value)
    return round(value) if of.whole else tidy(value)


def _with(part: Any, keys: tuple[str | int, ...], value: Any) -> Any:
    """Return a part of a state with another value at the end of the keys."""
    if not keys:
        return value
    key = keys[0]
    if isinstance(key, str):
        return replace(part, **{key: _with(getattr(part, key), keys[1:], value)})
    if key >= len(part):  # the other tuples have a fixed length
        _check_light(key, part)
    return (*part[:key], _with(part[key], keys[1:], value), *part[key + 1 :])


class History:
    """The states of a picture, for undo and redo. A drag is one step, however many states it went through."""

    def __init__(self, state: State) -> None:
        """Begin with a state."""
        self._past: list[State] = []
        self._future: list[State] = []
        self._merge: Hashable | None = None
        self.state = state

    def change(self, state: State, merge: Hashable | None = None) -> None:
        """Add a state, and drop the undone ones; an equal state adds nothing.

        Successive changes with the same `merge` are one step, until `settle`.
        """
        if state == self.state:
            return
        if merge is None or merge != self._merge:
            self._past = [*self._past, self.state][-MAX_STEPS:]
        self._merge = merge
        self._future = []
        self.state = state

    def settle(self) -> None:
        """End the step: the next change is another one."""
        self._merge = None

    def undo(self) -> State:
        """Go back one step, if there is one; return the state."""
        self.settle()
        if self._past:
            self._future.append(self.state)
            self.state = self._past.pop()
        return self.state

    def redo(self) -> State:
        """Go forward one step, if there is one; return the state."""
        self.settle()
        if self._future:
            self._past.append(self.state)
            self.state = self._future.pop()
        return self.state

    @property
    def can_undo(self) -> bool:
        """Whether there is a step back."""
        return bool(self._past)

    @property
    def can_redo(self) -> bool:
        """Whether there is an undone step."""
        return bool(self._future)
