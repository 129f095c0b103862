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
from shackled.ethereum._encoding import keccak256
from shackled.preview._project import CompilerError, Project

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


def hashes(**contents: str) -> dict[str, Any]:
    """Return the sources in the metadata of a compiler."""
    return {name: {"keccak256": "0x" + keccak256(content.encode()).hex()} for name, content in contents.items()}


def forge_writes(folder: Path, place: str, source: str, name: str, content: str = "", **more: Any) -> None:
    sources = hashes(**{source: content or f"contract {name} {{}}"})
    metadata = {"settings": {"compilationTarget": {source: name}}, "sources": sources}
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
    forge_writes(folder, "T.sol/OldName.json", "src/T.sol", "OldName")
    forge_writes(folder, "T.sol/Token.json", "src/T.sol", "Token")
    assert [each.name for each in source(folder, "src/T.sol", "contract Token {}").compile()] == ["Token"]


def test_the_newest_of_several_artifacts(tool: Tool) -> None:
    """As after a file of the same name was added: forge then writes to another folder."""
    folder = tool("forge", FORGE)
    forge_writes(folder, "src/T.sol/T.json", "src/T.sol", "T", abi=[{"type": "receive"}])
    forge_writes(folder, "T.sol/T.json", "src/T.sol", "T")
    os.utime(folder / "out" / "T.sol" / "T.json", (1, 1))
    (found,) = source(folder, "src/T.sol", "contract T {}").compile()
    assert found.abi == [{"type": "receive"}]


@pytest.mark.parametrize(
    "said",
    [
        "Error: Compiler run failed:\nError (6933): Expected primary expression.\n --> src/T.sol:4:28:",
        "Compiler run failed",
        "Error: solc exited with exit status: 1",
        "TypeError: Wrong argument count.\n --> contracts/T.sol:1:2:",
        "Error HH600: Compilation failed",
        "Error: Failed to install solc 0.8.35: error sending request for url (https://example.org)",
    ],
)
@pytest.mark.parametrize("name", ["forge", "hardhat"])
def test_failures_of_tools_that_end_with_0(tool: Tool, name: str, said: str) -> None:
    """As the forge of npm does, with and without what an earlier run wrote."""
    folder = tool(name, f"""[ "$1" = config ] && echo '{{"out":"out"}}' || printf 'Compiling\n{said}\n' """)
    place = {"forge": "src/T.sol", "hardhat": HARDHAT}[name]
    forge_writes(folder, "T.sol/T.json", "src/T.sol", "T")
    hardhat_writes(folder, "contract T {}")
    with pytest.raises(CompilerError) as raised:
        source(folder, place, "contract T {}").compile()
    assert raised.value.said == f"Compiling\n{said}"


@pytest.mark.parametrize("said", ["Warning (2072): Unused.", "1 | Error: no", "Errors: none", "note: TypeError: no"])
def test_warnings_are_no_failures(tool: Tool, said: str) -> None:
    folder = tool("forge", f"""[ "$1" = config ] && echo '{{"out":"out"}}' || echo '{said}' """)
    forge_writes(folder, "T.sol/T.json", "src/T.sol", "T")
    assert source(folder, "src/T.sol", "contract T {}").compile()


def test_artifacts_of_other_sources(tool: Tool) -> None:
    """The hashes decide, also those of imports."""
    folder = tool("forge", FORGE)
    forge_writes(folder, "T.sol/T.json", "src/T.sol", "T", "contract T {}\n")
    project = source(folder, "src/T.sol", "contract T {}\r\n")
    assert project.compile()
    built = folder / "out" / "T.sol" / "T.json"
    message = r"T\.json was not made of src/{} as it is now: run `forge build --force`"
    source(folder, "src/T.sol", "contract T { }\n")
    with pytest.raises(InputError, match=message.format("T.sol")):
        project.compile()
    document = json.loads(built.read_text())
    document["metadata"]["sources"] = hashes(**{"src/T.sol": "contract T { }\n", "src/B.sol": "contract B {}"})
    write(built, document)
    assert project.compile()
    source(folder, "src/B.sol", "contract B { }")
    with pytest.raises(InputError, match=message.format("B.sol")):
        project.compile()
    write(built, document | {"metadata": None})
    assert project.compile()


def test_a_solc_that_fails_without_an_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "solc").write_text("#!/bin/sh\necho '{}'; exit 1")
    (tmp_path / "solc").chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}{os.pathsep}{os.environ['PATH']}")
    with pytest.raises(CompilerError, match=r"T\.sol does not compile"):
        source(tmp_path, "T.sol", "contract T {}").compile()


HARDHAT = "contracts/T.sol"


def hardhat_writes(folder: Path, content: str, version: int = 2) -> None:
    name = HARDHAT if version == 2 else f"project/{HARDHAT}"
    artifact = {"sourceName": HARDHAT, "abi": [], "bytecode": CREATION}
    artifact |= {"inputSourceName": name, "buildInfoId": "1"} if version == 3 else {}
    write(folder / "artifacts" / HARDHAT / "T.json", artifact)
    if version == 2:
        write(folder / "artifacts" / HARDHAT / "T.dbg.json", {"buildInfo": "../../build-info/1.json"})
    build = {"input": {"sources": {name: {"content": content}}}}
    write(folder / "artifacts" / "build-info" / "1.json", build)


@pytest.mark.parametrize("version", [2, 3])
def test_hardhat_must_write_where_artifacts_are_looked_for(tool: Tool, version: int) -> None:
    folder = tool("hardhat", "exit 0")
    hardhat_writes(folder, "contract T {}", version)
    assert [each.name for each in source(folder, HARDHAT, "contract T {}").compile()] == ["T"]
    changed = source(folder, HARDHAT, "contract T { uint256 x; }")
    message = r"T\.json was not made of contracts/T\.sol as it is now: leave `paths\.artifacts` at its default"
    with pytest.raises(InputError, match=message):
        changed.compile()
    (folder / "artifacts" / HARDHAT / "T.json").unlink()
    with pytest.raises(InputError, match=r"hardhat wrote no contract of contracts/T\.sol to .*: leave `paths"):
        changed.compile()


def test_errors_of_hardhat_without_its_own_places(tool: Tool) -> None:
    folder = tool("hardhat", "printf 'Error HH600: failed\\n    at Main.run (hardhat.js:1:2)\\n'; exit 1")
    with pytest.raises(CompilerError) as raised:
        source(folder, HARDHAT, "contract T {}").compile()
    assert raised.value.said == "Error HH600: failed"
