"""From a state to what is drawn."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings

from shackled import Camera, Fog, InputError, Light, Material, Mesh, Object, Rim, Scene, Tone, load, render
from shackled.creator import (
    Backdrop,
    Curve,
    Facts,
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
    bounds_of,
    camera_axes,
    camera_of,
    describe,
    filled,
    lamp_of,
    light_of,
    orbit_of,
    to_scene,
)
from shackled.datasets import require
from shackled.gas import render_call
from shackled.scene import Hemisphere
from states import states

#: One of each family of pieces, and those that are unlike the others.
PIECES = (
    "teapot",
    "cornell-box",
    "first-render",
    "wireframe-cube",
    "seashell",
    "icons/coin",
    "icons/heart",
    "genesis/7",
)


def facts_of(name: str) -> tuple[Scene, Facts]:
    scene = require(name).make()
    return scene, describe(Source("piece", name), scene, name)


@pytest.mark.parametrize("name", PIECES)
def test_an_untouched_state_is_the_very_scene(name: str) -> None:
    scene, facts = facts_of(name)
    assert render_call(to_scene(State(facts.source), scene)) == render_call(scene)


@pytest.mark.parametrize("name", ["teapot", "first-render", "genesis/7", "icons/heart", "wireframe-cube"])
def test_what_the_controls_show_is_what_is_drawn(name: str) -> None:
    """The numbers of the controls, taken for the scene's own, give its picture but for a few pixels on edges."""
    scene, facts = facts_of(name)
    assert not facts.mixed
    shown = filled(State(facts.source), facts)
    again = render(to_scene(shown, scene, facts.bounds)).pixels
    assert (again != render(scene).pixels).any(axis=2).sum() < 30


def test_objects_that_differ_are_told() -> None:
    _, facts = facts_of("icons/coin")
    assert facts.mixed == {"surface.shading"}
    assert facts_of("cornell-box")[1].mixed >= {"surface.shading", "surface.ambient"}


def test_none_is_filled_from_the_source() -> None:
    _, facts = facts_of("genesis/7")
    state = State(facts.source, surface=Surface(diffuse=0.5))
    shown = filled(state, facts)
    assert shown.surface == Surface("flat", 1, 0.5, 1.2, 10, opacity=1, emission="#000000")
    assert shown.lights == (Lamp("directional", -90.0, 0.0, color="#ffffff"),)
    assert shown.size == Size(128, 128)
    assert shown.surface.color is None
    assert shown.max_triangles is None


def test_every_field_changes_the_scene() -> None:
    scene, facts = facts_of("icons/coin")
    state = State(
        facts.source,
        pose=Pose((1, 0, 0), (0, 90, 0), 2),
        camera=Orbit(distance=4, azimuth=-90, elevation=0, projection="orthographic", fov=90),
        lights=(
            Lamp("point", 90, 0, 2, "#ff0000"),
            Lamp("directional", 0, 90),
            Lamp("spot", 0, 0, 3, target=(0, 4, 0), inner_angle=10, outer_angle=20),
        ),
        ambient_light="#010203",
        hemisphere=Sky(True, "#010203", "#040506"),
        rim=Outline(True, "#070809", 5),
        fog=Haze(True, "#0a0b0c", 2, 3),
        tone=Curve(1.5, True, True),
        surface=Surface("unlit", 1, 2, 3, 4, "#00ff00", 0.5, "#0d0e0f"),
        background=Backdrop("#000001", "#000002"),
        cull=False,
        wireframe=True,
        invert=True,
        antialias=True,
        size=Size(20, 10),
    )
    made = to_scene(state, scene)
    middle, radius = np.array(facts.bounds.middle), facts.bounds.radius
    assert np.allclose(bounds_of(made).middle, middle + np.array([radius, 0, 0]), atol=radius)
    assert made.camera.projection == "orthographic"
    assert np.allclose(made.camera.eye, middle + np.array([-4 * radius, 0, 0]))
    assert np.isclose(made.camera.half_height, 4 * radius)
    assert np.allclose(made.lights[0].vector, middle + np.array([2 * radius, 0, 0]))
    assert np.allclose(made.lights[1].vector, (0, 1, 0))
    assert made.lights[0].color == (255, 0, 0)
    assert np.allclose(made.lights[2].vector, middle + np.array([0, 0, 3 * radius]))
    assert made.lights[2].direction is not None
    assert np.allclose(np.cross(made.lights[2].direction, (0, 4, -3)), 0)
    assert (made.lights[2].inner_angle, made.lights[2].outer_angle) == (10, 20)
    assert made.ambient_light == (1, 2, 3)
    assert (made.hemisphere, made.rim) == (Hemisphere((1, 2, 3), (4, 5, 6)), Rim((7, 8, 9), 5))
    assert made.fog == Fog((10, 11, 12), 2 * radius, 3 * radius)
    assert made.tone == Tone(1.5, True, True)
    assert all(o.material == Material("unlit", 1, 2, 3, 4, emission=(13, 14, 15)) for o in made.objects)
    assert all((o.mesh.colors == (0, 255, 0)).all() for o in made.objects)
    assert not any(o.cull for o in made.objects)
    assert all(o.wireframe for o in made.objects)
    assert all(o.opacity == 0.5 for o in made.objects)
    assert made.invert
    assert made.antialias
    assert (made.background.top, made.background.bottom) == ((0, 0, 1), (0, 0, 2))
    assert (made.width, made.height) == (20, 10)


