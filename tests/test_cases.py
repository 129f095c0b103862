"""Files as people have them: cases.toml says what becomes of each."""

from __future__ import annotations

import re
import shlex
import tomllib
from pathlib import Path
from typing import Any

import pytest
from benchmarks import shared

import case_files
from pictures import pixels_of
from shackled.cli.app import run

CASES = shared.SHARED / "review" / "cases"
ROWS = tomllib.loads(Path(__file__).with_name("cases.toml").read_text("utf-8"))["case"]
#: The keys of a row.
KEYS = {"file", "make", "text", "name", "options", "error", "notes", "shows", "empty", "like"}
#: Exact colours, and a square of two units that fills the picture.
PLAIN = shlex.split(
    "--unlit --no-antialias --azimuth 0 --elevation 0 --orthographic --background #102030 --size 64 --margin 0"
    " --up-axis y"
)
NOTE = "shackled: note: "


def shared_file(name: str) -> Path:
    path = Path(CASES, name)
    if not path.is_file():
        pytest.skip(f"needs {name} of ../shared/review/cases")
    return path


def file_of(row: dict[str, Any], folder: Path) -> Path:
    if "file" in row:
        return shared_file(row["file"])
    if "text" in row:
        return case_files.written(folder, {row["name"]: row["text"]})
    if row["make"] in case_files.FILES:
        return case_files.written(folder, case_files.FILES[row["make"]])
    made: Path = getattr(case_files, row["make"])(folder)
    return made


@pytest.mark.parametrize("row", ROWS, ids=[str(row.get("file") or row.get("make") or row["name"]) for row in ROWS])
def test_what_becomes_of_a_file(row: dict[str, Any], tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert row.keys() <= KEYS

    def render(path: Path, *more: str) -> tuple[int, list[str]]:
        options = [*PLAIN, *shlex.split(row.get("options", "")), "-o", str(tmp_path / "picture.png")]
        code = run(["render", str(path), "-q" if "--strict" in more else "--json", *options, *more])
        return code, capsys.readouterr().err.splitlines()

    path = file_of(row, tmp_path)
    code, said = render(path)
    picture = tmp_path / "picture.png"
    if "error" in row:
        assert (code, len(said)) == (2, 1), said
        assert re.search(row["error"], said[0]), said
        assert not picture.exists()
        return
    expected = row.get("notes", [])
    assert code == 0, said
    if "empty" in row:
        assert re.search(row["empty"], said[0]), said
        assert said[1:] == ["nothing is visible; the picture shows only the background"]
        assert (pixels_of(picture) == (0x10, 0x20, 0x30)).all()
        return
    assert len(said) == len(expected), said
    for line, pattern in zip(said, expected, strict=True):
        assert line.startswith(NOTE), line
        assert re.search(pattern, line), line
    pixels = pixels_of(picture)
    if "shows" in row:
        count = len(row["shows"])
        middles = [pixels[32, 64 * (2 * step + 1) // (2 * count)] for step in range(count)]
        assert [bytes(each).hex() for each in middles] == row["shows"]
    if "like" in row:
        render(shared_file(row["like"]))
        assert (pixels_of(picture) == pixels).all()
    picture.unlink()
    assert render(path, "--strict")[0] == (2 if expected else 0)
    assert picture.exists() == (not expected)
