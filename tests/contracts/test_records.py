"""Records of `Scene.extensions`: they say what the scene says, belong to their objects, and name the engines."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from attrs import asdict, evolve
from tools.ledger import World as Ledger
from tools.ledger import call_data as studio_call

from node_scripts import calls_made
from picture import ALL_FACES, TURNED_AWAY, read
from pictures import call_data, chain, draw, dynamic
from random_scenes import KINDS, random_case
from shackled import Camera, InputError, Light, Material, Mesh, Object, Scene
from shackled.artifacts import artifact
from shackled.chain._engines import ANTIALIASED, EFFECTS, PLAIN, engines
from shackled.datasets.common import shapes
from shackled.image import decode_bmp
from shackled.scene import encode
from shackled.scene._codec import Rectangle, extensions, render_call
from shackled.scene._in_range import in_range
from shackled.studio._storage import quantize
from stored_scenes import stored


def is_near(one: Any, other: Any, step: float = 2.0**-32) -> bool:
    """Whether numbers are the same, to a step of what they are rounded to; or both are None."""
    if one is None or other is None:
        return one is other
    return np.allclose(np.asarray(one, float), np.asarray(other, float), rtol=1e-12, atol=step)


# ---- what a call says ----


@pytest.mark.parametrize("kind", KINDS)
def test_a_call_says_what_its_scene_says(kind: str) -> None:
    """To the definition of the renderer, which shares no code with what writes it."""
    for seed in range(1, 9):
        scene = random_case(seed, kind).scene
        world = read(call_data("render", scene))
        frame, camera = world.camera, scene.camera
        assert (frame.width, frame.height) == (scene.width, scene.height)
        assert frame.is_perspective == (camera.projection == "perspective")
        forward = camera.target - camera.eye
        assert is_near(frame.eye, camera.eye)
        assert is_near(frame.axes[2], forward / np.linalg.norm(forward), 1e-6)
        assert frame.axes[1] @ camera.up < 0
        assert is_near([frame.near, scene.height / 2 / frame.focal], [camera.near or 0.0, camera.half_height])
        assert is_near(world.top, scene.background.top)
        assert is_near(world.bottom, scene.background.bottom)
        assert is_near(world.ambient_light, scene.ambient_light)
        assert world.invert == scene.invert
        for lamp, light in zip(world.lights, scene.lights, strict=True):
            assert lamp.is_point == (light.kind != "directional")
            assert is_near(lamp.vector, light.vector)
            assert is_near(lamp.color, light.color)
            cosines = np.cos(np.radians([light.inner_angle, light.outer_angle]))
            assert is_near(lamp.cone, None if light.direction is None else [*light.direction, *cosines])
            assert (lamp.shadow > 0) == light.shadow
        for surface, thing in zip(world.objects, scene.objects, strict=True):
            assert_is(surface, thing)
        assert_effects(scene)


def assert_is(surface: Any, thing: Object) -> None:
    """Check that what a call says of an object is the object."""
    mesh, material, texture = thing.mesh, thing.material, thing.material.texture
    found: Any = surface.texture
    assert is_near(surface.points, thing.world_positions(), 1e-6 * thing.scale * np.abs(mesh.positions).max())
    assert is_near(surface.colors, mesh.colors)
    assert np.array_equal(surface.faces, mesh.faces)
    assert ("unlit", "flat", "smooth")[surface.shading] == material.shading
    assert is_near(
        [surface.ambient, surface.diffuse, surface.specular, surface.shininess],
        [material.ambient, material.diffuse, material.specular, material.shininess],
    )
    assert (surface.culls, surface.is_wire, surface.two_sided) == (thing.cull, thing.wireframe, thing.two_sided)
    assert is_near(surface.emission, material.emission)
    assert is_near(surface.opacities, thing.opacity * (1 if mesh.opacities is None else mesh.opacities), 1 / 509)
    assert is_near(surface.fade, thing.fade)
    assert thing.fade is None or is_near(surface.position, thing.position)
    assert (found is None) == (texture is None)
    if texture is not None:
        assert is_near(found.texels, texture.pixels)
        assert (found.bilinear, found.clamps) == (texture.filter == "bilinear", texture.wrap == "clamp")
        assert is_near(surface.uvs, mesh.uvs, 2.0**-17)
        assert is_near(found.alpha, None if texture.alpha is None else texture.alpha[..., None])
        assert texture.alpha is None or found.cutoff == texture.cutoff


def assert_effects(scene: Scene) -> None:
    """Check the effects of a call of a scene."""
    world = read(call_data("render", scene))
    assert (len(world.samples) > 1) >= (scene.antialias or world.has_effects)
    if scene.hemisphere is not None:
        assert is_near(world.hemisphere, [scene.hemisphere.sky, scene.hemisphere.ground])
    if scene.rim is not None:
        assert is_near([*world.rim, world.rim_power], [*scene.rim.color, scene.rim.power])
    fog = scene.fog and [*scene.fog.color, scene.fog.near, scene.fog.far]
    assert is_near(world.fog and [*world.fog[0], *world.fog[1:]], fog)
    if scene.tone is not None:
        flags = asdict(scene.tone)
        assert is_near(world.exposure, flags.pop("exposure"), 2.0**-16)
        assert {name: getattr(world, name) for name in flags} == flags


def test_which_faces_cast_shadows() -> None:
    """Those that are turned away, if all that casts shadows is closed."""
    ball, light = shapes.icosphere(1), Light("directional", (1, 2, 3), shadow=True)
    for mesh, rule in ((ball, TURNED_AWAY), (evolve(ball, faces=ball.faces[1:]), ALL_FACES)):
        world = read(render_call(Scene([Object(mesh)], Camera((0, 0, 5), (0, 0, 0)), [light])))
        assert [lamp.shadow for lamp in world.lights] == [rule]


def test_a_fade_is_about_the_position_of_its_object(tmp_path: Path) -> None:
    """Also of a mesh that is beside it, whose coordinates are rounded to a grid: by the encoders, and when stored."""
    size, inner, outer = 48, 0.75, 1.5
    square = Mesh([(-1.05, 0, -1), (-1.05, 0, 5.1), (5.03, 0, 5.1), (5.03, 0, -1)], [(0, 1, 2), (0, 2, 3)], "white")
    ground = Object(square, (0.3, 0, -0.2), material=Material("unlit"), cull=False, fade=(inner, outer))
    camera = Camera((0, 9, 0), (0, 0, 0), (0, 0, -1), "orthographic", 3)
    scene = Scene([ground], camera, [], "black", width=size, height=size)
    at = (np.arange(size) + 0.5) * 6 / size - 3
    x, z = at[None, :], at[:, None]
    distance, step = np.hypot(x - 0.3, z + 0.2), 12 / size
    covered = (x > step - 0.75) & (z > step - 1.2)
    calls = [render_call(scene), render_call(evolve(scene, objects=[quantize(ground, 9)]))]
    if shutil.which("node"):
        calls += calls_made([{"text": scene.encode().decode()}], tmp_path)
    for call in calls:
        pixels = decode_bmp(dynamic(chain().call("Renderer", call).output), size, size)[:, :, 0]
        assert (pixels[covered & (distance < inner - step)] > 250).all()
        assert (pixels[distance > outer + step] == 0).all()
        assert np.count_nonzero(covered & (distance < inner - step)) > 20


# ---- the objects that they belong to ----

WIRE = Object(Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]), (0, 2**25, 0), wireframe=True)


@pytest.mark.parametrize("kind", ["glass", "cards", "shadows"])
def test_numbers_of_two_bytes(kind: str) -> None:
    """Objects behind 257 others, which lie outside of the picture."""
    scene = random_case(1, kind).scene
    many = evolve(scene, objects=[*257 * [WIRE], *scene.objects])
    assert np.array_equal(draw(many), draw(scene))
    for surface, thing in zip(read(call_data("render", many)).objects[257:], scene.objects, strict=True):
        assert_is(surface, thing)


@pytest.mark.parametrize("kind", ["textures", "glass", "cards", "shadows", "effects"])
def test_stored_scenes(kind: str) -> None:
    """Vertices and faces are stored in another order, and what belongs to them with them."""
    world = Ledger()
    scene = random_case(1, kind).scene
    pointer = stored(world, scene)
    kept = world.run(world.address("Studio"), studio_call("scene(address)", pointer))
    there, given = read(artifact("Renderer").selectors["render"] + kept), read(call_data("render", scene))
    for name in vars(given).keys() - {"camera", "objects"}:
        assert repr(getattr(there, name)) == repr(getattr(given, name))
    for one, other in zip(there.objects, given.objects, strict=True):
        assert corners(one) == corners(other)
        for name in ("texture", "fade", "emission", "is_opaque"):
            assert repr(getattr(one, name)) == repr(getattr(other, name))
    drawn = decode_bmp(world.call("Studio", "render(address)", pointer), scene.width, scene.height)
    assert np.array_equal(drawn, draw(scene))


def corners(surface: Any) -> list[list[tuple[float, ...]]]:
    """What belongs to the corners of faces, sorted."""
    parts = [surface.points, surface.colors, surface.opacities, surface.uvs]
    return sorted(sorted(map(tuple, face)) for face in np.column_stack(parts)[surface.faces].tolist())


def test_objects_far_down_the_scene_cannot_have_records() -> None:
    scene = Scene([WIRE] * 65536 + [evolve(WIRE, opacity=0.5)], Camera())
    with pytest.raises(InputError, match="among the first 65,536 of a scene, not number 65,536"):
        extensions(scene)


# ---- engines ----

FOUR_SAMPLES, SMOOTH = ANTIALIASED[:2], ANTIALIASED[2:]
BALL = Object(shapes.icosphere(1), material=Material("smooth"))
DULL = evolve(BALL, material=Material("unlit"))


def found(data: bytes) -> tuple[str, ...]:
    """The engines of a call, whose scene is where its first word says."""
    return engines(data[4 + int.from_bytes(data[4:36], "big") :], chain())


@pytest.mark.parametrize(
    ("changes", "needed"),
    [
        ({"antialias": False}, PLAIN),
        ({"antialias": False, "objects": [evolve(BALL, opacity=0.5)]}, PLAIN),
        ({"hemisphere": (0, 0, 9)}, EFFECTS),
        ({"objects": [DULL, evolve(DULL, opacity=0.5)]}, FOUR_SAMPLES),
        # of antialiased scenes: by light, projection, material and flags
        ({}, SMOOTH),
        ({"camera": Camera(projection="orthographic")}, FOUR_SAMPLES[1:]),
        ({"camera": Camera(projection="orthographic"), "lights": [Light("directional", (0, 0, 9))]}, SMOOTH),
        ({"lights": []}, FOUR_SAMPLES[:1]),
        ({"lights": 2 * [Light("point", (0, 0, 9))]}, SMOOTH),
        ({"lights": 3 * [Light("point", (0, 0, 9))]}, FOUR_SAMPLES[1:]),
        ({"objects": []}, FOUR_SAMPLES[:1]),
        ({"objects": [DULL]}, FOUR_SAMPLES[:1]),
        ({"objects": [DULL, BALL]}, ANTIALIASED[::2]),
        ({"objects": [evolve(DULL, wireframe=True), BALL]}, ANTIALIASED[1:]),
        ({"objects": [evolve(BALL, material=Material("smooth", 1, 1, 1, 1))]}, FOUR_SAMPLES[1:]),
        ({"objects": [evolve(BALL, material=Material("smooth", 1, 1, 0, 1))]}, SMOOTH),
    ],
)
def test_engines_of_a_call(changes: dict[str, object], needed: tuple[str, ...]) -> None:
    scene = Scene([BALL], lights=[Light("point", (0, 0, 9))], antialias=True)
    assert found(render_call(evolve(scene, **changes))) == needed  # type: ignore[arg-type]


def test_engines_of_other_calls() -> None:
    scene = in_range(Scene([DULL, evolve(DULL, opacity=0.5)], antialias=True))
    tile = encode(artifact("Renderer").selectors["renderTile"], scene, Rectangle(0, 0, 8, 8))
    assert found(tile) == FOUR_SAMPLES
    for data in (b"", bytes(4), bytes(100)):
        assert engines(data, chain()) == PLAIN
