"""One value of a state, by the path of its control."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from ..errors import InputError
from .checking import tidy
from .controls import CONTROLS, MAX_LAMPS, Control, control
from .orbit import around, lamp_camera
from .scene import Facts, filled
from .state import Lamp, Pose, State, Surface
from .view import direction

_AXES = {"x": 0, "y": 1, "z": 2}

#: Where a new light may stand: degrees to the right of the viewer, and above the horizon; the first that is free.
_LAMP_PLACES = ((45.0, 30.0), (-45.0, 30.0), (0.0, 80.0), (180.0, 30.0), (90.0, -20.0))
#: The cosine of the angle, 35 degrees, that lights are apart at least.
_APART = 0.82


def get(state: State, facts: Facts, path: str) -> Any:
    """What a control shows: the value, or the source's own. None where that is a choice."""
    return _at(filled(state, facts), _keys(path))


def put(state: State, facts: Facts, path: str, value: Any) -> State:
    """The state with another value there. InputError if the control does not take it.

    Angles go round; numbers keep 6 digits. What belongs together, as all of the camera does, is taken from the source
    when one of it is changed first.
    """
    of, keys = control(path), _keys(path)
    value = _tidy(of, value)
    if len(keys) == 1:
        return replace(state, **{path: value})
    group = str(keys[0])
    part = getattr(state, group)
    if part is None:
        part = getattr(facts.defaults, group)
    return replace(state, **{group: _with(part, keys[1:], value)})


def is_changed(state: State, facts: Facts, path: str) -> bool:
    """Whether a control shows anything else than the source's own; any value does, where its objects differ."""
    if path in facts.mixed:
        return _at(state, _keys(path)) is not None
    return bool(get(state, facts, path) != get(State(state.source), facts, path))


def reset(state: State, group: str | None = None) -> State:
    """The state with a group of controls as the source has it, or with all."""
    plain = State(state.source)
    if group is None:
        return plain
    names = {_keys(each.path)[0] for each in CONTROLS if each.group == group} | ({"lights"} & {group})
    if not names:
        raise InputError(f"there is no group of controls {group!r}")
    return replace(state, **{str(name): getattr(plain, str(name)) for name in names})


def reset_one(state: State, facts: Facts, path: str) -> State:
    """The state with one control as the source has it."""
    keys = _keys(path)
    if len(keys) == 1:
        return replace(state, **{path: getattr(State(state.source), path)})
    if keys[0] == "surface":
        return replace(state, surface=replace(state.surface, **{str(keys[1]): getattr(Surface(), str(keys[1]))}))
    if keys[0] == "pose":
        return put(state, facts, path, _at(Pose(), keys[1:]))
    lamps = facts.defaults.lights or ()
    if keys[0] == "lights" and int(keys[1]) >= len(lamps):
        return put(state, facts, path, getattr(Lamp(), str(keys[2])))
    return put(state, facts, path, get(State(state.source), facts, path))


def add_lamp(state: State, facts: Facts) -> State:
    """One light more, where none is yet: beside the viewer, above, or behind. InputError if there are four."""
    lamps = filled(state, facts).lights or ()
    if len(lamps) >= MAX_LAMPS:
        raise InputError(f"a picture has up to {MAX_LAMPS} lights")
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
    """The state without one of its lights, counted from 0."""
    lamps = filled(state, facts).lights or ()
    if not 0 <= number < len(lamps):
        raise InputError(f"there is no light {number}; the picture has {len(lamps)}")
    return replace(state, lights=(*lamps[:number], *lamps[number + 1 :]))


def _tidy(of: Control, value: Any) -> Any:
    if of.kind != "number" or isinstance(value, bool) or not isinstance(value, int | float):
        return value
    if not abs(value) < 1e9:  # nor is it a number of any control
        return value
    if of.turn and abs(value) < 1e6:
        value = around(value)
    return round(value) if of.whole else tidy(value)


def _keys(path: str) -> tuple[str | int, ...]:
    keys: list[str | int] = []
    for key in path.split("."):
        keys.append(_AXES.get(key, int(key) if key.isdigit() else key))
    return tuple(keys)


def _with(part: Any, keys: tuple[str | int, ...], value: Any) -> Any:
    """A part of a state, in which what the keys lead to is another."""
    if not keys:
        return value
    key = keys[0]
    if isinstance(key, str):
        return replace(part, **{key: _with(getattr(part, key), keys[1:], value)})
    if key >= len(part):
        raise InputError(f"there is no number {key}; there are {len(part)}")
    return (*part[:key], _with(part[key], keys[1:], value), *part[key + 1 :])


def _at(part: Any, keys: tuple[str | int, ...]) -> Any:
    """What the keys lead to."""
    for key in keys:
        part = part[key] if isinstance(key, int) else getattr(part, key)
    return part
