"""What the package says of itself: what it needs, where, and whose code is in it."""

from __future__ import annotations

import ast
import json
import re
import sys
import tomllib
from collections.abc import Iterator
from functools import cache
from graphlib import TopologicalSorter
from importlib import import_module
from importlib.metadata import packages_distributions
from pathlib import Path
from typing import Any

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
from tools import build_package

from shackled.artifacts import contracts

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = ROOT / "src" / "shackled"
PROJECT: dict[str, Any] = tomllib.loads((ROOT / "pyproject.toml").read_text())
NEEDED = [Requirement(line) for line in PROJECT["project"]["dependencies"]]
EXTRAS = {
    name: [Requirement(line) for line in lines] for name, lines in PROJECT["project"]["optional-dependencies"].items()
}
LOCKED = ROOT / "tools" / "locked"

#: What parts of the package may import beside what every installation has: the extras that errors name.
EXTRA_OF = {
    "bench": "bench",
    "chain/_embedded.py": "pyevm pyrevm",
    "deploy/_account.py": "chain",
    "deploy/_transactor.py": "chain",
    "cli/chain_options.py": "chain",
    "tokens/": "chain",
    "animation.py": "mp4",
    "parallel/_cluster.py": "cluster",
    "scene/_files/gltf/draco.py": "draco",
    "web/_widget.py": "jupyter",
}


@cache
def of_the_package(path: Path) -> list[str]:
    """Return the modules that a file imports, and the names that it takes from them, all absolute."""
    here = path.relative_to(PACKAGE.parent).with_suffix("").parts[:-1] if path.is_relative_to(PACKAGE) else ()
    found: list[str] = []
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            found += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            base = [*here[: len(here) - node.level + 1]] if node.level else []
            found += [".".join([*base, *filter(None, [node.module]), alias.name]) for alias in node.names]
    return found


def test_what_is_imported_is_declared() -> None:
    """By its own name, and not because something else needs it too."""
    found, distributions = set(), packages_distributions()
    imported = {
        (path.relative_to(PACKAGE).as_posix(), name.partition(".")[0])
        for path in PACKAGE.rglob("*.py")
        for name in of_the_package(path)
    }
    for file, module in imported:
        if module in sys.stdlib_module_names or module == "shackled":
            continue
        declared = {canonicalize_name(each.name) for each in NEEDED}
        for start, extras in EXTRA_OF.items():
            if file.startswith(start):
                declared |= {canonicalize_name(each.name) for extra in extras.split() for each in EXTRAS[extra]}
        owners = {canonicalize_name(name) for name in distributions[module]}
        assert owners & declared, f"{file} imports {module}, which pyproject.toml does not declare"
        found |= owners & declared
    # and nothing is declared that nobody imports
    everything = [*NEEDED, *(each for lines in EXTRAS.values() for each in lines)]
    assert {canonicalize_name(each.name) for each in everything} <= found


def test_the_extras_are_those_of_the_tests_and_every_platform_needs_the_same() -> None:
    """No extra builds from its sources what the tests are run without; the EVM runs wherever wasmtime does."""
    extras = [each for lines in EXTRAS.values() for each in lines]
    assert {str(each) for each in extras} <= {str(Requirement(line)) for line in PROJECT["dependency-groups"]["dev"]}
    (pyrevm,) = (each.marker for each in extras if each.marker is not None)
    assert EXTRAS["pyrevm"][0].marker is pyrevm
    found = [pyrevm.evaluate({"python_version": each}) for each in ("3.11", "3.12", "3.13", "3.14")]
    assert found == [True, True, False, False]
    assert [each.name for each in NEEDED if each.marker is not None] == ["fast-simplification"]
    names = {each.name for each in NEEDED}
    assert "wasmtime" in names
    # without builds for some platforms, or without a licence
    assert not names & {"py-evm", "pyrevm"}


