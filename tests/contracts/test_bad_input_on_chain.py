"""Calldata that no codec of ours would make: each call returns a picture or is refused, within a bound of gas."""

from __future__ import annotations

import re
import struct
from collections import Counter
from collections.abc import Callable
from typing import Any

import eth_abi
import numpy as np
import pytest
from attrs import evolve

from judge import judge_pixels, render
from pictures import call_data, chain, dynamic, scene_types, words
from random_scenes import KINDS, broken_call, random_case
from shackled import Background, Camera, ChainError, Fog, Light, Material, Mesh, Object, RenderError, Scene
from shackled.artifacts import artifact
from shackled.errors import OutOfGasError
from shackled.image import decode_bmp
from shackled.scene._codec import Rectangle, render_call

ONE = 1 << 32
TRIANGLE = [[-50, -50, 0], [50, -50, 0], [0, 50, 0]]

#: More than enough for what a small canvas can cost.
GAS_BOUND = 200_000_000


def small_scene(width: int = 32, height: int = 32) -> Scene:
    """Three objects and two lights, with all that takes part in the layout of the call."""
    mesh = Mesh(TRIANGLE, [[0, 1, 2]], [[255, 0, 0], [0, 255, 0], [0, 0, 255]], [[0, 0, 1]] * 3)
    fan = Mesh([*TRIANGLE, [90, 20, -30], [-60, 70, 40]], [[0, 1, 2], [1, 3, 2], [2, 4, 0]], [[200, 180, 90]] * 5)
    things = [
        Object(mesh, (0, 0, -200), (0.1, 0.2, 0.3, 1), 1.5, Material("smooth", 0.2, 0.7, 0.5, 20)),
        Object(fan, (20, 10, -150), (0, 0, 0, 1), 1.0, Material("flat", 0.2, 0.7, 0.5, 20), cull=False, wireframe=True),
    ]
    things.append(evolve(things[0], position=(-30, 0, -180)))
    lights = [Light("directional", (1, 2, 3)), Light("point", (50, 60, -20), (255, 180, 90))]
    return Scene(things, Camera(near=1), lights, Background((9, 8, 7), (60, 70, 80)), width=width, height=height)


CALL = call_data("render", small_scene())


def refusal(data: bytes) -> str:
    with pytest.raises(RenderError) as caught:
        chain().call("Renderer", data, GAS_BOUND)
    return str(caught.value).removeprefix("the contract refused: ")


# ---- scenes of values out of range, through an outside encoder ----


#: A scene as nested lists in the order of the ABI, to be changed at will.
Values = list[Any]


def lists(value: Any) -> Any:
    return [lists(v) for v in value] if isinstance(value, tuple | list) else value


def values() -> Values:
    (scene,) = eth_abi.decode(scene_types(), CALL[4:])  # type: ignore[attr-defined]
    return list(lists(scene))


def encoded(scene: Values) -> bytes:
    return CALL[:4] + eth_abi.encode(scene_types(), [scene])  # type: ignore[attr-defined]


def put(*path: int, value: Any) -> Callable[[Values], None]:
    """Sets one value of a scene."""

    def change(where: Values) -> None:
        for index in path[:-1]:
            where = where[index]
        where[path[-1]] = value

    return change


CANVAS, CAMERA, BACKGROUND, INVERT, AMBIENT, LIGHTS, OBJECTS, EXTENSIONS = range(8)
MESH, POSITION, ROTATION, SCALE, MATERIAL, FLAGS = range(6)
FAR = 1 << 58
BIG = (1 << 255) - 1


# ---- records of extensions ----


def record(kind: int, index: int, content: bytes) -> bytes:
    return struct.pack(">BHH", kind, index, len(content)) + content


def cone(*numbers: int) -> bytes:
    return struct.pack(">5q", *numbers)


def fog(near: int, far: int) -> bytes:
    return b"\xff" * 3 + struct.pack(">2q", near, far)


def tone(exposure: int, flags: int) -> bytes:
    return struct.pack(">IB", exposure, flags)


DOWN = cone(0, -ONE, 0, ONE, 0)
HALF = (1 << 23).to_bytes(4, "big")
#: Of the objects of the small scene.
VERTICES = (3, 5, 3)


