"""The state of a picture, as a value and as JSON."""

from __future__ import annotations

import json
from typing import Any

import pytest
from hypothesis import given

from shackled import InputError
from shackled.creator import (
    CONTROLS,
    GROUPS,
    Backdrop,
    Curve,
    Haze,
    Lamp,
    Orbit,
    Outline,
    Pose,
    Size,
    Sky,
    Source,
    State,
    Surface,
    control,
    from_document,
    lamp_controls,
    to_document,
)
from states import states

TEAPOT = Source("piece", "teapot")


@given(states())
def test_json_holds_all_of_a_state(state: State) -> None:
    assert from_document(json.loads(json.dumps(to_document(state)))) == state


def test_what_nobody_touched_is_not_written() -> None:
    assert to_document(State(TEAPOT)) == {"source": {"kind": "piece", "name": "teapot"}}


def test_values_are_of_one_form() -> None:
    pose = Pose([1, 2, 3], (0, -0.0, 0), 2)  # type: ignore[arg-type]
    assert pose == Pose((1.0, 2.0, 3.0), (0.0, 0.0, 0.0), 2.0)
    assert str(pose.rotation) == "(0.0, 0.0, 0.0)"
    assert Backdrop("#ABCDEF").top == "#abcdef"
    assert Size(64.0, 32).width == 64  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Orbit(fov=200), "the fov of the camera must be a number from 0.2 to 179.8, not 200"),
        (
            lambda: Orbit(distance=float("nan")),
            "the distance of the camera must be a number from 0.01 to 1000, not nan",
        ),
        (lambda: Orbit(distance=10**400), "the distance of the camera must be a number from 0.01 to 1000, not 1000"),
        (lambda: Orbit(azimuth=True), "the azimuth of the camera must be a number from -180 to 180, not True"),
        (lambda: Orbit(projection="round"), "the projection of the camera must be one of perspective, orthographic"),  # type: ignore[arg-type]
        (lambda: Orbit(target=(1, 2)), "the target of the camera must be 3 numbers, not (1, 2)"),  # type: ignore[arg-type]
        (lambda: Pose(scale=0), "the scale of the object must be a number from 0.01 to 100, not 0"),
        (lambda: Lamp(color="red"), "the color of the light must be a colour #rrggbb, not 'red'"),
        (lambda: Lamp(color="#gg0000"), "the color of the light must be red, green and blue"),
        (lambda: Lamp(kind=["point"]), "the kind of the light must be one of directional, point, spot, not ['point']"),  # type: ignore[arg-type]
        (lambda: Surface(shininess=1.5), "the shininess of the material must be a whole number from 1 to 128, not 1.5"),  # type: ignore[arg-type]
        (lambda: Size(0, 10), "the width of the picture must be a whole number from 1 to 1024, not 0"),
        (lambda: Source("piece", "../etc/passwd"), "the name of a source must be the name of a piece such as teapot"),
        (lambda: Source("upload", "abc"), "the name of a source must be 64 hexadecimal digits, not 'abc'"),
        (lambda: Source("file", "abc"), "the kind of a source must be one of piece, upload"),  # type: ignore[arg-type]
        (lambda: State(TEAPOT, lights=(Lamp(),) * 5), "a picture has up to 4 lights, not 5"),
        (lambda: State(TEAPOT, opacities=(1,)), "opacities must be 8 numbers or null, not (1,)"),
        (lambda: State(TEAPOT, opacities=(2,) * 8), "opacities[0] must be a number from 0 to 1, not 2"),
        (lambda: State(TEAPOT, cull=1), "cull must be true or false, not 1"),  # type: ignore[arg-type]
        (lambda: State(TEAPOT, max_triangles=3), "max_triangles must be a whole number from 4 to 65535, not 3"),
    ],
)
def test_what_is_wrong_is_named(make: Any, message: str) -> None:
    with pytest.raises(InputError) as error:
        make()
    assert message in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("document", "message"),
    [
        ([], "the state must be a table, not []"),
        ({}, "the state must have a source"),
        ({"sauce": 1}, "the state has an unknown key 'sauce'; known are source, pose, camera"),
        ({"source": {"kind": "piece"}}, "source must have a kind and a name"),
        ({"source": {"kind": "piece", "name": 7}}, "the name of a source must be the name of a piece"),
        ({"source": {"kind": "piece", "name": "teapot"}, "camera": None}, "camera must be a table, not None"),
        ({"source": {"kind": "piece", "name": "teapot"}, "camera": {"up": 1}}, "camera has an unknown key 'up'"),
        ({"source": {"kind": "piece", "name": "teapot"}, "lights": 4}, "lights must be a list, not 4"),
        ({"source": {"kind": "piece", "name": "teapot"}, "lights": [4]}, "lights[0] must be a table, not 4"),
        ({"source": {"kind": "piece", "name": "teapot"}, "lights": [{}] * 9}, "a picture has up to 4 lights"),
        ({"source": {"kind": "piece", "name": "teapot"}, "wireframe": "yes"}, "wireframe must be true or false"),
    ],
)
def test_a_wrong_document_is_refused(document: object, message: str) -> None:
    with pytest.raises(InputError) as error:
        from_document(document)
    assert message in str(error.value)


def test_each_field_has_a_control() -> None:
    fields = {
        "pose": Pose,
        "camera": Orbit,
        "hemisphere": Sky,
        "rim": Outline,
        "fog": Haze,
        "tone": Curve,
        "surface": Surface,
        "background": Backdrop,
        "size": Size,
    }

    def paths_of(part: str, value: object) -> list[str]:
        return [
            f"{part}.{name}{axis}"
            for name, each in vars(value).items()
            for axis in ((".x", ".y", ".z") if isinstance(each, tuple) else ("",))
        ]

    for part, kind in fields.items():
        assert all(control(path).path == path for path in paths_of(part, kind()))
    assert [each.path for each in lamp_controls(3)] == paths_of("lights.3", Lamp())
    assert {each.group for each in CONTROLS} == {key for key, _ in GROUPS}
    assert all(each.label and each.low < each.high for each in CONTROLS)
