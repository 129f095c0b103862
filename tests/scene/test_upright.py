"""Which axis points up: what is taken, what is told, and what turns a model."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from benchmarks import shared

from shackled import InputError, Scene, load
from shackled.datasets import pieces
from shackled.scene._mesh import faces_of_all
from shackled.scene._upright import base_axis

#: A pyramid with its tip along z, and the same as glTF has it.
ALONG_Z = trimesh.Trimesh([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0), (0, 0, 3)])
ALONG_Z.faces = [(0, 2, 1), (0, 3, 2), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)]
ALONG_Y = trimesh.Trimesh(np.array([(x, z, -y) for x, y, z in ALONG_Z.vertices]), ALONG_Z.faces)

MESHES = shared.SHARED / "meshes"
#: Some as their authors made them.
FULL = ("cornell-box", "spot", "utah-teapot")


def told(path: str | Path, **look: Any) -> tuple[list[str], Scene]:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        scene = load(path, **look)
    return [str(each.message) for each in caught], scene


@pytest.fixture(autouse=True)
def _in_a_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for kind in ("stl", "obj", "ply", "glb"):
        ALONG_Z.export(f"z.{kind}")
        ALONG_Y.export(f"y.{kind}")


def test_stl_files_have_z_up_unless_told_otherwise() -> None:
    notes, scene = told("z.stl")
    assert notes == ["z.stl is read as z up; `up_axis` y keeps it as it is"]
    np.testing.assert_allclose(scene.world_positions(), load("z.stl", up_axis="z").world_positions(), atol=1e-12)
    highest = scene.world_positions()[:, 1].argmax()
    assert scene.objects[0].mesh.positions[highest].tolist() == [0, 0, 3]
    for look in ({"up_axis": "y"}, {"rotate": (0, 0, 0)}, {"up": (0, 1, 0)}):
        notes, kept = told("z.stl", **look)
        assert notes == []
        assert kept.objects[0].rotation.tolist() == [0, 0, 0, 1]
    # in a list, the others are as they are
    with pytest.warns(match=r"^z\.stl is read as z up"):
        one, other = load(["z.stl", "y.obj"]).objects
    np.testing.assert_allclose(Scene([one]).bounds, Scene([other]).bounds, atol=1e-9)


@pytest.mark.parametrize("kind", ["obj", "ply"])
def test_a_flat_base_along_z_is_told(kind: str) -> None:
    notes, scene = told(f"z.{kind}")
    assert notes == [f"z.{kind} is read as y up, but stands on a flat base along z; `up_axis` z turns it upright"]
    assert scene.objects[0].rotation.tolist() == [0, 0, 0, 1]
    assert told(f"z.{kind}", up_axis="z")[0] == []
    assert told(f"y.{kind}")[0] == []
    assert told("z.glb")[0] == []  # which has y up by its specification


def test_reliefs_letters_and_flat_things_do_not_stand() -> None:
    def axis(mesh: trimesh.Trimesh, *scale: float) -> str | None:
        return base_axis(np.array(mesh.vertices) * (scale or 1), np.array(mesh.faces))

    assert [axis(ALONG_Z), axis(ALONG_Y), axis(ALONG_Z, 1, 1, 0.1), axis(ALONG_Z, 1, 1, 0)] == ["z", "y", None, None]
    assert axis(trimesh.creation.cylinder(1, 3, sections=5)) is None
    assert axis(trimesh.creation.box(), 1e200) is None


def test_no_icon_is_told_to_be_turned() -> None:
    for piece in pieces("icons"):
        scene = piece.make()
        assert base_axis(scene.world_positions(), faces_of_all(each.mesh for each in scene.objects)) != "z", piece.name


@pytest.mark.skipif(not MESHES.is_dir(), reason="needs the meshes of the benchmarks")
def test_no_model_with_y_up_is_told_to_be_turned() -> None:
    paths = [*sorted(MESHES.glob("decimated/*.ply")), *(MESHES / "full" / f"{name}.obj" for name in FULL)]
    assert len(paths) == 18
    for path in paths:
        assert not any("stands on a flat base" in note for note in told(path)[0]), path
    assert any("stands on a flat base" in note for note in told(MESHES / "full" / "david.ply")[0])


def test_a_direction_of_a_model_is_its_upper_side() -> None:
    """Without a camera that it could tilt."""
    same, expected = load("z.obj", up=(0, 0, 2)), load("z.obj", up_axis="z")
    np.testing.assert_allclose(same.world_positions(), expected.world_positions(), atol=1e-12)
    np.testing.assert_allclose(same.camera.eye, expected.camera.eye, atol=1e-12)
    assert same.camera.up.tolist() == expected.camera.up.tolist() == [0, 1, 0]
    (down,) = load("y.obj", up=(0, -1, 0)).objects
    assert down.mesh.positions[down.world_positions()[:, 1].argmin()].tolist() == [0, 3, 0]
    assert load("y.obj", up=(0, 0, 1), eye=(0, 9, 0)).camera.up.tolist() == [0, 0, 1]
    with pytest.raises(InputError, match=r"`up` must not be \(0, 0, 0\)"):
        load("y.obj", up=(0, 0, 0))


def test_scene_files() -> None:
    def place(keys: str) -> list[float]:
        Path("scene.toml").write_text(f"[[objects]]\nmesh = {keys}\n")
        (found,) = load("scene.toml").objects
        points = found.world_positions()
        return [*(np.median(points, axis=0) - points[found.mesh.positions.max(axis=1).argmax()]).round(6).tolist()]

    with pytest.warns(match=r"z\.stl is read as z up; `up_axis` y keeps it as it is$"):
        assert place('"z.stl"') == [0, -3, 0]
    assert place('"z.stl"\nup_axis = "y"') == [0, 0, -3]
    assert place('"z.stl"\nrotation = [0, 0, 0]') == [0, 0, -3]
    # before the rotation
    assert place('"z.stl"\nup_axis = "z"\nrotation = [0, 0, 90]') == [3, 0, 0]
    assert place('"y.glb"\nup_axis = "x"') == [3, 0, 0]
    with pytest.raises(InputError, match=r"objects\[0\]\.up_axis must be one of x, y, z, not 'w'"):
        place('"z.stl"\nup_axis = "w"')
    with pytest.raises(InputError, match=r"objects\[0\]\.up_axis is for meshes of files$"):
        place('{ positions = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], faces = [[0, 1, 2]] }\nup_axis = "z"')