def test_effects_are_shown_and_removed() -> None:
    scene, facts = facts_of("teapot")
    shown = filled(State(facts.source), facts)
    assert shown.fog is not None
    assert not shown.fog.on
    depths = (scene.world_positions() - scene.camera.eye) @ -camera_axes(scene.camera)[2] / facts.bounds.radius
    assert shown.fog.near < depths.min() < depths.max() < shown.fog.far
    assert to_scene(shown, scene).fog is None
    foggy = load(scene, fog=("red", 1, 2), rim="white", hemisphere="white", exposure=2)
    facts = describe(Source("piece", "teapot"), foggy, "")
    shown = filled(State(facts.source), facts)
    made = to_scene(shown, foggy)
    assert (made.hemisphere, made.rim, made.tone) == (foggy.hemisphere, foggy.rim, foggy.tone)
    assert made.fog is not None
    assert np.allclose((made.fog.near, made.fog.far), (1, 2), rtol=1e-5)
    off = replace(shown, hemisphere=Sky(), rim=Outline(), fog=Haze(far=0), tone=Curve())
    made = to_scene(off, foggy)
    assert (made.hemisphere, made.rim, made.fog, made.tone) == (None, None, None, None)
    assert to_scene(replace(off, fog=Haze(True, far=0)), foggy).fog is not None


def test_objects_have_an_opacity_of_their_own() -> None:
    scene, facts = facts_of("cornell-box")
    assert len(scene.objects) > 2
    opacities = (0.25, None, 1.0, *State(facts.source).opacities[3:])
    state = State(facts.source, surface=Surface(opacity=0.5), opacities=opacities)
    made = [o.opacity for o in to_scene(state, scene).objects]
    assert made == [0.25, 0.5, 1.0, *[0.5] * (len(made) - 3)]


def test_a_pose_moves_all_objects_together() -> None:
    mesh = Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    scene = Scene([Object(mesh, (-1, 0, 0)), Object(mesh, (1, 0, 0), scale=3)])
    bounds = bounds_of(scene)
    made = to_scene(State(Source("piece", "x"), Pose((0.5, 0, 0), (0, 0, 90), 2)), scene)
    for before, after in zip(scene.objects, made.objects, strict=True):
        from_middle = before.position - bounds.middle
        expected = np.array(bounds.middle) + (0.5 * bounds.radius, 0, 0) + 2 * from_middle[[1, 0, 2]] * (-1, 1, 1)
        assert np.allclose(after.position, expected)
        assert after.scale == 2 * before.scale