def texture(index: int, flags: int, width: int, height: int, bits: int, words: int = 0) -> bytes:
    """The record of a texture of an object. words: more than it should have."""
    begin = bytes([flags, width - 1, height - 1, bits])
    size = 4 + (3 << bits if bits <= 8 else 0) + (width * height * bits + 7) // 8 + 6 * VERTICES[index % 3]
    content = begin + np.random.default_rng(bits).bytes(size + -size % 32 + 32 * words - 4)
    return bytes([8, 0, index]) + (len(content) // 32).to_bytes(2, "big") + content


def levels(index: int, words: int) -> bytes:
    """The record of opacities of the vertices of an object."""
    return b"\t" + index.to_bytes(2, "big") + words.to_bytes(2, "big") + np.random.default_rng(words).bytes(32 * words)


#: Records that are wrong in the scene above, and their errors.
RECORDS: list[tuple[bytes, str]] = [
    (b"\1", "ExtensionCutOff(position=0)"),
    (record(1, 1, DOWN)[:-1], "ExtensionCutOff(position=0)"),
    (record(1, 1, DOWN) + b"\2\0\1\0", "ExtensionCutOff(position=45)"),
    (record(2, 1, HALF) + bytes([2, 0, 2, 255, 255]), "ExtensionCutOff(position=9)"),
    (record(0, 0, b""), "UnknownExtension(kind=0, index=0)"),
    # sizes of kinds from 8 on are told in words
    (b"\xc8\0\7\0\1" + bytes(32), "UnknownExtension(kind=200, index=7)"),
    (b"\xc8\0\7\0\1" + bytes(31), "ExtensionCutOff(position=0)"),
    (record(255, 65535, b""), "UnknownExtension(kind=255, index=65535)"),
    (record(2, 1, HALF) + record(1, 1, DOWN), "ExtensionOrder(kind=1, index=1)"),
    (record(2, 1, HALF) + record(2, 1, HALF), "ExtensionOrder(kind=2, index=1)"),
    (record(2, 2, HALF) + record(2, 1, HALF), "ExtensionOrder(kind=2, index=1)"),
    (record(3, 0, b"") + record(2, 1, HALF), "ExtensionOrder(kind=2, index=1)"),
    (record(3, 0, b"") + record(3, 0, b""), "ExtensionOrder(kind=3, index=0)"),
    (record(1, 1, DOWN + b"\0"), "ExtensionSize(kind=1, index=1, expected=40, actual=41)"),
    (record(2, 1, HALF[:3]), "ExtensionSize(kind=2, index=1, expected=4, actual=3)"),
    (record(2, 1, b""), "ExtensionSize(kind=2, index=1, expected=4, actual=0)"),
    (record(3, 0, b"\1"), "ExtensionSize(kind=3, index=0, expected=0, actual=1)"),
    (record(1, 2, DOWN), "ExtensionIndex(kind=1, index=2, count=2)"),
    (record(2, 3, HALF), "ExtensionIndex(kind=2, index=3, count=3)"),
    (record(2, 65535, HALF), "ExtensionIndex(kind=2, index=65535, count=3)"),
    (record(3, 1, b""), "ExtensionIndex(kind=3, index=1, count=1)"),
    (record(1, 0, DOWN), "SpotIsNoPoint(light=0)"),
    (record(1, 1, cone(FAR + 1, 2, -3, ONE, 0)), f"SpotOutOfRange(light=1, x={FAR + 1}, y=2, z=-3)"),
    (record(1, 1, cone(0, 0, -FAR - 1, ONE, 0)), f"SpotOutOfRange(light=1, x=0, y=0, z={-FAR - 1})"),
    (record(1, 1, cone(0, 0, 0, ONE, 0)), "SpotWithoutDirection(light=1)"),
    (record(1, 1, cone(1, 0, 0, ONE + 1, 0)), f"SpotAngles(light=1, cosInner={ONE + 1}, cosOuter=0)"),
    (record(1, 1, cone(1, 0, 0, 0, -ONE - 1)), f"SpotAngles(light=1, cosInner=0, cosOuter={-ONE - 1})"),
    (record(1, 1, cone(1, 0, 0, 5, 6)), "SpotAngles(light=1, cosInner=5, cosOuter=6)"),
    (record(2, 0, (1 << 24).to_bytes(4, "big")), f"OpacityOutOfRange(object=0, opacity={1 << 24})"),
    (record(2, 0, b"\xff" * 4), f"OpacityOutOfRange(object=0, opacity={2**32 - 1})"),
    (record(4, 0, bytes(5)), "ExtensionSize(kind=4, index=0, expected=6, actual=5)"),
    (record(5, 0, bytes(5)), "ExtensionSize(kind=5, index=0, expected=4, actual=5)"),
    (record(6, 0, b""), "ExtensionSize(kind=6, index=0, expected=19, actual=0)"),
    (record(7, 0, bytes(4)), "ExtensionSize(kind=7, index=0, expected=5, actual=4)"),
    (record(4, 1, bytes(6)), "ExtensionIndex(kind=4, index=1, count=1)"),
    (record(7, 65535, bytes(5)), "ExtensionIndex(kind=7, index=65535, count=1)"),
    (record(5, 0, bytes(4)) + record(4, 0, bytes(6)), "ExtensionOrder(kind=4, index=0)"),
    (record(5, 0, bytes(4)), "RimPowerOutOfRange(power=0)"),
    (record(5, 0, b"\0\0\0\x11"), "RimPowerOutOfRange(power=17)"),
    (record(6, 0, fog(0, 0)), "FogOutOfRange(near=0, far=0)"),
    (record(6, 0, fog(2, 1)), "FogOutOfRange(near=2, far=1)"),
    (record(6, 0, fog(-1, 1)), "FogOutOfRange(near=-1, far=1)"),
    (record(6, 0, fog(0, FAR + 1)), f"FogOutOfRange(near=0, far={FAR + 1})"),
    (record(7, 0, bytes(5)), "ExposureOutOfRange(exposure=0)"),
    (record(7, 0, tone((64 << 16) + 1, 0)), f"ExposureOutOfRange(exposure={(64 << 16) + 1})"),
    (record(7, 0, tone(1, 4)), "UnknownToneFlags(flags=4)"),
    (record(7, 0, tone(1, 255)), "UnknownToneFlags(flags=255)"),
    (texture(3, 0, 1, 1, 1), "ExtensionIndex(kind=8, index=3, count=3)"),
    (b"\10\0\1\0\0", "ExtensionSize(kind=8, index=1, expected=32, actual=0)"),
    (texture(1, 4, 1, 1, 1), "TextureFormat(object=1, flags=4, bits=1)"),
    (texture(1, 255, 1, 1, 24), "TextureFormat(object=1, flags=255, bits=24)"),
    (texture(1, 0, 1, 1, 0), "TextureFormat(object=1, flags=0, bits=0)"),
    (texture(1, 0, 1, 1, 3), "TextureFormat(object=1, flags=0, bits=3)"),
    (texture(1, 0, 1, 1, 32), "TextureFormat(object=1, flags=0, bits=32)"),
    (texture(1, 0, 9, 9, 4, -1), "ExtensionSize(kind=8, index=1, expected=128, actual=96)"),
    (texture(1, 0, 9, 9, 4, 1), "ExtensionSize(kind=8, index=1, expected=128, actual=160)"),
    (texture(0, 0, 1, 1, 1) + texture(0, 0, 1, 1, 1), "ExtensionOrder(kind=8, index=0)"),
    (levels(3, 1), "ExtensionIndex(kind=9, index=3, count=3)"),
    (levels(65535, 0), "ExtensionIndex(kind=9, index=65535, count=3)"),
    (levels(0, 0), "ExtensionSize(kind=9, index=0, expected=32, actual=0)"),
    (levels(2, 2), "ExtensionSize(kind=9, index=2, expected=32, actual=64)"),
    (levels(1, 1) + levels(1, 1), "ExtensionOrder(kind=9, index=1)"),
    (levels(1, 1) + texture(1, 0, 1, 1, 1), "ExtensionOrder(kind=8, index=1)"),
    (b"\x0c\0\3\0\1" + bytes(32), "ExtensionIndex(kind=12, index=3, count=3)"),
    (b"\x0c\0\1\0\2" + bytes(64), "ExtensionSize(kind=12, index=1, expected=32, actual=64)"),
    (b"\x0c\0\2\0\1" + (1 << 24).to_bytes(32, "big"), "EmissionNotAColor(object=2, value=16777216)"),
    (b"\x0d\0\1\0\1" + bytes(32), "AlphaWithoutTexture(object=1)"),
    (texture(0, 0, 1, 1, 1) + b"\x0d\0\1\0\1" + bytes(32), "AlphaWithoutTexture(object=1)"),
    (texture(1, 0, 1, 1, 1) + b"\x0d\0\1\0\1\0\4\0\0\1" + bytes(27), "TextureFormat(object=1, flags=4, bits=1)"),
    (texture(1, 0, 1, 1, 1) + b"\x0d\0\1\0\1\0\0\0\0\3" + bytes(27), "TextureFormat(object=1, flags=0, bits=3)"),
    (
        texture(1, 0, 1, 1, 1) + b"\x0d\0\1\0\1\0\0\x0f\x0f\1" + bytes(27),
        "ExtensionSize(kind=13, index=1, expected=64, actual=32)",
    ),
    (b"\x0d\0\1\0\0", "ExtensionSize(kind=13, index=1, expected=32, actual=0)"),
    (b"\x0e\0\1\0\1" + bytes(32), "UnknownExtension(kind=14, index=1)"),
    (bytes([10, 0, 0, 0, 0]), "ExtensionSize(kind=10, index=0, expected=32, actual=0)"),
    (bytes([10, 0, 2, 0, 1]) + words(1), "ExtensionIndex(kind=10, index=2, count=2)"),
    (bytes([10, 0, 0, 0, 1]) + words(0), "ShadowRuleOutOfRange(light=0, rule=0)"),
    (bytes([10, 0, 0, 0, 1]) + words(4), "ShadowRuleOutOfRange(light=0, rule=4)"),
    (b"".join(bytes([10, 0, i, 0, 1]) + words(1) for i in (0, 1)), "SeveralShadows(light=1)"),
    (bytes([11, 0, 0, 0, 1]) + bytes(32), "GroundOutOfRange(object=0, inner=0, outer=0)"),
]
#: Records whose values are at their bounds.
RECORDS_AT_BOUNDS = [
    b"",
    record(2, 0, bytes(4)),
    record(2, 2, ((1 << 24) - 1).to_bytes(4, "big")),
    record(1, 1, cone(FAR, -FAR, FAR, ONE, -ONE)) + record(2, 0, HALF) + record(2, 1, HALF) + record(2, 2, HALF),
    record(1, 1, cone(0, 0, 1, -ONE, -ONE)),
    record(1, 1, cone(0, 0, -1, ONE, ONE)),
    record(3, 0, b""),
    record(1, 1, DOWN) + record(2, 2, HALF) + record(3, 0, b""),
    record(4, 0, bytes(6)) + record(5, 0, b"\0\0\0\1") + record(6, 0, fog(0, 1)) + record(7, 0, tone(1, 0)),
    record(2, 2, HALF) + record(4, 0, b"\xff" * 6) + record(5, 0, b"\xff\xff\xff\x10"),
    record(6, 0, fog(FAR - 1, FAR)) + record(7, 0, tone(64 << 16, 3)),
    texture(0, 0, 1, 1, 1) + texture(1, 1, 7, 5, 4) + texture(2, 2, 3, 256, 2),
    record(7, 0, tone(1 << 16, 2)) + texture(1, 3, 256, 256, 24),
    record(2, 0, HALF) + texture(0, 0, 1, 1, 1) + levels(0, 1) + levels(2, 1),
]


WRONG: list[tuple[Callable[[Values], None], str]] = [
    (put(CANVAS, value=[0, 5]), "CanvasSize(width=0, height=5)"),
    (put(CANVAS, value=[5, 0]), "CanvasSize(width=5, height=0)"),
    (put(CANVAS, value=[2049, 1]), "CanvasSize(width=2049, height=1)"),
    (put(CANVAS, value=[1, 2049]), "CanvasSize(width=1, height=2049)"),
    (put(CANVAS, value=[2**256 - 1, 2]), f"CanvasSize(width={2**256 - 1}, height=2)"),
    (put(CAMERA, 3, value=2), "UnknownProjection(projection=2)"),
    (put(CAMERA, 3, value=2**255), f"UnknownProjection(projection={2**255})"),
    (put(CAMERA, 4, value=(1 << 22) - 1), f"HalfHeightOutOfRange(halfHeight={(1 << 22) - 1})"),
    (put(CAMERA, 4, value=(1 << 42) + 1), f"HalfHeightOutOfRange(halfHeight={(1 << 42) + 1})"),
    (put(CAMERA, 4, value=0), "HalfHeightOutOfRange(halfHeight=0)"),
    (put(CAMERA, 4, value=-ONE), f"HalfHeightOutOfRange(halfHeight={-ONE})"),
    (put(CAMERA, 5, value=0), "NearOutOfRange(near=0)"),
    (put(CAMERA, 5, value=-1), "NearOutOfRange(near=-1)"),
    (put(CAMERA, 5, value=FAR + 1), f"NearOutOfRange(near={FAR + 1})"),
    (put(CAMERA, 0, value=[FAR + 1, 0, 0]), f"CameraOutOfRange(x={FAR + 1}, y=0, z=0)"),
    (put(CAMERA, 1, value=[0, -FAR - 1, 7]), f"CameraOutOfRange(x=0, y={-FAR - 1}, z=7)"),
    (put(CAMERA, 2, value=[0, 1, BIG]), f"CameraOutOfRange(x=0, y=1, z={BIG})"),
    (put(CAMERA, 1, value=[0, 0, 0]), "NoViewDirection()"),
    (put(CAMERA, 2, value=[0, 0, 0]), "NoViewDirection()"),
    (put(CAMERA, 2, value=[0, 0, 5 * ONE]), "NoViewDirection()"),
    (put(CAMERA, 2, value=[0, 0, -1]), "NoViewDirection()"),
    (put(BACKGROUND, 0, value=1 << 24), f"NotAColor(value={1 << 24})"),
    (put(BACKGROUND, 1, value=2**256 - 1), f"NotAColor(value={2**256 - 1})"),
    (put(AMBIENT, value=1 << 24), f"NotAColor(value={1 << 24})"),
    (put(LIGHTS, 1, 2, value=1 << 200), f"LightNotAColor(light=1, value={1 << 200})"),
    (put(INVERT, value=2), "NotAFlag(value=2)"),
    (put(LIGHTS, value=[[0, [1, 1, 1], 0]] * 5), "TooManyLights(count=5)"),
    (put(LIGHTS, value=[[0, [1, 1, 1], 0]] * 300), "TooManyLights(count=300)"),
    (put(LIGHTS, 1, 0, value=2), "UnknownLight(light=1, kind=2)"),
    (put(LIGHTS, 0, 1, value=[0, 0, 0]), "LightWithoutDirection(light=0)"),
    (put(LIGHTS, 1, 1, value=[0, FAR + 1, 0]), f"LightOutOfRange(light=1, x=0, y={FAR + 1}, z=0)"),
    (put(OBJECTS, 0, POSITION, value=[0, 0, -FAR - 1]), f"PositionOutOfRange(object=0, x=0, y=0, z={-FAR - 1})"),
    (put(OBJECTS, 1, ROTATION, value=[0, 0, 0, 0]), "RotationIsZero(object=1)"),
    (put(OBJECTS, 1, ROTATION, value=[5, FAR + 1, 6, 7]), f"RotationOutOfRange(object=1, x=5, y={FAR + 1}, z=6, w=7)"),
    (put(OBJECTS, 1, ROTATION, value=[5, 6, 7, -BIG]), f"RotationOutOfRange(object=1, x=5, y=6, z=7, w={-BIG})"),
    (put(OBJECTS, 0, SCALE, value=-1), "ScaleOutOfRange(object=0, scale=-1)"),
    (put(OBJECTS, 0, SCALE, value=(1 << 44) + 1), f"ScaleOutOfRange(object=0, scale={(1 << 44) + 1})"),
    (put(OBJECTS, 0, MATERIAL, 0, value=3), "UnknownShading(object=0, shading=3)"),
    (put(OBJECTS, 1, MATERIAL, 0, value=2), "NoNormals(object=1)"),
    (put(OBJECTS, 1, MATERIAL, 1, value=4 * ONE + 1), f"CoefficientOutOfRange(object=1, value={4 * ONE + 1})"),
    (put(OBJECTS, 0, MATERIAL, 2, value=-1), "CoefficientOutOfRange(object=0, value=-1)"),
    (put(OBJECTS, 0, MATERIAL, 3, value=BIG), f"CoefficientOutOfRange(object=0, value={BIG})"),
    (put(OBJECTS, 0, MATERIAL, 4, value=0), "ShininessOutOfRange(object=0, shininess=0)"),
    (put(OBJECTS, 1, MATERIAL, 4, value=129), "ShininessOutOfRange(object=1, shininess=129)"),
    (put(OBJECTS, 1, FLAGS, value=8), "UnknownFlags(object=1, flags=8)"),
    (put(OBJECTS, 0, MESH, value=b""), "MeshHeader(object=0, format=0, length=0)"),
    (put(OBJECTS, 0, MESH, value=b"\0\0\0\0"), "MeshHeader(object=0, format=0, length=4)"),
    (put(OBJECTS, 1, MESH, value=b"\4\0\0\0\0"), "MeshHeader(object=1, format=4, length=5)"),
    (put(OBJECTS, 1, MESH, value=b"\xff" + bytes(40)), "MeshHeader(object=1, format=255, length=41)"),
    (put(OBJECTS, 1, MESH, value=b"\0\0\1\0\1" + bytes(14)), "MeshLength(object=1, expected=20, actual=19)"),
    (put(OBJECTS, 1, MESH, value=b"\0\0\1\0\1" + bytes(16)), "MeshLength(object=1, expected=20, actual=21)"),
    (
        put(OBJECTS, 1, MESH, value=b"\0\xff\xff\xff\xff" + bytes(15)),
        f"MeshLength(object=1, expected={5 + 65535 * 15}, actual=20)",
    ),
    (
        put(OBJECTS, 0, MESH, value=b"\3\0\1\0\1" + bytes(16) + b"\0\0\0\0\0\1"),
        "IndexOutOfRange(object=0, face=0, vertexCount=1)",
    ),
    (
        put(OBJECTS, 1, MESH, value=b"\0\0\1\0\2" + bytes(9) + bytes(6) + b"\0\0\0\0\0\1"),
        "IndexOutOfRange(object=1, face=1, vertexCount=1)",
    ),
    (
        put(OBJECTS, 1, MESH, value=b"\0\0\1\0\1" + bytes(9) + b"\xff\xff\0\0\0\0"),
        "IndexOutOfRange(object=1, face=0, vertexCount=1)",
    ),
    (put(OBJECTS, 1, MESH, value=b"\0\0\0\0\1" + bytes(6)), "IndexOutOfRange(object=1, face=0, vertexCount=0)"),
    *((put(EXTENSIONS, value=data), error) for data, error in RECORDS),
]


@pytest.mark.parametrize(
    "changes", [{}, {"antialias": True}, {"fog": Fog("red", 1, 2)}], ids=["plain", "smooth edges", "fog"]
)
@pytest.mark.parametrize("shading", ["flat", "smooth"])
def test_every_index(shading: str, changes: dict[str, Any]) -> None:
    """Each engine checks 16 indices at once, of which the first may lie before those of the mesh."""
    scene = evolve(Scene([], Camera(near=1), [Light("directional", (1, 2, 3))], width=8, height=8), **changes)
    for faces in range(1, 17):
        mesh = Mesh(TRIANGLE, [[0, 1, 2]] * faces, normals=[[0, 0, 1]] * 3)
        thing = Object(mesh, (0, 0, -200), material=Material(shading))
        data = call_data("render", evolve(scene, objects=[thing]))
        start = data.index(bytes.fromhex("000000010002") * faces)
        for index in range(3 * faces):
            place = start + 2 * index
            error = f"IndexOutOfRange(object=0, face={index // 3}, vertexCount=3)"
            assert refusal(data[:place] + b"\0\3" + data[place + 2 :]) == error


@pytest.mark.parametrize(("change", "error"), WRONG, ids=lambda case: case if isinstance(case, str) else "")
def test_values_out_of_range(change: Callable[[Values], None], error: str) -> None:
    wrong = values()
    change(wrong)
    assert refusal(encoded(wrong)) == error


def test_every_error_of_a_scene_is_provoked() -> None:
    """All that the contract declares for scenes; the others have tests of their own below."""
    declared = {name for name, _ in artifact("Renderer").errors.values()}
    provoked = {error.partition("(")[0] for _, error in WRONG}
    others = {"AngleOutOfRange", "MalformedScene", "NoEngine", "OutOfGas", "RectangleOutsideCanvas", "RegistersOverlap"}
    assert declared - provoked == others & declared


#: Errors of records that models refuse, too: of cuts and order, and of the kinds 0 to 3.
OF_MODELS = re.compile(r"ExtensionCutOff|ExtensionOrder|Spot|Opacity|\w+\(kind=[0-3],")


@pytest.mark.parametrize("index", range(len(RECORDS)))
def test_models_with_wrong_records(index: int) -> None:
    """Each reader of records comes to an end: without one, all gas is used up."""
    data, error = RECORDS[index]
    wrong = values()
    wrong[EXTENSIONS] = data
    call = artifact("GlbEncoder").selectors["encode"] + encoded(wrong)[4:]
    if OF_MODELS.match(error):
        with pytest.raises(RenderError, match=re.escape(error)):
            chain().call("GlbEncoder", call, 400_000)
    else:
        chain().call("GlbEncoder", call, 400_000)


ALLOWED: list[Callable[[Values], None]] = [
    put(CAMERA, 0, value=[FAR, FAR, -FAR]),
    put(CAMERA, 1, value=[-FAR, FAR, -FAR]),
    put(CAMERA, 2, value=[1, 0, 0]),
    put(CAMERA, 4, value=1 << 22),
    put(CAMERA, 4, value=1 << 42),
    put(CAMERA, 5, value=1),
    put(CAMERA, 5, value=FAR),
    put(CAMERA, value=[[0] * 3, [0, 0, -1], [0, 1, 0], 1, 1 << 20, -FAR]),
    put(CAMERA, value=[[0] * 3, [0, 0, -1], [0, 1, 0], 1, FAR, FAR]),
    put(LIGHTS, value=[]),
    put(LIGHTS, value=[[0, [1, 0, 0], 0]] * 4),
    put(LIGHTS, 0, 1, value=[FAR, -FAR, FAR]),
    put(LIGHTS, 1, 1, value=[-FAR, -FAR, FAR]),
    put(OBJECTS, value=[]),
    put(OBJECTS, 0, POSITION, value=[-FAR, FAR, -FAR]),
    put(OBJECTS, 0, ROTATION, value=[0, 0, 0, 1]),
    put(OBJECTS, 0, ROTATION, value=[FAR, FAR, -FAR, FAR]),
    put(OBJECTS, 0, SCALE, value=0),
    put(OBJECTS, 0, SCALE, value=1 << 44),
    put(OBJECTS, 0, MATERIAL, value=[2, 4 * ONE, 4 * ONE, 4 * ONE, 128]),
    put(OBJECTS, 0, MATERIAL, value=[2, 0, 0, 0, 1]),
    put(OBJECTS, 1, MESH, value=b"\0\0\0\0\0"),
    put(OBJECTS, 1, MESH, value=b"\3\0\1\0\0" + bytes(16)),
    *(put(EXTENSIONS, value=data) for data in RECORDS_AT_BOUNDS),
]


@pytest.mark.parametrize("index", range(len(ALLOWED)))
def test_values_at_the_ends_of_their_ranges(index: int) -> None:
    allowed = values()
    ALLOWED[index](allowed)
    data = encoded(allowed)
    drawn = decode_bmp(dynamic(chain().call("Renderer", data, GAS_BOUND).output), 32, 32)
    assert judge_pixels("bounds", drawn, render(data)).faults == []


@pytest.mark.parametrize(
    "tile",
    [
        *[(0, 0, 0, 5), (0, 0, 5, 0), (0, 0, 33, 1), (0, 0, 1, 33)],
        *[(32, 0, 1, 1), (0, 32, 1, 1), (31, 0, 2, 1), (0, 31, 1, 2)],
        *[(2**256 - 1, 0, 2, 1), (0, 2**256 - 1, 1, 2), (2**255, 0, 2**255, 1), (0, 0, 2**256 - 1, 1)],
    ],
)
def test_tiles_outside_the_canvas(tile: tuple[int, int, int, int]) -> None:
    expected = "RectangleOutsideCanvas(x={}, y={}, width={}, height={})".format(*tile)
    assert refusal(call_data("renderTile", small_scene(), Rectangle(*tile))) == expected


@pytest.mark.parametrize("angle", [2**58 + 1, -(2**58) - 1, 3 * 2**57, 2**59 + 2, 2**255 - 1, -(2**255)])
def test_angles_out_of_range(angle: int) -> None:
    """2^26 degrees either way; the error has the angle that was given."""
    data = artifact("Renderer").selectors["eulerRotation"]
    chain().call("Renderer", data + words(2**58, -(2**58), 0))
    for position in range(3):
        angles = [0, 0, 0]
        angles[position] = angle
        assert refusal(data + words(*angles)) == f"AngleOutOfRange(degrees_={angle})"


def test_too_little_gas() -> None:
    needed = chain().call("Renderer", CALL).gas
    for gas in (needed // 2, 100_000, 30_000, 5_000):
        with pytest.raises(OutOfGasError, match="ran out of gas"):
            chain().call("Renderer", CALL, gas)


# ---- offsets and lengths ----

HEAD = 4 + 32
#: Places in the calldata of `small_scene`, where offsets and lengths are.
LIGHTS_OFFSET, OBJECTS_OFFSET, EXTENSIONS_OFFSET = (HEAD + 32 * word for word in (18, 19, 20))


def word_at(data: bytes, position: int) -> int:
    return int.from_bytes(data[position : position + 32], "big")


def with_word(data: bytes, position: int, value: int) -> bytes:
    return data[:position] + words(value) + data[position + 32 :]


def layout(data: bytes) -> dict[str, int]:
    """The position of every offset and length of a call."""
    lights = HEAD + word_at(data, LIGHTS_OFFSET)
    objects = HEAD + word_at(data, OBJECTS_OFFSET)
    places = {
        "offset of the lights": LIGHTS_OFFSET,
        "offset of the objects": OBJECTS_OFFSET,
        "number of lights": lights,
        "number of objects": objects,
        "offset of the extensions": EXTENSIONS_OFFSET,
        "length of the extensions": HEAD + word_at(data, EXTENSIONS_OFFSET),
    }
    for i in range(word_at(data, objects)):
        start = objects + 32 + word_at(data, objects + 32 + 32 * i)
        places[f"offset of object {i}"] = objects + 32 + 32 * i
        places[f"offset of the mesh of object {i}"] = start
        places[f"length of the mesh of object {i}"] = start + word_at(data, start)
    return places


PLACES = layout(CALL)


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("value", [2**256 - 1, 2**256 - 32, 2**255, 2**64, 2**32, 1_000_000])
def test_offsets_and_lengths_beyond_the_end(place: str, value: int) -> None:
    assert refusal(with_word(CALL, PLACES[place], value)) == f"MalformedScene(position={PLACES[place]})"


def test_lengths_that_just_do_not_fit() -> None:
    for place, size in (("number of lights", 5 * 32), ("number of objects", 32), ("length of the mesh of object 1", 1)):
        position = PLACES[place]
        most = (len(CALL) - position - 32) // size
        assert refusal(with_word(CALL, position, most + 1)) == f"MalformedScene(position={position})"
        # fits, but is wrong in another way
        assert not refusal(with_word(CALL, position, most)).startswith(f"MalformedScene(position={position})")


def test_an_offset_of_the_scene_beyond_the_end() -> None:
    for value in (2**256 - 1, 2**64, len(CALL)):
        # refused by the compiler's decoder, without words
        assert "encoded" in refusal(with_word(CALL, 4, value))


def test_other_orders_and_shared_parts_are_the_same_scene() -> None:
    """The ABI lets parts stand anywhere, and lets two offsets lead to one part."""
    twice = evolve(small_scene(), objects=2 * [small_scene().objects[1]])
    data = call_data("render", twice)
    objects = layout(data)["number of objects"] + 32
    shared = with_word(data, objects + 32, word_at(data, objects))
    assert chain().call("Renderer", shared).output == chain().call("Renderer", data).output
    lights = PLACES["number of lights"]
    moved = CALL[lights : lights + 32 + 32 * 5 * word_at(CALL, lights)]
    for same in (
        # lights behind everything else
        with_word(CALL, LIGHTS_OFFSET, len(CALL) - HEAD) + moved,
        # not at a multiple of 32, with something between
        with_word(CALL, LIGHTS_OFFSET, len(CALL) - HEAD + 7) + b"between" + moved,
        # bytes after the scene do not matter
        CALL + b"\xff" * 100,
    ):
        assert chain().call("Renderer", same).output == chain().call("Renderer", CALL).output


@pytest.mark.parametrize("function", ["render", "renderCounted", "renderDataURI", "renderSVG"])
def test_truncated_calls_are_refused(function: str) -> None:
    data = call_data(function, small_scene())
    needed = PLACES["length of the extensions"] + 32
    for size in {*range(0, needed, 32), needed - 1, needed - 31}:
        message = refusal(data[:size])
        if size >= HEAD + 32 * 21:
            assert re.fullmatch(r"MalformedScene\(position=\d+\)", message), f"{size} bytes: {message}"
    chain().call("Renderer", data[:needed])


def test_unknown_functions_and_value() -> None:
    for data in (b"", b"\0", bytes(4), b"\xff" * 4, bytes(1000)):
        refusal(data)


# ---- fuzz ----


def outcome(data: bytes) -> str:
    """The error, or "" for a picture; which must be one."""
    try:
        result = chain().call("Renderer", data, GAS_BOUND)
    except ChainError as error:
        message = str(error)
        # a revert with one of the contract's own errors, or without data by the decoder
        assert "ran out of gas" not in message, data.hex()
        assert "encoded" in message or re.match(r"the contract refused: [A-Z]\w+\(", message), message
        assert "Panic" not in message, message
        return message
    start = 4 + word_at(data, 4)
    width, height = word_at(data, start), word_at(data, start + 32)
    assert decode_bmp(dynamic(result.output), width, height).shape == (height, width, 3)
    return ""


@pytest.mark.parametrize("kind", sorted(KINDS.keys() - {"models"}))
def test_broken_calls(kind: str) -> None:
    outcomes = Counter(
        outcome(broken_call(seed, render_call(random_case(seed % 6, kind).scene))).partition("(")[0]
        for seed in range(1, 61)
    )
    assert outcomes[""] > 3
    assert len(outcomes) > 5


def test_changed_meshes() -> None:
    """Any bytes are a mesh if there are as many as its header says, and its faces name its vertices."""
    rng = np.random.default_rng(7)
    pictures = 0
    for _ in range(200):
        wrong = values()
        kind = int(rng.integers(4))
        count, faces = (int(n) for n in rng.integers(1, 9, 2))
        size = count * ((9 if kind & 2 else 6) + (7 if kind & 1 else 3))
        indices = rng.integers(0, count + (rng.random() < 0.2), (faces, 3)).astype(">u2").tobytes()
        mesh = bytes([kind]) + np.array([count, faces], ">u2").tobytes() + rng.bytes(size) + indices
        thing = wrong[OBJECTS][int(rng.integers(2))]
        thing[MESH] = mesh
        thing[MATERIAL][0] = int(rng.integers(3)) if kind & 1 else int(rng.integers(2))
        thing[SCALE] = int(2 ** rng.uniform(18, 32))
        pictures += outcome(encoded(wrong)) == ""
    assert pictures > 100
