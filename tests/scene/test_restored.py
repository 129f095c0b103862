"""Every property of a scene comes back from its call, and from its scene file: none is lost or becomes another."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from attrs import evolve, fields
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import ArrayLike, NDArray

from random_scenes import random_case, random_scene
from shackled import (
    Background,
    Camera,
    Fog,
    Ground,
    Light,
    Material,
    Mesh,
    Object,
    RenderError,
    Rim,
    Scene,
    Texture,
    Tone,
    load,
    render,
)
from shackled.errors import InputError
from shackled.scene import Hemisphere, decode
from shackled.scene._codec import render_call
from shackled.scene._constants import MAX_COORDINATE
from shackled.scene._fields import FILTERS, SHADINGS, WRAPS, Projection, Shading
from shackled.scene._in_range import _factor, _is_exact, _prepared

Floats = NDArray[np.float64]
Rng = np.random.Generator

#: The largest errors, as docs/scene-files.md states them: of vertices, as a part of half the largest side of their mesh
#: and in units of the decoded scene, with coordinates of 16 and of 24 bits; and of numbers that are multiples of 2^-32.
OF_SIZE, OF_UNIT, Q32 = 2.0**-15, {16: 2.0**-17, 24: 2.0**-9}, 2.0**-33
#: Lights beyond this are moved nearer.
FAR = 2.0**25


def whole(seed: int) -> Scene:
    """A scene with all there is, in any units: several objects of every kind, all lights, effects and a ground."""
    rng = np.random.default_rng([31, seed])
    unit = 10.0 ** rng.uniform(-6, 6)

    def color() -> NDArray[np.int64]:
        return rng.integers(0, 256, 3)

    def place(size: float) -> Floats:
        return np.asarray(rng.normal(size=3) * size * unit)

    def maybe() -> bool:
        return bool(rng.random() < 0.4)

    def thing(mesh: Mesh) -> Object:
        count, own = len(mesh.positions), rng.uniform(0.01, 100)
        opacities = rng.uniform(size=count) if maybe() else None
        colors, rows = rng.integers(0, 256, (count, 3)), rng.normal(size=(count, 5))
        mesh = Mesh(own * mesh.positions, mesh.faces, colors, rows[:, :3], rows[:, 3:], opacities)
        shading, (ambient, diffuse, specular) = SHADINGS[rng.integers(3)], rng.uniform(0, 4, 3)
        wood = texture(rng) if maybe() else None
        surface = Material(shading, ambient, diffuse, specular, rng.integers(1, 129), wood, color())
        return Object(mesh, place(0.1), rng.normal(size=4), unit / own, surface, maybe(), maybe(), rng.uniform(0.5, 1))

    lights = [
        Light.directional(toward=rng.normal(size=3), color=color()),
        Light.point(place(3), color()),
        Light.spot(place(3), place(1), "tomato", *sorted(rng.uniform(0, 180, 2))),
    ]
    shadowed = int(rng.integers(4))
    near = 0.01 * unit if maybe() else None
    camera = Camera(place(2) + np.array([0, 0, 6 * unit]), place(0.1), (0.1, 1, 0.2), near=near)
    if maybe():
        camera = evolve(camera, projection="orthographic", half_height=2 * unit)
    grounds: list[dict[str, Any]] = [
        {},
        {"height": -1.7 * unit, "radius": rng.uniform(1, 9) * unit},
        {"center": rng.normal(size=2) * unit, "inner": 1e-3 * unit},
        {"radius": rng.uniform(1, 9) * unit, "inner": 0},
    ]
    return Scene(
        [thing(each.mesh) for each in random_scene("contacts", seed).objects if each.fade is None],
        camera,
        [evolve(light, shadow=number == shadowed) for number, light in enumerate(lights)],
        Background(color(), color()),
        color(),
        maybe(),
        int(rng.integers(1, 2049)),
        int(rng.integers(1, 2049)),
        maybe(),
        Hemisphere(color(), color()),
        Rim(color(), rng.integers(1, 17)),
        Fog(color(), rng.uniform(0, 3) * unit, rng.uniform(4, 9) * unit),
        Tone(rng.uniform(0, 4), maybe(), maybe()),
        Ground(color(), **grounds[seed % 4]),
    )


def texture(rng: Rng) -> Texture:
    filter, wrap = FILTERS[rng.integers(2)], WRAPS[rng.integers(2)]
    return Texture(rng.integers(0, 256, (*rng.integers(1, 9, 2), 3), dtype=np.uint8), filter, wrap)


def near(found: Any, expected: Any, error: float) -> None:
    np.testing.assert_allclose(found, expected, rtol=0, atol=error)


def alike(found: Floats, expected: Floats, error: float = 2.0**-20) -> None:
    """Directions."""
    expected = expected / np.abs(expected).max()
    near(found / np.linalg.norm(found), expected / np.linalg.norm(expected), error)


def assert_restored(found: Scene, scene: Scene) -> None:
    """Each field of what was decoded is that of the scene; lengths are multiplied by a factor, about an eye."""
    prepared = _prepared(scene)
    factor = 1.0 if _is_exact(prepared) else _factor(prepared)
    eye = scene.camera.eye - found.camera.eye / factor

    def placed(points: ArrayLike) -> Floats:
        return np.asarray((np.asarray(points) - eye) * factor)

    checked = {"objects", "camera", "lights", "fog", "tone", "ground"}
    for field in fields(Scene):
        if field.name not in checked:
            assert getattr(found, field.name) == getattr(scene, field.name), field.name
    assert_camera(found.camera, scene.camera, factor)
    for one, light in zip(found.lights, scene.lights, strict=True):
        assert_light(one, light, placed)
    for thing, o in zip(found.objects, scene.objects, strict=True):
        assert_object(thing, o, placed, factor)
    assert (found.fog is None) == (scene.fog is None)
    if found.fog and scene.fog:
        assert found.fog.color == scene.fog.color
        far = min(max(scene.fog.far * factor, 2 * Q32), MAX_COORDINATE)
        near([found.fog.near, found.fog.far], [min(scene.fog.near * factor, MAX_COORDINATE - 1), far], 3 * Q32)
    assert (found.tone is None) == (scene.tone is None)
    if found.tone and scene.tone:
        assert found.tone.exposure == max(round(scene.tone.exposure * 2**16), 1) / 2**16
        assert evolve(found.tone, exposure=1) == evolve(scene.tone, exposure=1)
    assert (found.ground is None) == (scene.ground is None)
    if found.ground and scene.ground:
        assert found.ground.color == scene.ground.color
        ours = [each.under(one.world_positions()) for each, one in ((found.ground, found), (scene.ground, scene))]
        near(ours[0].position, placed(ours[1].position), 2 * Q32)
        near(ours[0].fade or (), np.multiply(ours[1].fade or (), factor), 2 * Q32)


def assert_camera(found: Camera, camera: Camera, factor: float) -> None:
    assert found.projection == camera.projection
    forward = camera.target - camera.eye
    alike(found.target - found.eye, forward)
    alike(np.cross(found.target - found.eye, found.up), np.cross(forward / np.abs(forward).max(), camera.up))
    half_height = camera.half_height * (factor if camera.projection == "orthographic" else 1)
    near(found.half_height, half_height, Q32)
    if camera.near is not None:
        # no near plane is one that is as far behind the eye as can be
        distance = -MAX_COORDINATE if found.near is None else found.near
        near(distance, min(max(camera.near * factor, -MAX_COORDINATE), MAX_COORDINATE), 2 * Q32)


def assert_light(found: Light, light: Light, placed: Any) -> None:
    assert (found.kind, found.color, found.shadow) == (light.kind, light.color, light.shadow)
    if light.kind == "directional":
        return alike(found.vector, light.vector)
    place = placed(light.vector)
    if np.abs(place).max() > FAR:
        alike(found.vector, place)
        # it was moved there by a factor that is rounded
        assert np.abs(found.vector).max() >= np.nextafter(FAR, 0)
    else:
        near(found.vector, place, Q32)
    if light.direction is not None and found.direction is not None:
        alike(found.direction, light.direction)
        angles = np.radians([[each.inner_angle, each.outer_angle] for each in (found, light)])
        near(np.cos(angles[0]), np.cos(angles[1]), 2 * Q32)
    return None


def assert_object(found: Object, o: Object, placed: Any, factor: float) -> None:
    used = np.unique(o.mesh.faces)
    assert (found.cull, found.wireframe, found.two_sided) == (o.cull, o.wireframe, o.two_sided)
    near(found.opacity, o.opacity, 2.0**-25)
    assert (found.material.shading, found.material.shininess) == (o.material.shading, o.material.shininess)
    for name in ("ambient", "diffuse", "specular"):
        near(getattr(found.material, name), getattr(o.material, name), Q32)
    assert (found.material.texture, found.material.emission) == (o.material.texture, o.material.emission)
    assert (found.fade is None) == (o.fade is None)
    near(found.fade or (), np.multiply(o.fade or (), factor), 2 * Q32)
    bits = 16 if np.abs(found.mesh.positions).max() <= 2**15 else 24
    positions = o.mesh.positions[used]
    size = float(np.ptp(positions, axis=0).max()) / 2 * o.scale * factor
    world = o.world_positions()[used]
    rounded = 2.0**-50 * float(np.abs(world).max()) * factor  # by the sums of this test itself
    near(found.world_positions(), placed(world), OF_SIZE * size + OF_UNIT[bits] + rounded)
    mesh = found.mesh
    assert np.array_equal(used[mesh.faces], o.mesh.faces)
    assert np.array_equal(mesh.rgba, o.mesh.rgba[used])
    if o.material.texture is not None and o.mesh.uvs is not None:
        near(mesh.uvs, o.mesh.uvs[used], 2.0**-17)
    if o.material.shading == "smooth" and o.mesh.normals is not None:
        near(units(mesh.normals), units(o.mesh.normals[used]), 2 / 511)


def units(rows: Any) -> Floats:
    return np.asarray(rows / np.maximum(np.linalg.norm(rows, axis=1, keepdims=True), 1e-300))


@pytest.mark.parametrize("seeds", [range(first, first + 60) for first in range(0, 240, 60)])
def test_from_calls(seeds: range) -> None:
    for seed in seeds:
        scene = whole(seed)
        assert_restored(decode(render_call(scene)), scene)


@pytest.mark.parametrize("seeds", [range(first, first + 100) for first in range(0, 400, 100)])
def test_from_calls_of_random_scenes(seeds: range) -> None:
    """Those whose numbers are not changed, of any size."""
    for seed in seeds:
        scene = random_case(seed).scene
        for each in (scene, evolve(scene, camera=evolve(scene.camera, near=None))):
            found = decode(render_call(each))
            # an object that a ground made is a ground again
            if found.ground is None:
                assert_restored(found, each)


coordinate = st.floats(-1, 1, width=32)
point = st.tuples(coordinate, coordinate, coordinate)
direction = point.filter(lambda v: max(map(abs, v)) > 1e-3)
magnitude = st.floats(-30, 30).map(lambda exponent: 10.0**exponent)


@settings(max_examples=300, deadline=None)
@given(
    st.lists(point, min_size=3, max_size=8),
    st.lists(magnitude, min_size=4, max_size=4),
    st.lists(direction, min_size=4, max_size=4),
    st.tuples(*[coordinate] * 4).filter(lambda q: max(map(abs, q)) > 1e-3),
    st.sampled_from(["unlit", "flat", "smooth"]),
    st.sampled_from(["perspective", "orthographic"]),
    st.tuples(st.floats(0, 180), st.floats(0, 180)).map(sorted),
    st.floats(0, 1),
    st.booleans(),
)
def test_scenes_of_every_size(
    points: list[tuple[float, float, float]],
    sizes: list[float],
    places: list[tuple[float, float, float]],
    rotation: tuple[float, float, float, float],
    shading: Shading,
    projection: Projection,
    angles: list[float],
    opacity: float,
    is_near: bool,
) -> None:
    size, scale, distance, far = sizes
    world = size * scale
    mesh = Mesh(np.array(points) * size, [[0, 1, 2]] + [[0, i, i - 1] for i in range(2, len(points))])
    thing = Object(mesh, np.array(places[0]) * world, rotation, scale, Material(shading), opacity=opacity)
    light = Light.spot(np.array(places[1]) * world * far, np.array(places[2]) * size, (1, 2, 3), *angles)
    half_height = min(max(world, 1e-30), 1e30) if projection == "orthographic" else 0.5
    eye = np.array(places[3]) * world * min(distance, 1e3)
    near = world * distance if is_near else None
    camera = Camera(eye, (0, 0, 0), (0.01, 1, 0.02), projection, half_height, near)
    scene = Scene([thing], camera, [light, Light.point(light.vector), Light.directional(toward=places[2])])
    try:
        call = render_call(scene)
    except InputError:
        return
    try:
        assert_restored(decode(call), scene)
    except InputError:
        # the contracts refuse it too
        with pytest.raises(RenderError):
            render(evolve(scene, width=1, height=1))


def test_from_scene_files(tmp_path: Path) -> None:
    path = tmp_path / "scene.json"
    for seed in range(150):
        for scene in (whole(seed), random_case(seed).scene):
            scene.save(path)
            found = load(path)
            assert found == scene
            # also with what only a decoded scene has
            decoded = decode(render_call(scene))
            decoded.save(path)
            assert load(path) == decoded


def test_a_ground_from_a_picture_is_a_ground(tmp_path: Path) -> None:
    scene = load("torus", 48, shadow=True, ground="tan", color="tomato")
    image = render(scene)
    image.save(tmp_path / "scene.png")
    found = load(tmp_path / "scene.png")
    assert (len(found.objects), found.triangles) == (1, scene.triangles)
    assert found.ground is not None
    assert (found.ground.color, found.ground.inner) == ((210, 180, 140), None)
    assert np.array_equal(render(found).pixels, image.pixels)
    # a look is of the objects, and the ground can be removed or replaced
    blue = load(tmp_path / "scene.png", color="blue")
    assert blue.ground == found.ground
    assert load(tmp_path / "scene.png", ground="none").ground is None
    np.testing.assert_allclose(np.abs(found.bounds).max(), np.abs(found.objects[0].world_positions()).max())


def test_a_disc_that_is_no_ground_stays_an_object() -> None:
    disc = Ground("tan", 0, 2, (0, 0)).under(np.zeros((0, 3)))
    ball = Object(Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]))
    camera = Camera((0, 2, 4), (0, 0, 0), near=0.25)

    def objects(*things: Object) -> tuple[int, bool]:
        found = decode(render_call(Scene(things, camera)))
        return len(found.objects), found.ground is not None

    found = [objects(*things) for things in ((ball, disc), (disc,), (disc, disc), (disc, ball))]
    assert found == [(1, True), (0, True), (1, True), (2, False)]
    for other in (
        evolve(disc, cull=False),
        evolve(disc, opacity=0.5),
        evolve(disc, rotation=(0, 90, 0)),
        evolve(disc, material=Material("flat", 0.5)),
        evolve(disc, mesh=evolve(disc.mesh, colors=[(1, 2, 3), (1, 2, 3), (1, 2, 3), (1, 2, 4)])),
        evolve(disc, mesh=evolve(disc.mesh, opacities=[1, 1, 1, 0.5])),
        evolve(disc, fade=(1, 3)),
    ):
        assert objects(ball, other) == (2, False)
    scene = decode(render_call(Scene([ball, evolve(disc, fade=(1, 2))], camera)))
    assert scene.ground == Ground("tan", 0, 2, (0, 0), 1)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"inner": 2, "radius": 2}, "the inner radius of a ground, 2, must be below its radius, 2"),
        ({"inner": -1}, "the inner radius of a ground must be a finite number, at least 0, not -1"),
        ({"center": 1}, "the center of a ground must be 2 finite numbers, not 1"),
    ],
)
def test_wrong_grounds(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError, match=message):
        Ground("tan", **changes)
    with pytest.raises(InputError, match="the inner radius of a ground, 9, must be below its radius"):
        render_call(load("cube", ground=Ground("tan", inner=9)))
