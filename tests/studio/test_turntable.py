"""Animated PNG files: the contract against a model, byte for byte, and both against Pillow."""

from __future__ import annotations

import base64
import io
import struct
import zlib
from typing import Any

import numpy as np
import pytest
from attrs import evolve
from eth_abi.abi import decode, encode
from PIL import Image as PillowImage
from tools.ledger import World, call_data
from tools.png_code import SIGNATURE, encode_png

from pictures import frames_of
from shackled import Background, Camera, Light, Material, Mesh, Object, RenderError, Scene, render
from shackled.artifacts import artifact
from shackled.chain import open_chain
from shackled.ethereum._encoding import word
from shackled.image import decode_bmp
from shackled.scene._arithmetic import from_euler
from shackled.scene._codec import encode_scene
from shackled.scene._in_range import in_range
from shackled.scene._packed import pack
from stored_scenes import CHANGES, SCENE_STRUCT, Pixels, changes, stored, turned

SPIN = "(uint256,uint256,uint256,(int256,int256,int256),bool)"
ONE = 1 << 32
UPRIGHT = (0, ONE, 0)
TENT = Mesh([[-90, 0, 0], [90, 0, 0], [0, 150, 40]], [[0, 1, 2]], [[255, 0, 0], [0, 255, 0], [0, 0, 255]])
BOARD = Mesh([[-60, -9, 30], [60, -9, 0], [60, 9, 0], [-60, 9, 0]], [[0, 1, 2], [0, 2, 3]])
SCENE = Scene(
    [
        Object(TENT, (0, -100, 0), material=Material("flat", 0.25, 0.75, 0.5, 16), cull=False),
        Object(BOARD, (50, 20, 200), from_euler((0, 30, 0)), 0.5, cull=False),
    ],
    Camera((200, 250, 900), (0, 40, 0)),
    [Light("directional", (-1, 2, 3))],
    Background("#102040", "#a0b0c0"),
    width=31,
    height=24,
)


def data_of(
    scene: Scene, frames: int = 4, delay: int = 80, scale: int = 1, axis: object = UPRIGHT, hold: bool = False
) -> bytes:
    """Data of a call of `animate`."""
    values = encode([SPIN], [(frames, delay, scale, axis, hold)])
    return artifact("Turntable").selectors["animate"] + word(256) + values + encode_scene(in_range(scene))


def animate(scene: Scene, **spin: Any) -> bytes:
    output = open_chain().call("Turntable", data_of(scene, **spin)).output
    return bytes(decode(["bytes"], output)[0])


def chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def model(pictures: list[Pixels], delay: int, scale: int) -> bytes:
    """The file, as the specification has it."""
    height, width, _ = pictures[0].shape
    sides = struct.pack(">II", width * scale, height * scale)
    parts = [SIGNATURE, chunk(b"IHDR", sides + b"\x08\x02\0\0\0"), chunk(b"acTL", struct.pack(">II", len(pictures), 0))]
    sequence = 0
    for number, pixels in enumerate(pictures):
        control = struct.pack(">I", sequence) + sides + struct.pack(">IIHHBB", 0, 0, delay, 1000, 0, 0)
        parts.append(chunk(b"fcTL", control))
        data = encode_png(pixels, scale)[41:-16]
        parts.append(chunk(b"fdAT", struct.pack(">I", sequence + 1) + data) if number else chunk(b"IDAT", data))
        sequence += 2 if number else 1
    return b"".join([*parts, chunk(b"IEND", b"")])


