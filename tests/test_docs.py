"""The Python code and the commands of the documentation, and the short programs."""

from __future__ import annotations

import ast
import json
import re
import runpy
import shlex
import subprocess
import sys
from functools import cache
from pathlib import Path
from typing import Any

import click
import numpy as np
import pytest
from click.testing import CliRunner
from tools.docs.contract_reference import MARK, filled
from tools.docs.definition import FILE as DEFINITION
from tools.docs.definition import named, on_page_markdown

import shackled
from animated_gltf import write
from nodes import KEY, Node
from pictures import frames_of
from shackled.artifacts import artifact
from shackled.cli.app import app

ROOT = Path(__file__).resolve().parent.parent
DOCS = ROOT / "docs"
PROGRAMS = sorted((ROOT / "examples" / "programs").glob("*.py"))
#: Those that need a node, whose address is in SHACKLED_RPC.
ON_A_NODE = {"node", "stored_mesh"}
#: Pages whose blocks form one program; of the others only the imports are run, since they need nodes or much time.
RUNNING = {"datasets", "explain", "export", "gas", "look", "measurements", "motion", "reference", "tutorial"}
TRIANGLE = "v 0 1 0\nv -1 -1 0\nv 1 -1 0\nf 1 2 3\n"
MODEL = """ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z
element face 1\nproperty list uchar int vertex_indices\nend_header\n0 1 0\n-1 -1 0\n1 -1 0\n3 0 1 2\n"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def blocks(page: Path) -> list[str]:
    return re.findall(r"^```python\n(.*?)^```$", page.read_text("utf-8"), re.MULTILINE | re.DOTALL)


def test_the_explanation_includes_the_definition() -> None:
    page = (DOCS / "explain.md").read_text("utf-8")
    text = DEFINITION.read_text("utf-8").partition("# ---- vectors ----")[0]
    functions = {each.name for each in ast.parse(text).body if isinstance(each, ast.FunctionDef | ast.ClassDef)}
    helpers = {"numbers", "q32", "rgb", "toward"}
    assert named(page) == functions - helpers
    assert "def shade(" in on_page_markdown(page)


def test_the_defaults_of_materials() -> None:
    page = (DOCS / "scene-files.md").read_text("utf-8")
    rows = dict(re.findall(r"^\| `(\w+)` \|.*\| `([^`]*)` \|$", page.partition("### `material`")[2], re.MULTILINE))
    material = shackled.Material()
    for name in ("shading", "ambient", "diffuse", "specular", "shininess"):
        assert json.loads(rows[name]) == getattr(material, name)


PAGES = [page for page in sorted(DOCS.glob("*.md")) if blocks(page)]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_code_of_a_page_runs(page: Path, folder: Path) -> None:
    code = ast.parse("\n".join(blocks(page)))
    imports = [statement for statement in code.body if isinstance(statement, ast.Import | ast.ImportFrom)]
    for statement in imports:
        if isinstance(statement, ast.ImportFrom) and (statement.module or "").startswith("shackled."):
            assert "._" not in (statement.module or "")
    (folder / "build").mkdir()
    (folder / "build" / "teapot.obj").write_text(TRIANGLE)
    (folder / "model.ply").write_text(MODEL)
    write(folder / "walk.gltf")
    if page.stem not in RUNNING:
        code.body = list(imports)
    triangle: dict[str, Any] = {"vertices": [(0, 1, 0), (-1, -1, 0), (1, -1, 0)], "faces": [[0, 1, 2]]}
    exec(compile(code, str(page), "exec"), {"shackled": shackled, **triangle})


def test_the_commands_of_pages_exist() -> None:
    """With the options that are shown."""
    texts = "\n".join(page.read_text("utf-8") for page in [*DOCS.glob("*.md"), ROOT / "README.md"])
    for line in re.findall(r"^(?:\$ )?(?:\.venv/bin/)?(shackled [a-z].*)$", texts, re.MULTILINE):
        words = shlex.split(line, comments=True)[1:]
        command: click.Command | None = app
        while words and isinstance(command, click.Group):
            command = command.get_command(click.Context(command), words.pop(0))
        assert command is not None, line
        known = {option for parameter in command.params for option in (*parameter.opts, *parameter.secondary_opts)}
        assert {word for word in words if word.startswith("-")} - {"--help"} <= known, line


def test_the_files_that_pages_name_exist() -> None:
    """By their paths, or the ends of these."""
    for page in [*DOCS.glob("*.md"), *(ROOT / name / "README.md" for name in (".", "contracts", "benchmarks"))]:
        for name in set(re.findall(r"`([\w./-]*\w\.(?:py|sol|toml))`", page.read_text("utf-8"))):
            assert any(path.endswith(f"/{name}") for path in sources()), f"{page}: {name}"


@cache
def sources() -> list[str]:
    folders = ("src", "contracts/src", "contracts/npm", "tests", "tools", "benchmarks", "examples")
    files = [*ROOT.glob("*.toml"), *(ROOT / "contracts").glob("*.toml"), *(ROOT / "contracts").glob("*.py")]
    files += [path for folder in folders for path in (ROOT / folder).rglob("*.*")]
    return [path.as_posix() for path in files]


def gallery() -> list[tuple[str, str, str]]:
    """The pictures of docs/gallery.md, and the commands below each: of an example, if any, and of `shackled`."""
    page = (DOCS / "gallery.md").read_text("utf-8")
    commands = r"```sh\n    (?:python (.*)\n    )?shackled (.*)\n    ```"
    return re.findall(r"!\[[^]]*\]\((images/gallery/[^)]*)\)[^`]*" + commands, page)


@pytest.mark.parametrize(("picture", "example", "command"), gallery(), ids=[Path(name).stem for name, *_ in gallery()])
def test_a_command_of_the_gallery_draws_its_picture(picture: str, example: str, command: str, folder: Path) -> None:
    if example:
        script, *arguments = shlex.split(example)
        subprocess.run([sys.executable, ROOT / script, *arguments], check=True)
    result = CliRunner().invoke(app, shlex.split(command), catch_exceptions=False)
    assert result.exit_code == 0, result.output
    shown, drawn = frames_of(DOCS / picture), frames_of(folder / Path(picture).name)
    assert len(shown) == len(drawn)
    assert all(map(np.array_equal, shown, drawn)), "run python -m tools.docs.draw_gallery"


def test_the_reference_has_every_name_with_an_example() -> None:
    text = (DOCS / "reference.md").read_text("utf-8")
    used = {
        node.attr
        for node in ast.walk(ast.parse("\n".join(blocks(DOCS / "reference.md"))))
        if isinstance(node, ast.Attribute)
    }
    assert set(shackled.__all__) <= used
    plain = {"__version__", "replace"}  # which mkdocstrings cannot show
    assert [name for name in shackled.__all__ if name not in plain and f"::: shackled.{name}\n" not in text] == []


def test_the_reference_of_the_contracts_is_complete() -> None:
    text = filled((DOCS / "contracts.md").read_text("utf-8"))
    assert MARK.search(text) is None
    names = ("Renderer", "Studio", "PngEncoder", "Turntable", "GlbEncoder", "Library", "Genesis", "Web", "Editions")
    for name in names:
        part = text.partition(f"\n## {name}\n")[2].partition("\n## ")[0] + text.partition("\n## Errors\n")[2]
        named = [entry["name"] for entry in artifact(name).abi if "name" in entry]
        assert [each for each in named if f"`{each}(" not in part] == []
    # what the interface of the Renderer says, not that of another contract with a function of this name
    assert "| `render(Scene scene)` → `bytes` | call | Draws a scene. Returns: A Windows bitmap" in text


def run(name: str) -> None:
    runpy.run_path(str(ROOT / "examples" / "programs" / f"{name}.py"), run_name="__main__")


@pytest.mark.parametrize("name", [program.stem for program in PROGRAMS if program.stem not in ON_A_NODE])
def test_a_program_runs(name: str, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    run(name)
    assert capsys.readouterr().out or list(folder.iterdir())


@pytest.mark.parametrize("name", sorted(ON_A_NODE))
@pytest.mark.usefixtures("folder")
def test_a_program_runs_on_a_node(
    name: str, node: Node, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("SHACKLED_RPC", node.url)
    monkeypatch.setenv("KEY", KEY)
    run(name)
    assert "gas" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("node", "the node cannot render: the node 127.0.0.1:1 cannot be reached"),
        ("stored_mesh", "set SHACKLED_RPC to the address of a node, and KEY to the private key"),
        ("trimesh_object", "this program needs trimesh: pip install trimesh"),
    ],
)
@pytest.mark.usefixtures("folder")
def test_a_program_says_in_a_line_what_it_lacks(name: str, words: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "trimesh", None)
    monkeypatch.delenv("SHACKLED_RPC", raising=False)
    if name == "node":
        monkeypatch.setenv("SHACKLED_RPC", "http://127.0.0.1:1")
    with pytest.raises(SystemExit) as ended:
        run(name)
    assert str(ended.value.code).startswith(words)
    assert "\n" not in str(ended.value.code)


def test_the_gallery_is_complete() -> None:
    """Each of its pictures has a command, and each program is short and listed."""
    pictures = sorted(path.relative_to(DOCS).as_posix() for path in (DOCS / "images" / "gallery").iterdir())
    assert pictures == sorted(name for name, *_ in gallery())
    page = (DOCS / "gallery.md").read_text("utf-8")
    assert len(PROGRAMS) >= 12
    for program in PROGRAMS:
        text = program.read_text("utf-8")
        assert 5 <= len(text.splitlines()) <= 25
        assert f"[`{program.name}`]" in page
        assert f'\n--8<-- "{program.name}"\n' in page


def test_the_programs_have_strict_types() -> None:
    """As in a project of somebody else, without the configuration of this one."""
    options = ["--strict", "--config-file=", "--cache-dir=.mypy_cache/programs"]
    command = [sys.executable, "-m", "mypy", *options, *map(str, PROGRAMS)]
    result = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert result.returncode == 0, result.stdout + result.stderr
