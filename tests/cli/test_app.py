"""How the command ends, whatever happens."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import NoReturn

import pytest

from shackled import cli
from shackled.cli.app import run


def test_stopped_while_it_is_read_in(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    def run() -> NoReturn:
        raise KeyboardInterrupt

    monkeypatch.setitem(sys.modules, "shackled.cli.app", SimpleNamespace(run=run))
    with pytest.raises(SystemExit) as end:
        cli.main()
    assert end.value.code == 1
    assert capsys.readouterr() == ("", "shackled: stopped\n")


def test_what_is_left_out_is_a_note_on_stderr(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("a.obj").write_text("mtllib a.mtl\nmtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    assert run(["render", "a.obj", "--size", "8", "--json"]) == 0
    assert capsys.readouterr().err == "shackled: note: a.obj: its materials are left out: a.mtl does not exist\n"


def test_characters_that_steer_a_terminal_are_not_sent_to_it(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["render", "a\x1b[31m.obj"]) == 2
    assert capsys.readouterr().err == "shackled: a\\x1b[31m.obj does not exist\n"


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full here")
@pytest.mark.parametrize("unbuffered", ["", "1"])
def test_a_full_disk_behind_the_output(unbuffered: str) -> None:
    with Path("/dev/full").open("w", encoding="utf-8") as full:
        told = subprocess.run(
            [sys.executable, "-m", "shackled", "render", "shape.obj", "--size", "8", "--json"],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            timeout=60,
            env=os.environ | {"PYTHONUNBUFFERED": unbuffered},
        )
    assert told.returncode == 1
    assert told.stderr == "shackled: No space left on device\n"
