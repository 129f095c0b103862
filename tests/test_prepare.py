"""The set-up that the Makefile asks for: what it refuses, and that it can be kept from installing anything as root."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from tools import prepare
from tools.constraints import HEAD, constraints


@pytest.fixture
def commands(monkeypatch: pytest.MonkeyPatch) -> list[tuple[object, ...]]:
    """What it would have run, as root of a Debian."""
    found: list[tuple[object, ...]] = []
    monkeypatch.setattr(prepare, "run", lambda *command, **_: found.append(command))
    monkeypatch.setattr(shutil, "which", lambda name: f"/usr/bin/{name}")
    monkeypatch.setattr(os, "geteuid", lambda: 0, raising=False)
    monkeypatch.delenv("SHACKLED_NO_APT", raising=False)
    return found


def test_packages_of_the_system(commands: list[tuple[object, ...]], monkeypatch: pytest.MonkeyPatch) -> None:
    prepare.apt_install("Node.js and npm", "nodejs", "npm")
    assert [command[:2] for command in commands] == [("apt-get", "update"), ("apt-get", "install")]
    commands.clear()
    monkeypatch.setenv("SHACKLED_NO_APT", "1")
    with pytest.raises(SystemExit, match=r"missing: Node.js and npm; install it, .* apt-get install nodejs npm"):
        prepare.apt_install("Node.js and npm", "nodejs", "npm")
    assert commands == []


def test_node_that_is_new_enough() -> None:
    for said in ("v20.0.0\n", "v22.19.1", "v100.0.0"):
        prepare.check_node(said)
    for said, shown in (("v18.20.4\n", "v18.20.4"), ("v8.0.0", "v8.0.0"), ("", "of an unknown"), ("nodejs", "nodejs")):
        with pytest.raises(SystemExit, match=f"Node 20 or newer is needed, this is {shown}"):
            prepare.check_node(said)


def test_node_is_looked_at(commands: list[tuple[object, ...]], monkeypatch: pytest.MonkeyPatch) -> None:
    """Before anything is installed with it."""
    old = subprocess.CompletedProcess(["node"], 0, "v18.20.4\n")
    monkeypatch.setattr(subprocess, "run", lambda *_, **__: old)
    with pytest.raises(SystemExit, match="Node 20 or newer"):
        prepare.prepare_node()
    assert commands == []


@pytest.mark.parametrize("target", [prepare.prepare_package, prepare.prepare_dev])
def test_versions_are_those_that_were_tried(
    target: Callable[[], None], commands: list[tuple[object, ...]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(prepare, "make_venv", lambda: None)
    monkeypatch.setattr(Path, "touch", lambda path: None)
    target()
    assert {command[command.index("--constraint") + 1] for command in commands} == {prepare.CONSTRAINTS}


def test_constraints_are_of_one_python() -> None:
    assert constraints("a==1\nb @ file:///b\nc==2\n", (3, 12)) == (
        f"{HEAD}a==1 ; python_version == '3.12'\nc==2 ; python_version == '3.12'\n"
    )
    assert sys.version_info >= prepare.OLDEST_PYTHON