def test_meshes_are_simplified_where_there_are_wheels() -> None:
    (marker,) = (each.marker for each in NEEDED if each.name == "fast-simplification")
    assert marker is not None
    for system, machine, has_wheel in (
        ("linux", "x86_64", True),
        ("linux", "riscv64", False),
        ("darwin", "arm64", True),
        ("win32", "AMD64", True),
        ("win32", "ARM64", False),
        ("freebsd14", "amd64", False),
    ):
        assert marker.evaluate({"sys_platform": system, "platform_machine": machine}) == has_wheel, machine


#: Packages that export names of their modules.
FACES = [".".join(path.parent.relative_to(PACKAGE.parent).parts) for path in sorted(PACKAGE.rglob("__init__.pyi"))]
MODULES = {
    ".".join(path.relative_to(PACKAGE.parent).with_suffix("").parts).removesuffix(".__init__"): path
    for path in PACKAGE.rglob("*.py")
}


def named_in(code: str) -> Iterator[str]:
    """Yield the names of the package that code uses, with its modules."""
    tree, known = ast.parse(code), {"shackled": "shackled"}
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and (node.module or "").partition(".")[0] == "shackled":
            known |= {alias.asname or alias.name: f"{node.module}.{alias.name}" for alias in node.names}
    yield from known.values()
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute):
            base, *rest = ast.unparse(node).split(".")
            if base in known:
                yield ".".join([known[base], *rest])


def test_packages_export_what_the_documentation_names() -> None:
    """And nothing else; private modules are for the package, and for what is developed with it."""
    exported = {f"{face}.{name}" for face in FACES for name in import_module(face).__all__}
    pages = [path.read_text() for path in (ROOT / "README.md", *(ROOT / "docs").glob("*.md"))]
    used = {name for page in pages for name in re.findall(r"\bshackled\.\w+(?:\.\w+)*", page)}
    code = ["\n".join(re.findall(r"^```python\n(.*?)^```$", page, re.M | re.S)) for page in pages]
    code += [path.read_text() for path in (ROOT / "examples").rglob("*.py")]
    used |= {name for each in code for name in named_in(each)}
    assert not [name for name in used if "._" in name and "__" not in name]
    assert exported == {name for name in used if name.rpartition(".")[0] in FACES and name not in MODULES}
    # the table of packages has all names
    rows = dict(re.findall(r"^\| `(shackled\.[\w.]+)` \|.*\| ([^|]*) \|$", "\n".join(pages), re.M))
    listed = {f"{package}.{name}" for package, names in rows.items() for name in re.findall(r"`(\w+)`", names)}
    assert not [name for name in listed if not hasattr(import_module(name.rpartition(".")[0]), name.rpartition(".")[2])]
    assert {name for name in exported if name.count(".") > 1} <= listed
    assert len(exported) <= 90


def test_no_imports_form_a_circle() -> None:
    """Neither of modules of the package nor of its folders, late imports and those for types included.

    Modules import others by their names, not by those that packages export.
    """
    graph: dict[str, set[str]] = {}
    folders: dict[str, set[str]] = {}
    for name, path in MODULES.items():
        found = of_the_package(path)
        assert not [each for each in found if each not in MODULES and each.rpartition(".")[0] in FACES], name
        graph[name] = {each if each in MODULES else each.rpartition(".")[0] for each in found} & MODULES.keys() - {name}
        if name != "shackled":
            folder, used = name.split(".")[1], {each.split(".")[1] for each in graph[name] - {"shackled"}}
            folders.setdefault(folder, set()).update(used - {folder})
    assert "shackled.scene._mesh" in graph["shackled.scene._scene"]
    assert "scene" in folders["chain"]
    for each in (graph, folders):
        TopologicalSorter(each).prepare()  # raises an error that names the circle


def test_tools_do_not_import_what_imports_them() -> None:
    """Benchmarks use tools and tests use both; the package uses none of them."""
    above = {"src": {"tools", "benchmarks", "tests"}, "tools": {"benchmarks", "tests"}, "benchmarks": {"tests"}}
    for folder, others in above.items():
        for path in sorted((ROOT / folder).rglob("*.py")):
            assert others.isdisjoint(each.partition(".")[0] for each in of_the_package(path)), path


