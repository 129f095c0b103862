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
from tools.lock import one_line_each


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


@pytest.mark.parametrize(("target", "listed"), [(prepare.prepare_package, "package"), (prepare.prepare_dev, "dev")])
def test_packages_are_those_that_were_tried(
    target: Callable[[], None], listed: str, commands: list[tuple[object, ...]], monkeypatch: pytest.MonkeyPatch
) -> None:
    """By version and hash; the package itself brings no others, nor does what builds it."""
    monkeypatch.setattr(prepare, "make_venv", lambda: None)
    monkeypatch.setattr(Path, "touch", lambda path: None)
    target()
    others, itself = commands
    assert others[-3:] == ("--require-hashes", "--requirement", prepare.LOCKED / f"{listed}.txt")
    assert itself[-4:] == ("--no-deps", "--no-build-isolation", "--editable", prepare.ROOT)
    assert sys.version_info >= prepare.OLDEST_PYTHON


def test_make_npm_needs_the_compiler_only(commands: list[tuple[object, ...]], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Path, "touch", lambda path: None)
    monkeypatch.setattr(subprocess, "run", lambda *_, **__: subprocess.CompletedProcess(["node"], 0, "v20.19.2\n"))
    prepare.prepare_node("contracts")
    assert [command[:2] for command in commands] == [("npm", "ci")]
    makefile = (prepare.ROOT / "Makefile").read_text()
    assert "\nnpm: $(CONTRACTS) $(PACKAGE) ##" in makefile


def test_the_compiler_of_evm_is_installed_where_it_can_be(
    commands: list[tuple[object, ...]], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    prepare.prepare_rust()
    assert commands == []
    monkeypatch.setattr(shutil, "which", lambda name: name if name == "apt-get" else None)
    prepare.prepare_rust()
    assert commands[1][-4:] == prepare.RUST_PACKAGES
    monkeypatch.setenv("SHACKLED_NO_APT", "1")
    prepare.prepare_rust()
    assert "evm.wasm is not built again: missing: the compiler of evm/" in capsys.readouterr().out


def test_one_line_for_each_package() -> None:
    assert one_line_each("a==1 ; os \\\n    --hash=b \\\n    --hash=c\nd==2\n") == "a==1 ; os --hash=b --hash=c\nd==2\n"
