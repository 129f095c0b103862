"""The command `shackled info`, and --strict."""

from __future__ import annotations

import re
from contextlib import nullcontext
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from PIL import Image as PillowImage

from commands import Shackled
from shackled import load, render
from shackled.errors import InputWarning

BOX = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
SIDES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
#: A roof over a square in the plane z = 0, and over one in y = 0.
TENT = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0), (2, 2, 3)]
TENT_FACES = [(0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)]
NOTE = "a.obj: its materials are left out: no.mtl does not exist"


def write(name: str, corners: list[Any], faces: list[Any], more: str = "") -> None:
    lines = [more, *("v {} {} {}".format(*corner) for corner in corners)]
    lines += ["f " + " ".join(str(corner + 1) for corner in face) for face in faces]
    Path(name).write_text("\n".join(lines) + "\n")


@pytest.mark.parametrize(
    ("faces", "closed", "inside_out", "edges", "words"),
    [
        (SIDES, True, False, (0, 0, 0), "closed"),
        ([side[::-1] for side in SIDES], True, True, (0, 0, 0), "closed, but its faces are seen from inside"),
        (SIDES[1:], False, False, (4, 0, 0), "not closed: 4 edges of one face"),
        ([SIDES[0][::-1], *SIDES[1:]], False, False, (0, 0, 4), "4 edges between faces that are wound differently"),
        ([*SIDES, (0, 1, 7)], False, False, (1, 2, 0), "not closed: 1 edge of one face and 2 edges of three faces"),
    ],
    ids=["closed", "inside out", "open", "turned", "crowded"],
)
def test_surfaces(
    faces: list[Any], closed: bool, inside_out: bool, edges: tuple[int, int, int], words: str, shackled: Shackled
) -> None:
    write("box.obj", BOX, faces)
    facts = shackled("info box.obj --no-gas --json").json
    assert (facts["closed"], facts["inside_out"]) == (closed, inside_out)
    assert (facts["open_edges"], facts["crowded_edges"], facts["disagreeing_edges"]) == edges
    assert (facts["low"], facts["high"], facts["vertices"]) == ([0, 0, 0], [1, 1, 1], 8)
    assert facts["triangles"] == sum(len(face) - 2 for face in faces)
    assert "pictures" not in facts
    # what is drawn without back faces; what is inside out is turned first
    with pytest.warns(InputWarning, match="^box.obj: 1 closed part wound") if inside_out else nullcontext():
        assert load("box.obj").objects[0].cull == closed
    assert f"surface   {words}" in shackled("info box.obj --no-gas").out


def test_what_looks_up(shackled: Shackled) -> None:
    write("z.obj", TENT, TENT_FACES)
    write("y.obj", [(x, z, -y) for x, y, z in TENT], TENT_FACES)
    # a square alone stands on nothing
    write("flat.obj", [(x, z, -y) for x, y, z in TENT], TENT_FACES[:1])
    bases = [shackled(f"info {name}.obj --no-gas --json").json["base"] for name in ("z", "y", "flat")]
    assert bases == ["z", "y", None]
    output = shackled("info z.obj --no-gas").out
    assert "up        y is taken, but it stands on a flat base along z: --up-axis z turns it" in output
    trimesh.load_mesh("z.obj").export("z.stl")
    output = shackled("info z.stl --no-gas").out
    assert "up        z: it stands on a flat base" in output
    assert "note      z.stl is read as z up; --up-axis y keeps it as it is" in output


def test_materials(shackled: Shackled) -> None:
    PillowImage.fromarray(np.arange(4 * 6 * 3, dtype=np.uint8).reshape(4, 6, 3)).save("map.png")
    Path("a.mtl").write_text("newmtl a\nmap_Kd map.png\nnewmtl b\nKd 1 0 0\n")
    Path("a.obj").write_text(
        "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n"
        "usemtl a\nf 1/1/1 2/2/1 3/3/1\nusemtl b\nf 3//1 2//1 1//1\n"
    )
    facts = shackled("info a.obj --no-gas --json").json
    assert (facts["parts"], facts["materials"], facts["textures"], facts["normals"]) == (2, 2, [[6, 4]], 2)
    assert facts["opaque"]
    output = shackled("info a.obj --no-gas").out
    assert "textures of 6 x 4 texels" in output
    assert "normals   of 2 of 2 parts" in output


def test_the_gas_is_that_of_render(shackled: Shackled) -> None:
    pictures = shackled("info shape.obj --json").json["pictures"]
    assert [each["size"] for each in pictures] == [128, 256, 512]
    assert pictures[1]["gas"] == render("shape.obj", 256).gas
    assert f"fits     {pictures[2]['fits']}\n" in shackled("render shape.obj --size 512").out
    assert f"256 px    {pictures[1]['gas']:,} gas, {pictures[1]['fits']}\n" in shackled("info shape.obj").out


def test_notes_are_told_once(shackled: Shackled) -> None:
    write("a.obj", BOX, SIDES, "mtllib no.mtl\nmtllib no.mtl")
    said = shackled("info a.obj --no-gas --json")
    assert (said.json["notes"], said.err) == ([NOTE], "")
    said = shackled("info a.obj --no-gas")
    assert (said.out.count(f"note      {NOTE}\n"), said.err) == (1, "")
    assert shackled("render a.obj --size 8 --json").err == f"shackled: note: {NOTE}\n"


def test_several_inputs(shackled: Shackled) -> None:
    Path("empty.json").write_text("{}")
    render("shape.obj", 8).save("scene.png")
    said = shackled("info shape.obj gone.ply cube scene.png empty.json --no-gas", expect=1)
    names = [line.split()[1] for line in said.out.splitlines() if line.startswith("input")]
    assert names == ["shape.obj", "cube", "scene.png"]
    assert said.err.splitlines() == [
        "shackled: gone.ply does not exist",
        "shackled: empty.json has no objects",
        "shackled: 3 read, 2 failed",
    ]


@pytest.mark.parametrize(
    "words",
    [
        "info a.obj",
        "render a.obj -o a.png",
        "export a.obj -o a.html",
        "export a.obj -o a.glb",
        "gas a.obj --profile a.svg",
        "stages a.obj -o stages",
        "store a.obj --calldata a.json --licence 'my own work' --rpc http://127.0.0.1:9",
    ],
)
def test_strict_writes_nothing(words: str, shackled: Shackled) -> None:
    write("a.obj", BOX, SIDES, "mtllib no.mtl")
    before = sorted(Path().iterdir())
    said = shackled(f"{words} --strict", expect=2)
    assert (said.out, said.err) == ("", f"shackled: {NOTE}\n")
    assert sorted(Path().iterdir()) == before


def test_the_most_used_options_come_first(shackled: Shackled, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "200")
    text = shackled("render --help").out
    assert re.findall(r"^(\w+):$", text, re.MULTILINE)[:4] == ["Arguments", "Options", "Files", "Canvas"]
    listed = text[text.index("Options:") : text.index("Files:")]
    options = re.findall(r"^  (?:-\w, )?(--[\w-]+)", listed, re.MULTILINE)
    used = "output size background color azimuth elevation max-triangles turntable help"
    assert options == [f"--{name}" for name in used.split()]
