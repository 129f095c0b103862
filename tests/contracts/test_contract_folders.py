"""The folders of contracts/src: which imports which, what the README says of them, and what their files compute."""

from __future__ import annotations

import ast
import os.path
import re
from graphlib import TopologicalSorter
from pathlib import Path

SOURCES = Path(__file__).resolve().parents[2] / "contracts" / "src"
README = SOURCES.parent / "README.md"
#: The folders of which each file computes a function of picture.py.
DRAWING = ("uniforms", "pipeline", "effects", "shadows")
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


def test_the_readme_says_which_file_answers() -> None:
    """As the sources do: Engine overrides the function with nothing, and Wires is the last base of Wireframe."""
    assert "| `drawEdges` | *nothing* (Engine) | Wires |" in README.read_text("utf-8")


def test_files_say_which_function_of_the_definition_they_compute() -> None:
    """In their first comment."""
    tree = ast.parse((SOURCES.parent / "picture.py").read_text("utf-8"))
    known = {each.name for each in tree.body if isinstance(each, ast.FunctionDef | ast.ClassDef)}
    for kind in (each for each in tree.body if isinstance(each, ast.ClassDef)):
        known |= {f"{kind.name}.{each.name}" for each in kind.body if isinstance(each, ast.FunctionDef)}
    for path in (path for folder in DRAWING for path in (SOURCES / folder).rglob("*.sol")):
        comment = path.read_text("utf-8").partition("\n// ")[2].partition("\n")[0]
        named = re.findall(r"`([\w.]+)`", comment) if " of picture.py" in comment else []
        assert named, f"{path}: the first comment names no function of picture.py"
        assert set(named) <= known, f"{path}: picture.py has no {set(named) - known}"
