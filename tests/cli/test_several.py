"""Several inputs of one command."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from PIL import Image as PillowImage

from commands import Shackled
from shackled import render


@pytest.fixture
def three(folder: Path) -> Path:
    """Three meshes in a folder, one of which is broken, beside what is no mesh."""
    models = folder / "models"
    models.mkdir()
    mesh = Path("shape.obj").read_text()
    (models / "a.obj").write_text(mesh)
    (models / "b.STL").write_bytes(b"nothing")
    (models / "c.obj").write_text(mesh.replace("v 0 1 0", "v 0 3 0"))
    (models / "read me.txt").write_text("not a mesh")
    return models


@pytest.mark.parametrize("jobs", ["", "--jobs 2"], ids=["one", "two"])
def test_a_folder_of_meshes(three: Path, jobs: str, shackled: Shackled) -> None:
    """One that fails does not stop the others."""
    said = shackled(f"render shape.obj models -o out/{{stem}}.webp --size 16 {jobs}", expect=1)
    assert sorted(os.listdir("out")) == ["a.webp", "c.webp", "shape.webp"]
    lines = sorted(said.out.splitlines())
    assert [line.split(":")[0] for line in lines] == [
        f"models{os.sep}a.obj -> out/a.webp",
        f"models{os.sep}c.obj -> out/c.webp",
        "shape.obj -> out/shape.webp",
    ]
    expected = render("models/c.obj", 16)
    assert f": 16 x 16 pixels, {expected.gas:,} gas; free to read on most nodes" in lines[1]
    with PillowImage.open("out/c.webp") as picture:
        assert picture.convert("RGB").tobytes() == expected.pixels.tobytes()
    error, summary = said.err.splitlines()
    assert error.startswith(f"shackled: models{os.sep}b.STL")
    assert summary == "shackled: 3 rendered, 1 failed"


def test_reports_for_programs(three: Path, shackled: Shackled) -> None:
    said = shackled("render models gone.obj -o out/ --json --size 16", expect=1)
    reports = [json.loads(line) for line in said.out.splitlines()]
    assert [report.get("output") for report in reports] == ["out/a.png", None, "out/c.png", None]
    assert "b.STL" in reports[1]["error"]
    assert reports[3] == {"input": "gone.obj", "error": "gone.obj does not exist"}
    assert reports[0]["sha256"] == render("models/a.obj", 16).sha256


def test_nothing_fails(shackled: Shackled) -> None:
    said = shackled("render shape.obj teapot --size 16 --turntable 2")
    assert said.out.count("2 frames") == 2
    assert said.err == "2 rendered, 0 failed\n"
    assert {"shape.gif", "teapot.gif"} <= set(os.listdir())


def test_notes_are_those_of_each_input(shackled: Shackled) -> None:
    for name in "ab":
        Path(f"{name}.obj").write_text("mtllib no.mtl\n" + Path("shape.obj").read_text())
    notes = [f"shackled: note: {name}.obj: its materials are left out: no.mtl does not exist" for name in "ab"]
    for more in ("--size 16", "--size 16 --jobs 2"):
        assert sorted(shackled(f"render a.obj b.obj {more}").err.splitlines()[:-1]) == notes
        said = shackled(f"render a.obj b.obj shape.obj -o strict/ --strict {more}", expect=1)
        errors = [note.replace("note: ", "") for note in notes]
        assert sorted(said.err.splitlines()) == ["shackled: 1 rendered, 2 failed", *errors]
        assert os.listdir("strict") == ["shape.png"]
        Path("strict/shape.png").unlink()
        said = shackled(f"render a.obj b.obj gone.obj --quiet {more}", expect=1)
        lines = "shackled: gone.obj does not exist\nshackled: 2 rendered, 1 failed\n"
        assert (said.out, said.err) == ("", lines)


@pytest.mark.parametrize(
    ("output", "path"),
    [("here", "here/shape.png"), ("new/deep/", "new/deep/shape.png"), ("x-{stem}.bmp", "x-shape.bmp")],
)
def test_one_input_may_be_written_to_a_folder(output: str, path: str, shackled: Shackled) -> None:
    Path("here").mkdir()
    assert shackled(f"render shape.obj -o {output} --json --size 16").json["output"] == path
    assert Path(path).is_file()


def test_nothing_is_left_of_inputs_that_cannot_be_read(shackled: Shackled) -> None:
    before = os.listdir()
    for words, code in (("gone.obj lost.obj", 1), ("gone.obj", 2)):
        said = shackled(f"render {words} -o out/", expect=code)
        assert "shackled: gone.obj does not exist\n" in said.err
    assert os.listdir() == before


def test_results_are_not_printed_through_the_bar(three: Path) -> None:
    """Which is on stderr, and breaks lines."""
    (three / "b.STL").unlink()
    for name in ("a", "c"):
        (three / f"{name}.obj").rename(three / f"{name * 60}.obj")
    command = f"{sys.executable} -m shackled render models/*.obj --size 500 -o out/"
    environment = os.environ | {"FORCE_COLOR": "1", "COLUMNS": "80"}
    done = subprocess.run(["sh", "-c", command], capture_output=True, text=True, timeout=120, env=environment)
    assert (done.returncode, done.stderr) == (0, "2 rendered, 0 failed\n")
    assert [".png: 500 x 500 pixels" in line for line in done.stdout.splitlines()] == [True, True]
