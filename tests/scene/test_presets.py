"""Looks by name."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from attrs import evolve

from shackled import Camera, InputError, Light, Scene, load, render
from shackled.scene import PRESETS, stage
from shackled.scene._presets import Preset

NAMES = [preset.name for preset in PRESETS]


def horizontal(camera: Camera) -> float:
    x, _, z = camera.eye - camera.target
    return float(np.degrees(np.arctan2(x, z)))


def test_presets_differ_and_show_the_object() -> None:
    pictures = [render("teapot", size=48, preset=name).pixels.astype(int) for name in NAMES]
    for one, other in combinations(pictures, 2):
        assert np.abs(one - other).mean() > 4
    for pixels, name in zip(pictures, NAMES, strict=True):
        assert np.abs(pixels[20:28, 20:28] - pixels[2:4, 2:4].mean(axis=(0, 1))).max() > 60, name


@pytest.mark.parametrize("preset", PRESETS, ids=NAMES)
def test_what_a_preset_sets_and_leaves(preset: Preset) -> None:
    own = evolve(load("teapot", 32, shadow=True, ground="white", fog="red", emission="#100000"), invert=True)
    own = evolve(own, objects=[evolve(own.objects[0], opacity=0.5, cull=False, wireframe=True)])
    scene = load(own, preset=preset.name)
    for name in ("camera", "ground", "fog", "antialias", "width", "height"):
        assert getattr(scene, name) == getattr(own, name)
    (thing,) = scene.objects
    assert (thing.opacity, thing.cull, thing.material.emission) == (0.5, False, (16, 0, 0))
    assert (thing.wireframe, scene.invert) == (preset.wireframe, preset.invert)
    assert evolve(thing.material, emission=(0, 0, 0)) == preset.material
    assert (scene.background, scene.ambient_light) == (preset.background, preset.ambient_light)
    assert (thing.mesh.colors == (preset.color or own.objects[0].mesh.colors)).all()
    assert [light.shadow for light in scene.lights] == [number == 0 for number in range(len(preset.lamps))]


@pytest.mark.parametrize("view", [{"azimuth": 100, "elevation": 5}, {"eye": (-3, 1, -4), "target": (0, 0, 0)}, {}])
def test_lights_stand_relative_to_the_camera(view: dict[str, object]) -> None:
    scene = load("teapot", preset="gold", **view)  # type: ignore[arg-type]
    for light, lamp in zip(scene.lights, next(each for each in PRESETS if each.name == "gold").lamps, strict=True):
        x, y, z = light.vector
        turned = np.degrees(np.arctan2(x, z)) - horizontal(scene.camera) - lamp.azimuth
        assert abs((turned + 180) % 360 - 180) < 1e-9
        assert np.degrees(np.arcsin(y)) == pytest.approx(lamp.elevation)


def test_other_settings_change_a_preset() -> None:
    light = Light.directional(toward=(0, 1, 0))
    scene = load("icosphere", preset="sunset", crease=180, color="white", lights=light, background="black", shadow=True)
    (thing,) = scene.objects
    assert (thing.material.shading, thing.material.diffuse) == ("smooth", 0.9)
    assert (thing.mesh.colors == 255).all()
    assert scene.lights == (evolve(light, shadow=True),)
    assert scene.background.top == (0, 0, 0)
    assert load("icosphere", preset="gold", unlit=True).objects[0].material.shading == "unlit"


def test_meshes_are_staged_and_lists_are_of_one_look() -> None:
    cube = load("cube").objects[0].mesh
    for scene in (stage(cube, preset="clay"), load([cube, "teapot"], preset="clay")):
        assert all((each.mesh.colors == (0xC8, 0x67, 0x4A)).all() for each in scene.objects)
        # its edges stay hard, and it costs no more than before
        assert scene.objects[0].material.shading == "flat"
        assert scene.background.top == (0xF6, 0xEC, 0xDF)


def test_errors_list_the_names() -> None:
    with pytest.raises(InputError, match=f"`preset` must be one of {', '.join(NAMES)}, not 'mud'"):
        load("teapot", preset="mud")


def test_an_empty_scene_has_a_preset() -> None:
    assert len(load(Scene([], Camera()), preset="neon").lights) == 2
