"""Scenes in PNG files."""

from __future__ import annotations

import tracemalloc
import zlib
from pathlib import Path

import numpy as np
import pytest
from attrs import evolve
from PIL import Image as PillowImage
from PIL.PngImagePlugin import PngInfo

from mesh_files import refusal
from shackled import Image, InputError, Mesh, Scene, load, render
from shackled.scene import stage
from shackled.scene._codec import render_call
from shackled.scene._files.picture import LONGEST_TEXT, scene_chunk

SCENE = load("icons/coin", 24)
CALL = b"0x" + render_call(SCENE).hex().encode()


HOLDS_NONE = "its chunk shackled holds no scene: it must be 0x and the call in hexadecimal, deflated"
NOT_ONE = "the picture carries no scene: it needs one chunk zTXt with it, and has "
PACKED = zlib.compress(CALL)


@pytest.fixture(scope="module")
def picture() -> bytes:
    return render(SCENE).encode(".png")


def chunks(data: bytes) -> list[tuple[bytes, bytes]]:
    found, place = [], 8
    while place < len(data):
        size = int.from_bytes(data[place : place + 4], "big")
        found.append((data[place + 4 : place + 8], data[place + 8 : place + 8 + size]))
        place += 12 + size
    return found


def png(*parts: tuple[bytes, bytes]) -> bytes:
    """A PNG file of one pixel with these chunks between its header and its pixels."""
    head = (b"IHDR", bytes([0, 0, 0, 1, 0, 0, 0, 1, 8, 2, 0, 0, 0]))
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        len(content).to_bytes(4, "big") + kind + content + zlib.crc32(kind + content).to_bytes(4, "big")
        for kind, content in (head, *parts, (b"IDAT", zlib.compress(bytes(4))), (b"IEND", b""))
    )


def text(content: bytes, keyword: bytes = b"shackled", method: bytes = b"\0") -> tuple[bytes, bytes]:
    return b"zTXt", keyword + b"\0" + method + zlib.compress(content)


def test_the_same_call_and_the_same_picture(tmp_path: Path, picture: bytes) -> None:
    path = tmp_path / "X.PNG"
    path.write_bytes(picture)
    for scene in (load(path), load(str(path))):
        assert render_call(scene) == render_call(SCENE)
    again = render(path)
    assert again.pixels.tobytes() == render(SCENE).pixels.tobytes()
    assert again.encode(".png") == picture
    assert load(path, 50, background="white").width == 50


def test_anybody_can_read_it(tmp_path: Path, picture: bytes) -> None:
    path = tmp_path / "x.png"
    path.write_bytes(picture)
    with PillowImage.open(path) as opened:
        assert opened.text == {"shackled": CALL.decode()}  # type: ignore[attr-defined]
    assert [kind for kind, _ in chunks(picture)] == [b"IHDR", b"zTXt", b"IDAT", b"IEND"]


def test_anybody_can_write_it(tmp_path: Path) -> None:
    path = tmp_path / "x.png"
    texts = PngInfo()
    texts.add_text("Title", "a coin")
    texts.add_text("shackled", CALL.decode(), zip=True)
    PillowImage.new("L", (3, 2)).save(path, pnginfo=texts)
    assert render_call(load(path)) == render_call(SCENE)
    path.write_bytes(png(text(b"0x" + CALL[2:].upper())) + b"what follows the end of a picture is no part of it")
    assert render_call(load(path)) == render_call(SCENE)


