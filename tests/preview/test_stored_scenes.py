"""Items of the library and the author's scenes, in the Studio before the contract is deployed."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from preview.small_contracts import SVG, answering, contract, output
from preview.test_preview import HERE, MODULES, needs_solc
from shackled.chain import RevmChain
from shackled.cli.app import run
from shackled.ethereum import checksum_address
from shackled.library import items
from shackled.preview import Preview, Project, Request, stored_scene
from shackled.preview._library import library_codes
from shackled.preview._world import World


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The user's cache."""
    monkeypatch.setattr("shackled.preview._library.user_cache_path", lambda *_, **__: tmp_path / "cache")
    library_codes.cache_clear()
    return tmp_path / "cache"


def test_the_library_is_computed_once(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    chain = RevmChain()
    addresses = chain.address("Library"), chain.address("Studio")
    made = library_codes(*addresses)
    assert {part.pointer: part.code for item in items() for part in item.transactions} == made
    (path,) = cache.iterdir()
    content = path.read_bytes()
    with monkeypatch.context() as patch:
        patch.setattr("shackled.library.items", lambda: pytest.fail("it was computed again"))
        library_codes.cache_clear()
        assert library_codes(*addresses) == made
    # a file that is damaged is written again
    path.write_bytes(content[:-1])
    library_codes.cache_clear()
    assert library_codes(*addresses) == made
    assert path.read_bytes() == content


@needs_solc
def test_contracts_that_need_the_library_have_it(cache: Path) -> None:
    folder = cache.parent
    (folder / "node_modules").symlink_to(MODULES)
    project = Project(Path(shutil.copy(HERE / "Shelf.sol", folder)))
    (token,) = Preview(project, Request()).tokens()
    assert token.problems == []
    # with its address in the code, in place of that of the constructor
    library = RevmChain().address("Library")
    assert items()[0].pointer in World(contract(answering(output(SVG)) + library)).codes
    assert items()[0].pointer not in World(contract(answering(output(SVG)))).codes


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
