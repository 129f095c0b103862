"""The library with which contracts build scenes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from eth_abi.abi import decode
from tools.examples import compile_example
from tools.ledger import World, call_data

from shackled import Mesh, RenderError, Texture
from shackled.scene import is_closed, pack, pack_texture
from shackled.studio import scene_struct, split_mesh

SCENE_STRUCT = scene_struct()
ROOT = Path(__file__).resolve().parents[2]
ONE = 1 << 32
TRIANGLE = [(0, 0, 0, 1), (9, 0, 0, 2), (0, 9, 0, 3)]

pytestmark = pytest.mark.skipif(
    not (ROOT / "contracts" / "node_modules" / "solc").is_dir(), reason="the compiler is not installed"
)


@pytest.fixture(scope="module")
def world() -> World:
    return World()


@pytest.fixture(scope="module")
def probe(world: World) -> bytes:
    return world.deploy(compile_example("tests/studio/BuilderProbe.sol")[0])


def ask(world: World, probe: bytes, kinds: list[str], signature: str, *values: Any) -> tuple[Any, ...]:
    return tuple(decode(kinds, world.run(probe, call_data(signature, *values))))


def made(
    world: World, probe: bytes, room: tuple[int, int], vertices: list[tuple[int, ...]], faces: list[tuple[int, ...]]
) -> bytes:
    packed, behind = ask(
        world,
        probe,
        ["bytes", "bytes"],
        "mesh(uint256,uint256,(int256,int256,int256,uint256)[],uint256[3][])",
        *room,
        vertices,
        faces,
    )
    assert behind == (0x1234567890ABCDEF).to_bytes(32, "big") + (0xFEDCBA0987654321).to_bytes(32, "big")
    return bytes(packed)


@pytest.mark.parametrize(
    ("room", "count"),
    [
        ((0, 0), (0, 0)),
        ((9, 9), (0, 0)),
        ((1, 1), (1, 0)),
        ((1, 1), (1, 1)),
        ((60, 80), (60, 80)),
        ((70, 200), (60, 80)),
    ],
)
def test_any_mesh(world: World, probe: bytes, room: tuple[int, int], count: tuple[int, int]) -> None:
    random = np.random.default_rng(count[0])
    positions = random.integers(-32768, 32768, (count[0], 3))
    colors = random.integers(0, 1 << 24, count[0])
    faces = random.integers(0, max(count[0], 1), (count[1], 3))
    vertices = [(*position, color) for position, color in zip(positions.tolist(), colors.tolist(), strict=True)]
    packed = made(world, probe, room, vertices, faces.tolist())
    parts = split_mesh(packed)
    assert [tuple(c - 32768 for c in position) for position in parts.positions] == [
        tuple(p) for p in positions.tolist()
    ]
    assert parts.colors == colors.tolist()
    assert parts.faces == [tuple(face) for face in faces.tolist()]
    if count[1]:
        channels = np.stack([colors >> 16, colors >> 8 & 255, colors & 255], axis=1)
        assert packed == pack(Mesh(positions, faces, channels))


@pytest.mark.parametrize(
    ("room", "vertices", "faces", "error"),
    [
        ((65536, 0), [], [], "ModelTooLarge"),
        ((0, 65536), [], [], "ModelTooLarge"),
        ((2, 1), TRIANGLE, [], "TooManyVertices"),
        ((3, 1), TRIANGLE, [(0, 1, 2), (0, 1, 2)], "TooManyFaces"),
        ((3, 1), TRIANGLE, [(0, 1, 3)], "NoSuchVertex"),
        ((3, 1), [(32768, 0, 0, 0)], [], "PositionOutOfRange"),
        ((3, 1), [(0, 0, -32769, 0)], [], "PositionOutOfRange"),
        ((3, 1), [(0, 0, 0, 1 << 24)], [], "NotAColor"),
    ],
)
def test_what_does_not_fit(
    world: World,
    probe: bytes,
    room: tuple[int, int],
    vertices: list[tuple[int, ...]],
    faces: list[tuple[int, ...]],
    error: str,
) -> None:
    with pytest.raises(RenderError, match=refused(error)):
        made(world, probe, room, vertices, faces)


def refused(name: str) -> str:
    """What is said of an error of the library: its name if a compiled contract has it too, else its first bytes."""
    kinds = {
        "ModelTooLarge": "uint256,uint256",
        "PositionOutOfRange": "int256,int256,int256",
        "NoSuchVertex": "uint256,uint256",
        "TextureTexels": "uint256,uint256",
        "TextureCoordinates": "uint256,int256,int256",
    }
    zeros = [0] * (kinds.get(name, "uint256").count(",") + 1)
    return f"{name}|0x" + call_data(f"{name}({kinds.get(name, 'uint256')})", *zeros)[:4].hex()


def test_nothing_is_added_to_what_is_packed(world: World, probe: bytes) -> None:
    with pytest.raises(RenderError, match=refused("TooManyVertices")):
        world.run(probe, call_data("addAfterPacking()"))


def test_a_box_is_closed(world: World, probe: bytes) -> None:
    (packed,) = ask(world, probe, ["bytes"], "box()")
    parts = split_mesh(packed)
    mesh = Mesh(np.array(parts.positions) - 32768, parts.faces)
    assert is_closed(mesh)
    assert mesh.positions.min(axis=0).tolist() == [-10, -20, -30]
    assert mesh.positions.max(axis=0).tolist() == [40, 50, 60]
    assert set(parts.colors) == {0x102030}


def test_a_scene(world: World, probe: bytes) -> None:
    (scene,) = ask(world, probe, [SCENE_STRUCT], "scene(uint256,uint256,uint256)", 5, 3, 2)
    canvas, camera, background, invert, ambient, lights, objects, more = scene
    assert more == b""
    assert canvas == (20, 10)
    assert camera[:3] == ((0, 0, 1000 * ONE), (0, 0, 0), (0, ONE, 0))
    assert abs(camera[4] / ONE - np.tan(np.radians(25))) < 1e-6
    assert (background, invert, ambient) == ((0x2E3648, 0x8892A2), 0, 0xFFFFFF)
    assert lights == ((0, (-ONE, 2 * ONE, 3 * ONE), 0xFFFFFF), (1, (10 * ONE, -20 * ONE, 30 * ONE), 0x808080))
    assert len(objects) == 3
    assert objects[0][4] == (1, ONE // 4, ONE // 2, ONE, 7)
    assert objects[1][4] == (0, ONE, 0, 0, 1)
    assert abs(objects[2][2][1] / ONE - np.sqrt(0.5)) < 1e-6
    assert all(o[0] == bytes(5) and o[3] == ONE and o[5] == 1 for o in objects)


def test_what_the_structs_do_not_hold(world: World, probe: bytes) -> None:
    """In whatever order they are added, their records ascend; the last of an object counts."""
    (scene,) = ask(world, probe, [SCENE_STRUCT], "extended()")
    assert [light[0] for light in scene[5]] == [0, 1, 1]
    numbers = [(0, ONE, -2 * ONE, 90 * ONE // 100, -(50 * ONE // 100)), (-ONE, 0, 0, ONE, ONE)]
    cones = [b"".join(number.to_bytes(8, "big", signed=True) for number in cone) for cone in numbers]
    fog = b"\xc0\xff\xee" + (2 * ONE).to_bytes(8, "big") + (5 * ONE).to_bytes(8, "big")
    effects = b"\4\0\0\0\6\1\2\3\4\5\6" + b"\5\0\0\0\4\7\10\11\4" + b"\6\0\0\0\x13" + fog
    effects += b"\7\0\0\0\5\0\0\x80\0\2"
    spots = b"\1\0\1\0\x28" + cones[0] + b"\1\0\2\0\x28" + cones[1]
    assert scene[7] == spots + b"\2\0\0\0\4\0\x80\0\0" + b"\2\0\2\0\4\0\0\0\0" + b"\3\0\0\0\0" + effects
    call = call_data(f"render({SCENE_STRUCT})", scene)
    assert len(world.run(world.address("Renderer"), call)) > 54 + 3 * 20 * 10


UVS = np.array([[0, 1], [1.5, 1], [1.5, -0.25], [0, -0.25]])
TEXTURED = "textured(uint256,bytes,bytes,int256[2][])"


@pytest.mark.parametrize("colors", [2, 4, 15, 400])
def test_textures(world: World, probe: bytes, colors: int) -> None:
    random = np.random.default_rng(colors)
    palette = random.integers(0, 256, (colors, 3), dtype=np.uint8)
    numbers = np.concatenate([np.arange(min(colors, 15)), random.integers(0, colors, 15)])[:15]
    texture = Texture(palette[numbers].reshape(3, 5, 3) if colors < 16 else palette[:15].reshape(3, 5, 3), "nearest")
    packed = pack_texture(texture, UVS)
    bits = packed[3]
    texels = 4 + (3 << bits)
    content = packed[4:texels], packed[texels : texels + (15 * bits + 7) // 8]
    uvs = np.rint(UVS * 65536).astype(int).tolist()
    (scene,) = ask(world, probe, [SCENE_STRUCT], TEXTURED, 0, *content, uvs)
    words = len(packed) // 32
    assert scene[7] == b"\7\0\0\0\5\0\0\x80\0\2" + bytes([8, 0, 1, 0, words]) + packed
    call = call_data(f"render({SCENE_STRUCT})", scene)
    pixels = world.run(world.address("Renderer"), call)[64 + 54 :][:600]
    assert len(set(pixels)) > 3


def test_textures_that_are_wrong(world: World, probe: bytes) -> None:
    uvs = [[0, 0]] * 4
    for values, name in (
        ((0, bytes(9), bytes(2), uvs), "TexturePalette"),
        ((0, bytes(6), bytes(3), uvs), "TextureTexels"),
        ((0, b"", bytes(15), uvs), "TextureTexels"),
        ((0, b"", bytes(45), [[0, 1 << 23], *uvs[1:]]), "TextureCoordinates"),
    ):
        with pytest.raises(RenderError, match=refused(name)):
            world.run(probe, call_data(TEXTURED, *values))


@pytest.mark.parametrize("count", [7, 8, 32, 33, 64])
def test_opacities(world: World, probe: bytes, count: int) -> None:
    levels = bytes(range(1, count + 1))
    (scene,) = ask(world, probe, [SCENE_STRUCT], "seeThrough(bytes)", levels)
    words = (count + 31) // 32
    expected = b"\2\0\1\0\4\0\x80\0\0" + b"\3\0\0\0\0" + b"\t\0\0\0\1" + bytes(32)
    assert scene[7] == expected + bytes([9, 0, 1, 0, words]) + levels.ljust(32 * words, b"\0")


@pytest.mark.parametrize("spare", [(0, 0), (1, 1), (0, 9), (30, 40)])
def test_two_objects_of_one_model(world: World, probe: bytes, spare: tuple[int, int]) -> None:
    """A model is packed for each: both have its mesh."""
    (expected,) = ask(world, probe, ["bytes"], "box()")
    (scene,) = ask(world, probe, [SCENE_STRUCT], "twoOfOne(uint256,uint256)", *spare)
    assert [o[0] for o in scene[6]] == [expected, expected]


@pytest.mark.parametrize(("counts", "error"), [((2, 3, 0), "TooManyObjects"), ((1, 1, 5), "TooManyLights")])
def test_no_room_for_more(world: World, probe: bytes, counts: tuple[int, int, int], error: str) -> None:
    with pytest.raises(RenderError, match=refused(error)):
        world.run(probe, call_data("scene(uint256,uint256,uint256)", *counts))
