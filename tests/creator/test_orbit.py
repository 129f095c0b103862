"""Dragging, zooming, panning, and lights on a sphere."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shackled import load, render
from shackled.creator import (
    Lamp,
    Orbit,
    Pose,
    Size,
    Source,
    State,
    describe,
    direction,
    drag,
    fit,
    front,
    lamp_camera,
    lamp_from_disc,
    lamp_on_disc,
    pan,
    to_scene,
    zoom,
)

ways = st.floats(-3, 3)


@given(ways, ways)
def test_a_drag_there_and_back(dx: float, dy: float) -> None:
    camera = Orbit(elevation=0)
    dy = max(-0.5, min(dy, 0.5))
    again = drag(drag(camera, dx, dy), -dx, -dy)
    assert math.isclose(math.cos(math.radians(again.azimuth - camera.azimuth)), 1, abs_tol=1e-6)
    assert math.isclose(again.elevation, camera.elevation, abs_tol=1e-3)


def test_the_object_follows_the_finger() -> None:
    assert drag(Orbit(azimuth=0), 0.25, 0).azimuth == -45  # to the right: its left side comes into view
    assert drag(Orbit(elevation=0), 0, 0.25).elevation == 45  # downward: its top comes into view
    assert drag(Orbit(elevation=80), 0, 1).elevation == 90
    assert drag(Orbit(azimuth=170), -0.25, 0).azimuth == -145
    rolled = drag(Orbit(azimuth=0, elevation=0, roll=90), 0.25, 0)
    assert rolled.azimuth == pytest.approx(0, abs=1e-9)
    assert abs(rolled.elevation) == pytest.approx(45)


@given(st.floats(-1000, 1000), st.floats(0.01, 1000))
def test_zoom_stays_in_its_range(notches: float, distance: float) -> None:
    assert 0.01 <= zoom(Orbit(distance=distance), notches).distance <= 1000


def test_zoom_there_and_back() -> None:
    camera = Orbit(distance=3)
    assert zoom(camera, 1).distance < 3 < zoom(camera, -1).distance
    assert zoom(zoom(camera, 5), -5).distance == pytest.approx(3, rel=1e-5)


def test_pan_moves_what_is_seen_as_far_as_the_finger() -> None:
    facts = describe(Source("piece", "icosphere"), load("icosphere"), "")
    state = State(facts.source, camera=fit(front(facts)), size=Size(64, 64))
    scene = load("icosphere")

    def middle(camera: Orbit) -> np.ndarray:
        pixels = render(to_scene(replace(state, camera=camera, lights=()), scene)).pixels
        lit = np.argwhere((pixels != pixels[:, :1]).any(axis=2))
        where: np.ndarray = lit.mean(axis=0)
        return where

    assert state.camera is not None
    camera = replace(state.camera, distance=12.0)
    rows, columns = middle(pan(camera, 0.25, 0.125)) - middle(camera)
    assert columns == pytest.approx(16, abs=1)
    assert rows == pytest.approx(8, abs=1)


@pytest.mark.parametrize("projection", ["perspective", "orthographic"])
@pytest.mark.parametrize("size", [Size(96, 96), Size(48, 96), Size(96, 48)])
def test_fit_fills_the_picture(projection: str, size: Size) -> None:
    scene = load("icosphere")
    facts = describe(Source("piece", "icosphere"), scene, "")
    pose = Pose((3, 1, 0), scale=2)
    camera = Orbit(projection=projection, azimuth=50, fov=30)  # type: ignore[arg-type]
    fitted = fit(camera, pose, size.width / size.height)
    state = State(facts.source, pose, fitted, lights=(), size=size)
    pixels = render(to_scene(state, scene)).pixels
    lit = np.argwhere((pixels != pixels[:, :1]).any(axis=2))
    margins = [*lit.min(axis=0), size.height - 1 - lit[:, 0].max(), size.width - 1 - lit[:, 1].max()]
    assert min(margins) >= 1
    assert min(margins) <= 0.08 * min(size.width, size.height)


@given(st.floats(-180, 180), st.floats(-90, 90), st.floats(-180, 180), st.floats(-89, 89), st.floats(-180, 180))
def test_a_lamp_on_the_disc_there_and_back(a: float, e: float, azimuth: float, elevation: float, roll: float) -> None:
    lamp, camera = Lamp(azimuth=a, elevation=e), Orbit(azimuth=azimuth, elevation=elevation, roll=roll)
    x, y, near = lamp_on_disc(lamp, camera)
    assert math.hypot(x, y) <= 1 + 1e-9
    length = math.hypot(x, y)
    beyond = 1 if near else (2 - length) / max(length, 1e-9)
    again = lamp_from_disc(lamp, camera, x * beyond, y * beyond)
    assert np.allclose(direction(again.azimuth, again.elevation), direction(a, e), atol=2e-3)


@pytest.mark.parametrize("follow", [False, True])
def test_a_lamp_lights_the_side_on_which_it_is_shown(follow: bool) -> None:
    scene = load("icosphere")
    facts = describe(Source("piece", "icosphere"), scene, "")
    camera = fit(Orbit(azimuth=-140, elevation=10, fov=20))
    state = State(facts.source, camera=camera, lights_follow=follow, size=Size(64, 64))
    lamp = lamp_from_disc(Lamp(), lamp_camera(state, facts), 0.8, 0.5)
    pixels = render(to_scene(replace(state, lights=(lamp,)), scene)).pixels.astype(int).sum(axis=2)
    ball = pixels[12:52, 12:52]
    assert ball[:, 20:].mean() > ball[:, :20].mean()
    assert ball[20:].mean() > ball[:20].mean()


def test_places_of_a_lamp() -> None:
    camera = Orbit(azimuth=0, elevation=0)
    assert lamp_on_disc(Lamp(azimuth=90, elevation=0), camera) == pytest.approx((1, 0, True), abs=1e-9)
    assert lamp_on_disc(Lamp(azimuth=0, elevation=60), camera)[1] == pytest.approx(-math.sin(math.radians(60)))
    assert not lamp_on_disc(Lamp(azimuth=180, elevation=0), camera)[2]


def test_a_lamp_goes_over_the_rim_to_the_far_side() -> None:
    camera = Orbit(azimuth=0, elevation=0)
    assert lamp_from_disc(Lamp(), camera, 1, 0).azimuth == pytest.approx(90)
    assert lamp_from_disc(Lamp(), camera, 1.5, 0).azimuth == pytest.approx(150)
    assert abs(lamp_from_disc(Lamp(), camera, 30, 0).azimuth) == pytest.approx(180)
