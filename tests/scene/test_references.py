"""Meshes of pieces in scene files and links, normals across creases there, and what only the Creator reads."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from creator_page import link
from shackled import InputError, Mesh, Scene, load, render, replace
from shackled.cli.app import run
from shackled.scene._crease import creased

TEAPOT = {"piece": "teapot", "object": 0}
SMOOTH = {"shading": "smooth"}
TETRAHEDRON = {"positions": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], "faces": [[0, 2, 1], [0, 1, 3]]}


def read(tmp_path: Path, document: dict[str, Any]) -> Scene:
    path = tmp_path / "scene.json"
    path.write_text(json.dumps(document), "utf-8")
    return load(path)


def same(one: Mesh, other: Mesh) -> bool:
    return replace(one, uvs=None) == replace(other, uvs=None)


def test_a_mesh_of_a_piece_is_that_of_its_object(tmp_path: Path) -> None:
    document = {
        "creator": {"title": "T", "objects": [{"name": "pot"}]},
        "objects": [
            {"mesh": TEAPOT, "position": [1, 2, 3], "scale": 2, "material": SMOOTH},
            {"mesh": {"piece": "genesis/5"}, "color": "#ff0000"},
            {"mesh": {"piece": "cube"}, "material": SMOOTH},
        ],
    }
    pot, genesis, cube = read(tmp_path, document).objects
    assert same(pot.mesh, load("teapot").objects[0].mesh)
    assert (pot.position.tolist(), pot.scale, pot.material.shading) == ([1, 2, 3], 2, "smooth")
    assert (genesis.mesh.colors == (255, 0, 0)).all()
    assert (genesis.mesh.positions == load("genesis/5").objects[0].mesh.positions).all()
    # as the mesh of a file: by its shape
    assert cube.material.shading == "flat"


@pytest.mark.parametrize("mesh", [TEAPOT, TETRAHEDRON])
def test_crease(tmp_path: Path, mesh: dict[str, Any]) -> None:
    plain = load("teapot").objects[0].mesh if mesh is TEAPOT else Mesh(mesh["positions"], mesh["faces"])
    for degrees in (30, 180):
        (thing,) = read(tmp_path, {"objects": [{"mesh": mesh, "crease": degrees, "material": SMOOTH}]}).objects
        assert same(thing.mesh, creased(plain, degrees))
    (flat,) = read(tmp_path, {"objects": [{"mesh": mesh, "crease": 30}]}).objects
    assert flat.material.shading == "flat"
    assert same(flat.mesh, plain)


@pytest.mark.parametrize(
    ("document", "words"),
    [
        ({"creator": 1}, "creator must be a table, not 1"),
        ({"objects": [{"mesh": {"piece": "teapott"}}]}, r"mesh.piece: there is no piece 'teapott'; did you mean"),
        ({"objects": [{"mesh": {"piece": "../a.obj"}}]}, "there is no piece"),
        ({"objects": [{"mesh": {"piece": 3}}]}, r"objects\[0\].mesh.piece must be the name of a piece, not 3"),
        ({"objects": [{"mesh": {**TEAPOT, "object": 1}}]}, r"mesh.object is 1, but there are 1 objects"),
        ({"objects": [{"mesh": {**TEAPOT, "faces": []}}]}, r"unknown key 'faces' in objects\[0\].mesh"),
        ({"objects": [{"mesh": TEAPOT, "crease": 181}]}, r"objects\[0\].crease must be a finite number from 0 to 180"),
    ],
)  # fmt: skip
def test_wrong_references(tmp_path: Path, document: dict[str, Any], words: str) -> None:
    with pytest.raises(InputError, match=f"scene.json: .*{words}"):
        read(tmp_path, document)
    with pytest.raises(InputError, match=f"the link: .*{words}"):
        load(link(document))


def test_a_link_is_a_scene(tmp_path: Path) -> None:
    document = {"size": 40, "objects": [{"mesh": TEAPOT, "material": SMOOTH}], "background": "#102030"}
    wanted = render(read(tmp_path, document))
    for address in ("", "https://shackled.example/creator/", "http://127.0.0.1:8080/?input", "file:///a/creator.html"):
        assert render(link(document, address)).sha256 == wanted.sha256
    assert len(load([link(document), "cube"]).objects) == 2
    assert run(["render", link(document), "-o", str(tmp_path / "a.png"), "--preset", "gold", "--size", "20"]) == 0
    assert load(tmp_path / "a.png").background.top == (0x1C, 0x13, 0x0A)


def test_links_that_are_refused() -> None:
    good = link({"objects": [{"mesh": TEAPOT}]})
    for damaged in ("#1", good[:-3], good + "AAAA", "#1====", "#1_____"):
        with pytest.raises(InputError, match=r"the link is damaged|does not exist"):
            load(damaged)
    with pytest.raises(InputError, match="the link holds more than 4,194,304 bytes"):
        load(link({"x": "a" * (1 << 23)}))
    with pytest.raises(InputError, match="the link must hold an object"):
        load(link([]))


@pytest.mark.parametrize(
    ("part", "words"),
    [
        ({"mesh": "dog.obj"}, "a link cannot name files, such as 'dog.obj'; save a scene file in the Creator instead$"),
        ({"mesh": TEAPOT, "material": {"texture": "wood.png"}}, "a link cannot name files, such as 'wood.png'; save a"),
        ({"mesh": {"file": "ab12"}}, r"objects\[0\] needs a file that was opened in the Creator; save a"),
    ],
)
def test_a_link_names_no_files(part: dict[str, Any], words: str) -> None:
    with pytest.raises(InputError, match=words):
        load(link({"objects": [part]}))
