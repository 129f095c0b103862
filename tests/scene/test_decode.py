"""Scenes from calldata: what Python encoded comes back as the same bytes, and anything else harms nobody."""

from __future__ import annotations

import math

import numpy as np
import pytest
from attrs import evolve
from hypothesis import given, settings
from hypothesis import strategies as st

from random_scenes import broken_call, random_case
from shackled import (
    Background,
    Camera,
    Fog,
    InputError,
    Light,
    Material,
    Mesh,
    Object,
    RenderError,
    Rim,
    Scene,
    Tone,
    render,
)
from shackled.chain import open_chain
from shackled.datasets import pieces
from shackled.scene import ANTIALIAS, NORMAL_UNIT, Hemisphere, Projection, decode, fit, pack, render_call
from shackled.scene._arithmetic import cosine
from shackled.scene._object import Shading
from shackled.scene._packed import unpack
from shackled.scene._records import FOG, HEMISPHERE, OPACITY_OF, RIM, SPOT, TONE

TRIANGLE = Mesh([[0, 0, 0], [1000, 0, 0], [0, 1000, 0]], [[0, 1, 2]], [[1, 2, 3], [4, 5, 6], [255, 0, 128]])
SCENE = Scene(
    [Object(TRIANGLE, position=(0, 0, -2500), opacity=0.25)],
    Camera(),
    [Light.spot((1, 2, 3), (-1, -2, -3), "tomato", 20, 40)],
)


def assert_same(scene: Scene) -> Scene:
    call = render_call(scene)
    found = decode(call)
    assert render_call(found) == call
    return found


def test_every_piece() -> None:
    for piece in pieces():
        if piece.ready() and (piece.dataset != "genesis" or piece.name.endswith("7")):
            assert_same(piece.make())


def test_every_field() -> None:
    scene = Scene(
        [
            Object(
                TRIANGLE,
                (1, 2, -30),
                (0, 1, 0, 1),
                0.5,
                Material("flat", 1, 2, 4, 128),
                False,
                True,
                0.5,
                two_sided=True,
            ),
            Object(TRIANGLE, material=Material("unlit", 0.25, 0.5, 0)),
        ],
        Camera((0, 0, 4), (0, 0, 0), (0, 2, 0), near=0.25, half_height=0.5),
        [Light.directional(toward=(1, 2, 3), color=(1, 2, 3)), Light.point((4, 5, 6)), SCENE.lights[0]],
        Background((1, 2, 3), (4, 5, 6)),
        (7, 8, 9),
        True,
        320,
        200,
        True,
        Hemisphere((1, 2, 3), (4, 5, 6)),
        Rim((7, 8, 9), 16),
        Fog((1, 2, 3), 0.25, 12),
        Tone(1.5, gamma=True),
    )
    found = assert_same(scene)
    # cosines have 32 bits after the point
    *others, light = found.lights
    light = evolve(light, inner_angle=round(light.inner_angle, 6), outer_angle=round(light.outer_angle, 6))
    assert evolve(found, lights=[*others, light]) == scene


@pytest.mark.parametrize("seeds", [range(first, first + 50) for first in range(0, 200, 50)])
def test_random_scenes(seeds: range) -> None:
    for seed in seeds:
        scene = random_case(seed).scene
        assert_same(scene)
        assert_same(evolve(scene, camera=evolve(scene.camera, near=None)))


coordinate = st.floats(-1, 1, width=32)
point = st.tuples(coordinate, coordinate, coordinate)
direction = point.filter(lambda v: max(map(abs, v)) > 1e-3)
magnitude = st.floats(-30, 30).map(lambda exponent: 10.0**exponent)
color = st.tuples(*[st.integers(0, 255)] * 3)


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
        found = decode(call)
    except InputError:
        # the contracts refuse it too
        with pytest.raises(RenderError):
            render(evolve(scene, width=1, height=1))
        return
    assert render_call(found) == call


def test_what_fit_made_is_kept() -> None:
    far = Light.point((3e25, 0, 0))
    for camera in (Camera((0, 0, 1e20)), Camera((0, 0, 1e20), projection="orthographic", half_height=1e20)):
        scene = Scene([Object(TRIANGLE, scale=1e15)], camera, [far])
        assert fit(scene).lights[0].vector.max() > 2**22
        assert_same(scene)


def test_angles_from_every_cosine() -> None:
    rng = np.random.default_rng(1)
    one = 2**32
    for value in (*range(-one, -one + 200), *range(one - 200, one + 1), *rng.integers(-one, one, 20_000).tolist(), 0):
        angle = math.degrees(math.acos(value / one))
        assert 0 <= angle <= 180
        assert round(cosine(angle) * one) == value