def test_pixels_are_not_decoded(tmp_path: Path) -> None:
    path = tmp_path / "x.png"
    huge = png(text(CALL)).replace(bytes([0, 0, 0, 1, 0, 0, 0, 1, 8]), b"\x7f\xff\xff\xff" * 2 + b"\x08")
    path.write_bytes(huge[:29] + zlib.crc32(huge[12:29]).to_bytes(4, "big") + huge[33:])
    assert render_call(load(path)) == render_call(SCENE)


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"GIF89a", "it is not a PNG file"),
        (png(text(CALL, b"shackled2")), NOT_ONE + "none"),
        (png(text(CALL), (b"tEXt", b"shackled\0" + CALL)), NOT_ONE + "zTXt, tEXt"),
        (png((b"iTXt", b"shackled\0\0\0\0\0" + CALL)), NOT_ONE + "iTXt"),
        *(
            (png((b"zTXt", b"shackled" + content)), HOLDS_NONE)
            for content in (
                b"\0", b"\0\0", b"\0\1" + PACKED, b"\0\0" + PACKED[:-5], b"\0\0" + PACKED + b"\0",
                b"\0\0" + PACKED[:-1] + b"\0", b"\0\0no zlib",
            )
        ),
        *((png(text(content)), HOLDS_NONE) for content in (b"", b"0xzz", CALL[:-1], CALL[2:])),
        (png(text(b"0x12345678")), "the chunk shackled: it is no call of render"),
        (png(text(CALL + b"00")), "the chunk shackled: the call is not the one that Shackled makes"),
        *((png(text(CALL))[:end], "the picture is cut off") for end in (-12, 60, 8)),
        (png(text(CALL)).replace(b"shackled", b"shackles"), "checksum of its chunk b'zTXt' is wrong"),
    ],
)  # fmt: skip
def test_refusals(data: bytes, message: str, tmp_path: Path) -> None:
    assert message in refusal(tmp_path / "x.png", data, load)


def test_a_bomb_is_not_inflated(tmp_path: Path) -> None:
    bomb = png((b"zTXt", b"shackled\0\0" + zlib.compress(bytes(200_000_000))))
    tracemalloc.start()
    try:
        message = refusal(tmp_path / "x.png", bomb, load)
        assert tracemalloc.get_traced_memory()[1] < 4 * LONGEST_TEXT
    finally:
        tracemalloc.stop()
    assert message == "its scene has more than 8,000,000 characters, the most that are read"


def test_a_bomb_of_objects_is_not_built(tmp_path: Path) -> None:
    """Many objects that share one mesh."""
    call = bytearray(render_call(evolve(SCENE, lights=[], objects=[SCENE.objects[0]])))
    place = 4 + 32 * (1 + 21 + 1)
    assert int.from_bytes(call[place : place + 32], "big") == 1
    call[place : place + 32] = (50_000).to_bytes(32, "big")
    call[place + 32 : place + 64] = (32 * 50_000).to_bytes(32, "big") * 50_000
    assert "cut off" in refusal(tmp_path / "x.png", png(text(b"0x" + bytes(call).hex().encode())), load)


def large_scene(triangles: int) -> Scene:
    rng = np.random.default_rng(5)
    positions = rng.integers(-30_000, 30_000, (triangles, 3))
    return stage(Mesh(positions, rng.integers(0, triangles, (triangles, 3))), 8)


def test_a_large_scene_is_written_only_when_asked_for(tmp_path: Path) -> None:
    scene = large_scene(6000)
    image = Image(np.zeros((8, 8, 3), np.uint8), scene=scene)
    assert b"zTXt" not in dict(chunks(image.encode(".png")))
    image.save(tmp_path / "x.png", scene=True)
    assert render_call(load(tmp_path / "x.png")) == render_call(scene)
    # few bytes when compressed, but Pillow would refuse to open the picture
    scene = load(Mesh([[0, 0, 0], [9, 0, 0], [0, 9, 0]], [[0, 1, 2]] * 40_000), 8)
    chunk = scene_chunk(evolve(scene, objects=scene.objects * 3))
    assert len(chunk.data) < 2**16
    assert not chunk.is_small


def test_a_huge_scene_is_not_written() -> None:
    scene = evolve(large_scene(60_000), width=8)
    image = Image(np.zeros((8, 8, 3), np.uint8), scene=evolve(scene, objects=scene.objects * 5))
    with pytest.raises(InputError, match="too large for a PNG file"):
        image.encode(".png", scene=True)


def test_without(picture: bytes) -> None:
    image = render(SCENE)
    plain = image.encode(".png", scene=False)
    assert [part for part in chunks(picture) if part[0] != b"zTXt"] == chunks(plain)
    assert Image(image.pixels).encode(".png") == plain
    with pytest.raises(InputError, match="cannot carry its scene, which is not known"):
        Image(image.pixels).encode(".png", scene=True)


@pytest.mark.parametrize("extension", [".bmp", ".svg", ".gif"])
def test_other_formats_carry_none(extension: str) -> None:
    with pytest.raises(InputError, match=f"only a .png file carries its scene, not {extension}"):
        Image(np.zeros((8, 8, 3), np.uint8), scene=SCENE).encode(extension, scene=True)
