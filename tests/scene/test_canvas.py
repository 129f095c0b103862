"""Mesh files are drawn with the triangles that the canvas can show."""

from __future__ import annotations

import json
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from attrs import evolve
from numpy.typing import NDArray

from mesh_files import sheet
from shackled import Camera, Mesh, Scene, load, render, turntable
from shackled.cli.app import run
from shackled.datasets.common import shapes
from shackled.errors import InputWarning
from shackled.scene._canvas import as_shown
from shackled.scene._look import look_at

#: 16,000 triangles.
BALL = shapes.sphere(100, 81)
NOTE = (
    r"^ball.obj is simplified from 16,000 to [\d,]+ triangles, as 128 x 128 pixels show no more; `max_triangles` all "
)


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for name, mesh in (("ball", BALL), ("small", shapes.sphere(40, 41))):
        trimesh.Trimesh(mesh.positions, mesh.faces, process=False).export(f"{name}.obj")


def shown(scene: Scene) -> Scene:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", InputWarning)
        return as_shown(scene, "it")


def test_a_picture_of_fewer_triangles_looks_the_same() -> None:
    whole = render("ball.obj", 128, max_triangles="all")
    with pytest.warns(InputWarning, match=NOTE):
        image = render("ball.obj", 128)
    assert image.scene is not None
    assert whole.scene is not None
    assert 4096 <= image.scene.triangles < 5000
    assert image.scene.camera == whole.scene.camera
    assert [each.cull for each in image.scene.objects] == [True]
    assert (image.gas or 0) < (whole.gas or 0) / 2
    difference = np.abs(image.pixels.astype(int) - whole.pixels)
    assert difference.mean() < 0.2
    assert np.percentile(difference, 99) <= 4
    # coarser than the canvas shows, and seen
    coarse = render("ball.obj", 128, max_triangles=200)
    assert np.abs(coarse.pixels.astype(int) - whole.pixels).mean() > 5 * difference.mean()


def test_what_a_picture_needs_and_what_else_keeps_all() -> None:
    scene = load("ball.obj")
    assert scene.triangles == 16_000
    assert scene == load("ball.obj", max_triangles="all") == load("ball.obj", 256, max_triangles="all")
    assert load("ball.obj", 128, max_triangles=300).triangles <= 300
    with pytest.warns(InputWarning, match="^the model is simplified from 19,200"):
        assert load(["ball.obj", "small.obj"], 128).triangles < 8000
    with pytest.warns(InputWarning, match="from 16,000 to"):
        turntable("ball.obj", 2, 16)
    scene.save("scene.json")
    assert load("scene.json", 128).triangles == load(BALL, 128).triangles == 16_000


def test_small_meshes_are_as_they_are() -> None:
    (small,) = load("small.obj", 16).objects
    assert small == load("small.obj").objects[0]
    assert small.mesh.triangles == 3200
    # a triangle for 8 pixels
    scene = load("ball.obj", 400, max_triangles="all")
    assert as_shown(scene, "it") is scene


def test_the_nearer_the_finer() -> None:
    scene = look_at(BALL, {"size": (128, 128)})
    camera = scene.camera
    near = evolve(scene, camera=evolve(camera, eye=camera.eye * 0.35))
    assert shown(scene).triangles < shown(near).triangles
    for eye in ((0, 0, 0), (0, 0, 0.9), camera.target):
        inside = evolve(scene, camera=Camera(eye, camera.target))
        assert as_shown(inside, "it") is inside
    level = evolve(scene, camera=Camera((0, 0, 5), (0, 0, 0), projection="orthographic", half_height=1.2))
    assert 4096 <= shown(level).triangles < 6000


def test_what_is_seen_of_edges_stays() -> None:
    wires = look_at(BALL, {"wireframe": True})
    assert as_shown(wires, "it") is wires
    flat = look_at(BALL, {"shading": "flat"})
    assert as_shown(flat, "it") is flat
    half = Mesh(BALL.positions, BALL.faces[BALL.positions[BALL.faces][:, :, 1].max(axis=1) < 0.2])
    for mesh in (half, striped(BALL)):
        scene = look_at(mesh, {"size": (128, 128)})
        (whole,), (left,) = scene.objects, shown(scene).objects
        assert left.mesh.triangles < 0.7 * whole.mesh.triangles
        edge = rim(mesh)
        assert len(edge) >= 100
        gaps = np.linalg.norm(edge[:, None] - left.mesh.positions, axis=2).min(axis=1)
        assert gaps.max() < 1e-5


