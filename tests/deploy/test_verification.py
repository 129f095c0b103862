"""The files with which explorers verify the sources: complete, and what they compile to."""

from __future__ import annotations

import json
import os
import re
from pathlib import Path
from typing import Any
from unittest.mock import Mock

import pytest
from tools.build_contracts import compile_once

from compiler import needs_compiler
from shackled import artifacts
from shackled.artifacts import artifact, contracts, source, standard_input
from shackled.deploy import deployments
from shackled.deploy._contract import CONTRACTS, write_verification
from shackled.ethereum._encoding import checksum_address

#: `make verify` compiles all groups, `make test` one with sources of a library.
CHOSEN = os.environ.get("VERIFY", "png")
GROUPS = sorted({artifact(name).group for name in contracts()}) if CHOSEN == "all" else CHOSEN.split()


def test_every_source_is_in_the_files(tmp_path: Path) -> None:
    """Explorers refuse sources that are only named, by `urls`."""
    assert write_verification(tmp_path, 1, deployments(CONTRACTS)) == {}
    entries = json.loads((tmp_path / "contracts.json").read_text("utf-8"))["contracts"]
    assert [entry["name"].partition(":")[2] for entry in entries] == [each.name for each in deployments(CONTRACTS)]
    assert {path.name for path in tmp_path.iterdir()} == {
        "contracts.json",
        *(entry["standardInput"] for entry in entries),
    }
    for entry in entries:
        path, _, name = entry["name"].partition(":")
        request = json.loads((tmp_path / entry["standardInput"]).read_text("utf-8"))
        assert request == standard_input(artifact(name).group)
        assert name in request["settings"]["outputSelection"][path]
        assert all(source.keys() == {"content"} for source in request["sources"].values())


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        (None, r"the source @openzeppelin/\S+, of a library, is not installed: run npm ci in contracts/"),
        ("other", r"@openzeppelin/\S+ has changed: run tools/build_contracts.py --group png"),
    ],
)
def test_contracts_whose_sources_are_not_there(
    text: str | None, reason: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """They are left out, and the others are written."""
    monkeypatch.setattr(artifacts, "source", lambda path: text if path.startswith("@") else source(path))
    (found,) = write_verification(tmp_path, 1, deployments(["GlbEncoder", "PngEncoder"])).items()
    assert found[0] == "PngEncoder"
    assert re.fullmatch(reason, found[1])
    assert {path.name for path in tmp_path.iterdir()} == {"contracts.json", "standard-input-glb.json"}
    (entry,) = json.loads((tmp_path / "contracts.json").read_text("utf-8"))["contracts"]
    assert entry["standardInput"] == "standard-input-glb.json"


def test_the_program_of_the_documentation(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page = (Path(__file__).parents[2] / "docs" / "nodes.md").read_text("utf-8")
    program = re.search(r"```python\n([^`]*stdJsonInput[^`]*)```", page)
    assert program
    write_verification(tmp_path / "deployed-1", 1, deployments(["GlbEncoder"]))
    sent: list[tuple[str, dict[str, Any]]] = []

    def post(url: str, json: dict[str, Any], timeout: float) -> Mock:
        sent.append((url, json))
        return Mock()

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("requests.post", post)
    exec(program[1], {})
    ((url, body),) = sent
    (contract,) = deployments(["GlbEncoder"])
    assert url == f"https://sourcify.dev/server/v2/verify/1/{checksum_address(contract.address)}"
    assert re.fullmatch(r"0\.8\.37\+commit\.[0-9a-f]{8}", body.pop("compilerVersion"))
    assert body == {
        "stdJsonInput": standard_input("glb"),
        "contractIdentifier": "encode/GlbEncoder.sol:GlbEncoder",
    }


@needs_compiler
@pytest.mark.parametrize("group", GROUPS)
def test_an_input_compiles_alone(group: str) -> None:
    """The compiler gets no other file, and makes the creation code."""
    made = compile_once(standard_input(group))
    codes = {name: output["evm"]["bytecode"]["object"] for each in made.values() for name, output in each.items()}
    assert codes == {name: artifact(name).creation.hex() for name in contracts() if artifact(name).group == group}