def test_notices_of_all_whose_code_is_compiled_in() -> None:
    """Each library of the sources, in the version that is installed, with its licence in full, and its contracts."""
    notices = (ROOT / "THIRD-PARTY-NOTICES").read_text()
    locked = json.loads((ROOT / "contracts" / "package-lock.json").read_text())["packages"]
    folders = {name.removeprefix("node_modules/"): entry for name, entry in locked.items() if name}
    sources = {
        name: json.loads((PACKAGE / "artifacts" / f"{name}.json").read_text())["sources"] for name in contracts()
    }
    users = {
        name: {each for each in sources if any(s.startswith(f"{name}/") for s in sources[each])} for name in folders
    }
    libraries = {name for name in folders if users[name]}
    assert libraries >= {"@openzeppelin/contracts", "erc721a", "solady"}
    for name in libraries:
        section = notices.partition(f"{folders[name]['version']} ({name})")[2].partition("\n---")[2]
        licence = section.partition("Copyright (c)")[2].partition("---")[0]
        assert "Permission is hereby granted, free of charge" in licence
        assert "OTHER DEALINGS IN THE" in licence
        shipped = ROOT / "contracts" / "node_modules" / name / "LICENSE.txt"
        if shipped.exists():
            assert shipped.read_text().strip() in notices
        assert users[name] <= set(re.findall(r"\w+", notices.partition("\n---")[0])), name


def test_the_package_of_the_contracts() -> None:
    """It has the same notices, and no program of a package runs when it is installed."""
    for name in ("LICENSE", "THIRD-PARTY-NOTICES"):
        assert name in build_package.NOTICES
        assert (ROOT / "contracts" / name).read_bytes() == (ROOT / name).read_bytes()
    assert "ignore-scripts=true" in (ROOT / "contracts" / ".npmrc").read_text().splitlines()


def locked(name: str) -> list[Requirement]:
    """Return the requirements of a file of tools/locked: each of one version, with hashes, and of no address."""
    found = []
    for line in (LOCKED / f"{name}.txt").read_text().splitlines()[1:]:
        requirement, *hashes = line.split(" --hash=")
        assert re.fullmatch(r"[A-Za-z0-9._-]+==[A-Za-z0-9.!+]+( ; [^/]+)?", requirement)
        assert hashes
        assert all(re.fullmatch("sha256:[0-9a-f]{64}", each) for each in hashes)
        found.append(Requirement(requirement))
    return found


@pytest.mark.parametrize("python", ["3.11", "3.12", "3.13", "3.14"])
@pytest.mark.parametrize(
    "platform", [("linux", "x86_64"), ("linux", "aarch64"), ("darwin", "arm64"), ("win32", "AMD64")]
)
def test_locked_packages_fit_what_is_asked_for(python: str, platform: tuple[str, str]) -> None:
    """One version of each on each platform; both files have the same."""
    environment = {"python_version": python, "python_full_version": f"{python}.9"}
    environment |= dict(zip(("sys_platform", "platform_machine"), platform, strict=True))

    def here(requirements: list[Requirement]) -> list[Requirement]:
        return [each for each in requirements if each.marker is None or each.marker.evaluate(environment)]

    group = [Requirement(line) for line in PROJECT["dependency-groups"]["dev"]]
    extras = [each for lines in EXTRAS.values() for each in lines]
    build = [Requirement(line) for line in PROJECT["build-system"]["requires"]]
    dev = {canonicalize_name(each.name): str(each.specifier) for each in here(locked("dev"))}
    for name, wanted in (("package", [*NEEDED, *build]), ("dev", [*NEEDED, *build, *group, *extras])):
        pinned = {canonicalize_name(each.name): str(each.specifier) for each in here(locked(name))}
        assert len(pinned) == len(here(locked(name)))
        assert pinned.items() <= dev.items()
        for requirement in here(wanted):
            version = pinned.get(canonicalize_name(requirement.name), "")[2:]
            assert version, f"{requirement.name} is not in tools/locked/{name}.txt: run python tools/lock.py"
            assert requirement.specifier.contains(version, prereleases=True)
