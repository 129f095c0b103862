"""The commands that `make release-check` takes out of README and docs, and the page that an install builds."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest
from tools import build_hook
from tools.addresses import ROOT
from tools.doc_commands import NEED_NODE, SKIPPED, commands

PAGE = """Run `make npm`, or `make`.

```
shackled render a.obj   # draws
$ pip install '.[chain]'
```

```python
shackled = 1
make = 2
```

    ```sh
    make demo
    ```

`shackled creator` and `shackled info`
"""


def test_commands_of_a_page() -> None:
    wanted = ["make npm", "shackled render a.obj", "pip install '.[chain]'", "make demo", "shackled creator"]
    assert commands(PAGE) == wanted


def test_every_exception_is_one_of_a_command() -> None:
    pages = [ROOT / "README.md", *(ROOT / "docs").glob("*.md")]
    found = [command for page in pages for command in commands(page.read_text("utf-8"))]
    for start in (*SKIPPED, *NEED_NODE):
        assert any(command.startswith(start) for command in found), start


@pytest.fixture
def clone(tmp_path: Path) -> Path:
    """The files of which the page is made, and a page that is newer."""
    for name in build_hook.PAGE_SOURCES:
        (path := tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        path.touch()
    (tmp_path / "build" / "page").mkdir(parents=True)
    for name in ("page/index.html", "creator.html"):
        (tmp_path / "build" / name).touch()
    return tmp_path


def test_a_page_is_built_if_it_is_old_or_missing(clone: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    ran: list[list[str]] = []
    monkeypatch.setattr(subprocess, "run", lambda command, **_: ran.append(command))
    assert build_hook.build_page(clone) == ""
    assert ran == []
    os.utime(clone / "tools" / "build_page.py", (2**32, 2**32))
    monkeypatch.setattr(shutil, "which", lambda name: None)
    assert "needs Node 20 or newer and npm" in build_hook.build_page(clone)
    monkeypatch.setattr(shutil, "which", lambda name: name)
    (clone / "web" / "node_modules").mkdir()
    assert build_hook.build_page(clone) == ""
    assert [command[-1] for command in ran] == ["web", "tools.build_page"]

    def fail(command: list[str], **_: object) -> None:
        raise subprocess.CalledProcessError(1, command)

    monkeypatch.setattr(subprocess, "run", fail)
    assert "returned non-zero exit status 1" in build_hook.build_page(clone)
