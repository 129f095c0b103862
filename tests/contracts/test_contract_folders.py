"""The folders of contracts/src: which imports which, and what the README says of them."""

from __future__ import annotations

import os.path
import re
from graphlib import TopologicalSorter
from pathlib import Path

SOURCES = Path(__file__).resolve().parents[2] / "contracts" / "src"
README = SOURCES.parent / "README.md"
#: `using Library for Type global`, by which contracts outside call functions of a value without a line of their own,
#: must stand in the file that declares the type, and these libraries take it as their argument.
ATTACHED = {
    "building/ModelMaker.sol": {"building/Lettering.sol", "building/Shapes.sol"},
    "building/StageMaker.sol": {"building/Framing.sol"},
}


def imports() -> dict[str, set[str]]:
    """Return the files that each file of contracts/src imports from there."""
    found = {}
    for path in SOURCES.rglob("*.sol"):
        name = path.relative_to(SOURCES).as_posix()
        targets = re.findall(r"""^import\b[^;"']*["'](\.[^"']+)["'];""", path.read_text("utf-8"), re.MULTILINE)
        found[name] = {os.path.normpath(f"{folder_of(name)}/{target}") for target in targets}
    return found


def folder_of(name: str) -> str:
    return os.path.dirname(name) or "."


def test_no_circle_of_files() -> None:
    graph = imports()
    for name, attached in ATTACHED.items():
        assert attached <= graph[name]
        assert all(name in graph[each] for each in attached)
        graph[name] -= attached
    assert set().union(*graph.values()) <= graph.keys()
    TopologicalSorter(graph).prepare()


def test_no_circle_of_folders() -> None:
    graph: dict[str, set[str]] = {}
    for name, targets in imports().items():
        graph.setdefault(folder_of(name), set()).update(folder_of(target) for target in targets)
    TopologicalSorter({folder: used - {folder} for folder, used in graph.items()}).prepare()


def test_the_readme_has_a_row_for_each_folder() -> None:
    """A row names files of its folder only; that of src/, which has few, names all of them."""
    rows = dict(re.findall(r"^\| `src/([\w/]*)` \| (.*) \|$", README.read_text("utf-8"), re.MULTILINE))
    files = imports()
    assert rows.keys() == {f"{folder_of(name)}/".removeprefix("./") for name in files}
    for folder, text in rows.items():
        assert [name for name in re.findall(r"`(\w+\.sol)`", text) if f"{folder}{name}" not in files] == []
    assert all(f"`{name}`" in rows[""] for name in files if folder_of(name) == ".")
