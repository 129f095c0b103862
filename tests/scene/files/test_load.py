import os
import tracemalloc
from pathlib import Path

import numpy as np
import pytest

from mesh_files import refusal
from shackled import load
from shackled.scene._files.content import MAX_BYTES

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


def test_a_mesh_is_staged(tmp_path: Path) -> None:
    (tmp_path / "a.OBJ").write_text(TRIANGLE)
    scene = load(tmp_path / "a.OBJ", (30, 20))
    assert (scene.width, scene.height, scene.lights) == (30, 20, load(tmp_path / "a.OBJ").lights)
    assert (load(str(tmp_path / "a.OBJ")).width, len(scene.lights)) == (256, 1)


def test_a_byte_order_mark_does_no_harm(tmp_path: Path) -> None:
    (tmp_path / "a.toml").write_bytes(b"\xef\xbb\xbfsize = 9\n")
    assert load(tmp_path / "a.toml").width == 9


@pytest.mark.parametrize("extension", ["obj", "ply", "stl", "glb", "gltf", "off", "toml", "json", "png"])
def test_what_is_no_file_of_its_kind(tmp_path: Path, extension: str) -> None:
    path = tmp_path / f"a.{extension}"
    assert refusal(path, read=load) == " does not exist"
    for content in (b"", b"\n \n"):
        path.write_bytes(content)
        assert refusal(path, read=load) == " is empty"
    for seed in range(5):
        path.write_bytes(np.random.default_rng(seed).bytes(1 + 700 * seed))
        refusal(path, read=load)
    path.unlink()
    path.mkdir()
    assert refusal(path, read=load) == " is a directory; a mesh or scene file is needed"


def test_unknown_extension(tmp_path: Path) -> None:
    known = ".obj, .ply, .stl, .glb, .gltf, .off, .toml, .json, .png"
    path = tmp_path / "a.3mf"
    assert refusal(path, read=load) == f" is neither a mesh nor a scene file by its extension; known are {known}"
    assert refusal(tmp_path, read=load) == f" is a directory; a mesh or scene file is needed: {known}"


@pytest.mark.skipif(os.geteuid() == 0 if hasattr(os, "geteuid") else True, reason="root may read everything")
def test_forbidden(tmp_path: Path) -> None:
    path = tmp_path / "a.obj"
    path.write_text(TRIANGLE)
    path.chmod(0)
    assert refusal(path, read=load) == " cannot be read: Permission denied"


def test_a_path_that_cannot_be() -> None:
    assert refusal(Path("a\0.obj"), read=load).endswith("cannot be read: embedded null byte")


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("a.toml", "size = 3\nsize = 4\n", " is not valid TOML: "),
        ("a.json", '{"size": 3', " is not valid JSON: "),
        ("a.json", "[" * 100_000, " is not valid JSON: "),
        ("a.json", "[1, 2]", " must hold an object with the keys of a scene, not [1, 2]"),
    ],
)
def test_wrong_toml_and_json(tmp_path: Path, name: str, text: str, message: str) -> None:
    (tmp_path / name).write_text(text)
    assert refusal(tmp_path / name, read=load).startswith(message)


def test_a_file_that_is_too_large_is_not_read(tmp_path: Path) -> None:
    path = tmp_path / "huge.obj"
    with path.open("wb") as file:
        file.truncate(MAX_BYTES + 2**20)  # a hole: it takes no place on the disk
    tracemalloc.start()
    try:
        assert refusal(path, read=load) == " has 257 MB; files up to 256 MB are read"
        assert tracemalloc.get_traced_memory()[1] < 2**20
    finally:
        tracemalloc.stop()
