import json
import os
import tracemalloc
from pathlib import Path

import numpy as np
import pytest

from shackled import Material, load
from shackled.errors import InputError
from shackled.scene import MAX_BYTES

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


def refusal(path: Path | str) -> str:
    with pytest.raises(InputError) as error:
        load(path)
    message = str(error.value)
    assert "\n" not in message
    return message


def test_a_mesh_is_staged(tmp_path: Path) -> None:
    (tmp_path / "a.OBJ").write_text(TRIANGLE)
    scene = load(tmp_path / "a.OBJ", (30, 20))
    assert (scene.width, scene.height, scene.lights) == (30, 20, load(tmp_path / "a.OBJ").lights)
    assert (load(str(tmp_path / "a.OBJ")).width, len(scene.lights)) == (256, 1)


def test_a_scene_file_stays_small_and_plain(tmp_path: Path) -> None:
    (tmp_path / "a.obj").write_text(TRIANGLE)
    (tmp_path / "a.toml").write_text('[[objects]]\nmesh = "a.obj"\n')
    scene = load(tmp_path / "a.toml")
    assert (scene.width, scene.height, len(scene.lights)) == (128, 128, 1)
    assert scene.objects[0].material == Material("flat")


def test_json_is_the_originals_if_it_has_a_canvas(tmp_path: Path) -> None:
    path = tmp_path / "a.json"
    path.write_text(json.dumps({"canvasDim": 16, "verts": [], "faces": []}))
    assert load(path).width == 16
    path.write_text(json.dumps({"size": 17}))
    assert load(path).width == 17


def test_a_byte_order_mark_does_no_harm(tmp_path: Path) -> None:
    (tmp_path / "a.toml").write_bytes(b"\xef\xbb\xbfsize = 9\n")
    assert load(tmp_path / "a.toml").width == 9


def test_missing_file(tmp_path: Path) -> None:
    for extension in ("obj", "ply", "stl", "glb", "off", "toml", "json"):
        path = tmp_path / f"none.{extension}"
        assert refusal(path) == f"{path} does not exist"


def test_unknown_extension(tmp_path: Path) -> None:
    known = "known are .obj, .ply, .stl, .glb, .gltf, .off, .toml, .json, .png"
    path = tmp_path / "a.3mf"
    assert refusal(path) == f"{path} is neither a mesh nor a scene file by its extension; {known}"


def test_directory(tmp_path: Path) -> None:
    assert refusal(tmp_path).startswith(f"{tmp_path} is a directory; a mesh or scene file is needed")
    (tmp_path / "a.obj").mkdir()
    assert refusal(tmp_path / "a.obj") == f"{tmp_path / 'a.obj'} is a directory; a mesh or scene file is needed"


@pytest.mark.parametrize("extension", ["obj", "ply", "stl", "glb", "gltf", "off", "toml", "json"])
@pytest.mark.parametrize("content", [b"", b"\n \n"])
def test_empty(tmp_path: Path, extension: str, content: bytes) -> None:
    path = tmp_path / f"a.{extension}"
    path.write_bytes(content)
    assert refusal(path) == f"{path} is empty"


@pytest.mark.parametrize("extension", ["obj", "ply", "stl", "glb", "gltf", "off", "toml", "json"])
def test_binary_garbage(tmp_path: Path, extension: str) -> None:
    path = tmp_path / f"a.{extension}"
    for seed in range(5):
        path.write_bytes(np.random.default_rng(seed).bytes(1 + 700 * seed))
        assert refusal(path).startswith(f"{path}")


@pytest.mark.skipif(os.geteuid() == 0 if hasattr(os, "geteuid") else True, reason="root may read everything")
def test_forbidden(tmp_path: Path) -> None:
    path = tmp_path / "a.obj"
    path.write_text(TRIANGLE)
    path.chmod(0)
    assert refusal(path) == f"{path} cannot be read: Permission denied"


def test_a_path_that_cannot_be() -> None:
    assert refusal("a\0.obj").endswith("cannot be read: embedded null byte")


def test_wrong_toml_and_json(tmp_path: Path) -> None:
    (tmp_path / "a.toml").write_text("size = 3\nsize = 4\n")
    assert refusal(tmp_path / "a.toml").startswith(f"{tmp_path / 'a.toml'} is not valid TOML: ")
    (tmp_path / "a.json").write_text('{"size": 3')
    assert refusal(tmp_path / "a.json").startswith(f"{tmp_path / 'a.json'} is not valid JSON: ")
    (tmp_path / "a.json").write_text("[1, 2]")
    assert refusal(tmp_path / "a.json").endswith("must hold an object with the keys of a scene, not [1, 2]")
    (tmp_path / "a.json").write_text("[" * 100_000)
    assert refusal(tmp_path / "a.json").startswith(f"{tmp_path / 'a.json'} is not valid JSON: ")


def test_a_file_that_is_too_large_is_not_read(tmp_path: Path) -> None:
    path = tmp_path / "huge.obj"
    with path.open("wb") as file:
        file.truncate(MAX_BYTES + 2**20)  # a hole: it takes no place on the disk
    tracemalloc.start()
    try:
        assert refusal(path) == f"{path} has 257 MB; files up to 256 MB are read"
        assert tracemalloc.get_traced_memory()[1] < 2**20
    finally:
        tracemalloc.stop()
