"""Items of the library and the author's scenes, in the Studio before the contract is deployed."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from preview.small_contracts import SVG, answering, contract, output
from preview.test_preview import HERE, MODULES, needs_solc
from shackled.chain._embedded import RevmChain
from shackled.cli.app import run
from shackled.ethereum._encoding import checksum_address
from shackled.library import items
from shackled.preview._preview import Preview, Request
from shackled.preview._project import Project
from shackled.preview._world import World, stored_scene


@needs_solc
def test_contracts_that_need_the_library_have_it(tmp_path: Path) -> None:
    (tmp_path / "node_modules").symlink_to(MODULES)
    project = Project(Path(shutil.copy(HERE / "Shelf.sol", tmp_path)))
    (token,) = Preview(project, Request()).tokens()
    assert token.problems == []
    # with its address in the code, in place of that of the constructor
    codes = {part.pointer: part.code for item in items() for part in item.transactions}
    library = RevmChain().address("Library")
    assert codes.items() <= World(contract(answering(output(SVG)) + library)).codes.items()
    assert not codes.keys() & World(contract(answering(output(SVG)))).codes.keys()


def test_scenes_of_the_author(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    codes = stored_scene("icons/diamond")
    pointer = list(codes)[-1]
    # that of the library, and of `shackled store`
    assert pointer == next(each.pointer for each in items() if each.name == "diamond")
    assert pointer in World(contract(answering(output(SVG))), stored=codes).codes
    monkeypatch.setenv("PATH", str(tmp_path))
    source = tmp_path / "A.sol"
    source.write_text("contract A {}")
    # there is no compiler, but the pointer is printed
    assert run(["preview", str(source), "--check", "--store", "icons/diamond"]) == 2
    assert f"icons/diamond is stored at {checksum_address(pointer)}" in capsys.readouterr().err
    assert run(["preview", str(source), "--check", "--store", "none"]) == 2
    assert "none does not exist" in capsys.readouterr().err