def rim(mesh: Mesh) -> NDArray[np.float64]:
    """The different places of vertices on edges that one face has, or that faces of two colours share."""
    corner = mesh.faces.reshape(-1)
    keys = np.unique(np.hstack([mesh.positions, mesh.colors]), axis=0, return_inverse=True)[1].reshape(-1)[corner]
    edges = np.sort(keys.reshape(-1, 3)[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    _, first, count = np.unique(edges, axis=0, return_index=True, return_counts=True)
    ends = corner.reshape(-1, 3)[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)[first[count == 1]]
    return np.unique(mesh.positions[ends.ravel()], axis=0)


def striped(mesh: Mesh) -> Mesh:
    """The mesh with faces of two colours."""
    red = mesh.positions[mesh.faces][:, :, 1].mean(axis=1) > 0.3
    corner = mesh.faces.reshape(-1)
    colors = np.where(np.repeat(red, 3)[:, None], (255, 0, 0), (255, 255, 255))
    return Mesh(mesh.positions[corner], np.arange(len(corner)).reshape(-1, 3), colors)


def test_planes_are_merged_in_flat_shading() -> None:
    x, y, faces = sheet(60, 60)
    wall = np.stack([x / 30 - 1, y / 30 - 1, 0 * x - 1], axis=1)
    walls = [Mesh(np.roll(wall, turn, axis=1), faces) for turn in range(3)]
    scene = look_at(shapes.joined(*walls), {"shading": "flat", "size": (64, 64)})
    assert scene.triangles == 21_600
    left = shown(scene)
    assert left.triangles < 8000
    assert np.abs(render(left).pixels.astype(int) - render(scene).pixels).max() <= 2


def test_painted_vertices_are_as_fine_as_pixels() -> None:
    levels = np.round(127 * np.sin(40 * BALL.positions[:, :1]) + 128) * np.ones(3)
    scene = look_at(evolve(BALL, colors=levels), {"size": (128, 128)})
    assert as_shown(scene, "it") is scene


def test_textures_stay_in_place() -> None:
    columns, rows, faces = sheet(100, 100)
    x, y = columns / 50 - 1, rows / 50 - 1
    mesh = Mesh(np.stack([x, y, 0.2 * np.sin(3 * x)], axis=1), faces, uvs=np.stack([(x + 1) / 2, (1 - y) / 2], axis=1))
    scene = look_at(mesh, {"size": (128, 128)})
    (left,) = shown(scene).objects
    assert left.mesh.triangles < 7000
    assert left.mesh.uvs is not None
    expected = np.stack([(left.mesh.positions[:, 0] + 1) / 2, (1 - left.mesh.positions[:, 1]) / 2], axis=1)
    # a pixel is 1/128 of the canvas
    assert np.abs(left.mesh.uvs - expected).max() < 0.01


def test_without_the_package_the_mesh_is_whole(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shackled.scene._simplify.find_spec", lambda name: None)
    with pytest.warns(InputWarning, match="with all of its 16,000 triangles, more than 32 x 32 pixels show: simplify"):
        assert load("ball.obj", 32).triangles == 16_000


def test_the_command_line(capsys: pytest.CaptureFixture[str]) -> None:
    def report(*options: str) -> tuple[dict[str, Any], str]:
        assert run(["render", "ball.obj", "--size", "64", "--json", *options]) == 0
        output, notes = capsys.readouterr()
        return json.loads(output), notes

    few, note = report()
    assert note.endswith("as 64 x 64 pixels show no more; --max-triangles all keeps every one\n")
    every, none = report("--max-triangles", "all")
    assert few["triangles"] < every["triangles"] / 2
    assert none == ""
    assert run(["render", "ball.obj", "--strict"]) != 0
    assert "simplified from 16,000" in capsys.readouterr().err
    assert run(["render", "ball.obj", "--max-triangles", "most"]) == 2
    assert "--max-triangles must be a whole number, at least 1, or all, not 'most'" in capsys.readouterr().err
    assert run(["info", "ball.obj", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["triangles"] == 16_000
    counts = [each["triangles"] for each in told["pictures"]]
    assert 4096 <= counts[0] < 5000
    assert counts[0] <= counts[1] <= counts[2]
