"""Contracts that Foundry and Hardhat have compiled: those of the source as it is now. Scripts stand for the tools."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from preview.small_contracts import SVG, answering, contract, output
from shackled.errors import InputError
from shackled.preview import CompilerError, Project

Tool = Callable[[str, str], Path]


@pytest.fixture
def tool(tmp_path: Path) -> Tool:
    """Make a project with a tool that runs a script of the shell."""

    def make(name: str, script: str) -> Path:
        (tmp_path / {"forge": "foundry.toml", "hardhat": "hardhat.config.js"}[name]).write_text("")
        command = tmp_path / "node_modules" / ".bin" / name
        command.parent.mkdir(parents=True)
        command.write_text(f"#!/bin/sh\n{script}\n")
        command.chmod(0o755)
        return tmp_path

    return make


FORGE = """[ "$1" = config ] && echo '{"out":"out"}'; exit 0"""
CREATION = "0x" + contract(answering(output(SVG))).creation.hex()


def write(path: Path, document: dict[str, Any]) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(document))


def forge_writes(folder: Path, place: str, source: str, name: str, **more: Any) -> None:
    metadata = {"settings": {"compilationTarget": {source: name}}}
    write(folder / "out" / place, {"abi": [], "bytecode": {"object": CREATION}, "metadata": metadata, **more})


def source(folder: Path, name: str, content: str) -> Project:
    (folder / name).parent.mkdir(parents=True, exist_ok=True)
    (folder / name).write_text(content)
    return Project(folder / name)


def test_files_of_one_name(tool: Tool) -> None:
    folder = tool("forge", FORGE)
    forge_writes(folder, "R.sol/R.json", "src/a/R.sol", "R", abi=[{"type": "receive"}])
    forge_writes(folder, "b/R.sol/R.json", "src/b/R.sol", "R")
    first, second = (source(folder, f"src/{each}/R.sol", "contract R {}").compile() for each in "ab")
    assert [len(each.abi) for each in first] == [1]
    assert [len(each.abi) for each in second] == [0]
    with pytest.raises(InputError, match=r"forge wrote no contract of src/c/R\.sol to "):
        source(folder, "src/c/R.sol", "contract R {}").compile()


def test_contracts_that_were_renamed(tool: Tool) -> None:
    folder = tool("forge", FORGE)
    for name in ("OldName", "Token"):
        forge_writes(folder, f"T.sol/{name}.json", "src/T.sol", name)
    project = source(folder, "src/T.sol", "// was OldName\ncontract Token {}")
    assert [each.name for each in project.compile()] == ["Token"]


def test_the_newest_of_several_artifacts(tool: Tool) -> None:
    """As after a file of the same name was added: forge then writes to another folder."""
    folder = tool("forge", FORGE)
    forge_writes(folder, "src/T.sol/T.json", "src/T.sol", "T", abi=[{"type": "receive"}])
    forge_writes(folder, "T.sol/T.json", "src/T.sol", "T")
    os.utime(folder / "out" / "T.sol" / "T.json", (1, 1))
    (found,) = source(folder, "src/T.sol", "contract T {}").compile()
    assert found.abi == [{"type": "receive"}]


def test_what_the_tools_say(tool: Tool) -> None:
    said = "Failed to install solc 0.8.35: error sending request for url (https://example.org)"
    folder = tool("forge", f'[ "$1" = config ] && echo \'{{"out":"out"}}\' && exit 0; echo "{said}"; exit 1')
    with pytest.raises(InputError, match=r"forge has no compiler: Failed to install solc 0\.8\.35: error sending"):
        source(folder, "src/T.sol", "contract T {}").compile()


HARDHAT = "contracts/T.sol"


def hardhat_writes(folder: Path, content: str) -> None:
    artifact = {"sourceName": HARDHAT, "contractName": "T", "abi": [], "bytecode": CREATION}
    write(folder / "artifacts" / HARDHAT / "T.json", artifact)
    write(folder / "artifacts" / HARDHAT / "T.dbg.json", {"buildInfo": "../../build-info/1.json"})
    build = {"input": {"sources": {HARDHAT: {"content": content}}}}
    write(folder / "artifacts" / "build-info" / "1.json", build)


def test_hardhat_must_write_where_artifacts_are_looked_for(tool: Tool) -> None:
    folder = tool("hardhat", "exit 0")
    hardhat_writes(folder, "contract T {}")
    assert [each.name for each in source(folder, HARDHAT, "contract T {}").compile()] == ["T"]
    with pytest.raises(
        InputError, match=r"hardhat wrote no contract of contracts/T\.sol to .*: leave `paths.artifacts`"
    ):
        source(folder, HARDHAT, "contract T { uint256 x; }").compile()


def test_errors_of_hardhat_without_its_own_places(tool: Tool) -> None:
    folder = tool("hardhat", "printf 'Error HH600: failed\\n    at Main.run (hardhat.js:1:2)\\n'; exit 1")
    with pytest.raises(CompilerError) as raised:
        source(folder, HARDHAT, "contract T {}").compile()
    assert raised.value.said == "Error HH600: failed"