@pytest.mark.parametrize(("count", "delay", "scale"), [(2, 20, 1), (5, 10_000, 2), (8, 77, 3), (12, 100, 8)])
def test_each_frame_is_the_scene_turned(world: World, count: int, delay: int, scale: int) -> None:
    pointer = stored(world, SCENE)
    pictures: list[Pixels] = []
    for step in range(count):
        angle = step * 360 * ONE // count
        turn = world.chain.ask("Renderer", "eulerRotation", 0, angle, 0)
        bmp = world.call("Studio", f"render(address,{CHANGES})", pointer, changes(fields=1, turn=turn))
        pictures.append(decode_bmp(bmp, 31, 24))
    spin = (count, delay, scale, UPRIGHT, False)
    png = world.call("Studio", f"animate(address,{SPIN})", pointer, spin)
    assert png == model(pictures, delay, scale)
    assert np.array_equal(pictures[0], render(SCENE).pixels)
    for found, expected in zip(frames_of(png), pictures, strict=True):
        assert np.array_equal(found, expected.repeat(scale, 0).repeat(scale, 1))
    with PillowImage.open(io.BytesIO(png)) as file:
        assert (file.info["loop"], file.info["duration"]) == (0, delay)
    uri = world.call("Studio", f"animateDataURI(address,{SPIN})", pointer, spin)
    assert uri == "data:image/png;base64," + base64.b64encode(png).decode()


def test_changes_come_first(world: World) -> None:
    pointer = stored(world, SCENE)
    red = changes(fields=16 + 4, background=(0xFF0000, 0xFF0000), canvas=(16, 8))
    spin = (3, 50, 2, UPRIGHT, False)
    png = world.call("Studio", f"animate(address,{SPIN},{CHANGES})", pointer, spin, red)
    expected = render(evolve(SCENE, width=16, height=8, background=Background("#ff0000"))).pixels
    assert np.array_equal(frames_of(png)[0][::2, ::2], expected)
    uri = world.call("Studio", f"animateDataURI(address,{SPIN},{CHANGES})", pointer, spin, red)
    assert uri == "data:image/png;base64," + base64.b64encode(png).decode()


@pytest.mark.parametrize("axis", [(1, 0, 0), (0, 0, -1), (2, -3, 1)])
def test_any_axis(axis: tuple[int, int, int]) -> None:
    """Of any length; the middle is that of the Studio's turns."""
    near = evolve(SCENE, camera=Camera((100, 120, 450), (0, 0, 80)), width=64, height=48)
    short = animate(near, axis=tuple(part * (ONE >> 16) for part in axis), frames=3)
    assert short == animate(near, axis=tuple(part * ONE * 1000 for part in axis), frames=3)
    found = frames_of(short)
    length = np.linalg.norm(axis)
    covered = 0
    for step, pixels in enumerate(found):
        half = np.pi * step / 3
        q = np.array([*(np.sin(half) * np.array(axis) / length), np.cos(half)])
        expected = render(turned(near, q))
        covered += expected.covered_pixels or 0
        assert (np.abs(pixels.astype(int) - expected.pixels).max(axis=2) > 3).mean() < 0.02
    assert covered > 60


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("projection", ["perspective", "orthographic"])
def test_nothing_leaves_the_picture(seed: int, projection: str) -> None:
    """The camera moves back as far as it must, and not much farther."""
    rng = np.random.default_rng(seed)
    cloud = Mesh(rng.integers(-200, 200, (12, 3)), rng.permutation(12).reshape(4, 3))
    objects = [
        Object(cloud, rng.uniform(-300, 300, 3), from_euler(rng.uniform(0, 360, 3)), 1.3, Material("unlit"), cull=False)
        for _ in range(2)
    ]
    size = (40, 30) if seed % 2 else (30, 40)
    away = rng.normal(0, 1, 3)
    view = Camera(away * 500 / np.linalg.norm(away), (0, 0, 0))
    if projection == "orthographic":
        view = evolve(view, projection=projection, half_height=100.0)
    scene = Scene(objects, view, background=Background("#000001"), width=size[0], height=size[1])
    axis = tuple(int(part) for part in rng.normal(0, ONE, 3))
    still, held = (frames_of(animate(scene, frames=24, axis=axis, hold=hold)) for hold in (False, True))
    covered = [np.any([(each != (0, 0, 1)).any(axis=2) for each in film], axis=0) for film in (still, held)]
    border = np.ones(covered[0].shape, bool)
    border[1:-1, 1:-1] = False
    assert (covered[0] & border).any()
    assert not (covered[1] & border).any()
    # of half of the picture 8 % are free, between the pictures of the film something less is covered
    assert (covered[1][5:-5, 5:-5].sum()) < covered[1].sum()


