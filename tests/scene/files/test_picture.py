"""Scenes in PNG files."""

from __future__ import annotations

import re
import tracemalloc
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from attrs import evolve
from PIL import Image as PillowImage
from PIL.PngImagePlugin import PngInfo

from shackled import Image, InputError, Mesh, Scene, load, render
from shackled.scene import read_scene, render_call, scene_chunk, stage
from shackled.scene._files.picture import LONGEST_TEXT

SCENE = load("icons/coin", 24)
CALL = b"0x" + render_call(SCENE).hex().encode()


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


def refusal(tmp_path: Path, data: bytes) -> str:
    path = tmp_path / "x.png"
    path.write_bytes(data)
    with pytest.raises(InputError) as error:
        load(path)
    message = str(error.value)
    assert "\n" not in message
    assert message.startswith(f"{path}: ")
    return message.removeprefix(f"{path}: ")


def test_the_same_call_and_the_same_picture(tmp_path: Path, picture: bytes) -> None:
    path = tmp_path / "X.PNG"
    path.write_bytes(picture)
    for scene in (load(path), load(str(path)), read_scene(path)):
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
    path.write_bytes(png(text(CALL.replace(b"0x", b"0X").upper().replace(b"0X", b"0x"))))
    assert render_call(load(path)) == render_call(SCENE)
    path.write_bytes(png(text(CALL)) + b"what follows the end of a picture is no part of it")
    assert render_call(load(path)) == render_call(SCENE)


def test_pixels_are_not_decoded(tmp_path: Path) -> None:
    path = tmp_path / "x.png"
    huge = png(text(CALL)).replace(bytes([0, 0, 0, 1, 0, 0, 0, 1, 8]), b"\x7f\xff\xff\xff" * 2 + b"\x08")
    head = huge[12:29]
    path.write_bytes(huge[:29] + zlib.crc32(head).to_bytes(4, "big") + huge[33:])
    assert load(path) == load_of(CALL, tmp_path)


def load_of(content: bytes, folder: Path) -> Scene:
    (folder / "y.png").write_bytes(png(text(content)))
    return load(folder / "y.png")


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"GIF89a", "it is not a PNG file"),
        (png(), "the picture carries no scene: it has no chunk zTXt with the keyword shackled"),
        (png(text(CALL, b"Shackled")), "carries no scene"),
        (png(text(CALL, b"shackled2")), "carries no scene"),
        (png(text(CALL), text(CALL)), "carries 2 scenes"),
        (png(text(CALL), (b"tEXt", b"shackled\0" + CALL)), "carries 2 scenes"),
        (png((b"iTXt", b"shackled\0\0\0\0\0" + CALL)), "in a chunk iTXt, not zTXt"),
        (png((b"tEXt", b"shackled\0" + CALL)), "in a chunk tEXt, not zTXt"),
        (png(text(CALL, method=b"\1")), "compressed by an unknown method"),
        (png((b"zTXt", b"shackled\0")), "compressed by an unknown method"),
        (png((b"zTXt", b"shackled\0\0")), "its scene is cut off"),
        (png((b"zTXt", b"shackled\0\0" + zlib.compress(CALL)[:-5])), "its scene is cut off"),
        (png((b"zTXt", b"shackled\0\0" + zlib.compress(CALL) + b"\0")), "is followed by other bytes"),
        (png((b"zTXt", b"shackled\0\0" + zlib.compress(CALL)[:-1] + b"\0")), "cannot be decompressed"),
        (png((b"zTXt", b"shackled\0\0no zlib")), "cannot be decompressed"),
        (png(text(b"")), "holds no scene: its text must be 0x and the call in hexadecimal"),
        (png(text(b"bound hand and foot")), "holds no scene"),
        (png(text(b"0x" + b"zz")), "holds no scene"),
        (png(text(CALL[:-1])), "holds no scene"),
        (png(text(CALL[2:])), "holds no scene"),
        (png(text(CALL.replace(b"00", b"0 0", 1))), "holds no scene"),
        (png(text(b"0x12345678")), "the chunk shackled: it is no call of render"),
        (png(text(CALL + b"00")), "the chunk shackled: 1 bytes follow the scene"),
        (png(text(CALL))[:-12], "the picture is cut off"),
        (png(text(CALL))[:60], "the picture is cut off"),
        (png(text(CALL))[:8], "the picture is cut off"),
        (png(text(CALL)).replace(b"shackled", b"shackles"), "checksum of its chunk b'zTXt' is wrong"),
    ],
)
def test_refusals(data: bytes, message: str, tmp_path: Path) -> None:
    assert message in refusal(tmp_path, data)


def test_a_bomb_is_not_inflated(tmp_path: Path) -> None:
    bomb = png((b"zTXt", b"shackled\0\0" + zlib.compress(bytes(200_000_000))))
    tracemalloc.start()
    try:
        message = refusal(tmp_path, bomb)
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
    assert "must follow" in refusal(tmp_path, png(text(b"0x" + bytes(call).hex().encode())))


def test_missing_and_empty(tmp_path: Path) -> None:
    path = tmp_path / "x.png"
    with pytest.raises(InputError, match="does not exist"):
        load(path)
    path.write_bytes(b"")
    with pytest.raises(InputError, match="is empty"):
        load(path)
    (tmp_path / "folder.png").mkdir()
    with pytest.raises(InputError, match="a mesh or scene file is needed"):
        load(tmp_path / "folder.png")


def large_scene(triangles: int) -> Scene:
    rng = np.random.default_rng(5)
    positions = rng.integers(-30_000, 30_000, (triangles, 3))
    return stage(Mesh(positions, rng.integers(0, triangles, (triangles, 3))), 8)


def test_a_large_scene_is_written_only_when_asked_for(tmp_path: Path) -> None:
    scene = large_scene(6000)
    image = Image(np.zeros((8, 8, 3), np.uint8), scene=scene)
    assert not scene_chunk(scene).is_small
    assert b"zTXt" not in dict(chunks(image.encode(".png")))
    image.save(tmp_path / "x.png", scene=True)
    assert render_call(load(tmp_path / "x.png")) == render_call(scene)


def test_a_long_text_is_written_only_when_asked_for() -> None:
    """Few bytes when compressed, but Pillow would refuse to open the picture."""
    scene = load(Mesh([[0, 0, 0], [9, 0, 0], [0, 9, 0]], [[0, 1, 2]] * 40_000), 8)
    chunk = scene_chunk(evolve(scene, objects=scene.objects * 3))
    assert len(chunk.data) < 2**16
    assert not chunk.is_small


def test_a_huge_scene_is_not_written() -> None:
    scene = evolve(large_scene(60_000), width=8)
    scene = evolve(scene, objects=scene.objects * 5)
    image = Image(np.zeros((8, 8, 3), np.uint8), scene=scene)
    assert b"zTXt" not in dict(chunks(image.encode(".png")))
    with pytest.raises(InputError, match=re.escape("too large for a PNG file")):
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
    image: Any = Image(np.zeros((8, 8, 3), np.uint8), scene=SCENE)
    assert image.encode(extension, scene=False) == image.encode(extension)
    with pytest.raises(InputError, match=f"only a .png file carries its scene, not {extension}"):
        image.encode(extension, scene=True)
