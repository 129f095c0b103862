"""The looks."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from attrs import evolve

from shackled import load, render
from shackled.creator import (
    PRESETS,
    Size,
    Source,
    State,
    apply_look,
    describe,
    from_link,
    preset,
    set_value,
    to_link,
    to_scene,
)

SCENE = load("teapot")
FACTS = describe(Source("piece", "teapot"), SCENE, "Teapot")
STATE = State(FACTS.source, size=Size(48, 48))


def picture(state: State) -> np.ndarray:
    pixels: np.ndarray = render(to_scene(state, SCENE, FACTS.bounds)).pixels
    return pixels


def test_looks_differ_and_show_the_object() -> None:
    pictures = [picture(apply_look(look, STATE, FACTS)) for look in PRESETS]
    for one, other in combinations(pictures, 2):
        assert np.abs(one.astype(int) - other).mean() > 4
    for pixels, look in zip(pictures, PRESETS, strict=True):
        on_object = pixels[20:28, 20:28].astype(int)
        background = pixels[2:4, 2:4].astype(int).mean(axis=(0, 1))
        assert np.abs(on_object - background).max() > 60, look.name


def test_names_are_unique() -> None:
    assert len({look.name for look in PRESETS}) == len(PRESETS) >= 8
    assert all(preset(look.name) is look for look in PRESETS)
    assert preset("mud") is None


@pytest.mark.parametrize("look", PRESETS, ids=lambda look: look.name)
def test_a_look_leaves_object_camera_and_size(look: object) -> None:
    state = set_value(STATE, FACTS, "camera.azimuth", 100)
    state = set_value(state, FACTS, "pose.scale", 1.5)
    dressed = apply_look(look, state, FACTS)  # type: ignore[arg-type]
    assert (dressed.source, dressed.pose, dressed.camera, dressed.size) == (
        state.source,
        state.pose,
        state.camera,
        state.size,
    )
    assert from_link(to_link(dressed)) == dressed


def test_a_look_is_lit_alike_from_every_side() -> None:
    ball = load("icosphere")
    facts = describe(Source("piece", "icosphere"), ball, "")
    look = preset("neon")
    assert look is not None
    pictures = []
    for azimuth in (0, 90):  # the ball is the same after a quarter of a turn
        state = set_value(State(facts.source), facts, "camera.azimuth", azimuth)
        state = set_value(state, facts, "camera.elevation", 0)
        for axis in "xyz":
            state = set_value(state, facts, f"camera.target.{axis}", 0)
        pictures.append(render(to_scene(apply_look(look, state, facts), ball)).pixels.astype(int))
    assert np.abs(pictures[0] - pictures[1]).mean() < 12


@pytest.mark.parametrize("name", [look.name for look in PRESETS if look.surface.shading == "smooth"])
def test_a_look_keeps_the_edges_of_a_cube(name: str) -> None:
    """Faces that are flat cost less than a cube whose edges are melted."""
    look = preset(name)
    assert look is not None
    cube = load("cube", 48)
    facts = describe(Source("piece", "cube"), cube, "")
    scene = to_scene(apply_look(look, State(facts.source), facts), cube, facts.bounds)
    (thing,) = scene.objects
    assert thing.material.shading == "flat"
    melted = evolve(scene, objects=[evolve(thing, material=evolve(thing.material, shading="smooth"))])
    gas, more = (render(each).gas or 0 for each in (scene, melted))
    assert 0 < gas < 0.6 * more