def test_a_camera_that_shows_everything_stays() -> None:
    for camera in (Camera((0, 0, 2000), (0, 0, 0)), Camera((0, 0, 900), (0, 0, 0), (0, 1, 0), "orthographic", 900.0)):
        scene = evolve(SCENE, camera=camera)
        assert animate(scene, hold=True) == animate(scene)


def test_a_scene_without_objects() -> None:
    for camera in (SCENE.camera, evolve(SCENE.camera, projection="orthographic", half_height=9.0)):
        first, second = frames_of(animate(Scene([], evolve(camera, near=1), width=8, height=8), frames=2, hold=True))
        assert np.array_equal(first, second)


def test_wide_meshes_are_held() -> None:
    wide = Mesh(np.asarray(BOARD.positions) * 900, BOARD.faces)
    scene = Scene([Object(wide, scale=1 / 900, cull=False)], Camera((0, 0, 100), (0, 0, 0)), width=24, height=24)
    narrow = evolve(scene, objects=[Object(BOARD, cull=False)])
    assert pack(wide, False)[0] == 2
    found, expected = (np.stack(frames_of(animate(each, hold=True))).astype(int) for each in (scene, narrow))
    assert (np.abs(found - expected).max(axis=3) > 8).mean() < 0.01


@pytest.mark.parametrize(
    ("spin", "error"),
    [
        ({"frames": 1}, "FramesOutOfRange(frames=1, least=2, most=360)"),
        ({"frames": 361}, "FramesOutOfRange(frames=361, least=2, most=360)"),
        ({"delay": 19}, "DelayOutOfRange(delay=19, least=20, most=10000)"),
        ({"delay": 1 << 255}, f"DelayOutOfRange(delay={1 << 255}, least=20, most=10000)"),
        ({"scale": 9}, "PixelScaleOutOfRange(scale=9, largest=8)"),
        ({"axis": (0, 0, 0)}, "AxisOutOfRange()"),
        ({"axis": (0, 0, (1 << 58) + 1)}, "AxisOutOfRange()"),
    ],
)
def test_what_is_refused(spin: dict[str, Any], error: str) -> None:
    with pytest.raises(RenderError) as caught:
        animate(SCENE, **spin)
    assert error in str(caught.value)


@pytest.mark.parametrize("hold", [False, True])
@pytest.mark.parametrize(
    ("change", "error"),
    [
        (lambda s: (*s[:6], [(s[6][0][0], ((1 << 255) - 1, 0, 0), *s[6][0][2:])], s[7]), "PositionOutOfRange(object=0"),
        (lambda s: (*s[:6], [(*s[6][0][:2], (0, 0, 0, 0), *s[6][0][3:])], s[7]), "RotationIsZero(object=0)"),
        (lambda s: ((0, 4), *s[1:]), "CanvasSize(width=0, height=4)"),
        (lambda s: (s[0], (s[1][0], s[1][0], *s[1][2:]), *s[2:]), "NoViewDirection()"),
        (lambda s: (s[0], ((1 << 254, 0, 0), *s[1][1:]), *s[2:]), "CameraOutOfRange"),
        (lambda s: (s[0], (*s[1][:4], 0, s[1][5]), *s[2:]), "HalfHeightOutOfRange(halfHeight=0)"),
        (lambda s: (*s[:6], [(b"", *s[6][0][1:])], s[7]), "MeshHeader(object=0"),
        (lambda s: (*s[:6], [(*s[6][0][:3], 1 << 200, *s[6][0][4:])], s[7]), "ScaleOutOfRange(object=0"),
    ],
)
def test_a_scene_that_cannot_be_drawn_is_refused(change: Any, error: str, hold: bool) -> None:
    """With the error of the renderer, whatever is computed before."""
    (struct_,) = decode([SCENE_STRUCT], word(32) + encode_scene(in_range(SCENE)))
    data = call_data(f"animate({SCENE_STRUCT},{SPIN})", change(struct_), (2, 50, 1, UPRIGHT, hold))
    with pytest.raises(RenderError) as caught:
        open_chain().call("Turntable", data)
    assert error in str(caught.value)
