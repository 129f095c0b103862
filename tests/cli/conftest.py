"""A folder of its own for each test, with a mesh in it."""

from __future__ import annotations

from pathlib import Path

import pytest

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
    Path("shape.obj").write_text(OBJ, "utf-8")
    return tmp_path
