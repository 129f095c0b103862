"""Files that others name: only those in the folder are read, by whatever name."""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from mesh_files import refusal
from shackled import InputError, load
from shackled.scene._files.beside import OUTSIDE

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n"
PLY = (
    "ply\nformat ascii 1.0\ncomment TextureFile {}\nelement vertex 3\n"
    + "".join(f"property float {name}\n" for name in "xyzst")
    + "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    + "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n"
)
#: Names that lead to `secret` beside the folder, where {} is its path.
NAMES = ("{}/", "../secret/", "sub/../../secret/", "link/", "file://{}/", "%2e%2e/secret/", "..\\secret\\")
_opened: list[str] = []
_is_watching = False


def _watch(event: str, arguments: tuple[object, ...]) -> None:
    if _is_watching and event == "open":
        _opened.append(os.fspath(arguments[0]) if isinstance(arguments[0], str | Path) else "")


sys.addaudithook(_watch)


@pytest.fixture
def folder(tmp_path: Path) -> Iterator[Path]:
    """A folder beside that of secrets, to which a link leads, and a watch over what is opened."""
    secret, models = tmp_path / "secret", tmp_path / "models"
    secret.mkdir()
    models.mkdir()
    (models / "sub").mkdir()
    Image.fromarray(np.arange(48, dtype=np.uint8).reshape(4, 4, 3)).save(secret / "private.png")
    (secret / "private.mtl").write_text("newmtl m\nKd 1 0 0\n")
    (secret / "private.obj").write_text(TRIANGLE)
    (models / "link").symlink_to(secret, target_is_directory=True)
    global _is_watching
    _opened.clear()
    _is_watching = True
    (secret / "private.mtl").read_text()
    assert len(secrets_opened()) == 1, "the watch sees nothing"
    _opened.clear()
    yield models
    _is_watching = False


def secrets_opened() -> list[str]:
    places = map(os.path.realpath, _opened)
    return [place for place in places if "/secret/" in place and "/models/" not in place]


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("kind", ["map", "alpha", "library", "ply"])
def test_meshes_read_nothing_elsewhere(folder: Path, name: str, kind: str) -> None:
    name = name.format(folder.parent / "secret")
    path = folder / ("a.ply" if kind == "ply" else "a.obj")
    library = f"{name}private.mtl" if kind == "library" else "a.mtl"
    statement = "map_d" if kind == "alpha" else "map_Kd"
    (folder / "a.mtl").write_text(f"newmtl m\n{statement} {name}private.png\n")
    path.write_text(PLY.format(f"{name}private.png") if kind == "ply" else f"mtllib {library}\n{TRIANGLE}")
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        (thing,) = load(path).objects
    assert thing.material.texture is None
    assert secrets_opened() == []
    assert "left out" in str(told[0].message)
    assert OUTSIDE in str(told[0].message) or "does not exist" in str(told[0].message)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("key", ["mesh", "texture"])
def test_scene_files_read_nothing_elsewhere(folder: Path, name: str, key: str) -> None:
    name = name.format(folder.parent / "secret").replace("\\", "/")
    (folder / "own.obj").write_text(TRIANGLE.replace("usemtl m\n", ""))
    mesh = f"{name}private.obj" if key == "mesh" else "own.obj"
    material = f'material.texture = "{name}private.png"\n' if key == "texture" else ""
    (folder / "a.toml").write_text(f'[[objects]]\nmesh = "{mesh}"\n{material}')
    told = refusal(folder / "a.toml", read=load)
    assert told.startswith("objects[0].")
    assert OUTSIDE in told or "does not exist" in told
    assert secrets_opened() == []


def test_what_is_told_does_not_depend_on_what_may_not_be_read(folder: Path) -> None:
    for name in ("../secret/private.obj", "../secret/none.obj", "link/private.obj", "link/none.obj"):
        (folder / "a.toml").write_text(f'[[objects]]\nmesh = "{name}"\n')
        with pytest.raises(InputError, match=OUTSIDE):
            load(folder / "a.toml")


def test_what_stays_inside_is_read(folder: Path) -> None:
    """A name with .. or of the whole path, and a link, that lead to the folder; the folder itself may be a link."""
    for name in ("wood.png", "sub/../wood.png", str(folder / "wood.png"), "alias.png", "Sub/WOOD.png"):
        Image.new("RGB", (2, 2), "red").save(folder / "wood.png")
        if not (folder / "alias.png").is_symlink():
            (folder / "alias.png").symlink_to("wood.png")
        (folder / "a.mtl").write_text(f"newmtl m\nmap_Kd {name}\n")
        (folder / "a.obj").write_text(f"mtllib a.mtl\n{TRIANGLE}")
        (thing,) = load(folder / "a.obj").objects
        assert thing.mesh.colors[0].tolist() == [255, 0, 0], name
    other = folder.parent / "other"
    other.symlink_to(folder, target_is_directory=True)
    assert load(other / "a.obj").objects[0].mesh.colors[0].tolist() == [255, 0, 0]