def test_normals_of_every_direction() -> None:
    rng = np.random.default_rng(2)
    normals = rng.normal(size=(60_000, 3))
    # also where a number is close to the middle between two
    numbers = np.round(NORMAL_UNIT * normals / np.linalg.norm(normals, axis=1, keepdims=True))
    corners = numbers + 0.4995 * rng.choice([-1, 1], numbers.shape)
    axes = np.vstack([np.eye(3), -np.eye(3), np.zeros((1, 3)), [[1, 1, 1], [1, 1, 0], [-1, 0, 1]]])
    for rows in (normals, corners, axes):
        faces = np.zeros((1, 3), int)
        packed = pack(Mesh(np.zeros_like(rows), faces, normals=rows), smooth=True)
        found = unpack(packed)
        assert pack(found, smooth=True) == packed
        assert found.normals is not None
        lengths = np.linalg.norm(found.normals, axis=1)
        assert np.allclose(lengths[lengths > 0], NORMAL_UNIT)


def test_broken_calls_are_refused_where_the_contracts_refuse_them() -> None:
    chain = open_chain()
    accepted = 0
    for seed in range(600):
        call = broken_call(seed, render_call(random_case(seed % 60).scene))
        try:
            decode(call)
        except InputError:
            continue
        accepted += 1
        try:
            chain.call("Renderer", call)
        except RenderError as error:
            # what no field alone is wrong with
            if "camera" not in str(error):
                raise
    assert 30 < accepted < 400


def other_numbers(call: bytes, rng: np.random.Generator) -> bytes:
    """A call in which one or two of the first 60 words are larger or smaller by a power of two, or by a little."""
    changed = bytearray(call)
    for _ in range(rng.integers(1, 3)):
        place = 4 + 32 * int(rng.integers(1, 60))
        value, shift = int.from_bytes(changed[place : place + 32], "big", signed=True), int(rng.integers(1, 31))
        value = [value >> shift, value << shift, value + shift - 15][rng.integers(3)]
        changed[place : place + 32] = (value % (1 << 256)).to_bytes(32, "big")
    return bytes(changed)


def test_what_is_accepted_is_the_same_call() -> None:
    """Scenes that `fit` would move or scale are refused: their pictures would change."""
    rng, accepted, refused = np.random.default_rng(7), 0, 0
    for seed in range(120):
        call = render_call(random_case(seed).scene)
        for _ in range(5):
            mutant = other_numbers(call, rng)
            try:
                scene = decode(mutant)
            except InputError as error:
                refused += "is not the one that Shackled makes of its scene" in str(error)
                continue
            accepted += 1
            assert render_call(scene) == mutant
    assert accepted > 100
    assert refused > 10


def changed(place: int, value: int) -> bytes:
    """The call of SCENE with another word. place: of the word after the selector."""
    call = bytearray(render_call(SCENE))
    call[4 + 32 * place : 36 + 32 * place] = (value % 2**256).to_bytes(32, "big")
    return bytes(call)


CALL = render_call(SCENE)
#: Words before the struct, and in it before the lights.
HEAD, STRUCT = 1, 21
OBJECT = HEAD + STRUCT + 1 + 5 + 1 + 1


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (b"", "no call of render"),
        (b"\0\0\0\0" + CALL[4:], "no call of render"),
        (CALL[:4], "cut off: the offset of the scene"),
        (CALL[:300], "cut off"),
        (CALL[:-1], "cut off"),
        (CALL + bytes(32), "32 bytes follow the scene"),
        (CALL[:-1] + b"\1", "zeros must fill the last word of the extensions"),
        (changed(0, 64), "the scene must follow"),
        (changed(HEAD, 0), "width must be from 1 to 2,048, not 0"),
        (changed(HEAD + 1, 2**255), "height must be from 1 to 2,048, not a larger number"),
        (changed(HEAD + 2, 2**58 + 1), "eye must be from"),
        (changed(HEAD + 2, 2**54 + 1), "eye has more digits than a float holds"),
        (changed(HEAD + 2, 2**58), "from byte 124 on, in the camera or the canvas, they differ"),
        (changed(HEAD + 11, 2), "projection must be from 0 to 1"),
        (changed(HEAD + 12, 1), "half_height must be"),
        (changed(HEAD + 13, 0), "near distance must be"),
        (changed(HEAD + 14, 2**24), "the top of the background as a colour"),
        (changed(HEAD + 16, 2), "invert must be from 0 to 1"),
        (changed(HEAD + 18, 32), "the lights must follow"),
        (changed(HEAD + 20, 2**63), "the extensions must follow"),
        (changed(HEAD + STRUCT, 5), "number of lights must be from 0 to 4"),
        (changed(HEAD + STRUCT + 1, 2), "kind of lights.0. must be from 0 to 1"),
        (changed(HEAD + STRUCT + 1, 0), "must be a point light to have a cone"),
        (changed(OBJECT - 2, 2**60), "no space for 1,152,921,504,606,846,976 objects"),
        (changed(OBJECT - 1, 0), "objects.0. must follow"),
        (changed(OBJECT, 0), "the mesh of objects.0. must follow"),
        (changed(OBJECT + 7, 0), "zero quaternion"),
        (changed(OBJECT + 8, 2**45), "scale of its mesh must be at most 4096"),
        (changed(OBJECT + 9, 2), "smooth shading needs a mesh with normals"),
        (changed(OBJECT + 10, 2**35), "ambient coefficient of objects.0. must be from 0 to 4"),
        (changed(OBJECT + 13, 0), "shininess of objects.0. must be from 1 to 128"),
        (changed(OBJECT + 14, 8), "flags of objects.0. must be from 0 to 7"),
        (changed(OBJECT + 15, 2**62), "cut off: the mesh"),
        (changed(OBJECT + 16, 4 << 248), "format from 0 to 3"),
        (changed(OBJECT + 16, 0), "a mesh|packed mesh of 0 vertices"),
    ],
)
def test_refusals(call: bytes, message: str) -> None:
    with pytest.raises(InputError, match=message):
        decode(call)


