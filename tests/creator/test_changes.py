"""Changing one control."""

from __future__ import annotations

from itertools import combinations
from typing import Any

import pytest

from shackled import InputError, load
from shackled.creator import (
    CONTROLS,
    Source,
    State,
    add_lamp,
    describe,
    direction,
    get_value,
    is_changed,
    lamp_controls,
    remove_lamp,
    reset_state,
    reset_value,
    set_value,
)

FACTS = describe(Source("piece", "teapot"), load("teapot", antialias=False), "Teapot")
PLAIN = State(FACTS.source)

OTHER: dict[str, Any] = {
    "camera.projection": "orthographic",
    "lights.0.kind": "point",
    "surface.shading": "flat",
    "surface.opacity": 0.5,
    "cull": False,
}


@pytest.mark.parametrize("control", [*CONTROLS, *lamp_controls(0)], ids=lambda control: control.path)
def test_each_control_can_be_changed_and_reset(control: Any) -> None:
    value = OTHER.get(
        control.path,
        {"switch": True, "color": "#123456", "number": min(control.high, 37)}[
            control.kind if control.kind != "choice" else "number"
        ],
    )
    state = set_value(PLAIN, FACTS, control.path, value)
    assert get_value(state, FACTS, control.path) == value
    assert is_changed(state, FACTS, control.path)
    assert not is_changed(PLAIN, FACTS, control.path)
    assert get_value(reset_value(state, FACTS, control.path), FACTS, control.path) == get_value(
        PLAIN, FACTS, control.path
    )
    assert reset_state(state, control.group) == PLAIN
    assert reset_state(state) == PLAIN
    others = [each.path for each in CONTROLS if each.path != control.path]
    assert not [path for path in others if get_value(state, FACTS, path) != get_value(PLAIN, FACTS, path)]


def test_where_objects_differ_the_value_of_the_first_is_a_change() -> None:
    facts = describe(Source("piece", "icons/coin"), load("icons/coin"), "Coin")
    plain = State(facts.source)
    assert not is_changed(plain, facts, "surface.shading")
    state = set_value(plain, facts, "surface.shading", get_value(plain, facts, "surface.shading"))
    assert is_changed(state, facts, "surface.shading")
    assert reset_value(state, facts, "surface.shading") == plain


def test_angles_go_round() -> None:
    state = set_value(PLAIN, FACTS, "camera.azimuth", 190)
    assert get_value(state, FACTS, "camera.azimuth") == -170
    assert get_value(set_value(PLAIN, FACTS, "pose.rotation.y", -540), FACTS, "pose.rotation.y") == -180


def test_numbers_keep_six_digits() -> None:
    assert get_value(set_value(PLAIN, FACTS, "pose.scale", 1 / 3), FACTS, "pose.scale") == 0.333333
    assert get_value(set_value(PLAIN, FACTS, "size.width", 99.7), FACTS, "size.width") == 100


def test_none_gives_the_own_colours_back() -> None:
    state = set_value(PLAIN, FACTS, "surface.color", "#ff0000")
    assert get_value(set_value(state, FACTS, "surface.color", None), FACTS, "surface.color") is None


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        ("camera.fov", 180, "the fov of the camera must be a number from 0.2 to 179.8, not 180"),
        ("camera.fov", "wide", "the fov of the camera must be a number from 0.2 to 179.8, not 'wide'"),
        ("camera.azimuth", float("inf"), "the azimuth of the camera must be a number"),
        ("pose.position.x", float("nan"), "the position of the object must be a number"),
        ("size.width", 1e30, "the width of the picture must be a whole number"),
        ("camera.roll", None, "the roll of the camera must be a number"),
        ("lights.3.color", "#ffffff", "there is no light 4; the picture has 1"),
    ],
)
def test_what_a_control_does_not_take(path: str, value: Any, message: str) -> None:
    with pytest.raises(InputError) as error:
        set_value(PLAIN, FACTS, path, value)
    assert message in str(error.value)


def test_lights_come_and_go() -> None:
    state = PLAIN
    for count in (2, 3, 4):
        state = add_lamp(state, FACTS)
        assert state.lights is not None
        assert len(state.lights) == count
    places = [direction(lamp.azimuth, lamp.elevation) for lamp in state.lights or ()]
    assert all(a @ b < 0.9 for a, b in combinations(places, 2))  # none stands where another is
    with pytest.raises(InputError, match="up to 4 lights"):
        add_lamp(state, FACTS)
    assert state.lights is not None
    kept = (*state.lights[:1], *state.lights[2:])
    assert remove_lamp(state, FACTS, 1).lights == kept
    with pytest.raises(InputError, match="there is no light 5"):
        remove_lamp(state, FACTS, 4)
    assert remove_lamp(PLAIN, FACTS, 0).lights == ()


def test_a_group_that_is_none() -> None:
    with pytest.raises(InputError, match="no group of controls 'engine'"):
        reset_state(PLAIN, "engine")
