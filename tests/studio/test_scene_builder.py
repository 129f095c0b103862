"""The library with which contracts build scenes."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from eth_abi.abi import encode

from compiler import needs_compiler
from probes import SCENE_STRUCT, Probe
from shackled import Mesh, RenderError, Texture
from shackled.artifacts import artifact
from shackled.ethereum._encoding import keccak256
from shackled.image import decode_bmp
from shackled.scene._decode import read_call
from shackled.scene._packed import pack, pack_texture, unpack
from shackled.scene._staging import Viewpoint, frame, is_closed
from shackled.studio._compact_mesh import split_mesh

ONE = 1 << 32
FULL = "full(uint256,uint256)"
#: What stands in memory behind what is made.
BEHIND = (0x1234567890ABCDEF).to_bytes(32, "big") + (0xFEDCBA0987654321).to_bytes(32, "big")
TRIANGLE = [(0, 0, 0, 1), (9, 0, 0, 2), (0, 9, 0, 3)]

pytestmark = needs_compiler


@pytest.fixture(scope="module")
def probe() -> Probe:
    return Probe("tests/studio/BuilderProbe.sol")


def made(probe: Probe, room: tuple[int, int], vertices: list[tuple[int, ...]], faces: list[tuple[int, ...]]) -> bytes:
    signature = "mesh(uint256,uint256,(int256,int256,int256,uint256)[],uint256[3][])"
    packed, behind = probe.ask(["bytes", "bytes"], signature, *room, vertices, faces)
    assert behind == BEHIND
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
        ((0, 0), (60, 80)),
        ((59, 3), (60, 80)),
    ],
)
def test_any_mesh(probe: Probe, room: tuple[int, int], count: tuple[int, int]) -> None:
    random = np.random.default_rng(count[0])
    positions = random.integers(-32768, 32768, (count[0], 3))
    colors = random.integers(0, 1 << 24, count[0])
    faces = random.integers(0, max(count[0], 1), (count[1], 3))
    vertices = [(*position, color) for position, color in zip(positions.tolist(), colors.tolist(), strict=True)]
    packed = made(probe, room, vertices, faces.tolist())
    parts = split_mesh(packed)
    assert (np.reshape(parts.positions, (-1, 3)) - 32768).tolist() == positions.tolist()
    assert parts.colors == colors.tolist()
    assert parts.faces == [tuple(face) for face in faces.tolist()]
    if count[1]:
        channels = np.stack([colors >> 16, colors >> 8 & 255, colors & 255], axis=1)
        assert packed == pack(Mesh(positions, faces, channels))


@pytest.mark.parametrize(
    ("room", "vertices", "faces", "error"),
    [
        ((65536, 0), [], [], "ModelTooLarge(uint256,uint256)"),
        ((0, 65536), [], [], "ModelTooLarge(uint256,uint256)"),
        ((3, 1), TRIANGLE, [(0, 1, 3)], "NoSuchVertex(uint256,uint256)"),
        ((3, 1), [(32768, 0, 0, 0)], [], "PositionOutOfRange(int256,int256,int256)"),
        ((3, 1), [(0, 0, -32769, 0)], [], "PositionOutOfRange(int256,int256,int256)"),
        ((3, 1), [(0, 0, 0, 1 << 24)], [], "NotAColor(uint256)"),
    ],
)
def test_what_does_not_fit(
    probe: Probe, room: tuple[int, int], vertices: list[tuple[int, ...]], faces: list[tuple[int, ...]], error: str
) -> None:
    with pytest.raises(RenderError, match=refused(error)):
        made(probe, room, vertices, faces)


def refused(error: str) -> str:
    """What is said of an error of the library: its name if a compiled contract has it too, else its first bytes."""
    return rf"error 0x{keccak256(error.encode())[:4].hex()}|: {error.partition('(')[0]}\("


def test_what_is_packed_stays_when_more_is_added(probe: Probe) -> None:
    packed, larger = probe.ask(["bytes", "bytes"], "addAfterPacking()")
    first, both = unpack(packed), unpack(larger)
    assert is_closed(first)
    assert (len(both.positions), len(both.faces)) == (16, 24)
    assert (both.positions == np.tile(first.positions, (2, 1))).all()
    assert (both.faces == np.concatenate([first.faces, first.faces + 8])).all()


def test_a_mesh_grows_until_it_is_full(probe: Probe) -> None:
    (packed,) = probe.ask(["bytes"], FULL, 65535, 65535)
    assert packed == bytes.fromhex("00ffffffff") + 65535 * bytes.fromhex("000100020003000004") + 65535 * bytes(6)
    for counts, error in (((65536, 0), "TooManyVertices(uint256)"), ((1, 65536), "TooManyFaces(uint256)")):
        with pytest.raises(RenderError, match=refused(error)):
            probe.run(FULL, *counts)


def test_a_scene(probe: Probe) -> None:
    scene = probe.scene("scene(uint256,uint256,uint256)", 5, 3, 2)
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


def test_what_the_structs_do_not_hold(probe: Probe) -> None:
    """In whatever order they are added, their records ascend; the last of an object counts."""
    scene = probe.scene("extended()")
    assert [light[0] for light in scene[5]] == [0, 1, 1]
    cosine = round(math.cos(math.radians(22.5)) * ONE)
    numbers = [(0, ONE, -2 * ONE, cosine, -ONE // 2), (-ONE, 0, 0, ONE, -ONE)]
    cones = [b"".join(number.to_bytes(8, "big", signed=True) for number in cone) for cone in numbers]
    fog = b"\xc0\xff\xee" + (2 * ONE).to_bytes(8, "big") + (5 * ONE).to_bytes(8, "big")
    effects = b"\4\0\0\0\6\1\2\3\4\5\6" + b"\5\0\0\0\4\7\10\11\4" + b"\6\0\0\0\x13" + fog
    effects += b"\7\0\0\0\5\0\0\x80\0\2" + b"\14\0\1\0\1" + (0x0A0B0C).to_bytes(32, "big")
    spots = b"\1\0\1\0\x28" + cones[0] + b"\1\0\2\0\x28" + cones[1]
    assert scene[7] == spots + b"\2\0\0\0\4\0\x80\0\0" + b"\2\0\2\0\4\0\0\0\0" + b"\3\0\0\0\0" + effects
    assert len(probe.render(scene)) == 54 + 3 * 20 * 10


UVS = np.array([[0, 1], [1.5, 1], [1.5, -0.25], [0, -0.25]])
TEXTURED = "textured(uint256,bytes,bytes,int256[2][])"


@pytest.mark.parametrize("colors", [2, 4, 15, 400])
def test_textures(probe: Probe, colors: int) -> None:
    random = np.random.default_rng(colors)
    palette = random.integers(0, 256, (colors, 3), dtype=np.uint8)
    numbers = np.concatenate([np.arange(min(colors, 15)), random.integers(0, colors, 15)])[:15]
    texture = Texture(palette[numbers].reshape(3, 5, 3) if colors < 16 else palette[:15].reshape(3, 5, 3), "nearest")
    packed = pack_texture(texture, UVS)
    bits = packed[3]
    texels = 4 + (3 << bits)
    content = packed[4:texels], packed[texels : texels + (15 * bits + 7) // 8]
    uvs = np.rint(UVS * 65536).astype(int).tolist()
    scene = probe.scene(TEXTURED, 0, *content, uvs)
    words = len(packed) // 32
    assert scene[7] == b"\7\0\0\0\5\0\0\x80\0\2" + bytes([8, 0, 1, 0, words]) + packed
    assert len(set(probe.render(scene)[54:][:600])) > 3


def test_textures_that_are_wrong(probe: Probe) -> None:
    uvs = [[0, 0]] * 4
    for values, name in (
        ((0, bytes(9), bytes(2), uvs), "TexturePalette(uint256)"),
        ((0, bytes(6), bytes(3), uvs), "TextureTexels(uint256,uint256)"),
        ((0, b"", bytes(15), uvs), "TextureTexels(uint256,uint256)"),
        ((0, b"", bytes(45), [[0, 1 << 23], *uvs[1:]]), "TextureCoordinates(uint256,int256,int256)"),
    ):
        with pytest.raises(RenderError, match=refused(name)):
            probe.run(TEXTURED, *values)


@pytest.mark.parametrize("count", [7, 8, 32, 33, 64])
def test_opacities(probe: Probe, count: int) -> None:
    levels = bytes(range(1, count + 1))
    scene = probe.scene("seeThrough(bytes)", levels)
    words = (count + 31) // 32
    expected = b"\2\0\1\0\4\0\x80\0\0" + b"\3\0\0\0\0" + b"\t\0\0\0\1" + bytes(32)
    assert scene[7] == expected + bytes([9, 0, 1, 0, words]) + levels.ljust(32 * words, b"\0")


@pytest.mark.parametrize("spare", [(0, 0), (1, 1), (0, 9), (30, 40)])
def test_two_objects_of_one_model(probe: Probe, spare: tuple[int, int]) -> None:
    """A model is packed for each: both have its mesh."""
    expected, _ = probe.ask(["bytes", "bytes"], "addAfterPacking()")
    scene = probe.scene("twoOfOne(uint256,uint256)", *spare)
    assert [o[0] for o in scene[6]] == [expected, expected]


def test_there_is_room_for_any_objects_and_four_lights(probe: Probe) -> None:
    signature = "scene(uint256,uint256,uint256)"
    scene = probe.scene(signature, 0, 30, 4)
    assert [o[4][0] for o in scene[6]] == 15 * [1, 0]
    assert len(scene[5]) == 4
    with pytest.raises(RenderError, match=refused("TooManyLights(uint256)")):
        probe.run(signature, 1, 1, 5)


def stepped(probe: Probe, order: str) -> Any:
    return probe.scene("steps(string)", order)


def test_the_sun_shines_until_other_light_is_added(probe: Probe) -> None:
    """The default sun stands to the upper left of the viewer; it makes room for the first light."""
    for order, (left, up, toward) in (("", (0, 1, 2)), ("l", (2, 1, 0))):
        ((kind, direction, color),) = stepped(probe, order)[5]
        assert (kind, color) == (0, 0xFFFFFF)
        # seen from +x, left is +z
        assert direction[left] * (-1 if not order else 1) > 0
        assert 0 < direction[up] < direction[toward]
    sun, spot = (0, (ONE, 2 * ONE, 3 * ONE), 0xFFFFFF), (1, (ONE, 2 * ONE, 3 * ONE), 0xFFFFFF)
    for order, lights in {"s": (sun,), "ls": (sun,), "ss": (sun, sun), "sl": (sun,), "d": (), "ds": (sun,)}.items():
        assert stepped(probe, order)[5] == lights
    scene = stepped(probe, "t")
    assert scene[5] == (spot,)
    assert scene[7][:5] == b"\1\0\0\0\x28"
    assert stepped(probe, "wts")[7].endswith(b"\n\0\0\0\1" + bytes(31) + b"\1")


@pytest.mark.parametrize(("order", "up"), [("D", -1), ("u", 1)])
def test_cameras_look_straight_down_and_up(probe: Probe, order: str, up: int) -> None:
    scene = stepped(probe, order)
    assert scene[1][2] == (0, 0, up * ONE)
    probe.render(scene)


def test_one_of_several_objects_is_painted(probe: Probe) -> None:
    """Objects may share a mesh; what is painted has its own from then on."""
    scene = stepped(probe, "aaaPL")
    colors = [unpack(o[0]).colors for o in scene[6]]
    assert [{tuple(c) for c in each.tolist()} for each in colors] == [
        {(0xAB, 0xCD, 0xEF)},
        {(0x10, 0x20, 0x30)},
        {(0x12, 0x34, 0x56)},
    ]
    assert len({(o[0][:5], o[0][-72:]) for o in scene[6]}) == 1


def test_fractions(probe: Probe) -> None:
    scene = stepped(probe, "af")
    assert scene[6][0][4] == (2, ONE // 3, ONE // 100, 2 * ONE, 5)
    assert scene[7] == b"\2\0\0\0\4\0\x20\0\0"


#: Steps by the error with which they are refused.
REFUSED = {
    "NoSuchObject(uint256,uint256)": "P L f r",
    "MeshNotPacked(uint256)": "pP",
    "NoLight()": "dw",
    "NothingToFit()": "F an",
    "BoundsUnknown(uint256)": "apF pr",
    "NoRoom(uint256)": "ar",
    "FieldOfViewOutOfRange(int256)": "v i",
    "HeightOutOfRange(int256)": "o",
    "NotOnePerVertex(uint256,uint256)": "aO aU",
    "SpotAnglesOutOfRange(int256,int256)": "1 2",
    "SpotOutOfRange(uint256,int256,int256,int256)": "3",
    "NotAColor(uint256)": "4 5",
    "RimPowerOutOfRange(uint256)": "6",
    "FogOutOfRange(int256,int256)": "7",
    "ExposureOutOfRange(uint256)": "8",
    "OpacityOutOfRange(uint256,uint256)": "a9",
    "GroundOutOfRange(uint256,uint256,uint256)": "g",
    "TextureFormat(uint256,uint256,uint256)": "ax",
}


@pytest.mark.parametrize(("order", "error"), [(order, error) for error in REFUSED for order in REFUSED[error].split()])
def test_steps_that_are_refused(probe: Probe, order: str, error: str) -> None:
    with pytest.raises(RenderError, match=refused(error)):
        stepped(probe, order)


def test_scenes_from_elsewhere_go_on(probe: Probe) -> None:
    """There is no room in memory behind their objects and lights, and nothing there is overwritten."""
    given = stepped(probe, "aass")
    scene, behind = probe.ask([SCENE_STRUCT, "bytes"], f"continued({SCENE_STRUCT})", given)
    assert behind == BEHIND
    assert scene[:5] == given[:5]
    assert scene[5] == given[5] + given[5][:1]
    assert scene[6][:2] == given[6]
    assert scene[6][2][0] == bytes(5)


@pytest.mark.parametrize(
    ("length", "scale"), [(1500, (1, 10)), (3000, (1, 10)), (1000, (1, 1000)), (1000, (1, 100000))]
)
def test_long_and_small_objects_are_in_view(probe: Probe, length: int, scale: tuple[int, int]) -> None:
    """A pyramid and a bar, seen from their ends with the eye close by: nothing is clipped, at any scale."""
    square = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    for near, far in ((0, 300), (2, 2)):
        corners = [(far * x, far * y, 0) for x, y in square] + [(near * x, near * y, length) for x, y in square]
        sides = [(k, (k + 1) % 4, 4 + (k + 1) % 4) for k in range(4)] + [(k, 4 + (k + 1) % 4, 4 + k) for k in range(4)]
        mesh = pack(Mesh(corners, [*sides, (4, 5, 6), (4, 6, 7)]))
        scene = probe.scene("alone(bytes,int256,int256,int256[3])", mesh, *scale, [0, 0, 1])
        white = decode_bmp(probe.render(scene), 64, 64)[..., 0] == 255
        rows, columns = np.nonzero(white)
        # whole, symmetric, in the middle
        assert white.sum() == (rows.max() - rows.min() + 1) * (columns.max() - columns.min() + 1) > 0
        assert (rows.min() + rows.max(), columns.min() + columns.max()) == (63, 63)


@pytest.mark.parametrize("tenths", [0, 500, 225])
@pytest.mark.parametrize("toward", [(0, 0, 1), (1, 2, 3), (-3, -2, -1), (0, 1, 0)])
def test_cameras_fit_objects(probe: Probe, tenths: int, toward: tuple[int, int, int]) -> None:
    """They stand where `frame` of Python puts them, as near as all vertices fit the picture."""
    random = np.random.default_rng(1)
    meshes = [Mesh(random.integers(-300, 300, (9, 3)), [[0, 1, 2]]) for _ in range(3)]
    packed = [pack(mesh) for mesh in meshes]
    signature = "fitted(bytes[],int256,int256[3])"
    scene = probe.scene(signature, [*packed, bytes(5)], tenths, list(toward))
    # the last object has no vertices
    scene = (*scene[:6], scene[6][:3], scene[7])
    found = read_call(artifact("Renderer").selectors["render"] + encode([SCENE_STRUCT], [scene]))
    camera = found.camera
    points = np.concatenate([o.world_positions() for o in found.objects])
    x, y, z = toward
    view = Viewpoint(
        math.degrees(math.atan2(x, z)),
        math.degrees(math.atan2(y, math.hypot(x, z))),
        projection="perspective" if tenths else "orthographic",
        half_height=math.tan(math.radians(tenths / 20)) if tenths else 1.0,
        aspect=1.5,
    )
    expected = frame(points, view)
    assert camera.half_height == pytest.approx(expected.half_height, rel=1e-6)
    if tenths:
        assert camera.eye == pytest.approx(expected.eye, abs=0.01)
    assert camera.target == pytest.approx(expected.target, abs=0.01)
    direction = (camera.eye - camera.target) / np.linalg.norm(camera.eye - camera.target)
    assert direction == pytest.approx(np.array(toward) / np.linalg.norm(toward), abs=1e-6)


def test_objects_are_placed_in_boxes(probe: Probe) -> None:
    """As large as they fit, in the middle; those whose mesh is stored by the bounds that are given."""
    mesh = pack(Mesh([[0, 0, 0], [400, 0, 0], [0, 100, 300]], [[0, 1, 2]]))
    room = [90, 10, -10, -10, 110, 70]
    signature = "placed(bytes,int256[3][2],int256[6])"
    scene = probe.scene(signature, mesh, [[-10, 0, 0], [10, 10, 5]], room)
    first, second = scene[6]
    # turned about y by 90 degrees: 300 by 100 by 400 in 100 by 100 by 80
    assert first[3] / ONE == pytest.approx(0.2)
    assert np.array(first[1]) / ONE == pytest.approx([40 - 30, 60 - 10, 30 + 40], abs=1e-4)
    assert second[3] / ONE == pytest.approx(5)
    assert np.array(second[1]) / ONE == pytest.approx([40, 60 - 25, 30 - 12.5], abs=1e-4)