def record(kind: int, index: int, content: bytes) -> bytes:
    return bytes([kind]) + index.to_bytes(2, "big") + len(content).to_bytes(2, "big") + content


def spot(inner: int = 2**32, outer: int = 0, x: int = 1) -> bytes:
    return b"".join(value.to_bytes(8, "big", signed=True) for value in (x, 0, 0, inner, outer))


OPAQUE, HALF = (2**24).to_bytes(4, "big"), (2**23).to_bytes(4, "big")


@pytest.mark.parametrize(
    ("records", "message"),
    [
        (record(SPOT, 0, spot())[:-1], "cut off at byte 0"),
        (record(SPOT, 0, spot()) + b"\2\0", "cut off at byte 45"),
        (record(SPOT, 0, spot()) * 2, "must ascend"),
        (record(OPACITY_OF, 0, HALF) + record(SPOT, 0, spot()), "must ascend"),
        (record(ANTIALIAS, 0, b"") + record(OPACITY_OF, 0, HALF), "must ascend"),
        (record(ANTIALIAS, 0, b"") * 2, "must ascend"),
        (record(255, 0, b""), "kind 255 and 0 bytes is not known"),
        (record(ANTIALIAS, 0, b"\1"), "kind 3 and 1 bytes is not known"),
        (record(ANTIALIAS, 1, b""), "number 1 of 1"),
        (record(SPOT, 0, HALF), "kind 1 and 4 bytes is not known"),
        (record(SPOT, 1, spot()), "number 1 of 1"),
        (record(OPACITY_OF, 7, HALF), "number 7 of 1"),
        (record(OPACITY_OF, 0, OPAQUE), "below 1"),
        (record(SPOT, 0, spot(x=0)), "direction of a spot light must not be zero"),
        (record(SPOT, 0, spot(x=2**59)), "the direction of lights.0. must be from"),
        (record(SPOT, 0, spot(2**32 + 1)), "a cosine of lights.0. must be from -1 to 1"),
        (record(SPOT, 0, spot(0, 1)), "must not be above its outer_angle"),
        (record(HEMISPHERE, 1, bytes(6)), "number 1 of 1"),
        (record(HEMISPHERE, 0, bytes(5)), "kind 4 and 5 bytes is not known"),
        (record(RIM, 0, bytes(4)), "power of a rim must be a whole number from 1 to 16, not 0"),
        (record(RIM, 0, b"\0\0\0\x11"), "power of a rim must be a whole number from 1 to 16, not 17"),
        (record(FOG, 0, bytes(19)), "near distance of the fog, 0, must be below its far distance, 0"),
        (record(FOG, 0, bytes(11) + (2**58 + 1).to_bytes(8, "big")), "a distance of the fog must be from 0 to"),
        (record(TONE, 0, bytes(5)), "exposure beyond its range"),
        (record(TONE, 0, b"\0\x40\0\1\0"), "exposure beyond its range"),
        (record(TONE, 0, b"\0\1\0\0\4"), "unknown flags"),
    ],
)
def test_extensions(records: bytes, message: str) -> None:
    plain = render_call(evolve(SCENE, objects=[evolve(SCENE.objects[0], opacity=1)], lights=[Light.point((1, 2, 3))]))
    call = plain[:-32] + len(records).to_bytes(32, "big") + records + bytes(-len(records) % 32)
    with pytest.raises(InputError, match=message):
        decode(call)


def test_objects_that_share_their_bytes_are_refused() -> None:
    """A small call could fill the memory with them."""
    call = render_call(evolve(SCENE, objects=[evolve(SCENE.objects[0], opacity=1)] * 2))
    place = 4 + 32 * (OBJECT - 1)
    first = int.from_bytes(call[place : place + 32], "big")
    shared = call[: place + 32] + first.to_bytes(32, "big") + call[place + 64 :]
    with pytest.raises(InputError, match="must follow what is before it"):
        decode(shared)


def test_vertices_that_no_face_may_name() -> None:
    packed = pack(TRIANGLE)
    assert unpack(packed) == TRIANGLE
    with pytest.raises(InputError, match="numbered 0 to 2"):
        unpack(packed[:-1] + b"\7")
    with pytest.raises(InputError, match="has 38 bytes, not 37"):
        unpack(packed[:-1])


@pytest.mark.parametrize("wide", [False, True])
def test_coordinates_have_signs(wide: bool) -> None:
    most = 2**23 if wide else 2**15
    mesh = Mesh([[-most, most - 1, 0], [-1, 1, 2], [3, -4, 5]], [[0, 1, 2]])
    assert unpack(pack(mesh)) == mesh
