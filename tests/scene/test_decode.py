"""Scenes from calldata: whatever Python encoded comes back, and anything else harms nobody.

`decode` itself compares the bytes of the call that is made of the scene again.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from attrs import evolve

from random_scenes import broken_call, random_case
from shackled import Camera, InputError, Light, Mesh, Object, RenderError, Scene
from shackled.chain import open_chain
from shackled.datasets import pieces
from shackled.scene import decode
from shackled.scene._arithmetic import cosine
from shackled.scene._codec import render_call
from shackled.scene._in_range import in_range
from shackled.scene._packed import NORMAL_UNIT, pack, unpack
from shackled.scene._records import ANTIALIAS, FOG, OPACITY_OF, RIM, SPOT, TONE

TRIANGLE = Mesh([[0, 0, 0], [1000, 0, 0], [0, 1000, 0]], [[0, 1, 2]], [[1, 2, 3], [4, 5, 6], [255, 0, 128]])
SCENE = Scene(
    [Object(TRIANGLE, position=(0, 0, -2500), opacity=0.25)],
    Camera(),
    [Light.spot((1, 2, 3), (-1, -2, -3), "tomato", 20, 40)],
)


def test_every_piece() -> None:
    for piece in pieces():
        if piece.ready() and (piece.dataset != "genesis" or piece.name.endswith("7")):
            decode(render_call(piece.make()))


def test_what_fit_made_is_kept() -> None:
    far = Light.point((3e25, 0, 0))
    for camera in (Camera((0, 0, 1e20)), Camera((0, 0, 1e20), projection="orthographic", half_height=1e20)):
        scene = Scene([Object(TRIANGLE, scale=1e15)], camera, [far])
        assert in_range(scene).lights[0].vector.max() > 2**22
        decode(render_call(scene))


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
    """Scenes that `in_range` would move or scale are refused: their pictures would change."""
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


#: Of calls that are read, and would be made otherwise.
OTHER = "the call is not the one that Shackled makes of its scene: from byte "


@pytest.mark.parametrize(
    ("calls", "message"),
    [
        ([b"", b"\0\0\0\0" + CALL[4:]], "no call of render"),
        ([CALL[:4], CALL[:300], CALL[:-1]], "cut off: it ends after"),
        ([changed(OBJECT - 2, 2**60), changed(OBJECT + 15, 2**62)], "cut off: it ends after"),
        ([changed(HEAD, 0)], "the width of a picture must be from 1 to 2048 pixels, not 0"),
        ([changed(HEAD + 1, 2**255)], "the height of a picture must be from 1 to 2048 pixels"),
        ([changed(HEAD + 2, 2**58)], f"{OTHER}124 on"),
        ([changed(HEAD + 2, value) for value in (2**58 + 1, 2**54 + 1, -(2**255))], OTHER),
        ([changed(HEAD + 11, 2)], "projection must be one of perspective, orthographic, not '2'"),
        ([changed(HEAD + 12, 1)], "half_height must be"),
        ([changed(HEAD + 13, 0)], "near distance must be"),
        ([changed(HEAD + 14, 2**24)], "the background colour must be"),
        ([changed(HEAD + STRUCT, 5)], "lights|cut off"),
        ([changed(HEAD + STRUCT + 1, 2)], "lights.0.: the kind of a light must be one of"),
        ([changed(OBJECT + 7, 0)], "objects.0.: the rotation of an object must not be the zero quaternion"),
        ([changed(OBJECT + 10, 2**35)], "objects.0.: the ambient coefficient of a material must be"),
        ([changed(OBJECT + 13, 0)], "objects.0.: the shininess of a material must be a whole number from 1 to 128"),
        ([changed(OBJECT + 16, 0)], "objects.0.: a packed mesh of 0 vertices"),
        # of bytes, offsets, flags, the kind of a light with a cone, a large scale, normals that are not there
        ([CALL + bytes(32), CALL[:-1] + b"\1"], OTHER),
        ([changed(place, 64) for place in (0, HEAD + 18, HEAD + 19, HEAD + 20, OBJECT - 1, OBJECT)], OTHER),
        ([changed(HEAD + 16, 2), changed(OBJECT + 14, 8), changed(OBJECT + 16, 4 << 248)], f"{OTHER}|a packed mesh"),
        ([changed(HEAD + STRUCT + 1, 0), changed(OBJECT + 8, 2**45), changed(OBJECT + 9, 2)], OTHER),
    ],
)
def test_refusals(calls: list[bytes], message: str) -> None:
    for call in calls:
        with pytest.raises(InputError, match=message):
            decode(call)


def record(kind: int, index: int, content: bytes) -> bytes:
    return bytes([kind]) + index.to_bytes(2, "big") + len(content).to_bytes(2, "big") + content


def spot(inner: int = 2**32, outer: int = 0, x: int = 1) -> bytes:
    return b"".join(value.to_bytes(8, "big", signed=True) for value in (x, 0, 0, inner, outer))


OPAQUE, HALF = (2**24).to_bytes(4, "big"), (2**23).to_bytes(4, "big")


@pytest.mark.parametrize(
    ("extensions", "message"),
    [
        # cut off, not in ascending order, twice, of what is not there, and opaque
        ([record(SPOT, 0, spot()) + b"\3\0"], OTHER),
        ([record(SPOT, 0, spot()) * 2, record(ANTIALIAS, 0, b"") * 2], OTHER),
        ([record(OPACITY_OF, 0, HALF) + record(SPOT, 0, spot())], OTHER),
        ([record(ANTIALIAS, 1, b""), record(SPOT, 1, spot()), record(OPACITY_OF, 7, HALF)], OTHER),
        ([record(OPACITY_OF, 0, OPAQUE), record(RIM, 1, b"\0\0\0\1")], OTHER),
        ([record(SPOT, 0, spot(x=2**59)), record(TONE, 0, bytes(5)), record(TONE, 0, b"\0\1\0\0\4")], OTHER),
        ([record(255, 0, b"")], "kind 255 and 0 bytes is not known"),
        ([record(ANTIALIAS, 0, b"\1")], "kind 3 and 1 bytes is not known"),
        ([record(SPOT, 0, HALF), record(SPOT, 0, HALF)[:-1]], "kind 1 and [34] bytes is not known"),
        ([record(SPOT, 0, spot(x=0))], "lights.0.: the direction of a spot light must not be zero"),
        ([record(SPOT, 0, spot(2**32 + 1))], "lights.0.: the cosine of an angle must be .* from -1 to 1"),
        ([record(SPOT, 0, spot(0, 1))], "must not be above its outer_angle"),
        ([record(RIM, 0, bytes(4))], "power of a rim must be a whole number from 1 to 16, not 0"),
        ([record(FOG, 0, bytes(19))], "near distance of the fog, 0, must be below its far distance, 0"),
        ([record(FOG, 0, bytes(11) + (2**58 + 1).to_bytes(8, "big"))], OTHER),
        ([record(TONE, 0, b"\0\x40\0\1\0")], "the exposure must be a finite number from 0 to 64"),
    ],
)
def test_extensions(extensions: list[bytes], message: str) -> None:
    plain = render_call(evolve(SCENE, objects=[evolve(SCENE.objects[0], opacity=1)], lights=[Light.point((1, 2, 3))]))
    for records in extensions:
        call = plain[:-32] + len(records).to_bytes(32, "big") + records + bytes(-len(records) % 32)
        with pytest.raises(InputError, match=message):
            decode(call)


def test_vertices_that_no_face_may_name() -> None:
    packed = pack(TRIANGLE)
    assert unpack(packed) == TRIANGLE
    with pytest.raises(InputError, match="numbered 0 to 2"):
        unpack(packed[:-1] + b"\7")
    with pytest.raises(InputError, match="has 38 bytes, not 37"):
        unpack(packed[:-1])
