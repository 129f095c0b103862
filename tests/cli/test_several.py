"""Several inputs of one command."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from PIL import Image as PillowImage

from shackled import render
from shackled.cli.app import run

SMALL = ["--size", "16"]


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


@pytest.mark.parametrize("jobs", [[], ["--jobs", "2"]], ids=["one", "two"])
def test_a_folder_of_meshes(three: Path, jobs: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    """One that fails does not stop the others."""
    assert run(["render", "shape.obj", "models", "-o", "out/{stem}.webp", *SMALL, *jobs]) == 1
    output, messages = capsys.readouterr()
    assert sorted(os.listdir("out")) == ["a.webp", "c.webp", "shape.webp"]
    lines = sorted(output.splitlines())
    assert [line.split(":")[0] for line in lines] == [
        f"models{os.sep}a.obj -> out/a.webp",
        f"models{os.sep}c.obj -> out/c.webp",
        "shape.obj -> out/shape.webp",
    ]
    expected = render("models/c.obj", 16)
    assert f": 16 x 16 pixels, {expected.gas:,} gas; fits one transaction" in lines[1]
    with PillowImage.open("out/c.webp") as picture:
        assert picture.convert("RGB").tobytes() == expected.pixels.tobytes()
    error, summary = messages.splitlines()
    assert error.startswith(f"shackled: models{os.sep}b.STL")
    assert summary == "shackled: 3 rendered, 1 failed"


def test_reports_for_programs(three: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["render", "models", "gone.obj", "-o", "out/", "--json", *SMALL]) == 1
    reports = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [report.get("output") for report in reports] == ["out/a.png", None, "out/c.png", None]
    assert "b.STL" in reports[1]["error"]
    assert reports[3] == {"input": "gone.obj", "error": "gone.obj does not exist"}
    assert reports[0]["sha256"] == render("models/a.obj", 16).sha256


def test_nothing_fails(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["render", "shape.obj", "teapot", *SMALL, "--turntable", "2"]) == 0
    output, messages = capsys.readouterr()
    assert output.count("2 frames") == 2
    assert messages == "2 rendered, 0 failed\n"
    assert {"shape.gif", "teapot.gif"} <= set(os.listdir())


def test_notes_are_those_of_each_input(capsys: pytest.CaptureFixture[str]) -> None:
    for name in "ab":
        Path(f"{name}.obj").write_text("mtllib no.mtl\n" + Path("shape.obj").read_text())
    notes = [f"shackled: note: {name}.obj: its materials are left out: no.mtl does not exist" for name in "ab"]
    for jobs in ([], ["--jobs", "2"]):
        assert run(["render", "a.obj", "b.obj", *SMALL, *jobs]) == 0
        assert sorted(capsys.readouterr().err.splitlines()[:-1]) == notes
        assert run(["render", "a.obj", "b.obj", "shape.obj", "-o", "strict/", "--strict", *SMALL, *jobs]) == 1
        errors = [note.replace("note: ", "") for note in notes]
        assert sorted(capsys.readouterr().err.splitlines()) == [f"shackled: {1} rendered, 2 failed", *errors]
        assert os.listdir("strict") == ["shape.png"]
        Path("strict/shape.png").unlink()
        assert run(["render", "a.obj", "b.obj", "gone.obj", "--quiet", *SMALL, *jobs]) == 1
        assert capsys.readouterr() == ("", "shackled: gone.obj does not exist\nshackled: 2 rendered, 1 failed\n")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["models/a.obj", "more/a.obj"], "the picture of more/a.obj would overwrite that of models/a.obj: a.png"),
        (["models/a.obj", "models/a.obj", "-o", "out/"], "would overwrite that of models/a.obj: out/a.png"),
        (["models/a.obj", "shape.obj", "-o", "one.png"], "2 inputs need more than one file: give -o a folder, such as"),
        (["models/a.obj", "shape.obj", "-o", "frames/", "--turntable", "2"], "give -o a pattern, such as out/{stem}"),
        (["models/a.obj", "shape.obj", "-o", "{stem}.tiff"], "must end in one of .png"),
        (["models/a.obj", "shape.obj", "-o", "-"], "standard output takes one picture, not 2"),
        (["-", "-"], "-, standard input, is one file: give it once"),
        (["more/none"], "the folder more/none has no mesh files in it, .obj .ply .stl .glb .gltf .off"),
        (["models/a.obj", "kept.png", "-o", "{stem}.png"], "would overwrite the input kept.png"),
        (["models/a.obj", "shape.obj", "-o", "models/a.obj/{stem}.png"], "models/a.obj"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else "",
)
def test_wrong_names_are_told_before_anything_is_drawn(
    three: Path, arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    Path("more/none").mkdir(parents=True)
    Path("more/a.obj").write_text(Path("shape.obj").read_text())
    Path("kept.png").write_bytes(b"kept")
    before = sorted(Path().rglob("*"))
    assert run(["render", *arguments, *SMALL]) == 2
    output, messages = capsys.readouterr()
    assert output == ""
    assert message in messages
    assert messages.count("\n") == 1
    assert sorted(Path().rglob("*")) == before
    assert Path("kept.png").read_bytes() == b"kept"


def test_one_input_may_be_written_to_a_folder(capsys: pytest.CaptureFixture[str]) -> None:
    Path("here").mkdir()
    for output, path in (
        ("here", "here/shape.png"),
        ("new/deep/", "new/deep/shape.png"),
        ("x-{stem}.bmp", "x-shape.bmp"),
    ):
        assert run(["render", "shape.obj", "-o", output, "--json", *SMALL]) == 0
        assert json.loads(capsys.readouterr().out)["output"] == path
        assert Path(path).is_file()


def test_nothing_is_left_of_an_input_that_cannot_be_read(capsys: pytest.CaptureFixture[str]) -> None:
    before = os.listdir()
    assert run(["render", "gone.obj", "lost.obj", "-o", "out/"]) == 1
    assert run(["render", "gone.obj", "-o", "out/"]) == 2
    assert os.listdir() == before
    assert capsys.readouterr().err.count("shackled: gone.obj does not exist\n") == 2


def test_an_empty_folder(capsys: pytest.CaptureFixture[str]) -> None:
    Path("empty").mkdir()
    assert run(["render", "empty"]) == 2
    assert "the folder empty has no mesh files in it, .obj" in capsys.readouterr().err


def test_as_a_shell_runs_it(three: Path) -> None:
    command = f"{sys.executable} -m shackled render models/*.obj --size 8 -o out/"
    done = subprocess.run(["sh", "-c", command], capture_output=True, text=True, timeout=120)
    assert (done.returncode, done.stderr) == (0, "2 rendered, 0 failed\n")
    assert sorted(os.listdir("out")) == ["a.png", "c.png"]


def test_results_are_not_printed_through_the_bar(folder: Path) -> None:
    """Which is on stderr, and breaks lines."""
    for name in "abcd":
        Path(f"{name * 60}.obj").write_text(Path("shape.obj").read_text())
    command = [sys.executable, "-m", "shackled", "render", ".", "-o", "out/", "--size", "500"]
    environment = os.environ | {"FORCE_COLOR": "1", "COLUMNS": "80"}
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, env=environment)
    assert done.returncode == 0
    assert len(done.stdout.splitlines()) == 5
    assert all(".png: 500 x 500 pixels" in line for line in done.stdout.splitlines())
