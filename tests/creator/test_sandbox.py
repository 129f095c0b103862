"""A process that reads files of strangers reaches nothing else. It is tried in a process of its own, for good."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

PROLOGUE = """
import os, socket, subprocess, sys
from pathlib import Path
from shackled.creator import ForbiddenError, enter_sandbox, upload_folder
enter_sandbox()
mine = Path(sys.argv[1])
"""


def tried(tmp_path: Path, code: str) -> str:
    """What a program prints that tries something in a guarded process."""
    (tmp_path / "secret.txt").write_text("secret")
    (tmp_path / "secret.py").write_text("print('secret')")
    script = (
        f"{PROLOGUE}\nwith upload_folder() as inside:\n    try:\n        {code}\n    except ForbiddenError as error:\n"
    )
    script += "        print('forbidden:', error)\nprint((mine / 'secret.txt').read_text())\n"
    found = subprocess.run(
        [sys.executable, "-c", script, str(tmp_path)], check=True, capture_output=True, text=True, timeout=60
    )
    return found.stdout


@pytest.mark.parametrize(
    "code",
    [
        "print((mine / 'secret.txt').read_text())",
        "open(mine / 'new.txt', 'w')",
        "os.open(mine / 'secret.txt', os.O_RDONLY)",
        "(inside / 'link').symlink_to(mine / 'secret.txt')",
        "open(inside / '..' / '..' / 'etc' / 'hostname')",
        "os.remove(mine / 'secret.txt')",
        "socket.create_connection(('127.0.0.1', 9))",
        "subprocess.run(['true'])",
        "os.system('true')",
        "open(os.__file__, 'a')",
        # of the kind that Python loads, but not from where it loads them
        "open(mine / 'secret.py')",
        "import importlib.util as u; s = u.spec_from_file_location('x', mine / 'secret.py');"
        " s.loader.exec_module(u.module_from_spec(s))",
    ],
)
def test_nothing_outside_is_reached(code: str, tmp_path: Path) -> None:
    first, *rest = tried(tmp_path, code).splitlines()
    assert first.startswith("forbidden:")
    assert rest == ["secret"]  # after the upload all is as before


@pytest.mark.parametrize(
    "code",
    [
        "(inside / 'a.txt').write_text('x'); print('allowed', (inside / 'a.txt').read_text())",
        "import colorsys; print('allowed')",
    ],
)
def test_what_reading_needs_is_allowed(code: str, tmp_path: Path) -> None:
    assert tried(tmp_path, code).startswith("allowed")
