"""Several inputs of one command."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from PIL import Image as PillowImage

from commands import Shackled
from shackled import Scene, render
from shackled.chain._embedded import RevmChain
from shackled.cli import progress


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
    assert re.fullmatch(r"shackled: 3 rendered, 1 failed, in \d+\.\d s", summary)


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
    assert re.fullmatch(r"2 rendered, 0 failed, in \d+\.\d s\n", said.err)
    assert {"shape.gif", "teapot.gif"} <= set(os.listdir())


def test_notes_are_those_of_each_input(shackled: Shackled) -> None:
    for name in "ab":
        Path(f"{name}.obj").write_text("mtllib no.mtl\n" + Path("shape.obj").read_text())
    notes = [f"shackled: note: {name}.obj: its materials are left out: no.mtl does not exist" for name in "ab"]
    for more in ("--size 16", "--size 16 --jobs 2"):
        first, others, _ = shackled(f"render a.obj b.obj {more}").err.splitlines()
        one, two = ("a.obj", "b.obj") if first == notes[0] else ("b.obj", "a.obj")
        assert first in notes
        assert others == f"shackled: the note on {one} is also true of {two}"
        said = shackled(f"render a.obj b.obj shape.obj -o strict/ --strict {more}", expect=1)
        errors = [note.replace("note: ", "") for note in notes]
        assert sorted(said.err.splitlines())[1:] == errors
        assert said.err.count("shackled: 1 rendered, 2 failed, in ") == 1
        assert os.listdir("strict") == ["shape.png"]
        Path("strict/shape.png").unlink()
        said = shackled(f"render a.obj b.obj gone.obj --quiet {more}", expect=1)
        assert said.out == ""
        assert said.err.startswith("shackled: gone.obj does not exist\nshackled: 2 rendered, 1 failed, in ")


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
    assert (done.returncode, done.stderr.partition(",")[0]) == (0, "2 rendered")
    assert [".png: 500 x 500 pixels" in line for line in done.stdout.splitlines()] == [True, True]


def test_a_picture_is_drawn_once(monkeypatch: pytest.MonkeyPatch, shackled: Shackled) -> None:
    """Unless its triangles are shown: then it is drawn again to count them. A drawing is told by its width."""
    calls: list[str] = []

    def watched(name: str) -> Any:
        made = getattr(RevmChain, name)

        def call(chain: RevmChain, scene: Scene, *given: Any) -> Any:
            calls.append(name if name == "count" else str(scene.width))
            return made(chain, scene, *given)

        return call

    for name in ("draw", "count"):
        monkeypatch.setattr(RevmChain, name, watched(name))
    for words, expected in (
        ("shape.obj teapot", ["16", "16"]),
        ("shape.obj -q", ["16"]),
        # lit pixels are those that differ from a column of the background
        ("shape.obj", ["16", "count", "1"]),
        ("shape.obj teapot --json", ["16", "count", "1"] * 2),
        # what looks like a background is compared with one
        ("shape.obj teapot --target 0,99,0 --eye 0,99,1", ["16", "1"] * 2),
        ("shape.obj --unlit --color red --ambient 1 --eye 0.1,0.1,3 --target 0,0,0 --fov 1 -q", ["16", "1"]),
    ):
        calls.clear()
        said = shackled(f"render {words} --size 16 -o out/")
        assert calls == expected
        assert ("nothing is visible" in said.err) == ("99" in words)
    assert said.err == ""


def test_what_is_there_is_skipped(three: Path, shackled: Shackled) -> None:
    """Only whole files that show the same scene: not those of another input or look, and no halves."""
    (three / "b.STL").unlink()
    command = "render shape.obj models -o out/ --size 24 --skip-existing"
    made = {"shape", "a", "c"}

    def drawn(more: str = "") -> set[str]:
        said = shackled(f"{command} {more}")
        lines = [line.partition(": ") for line in said.out.splitlines()]
        assert len(lines) == 3
        skipped = {line for line, _, rest in lines if rest == "skipped, as it shows the same scene already"}
        assert (f", {len(skipped)} skipped, 0 failed" in said.err) == bool(skipped)
        return {Path(line.partition(" -> ")[2]).stem for line, _, _ in lines if line not in skipped}

    assert drawn() == made
    before = {path: path.read_bytes() for path in Path("out").iterdir()}
    assert drawn() == drawn("--jobs 2") == set()
    assert before == {path: path.read_bytes() for path in Path("out").iterdir()}
    picture = Path("out/a.png")
    for damaged in (picture.read_bytes()[:-9], bytes(4000), before[Path("out/c.png")]):
        picture.write_bytes(damaged)
        assert drawn() == {"a"}
        assert picture.read_bytes() == before[picture]
    (three / "c.obj").write_text((three / "c.obj").read_text().replace("0 3 0", "0 3.5 0"))
    assert drawn() == {"c"}
    assert drawn("--elevation 40") == made
    assert drawn("--elevation 40 --transparent") == made
    assert drawn("--elevation 40 --transparent") == set()
    report = shackled(f"{command} --elevation 40 --transparent --json").out.splitlines()
    assert json.loads(report[0]) == {"input": "shape.obj", "output": "out/shape.png", "skipped": True}
    said = shackled("render shape.obj -o out/shape.png --size 24 --elevation 40 --transparent --skip-existing")
    assert said.out == "shape.obj -> out/shape.png: skipped, as it shows the same scene already\n"


def test_a_scene_that_is_too_large_for_its_file_is_known_by_its_digest(
    monkeypatch: pytest.MonkeyPatch, shackled: Shackled
) -> None:
    monkeypatch.setattr("shackled.scene._files.picture.MAX_CHUNK", 10)
    command = "render shape.obj -o out/ --size 24 --skip-existing"
    assert "skipped" not in shackled(command).out
    assert b"shackled-sha256" in Path("out/shape.png").read_bytes()
    assert "skipped" in shackled(command).out
    assert "skipped" not in shackled(f"{command} --fov 20").out


def test_what_cannot_be_skipped(shackled: Shackled) -> None:
    for more, words in (
        ("-o out.webp", "--skip-existing needs .png files, which say what they show, not out.webp"),
        ("-o -", "--skip-existing needs .png files, which say what they show, not -"),
        ("--turntable 2", "--skip-existing and --turntable exclude each other"),
        ("--no-scene", "--skip-existing and --no-scene exclude each other"),
        ("--shard 5/4", "--shard must be the number of a part and of all parts, such as 1/4 to 4/4, not '5/4'"),
        ("--shard 0/4", "not '0/4'"),
    ):
        assert words in shackled(f"render shape.obj --skip-existing {more}", expect=2).err
    assert os.listdir() == ["shape.obj"]


def test_the_shards_are_the_whole(shackled: Shackled) -> None:
    for name in "abcde":
        Path(f"{name}.obj").write_text(Path("shape.obj").read_text())
    found = [shackled(f"render . -o out/ --size 8 --shard {part}/4 --json").out.splitlines() for part in range(1, 5)]
    assert [len(each) for each in found] == [2, 2, 1, 1]
    assert {json.loads(line)["input"] for each in found for line in each} == {*map(str, Path().glob("*.obj"))}
    assert shackled("render shape.obj -o out/ --shard 2/2").err.startswith("0 rendered, 0 failed")


def test_a_batch_writes_a_log_where_there_is_no_terminal(monkeypatch: pytest.MonkeyPatch, shackled: Shackled) -> None:
    monkeypatch.setattr(progress, "LOG_PAUSE", 0.0)
    lines = shackled("render shape.obj teapot -o out/ --size 16").err.splitlines()
    assert re.fullmatch(r"rendering: 1 of 2 in \d+ s, about \d+ s left", lines[0])
    assert lines[1].startswith("rendering: 2 of 2 in ")
    assert shackled("render shape.obj teapot -o out/ --size 16 -q").err == ""


def test_a_name_that_begins_with_a_dash(shackled: Shackled) -> None:
    """As a shell gives it for *.obj: it does not stop the others."""
    Path("-dash.obj").write_text(Path("shape.obj").read_text())
    shackled("render -dash.obj shape.obj -o out/ --size 16")
    assert sorted(os.listdir("out")) == ["-dash.png", "shape.png"]
    assert shackled("render -o one.png --size 16 -- -dash.obj").err == ""
    wrong = shackled("render shape.obj -gone.obj", expect=2).err
    assert wrong == "shackled: no such option -g; before a file whose name begins with -, put --\n"
