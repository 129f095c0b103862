"""A folder of its own for each test, with a mesh in it, and the command, run in this process."""

from __future__ import annotations

import shlex
from pathlib import Path

import pytest

from commands import Said, Shackled
from shackled.cli.app import run

OBJ = """\
v -1 -1 0.5
v 1 -1 0.25
v 0 1 0
v 0 0 -1
f 1 2 3
f 2 1 4
f 3 2 4
f 1 3 4
"""


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("SHACKLED_CACHE", str(tmp_path / "cache"))
    Path("shape.obj").write_text(OBJ, "utf-8")
    return tmp_path


@pytest.fixture
def shackled(capsys: pytest.CaptureFixture[str]) -> Shackled:
    """Runs the command with words as a shell splits them, and with further arguments. expect: its exit code."""

    def command(words: str, *more: object, expect: int = 0) -> Said:
        capsys.readouterr()
        code = run([*shlex.split(words), *map(str, more)])
        said = Said(code, *capsys.readouterr())
        assert code == expect, said
        assert "Traceback" not in said.err
        return said

    return command