def test_a_camera_there_and_back() -> None:
    scene = Scene([Object(Mesh([(-1, -2, -3), (4, 0, 1), (0, 9, 2)], [(0, 1, 2)]))])
    bounds = bounds_of(scene)
    for camera in (
        Camera((3, 4, 20), (0, 1, 0)),
        Camera((0, 30, 0), (0, 0, 0), (1, 0, 1)),
        Camera((0, -30, 0), (0, 0, 0), (0, 0, 1)),
        Camera((5, 5, 30), (0, 0, 0), (1, 1, 0), "orthographic", 7),
    ):
        again = camera_of(orbit_of(camera, bounds), bounds)
        assert np.allclose(again.eye, camera.eye, atol=1e-3)
        assert np.allclose(camera_axes(again), camera_axes(camera), atol=1e-6)
        assert np.isclose(again.half_height, camera.half_height, rtol=1e-5)


def test_a_light_there_and_back() -> None:
    bounds = bounds_of(load("cornell-box"))
    for light in (
        Light("point", (1, 2, 3), "#102030"),
        Light("directional", (1, -2, 3)),
        Light("point", bounds.middle),
        Light.spot((1, 2, 3), (1, -1, 0.5), "#102030", 5, 30),
        Light.spot((1, 2, 3), np.subtract(bounds.middle, (1, 2, 3)), outer_angle=90),
        Light.spot(bounds.middle, (0, 0, 1)),
    ):
        again = light_of(lamp_of(light, bounds), bounds)
        assert again.color == light.color
        assert (again.inner_angle, again.outer_angle) == (light.inner_angle, light.outer_angle)
        if light.direction is not None:
            assert again.direction is not None
            one, other = (each / np.linalg.norm(each) for each in (light.direction, again.direction))
            assert np.allclose(one, other, atol=1e-3)
        if light.kind != "directional":
            assert np.allclose(again.vector, light.vector, atol=0.01)
        else:
            assert np.allclose(again.vector, light.vector / 14**0.5, atol=1e-5)


def test_lights_that_follow_are_seen_from_the_same_side() -> None:
    scene, facts = facts_of("teapot")
    assert facts.defaults.camera is not None
    camera = replace(facts.defaults.camera, azimuth=170.0, elevation=-30.0)
    made = to_scene(State(facts.source, camera=camera, lights_follow=True), scene)
    seen = [
        camera_axes(each.camera) @ np.asarray(each.lights[0].vector) / np.linalg.norm(each.lights[0].vector)
        for each in (scene, made)
    ]
    assert np.allclose(seen[0], seen[1], atol=1e-5)
    assert not np.allclose(made.lights[0].vector, scene.lights[0].vector, atol=0.1)


def test_a_spot_light_follows_with_its_cone() -> None:
    scene, facts = facts_of("teapot")
    assert facts.defaults.camera is not None
    camera = replace(facts.defaults.camera, azimuth=170.0, elevation=-30.0)
    lamp = Lamp("spot", 20.0, 50.0, target=(0.5, 0.0, 0.0))
    state = State(facts.source, lights=(lamp,), lights_follow=True)
    seen = []
    for each in (to_scene(state, scene), to_scene(replace(state, camera=camera), scene)):
        (light,) = each.lights
        assert light.direction is not None
        seen.append(camera_axes(each.camera) @ np.stack([light.vector - facts.bounds.middle, light.direction]).T)
    assert np.allclose(seen[0], seen[1], atol=1e-4)


def test_a_spot_light_shines_whatever_its_numbers() -> None:
    bounds = bounds_of(load("teapot"))
    straight = light_of(Lamp("spot", 30, 40, 0, target=(0, 0, 0)), bounds)
    assert straight.direction is not None
    assert straight.direction.any()
    crossed = light_of(Lamp("spot", inner_angle=60, outer_angle=20), bounds)
    assert (crossed.inner_angle, crossed.outer_angle) == (20, 20)


def test_fewer_triangles() -> None:
    scene, facts = facts_of("teapot")
    made = to_scene(State(facts.source, max_triangles=300), scene, facts.bounds)
    assert 0 < len(made.objects[0].mesh.faces) <= 300


@settings(max_examples=60, deadline=None)
@given(states())
def test_any_state_can_be_drawn_or_says_why_not(state: State) -> None:
    scene, facts = SMALL
    size = Size(8, 8)
    with suppress(InputError):
        image = render(to_scene(replace(state, size=size, max_triangles=None), scene, facts.bounds))
        assert image.pixels.shape == (8, 8, 3)


SMALL = facts_of("tetrahedron")
