"""What holds for every file of the repository, and for what is published."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import tomllib
from pathlib import Path

import pytest

import shackled
from shackled.artifacts import artifact, contracts

ROOT = Path(__file__).resolve().parent.parent
#: Files that are not text.
BINARY = {".png", ".gif", ".bmp", ".ico", ".wasm"}

#: Folders with a package.json.
NPM_PACKAGES = ("contracts", "web")
#: Bytes of a file of the repository.
LARGEST = 2**20
#: EIP-170.
MAX_RUNTIME_SIZE = 24576


@pytest.fixture(scope="module")
def files() -> dict[str, Path]:
    """The files of the repository, those that are not committed yet too."""
    if not (ROOT / ".git").exists() or not shutil.which("git"):
        pytest.skip("not a clone of the repository")
    listing = ["git", "-c", f"safe.directory={ROOT}", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    names = subprocess.run(listing, cwd=ROOT, check=True, capture_output=True, text=True).stdout.split("\0")
    return {name: ROOT / name for name in names if name and (ROOT / name).is_file()}


@pytest.fixture(scope="module")
def texts(files: dict[str, Path]) -> dict[str, str]:
    """The text files of the repository."""
    found = {name: path.read_text("utf-8") for name, path in files.items() if path.suffix not in BINARY}
    assert "pyproject.toml" in found
    return found


def matches(texts: dict[str, str], pattern: str) -> list[str]:
    return [
        f"{name}: {match[0]}" for name, text in texts.items() for match in re.finditer(pattern, text, re.IGNORECASE)
    ]


def test_no_file_is_large(files: dict[str, Path]) -> None:
    """Every version of a file stays in every clone."""
    assert [name for name, path in files.items() if path.stat().st_size > LARGEST] == []


def test_no_file_names_a_registry(texts: dict[str, str]) -> None:
    assert matches(texts, r"""https?://[^/\s"']*(registry|pypi|npmjs|pythonhosted|artifactory|nexus)[^\s"']*""") == []
    for folder in NPM_PACKAGES:
        lock = texts[f"{folder}/package-lock.json"]
        assert '"resolved"' not in lock
        assert lock.count('"integrity"') >= 5


def test_no_file_names_a_place_on_a_machine(texts: dict[str, str]) -> None:
    assert matches(texts, r"(?<![\w.~-])/(work|root|home|Users)/\w+") == []


def test_lines_end_as_they_should(texts: dict[str, str]) -> None:
    bad = [name for name, text in texts.items() if "\r" in text or (text and not text.endswith("\n"))]
    assert bad == []


def test_contracts_say_licence_and_compiler(texts: dict[str, str]) -> None:
    sources = {name: text for name, text in texts.items() if name.endswith(".sol")}
    assert len(sources) > 10
    compiler = json.loads(texts["contracts/package.json"])["dependencies"]["solc"]
    licence = "// SPDX-License-Identifier: MIT\n"
    # those that contracts outside import have an open one
    heads = (f"{licence}pragma solidity {compiler};\n", f"{licence}pragma solidity ^0.8.25;\n")
    assert [name for name, text in sources.items() if not text.startswith(heads)] == []


def test_links_lead_somewhere(texts: dict[str, str]) -> None:
    """To files that are there, and to headings of pages."""
    # the page that tools/docs/with_creator.py adds to the site
    broken, made = [], {"docs/creating.md: creator/index.html", "docs/index.md: creator/index.html"}
    for name, text in texts.items():
        if name.endswith(".md"):
            text = re.sub(r"^```.*?^```|`[^`\n]+`", "", text, flags=re.DOTALL | re.MULTILINE)
            linked = re.findall(r"\]\(([^)\s]+)[^)]*\)", text)
            for target in linked + re.findall(r'(?:src|href)="([^"#]+)', text):
                path, _, heading = target.partition("#")
                page = (ROOT / name).parent.joinpath(path) if path else ROOT / name
                if "://" not in target and not (page.exists() and (not heading or has_heading(page, heading))):
                    broken.append(f"{name}: {target}")
    assert set(broken) == made


def has_heading(page: Path, anchor: str) -> bool:
    text = page.read_text("utf-8")
    headings = [
        re.sub(r"\]\([^)]*\)|[^\w\s-]", "", each.lower()) for each in re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    ]
    # the site makes one hyphen of several, GitHub does not
    gap = r"[-\s]+" if page.is_relative_to(ROOT / "docs") else r"\s"
    known = {re.sub(gap, "-", each.strip()) for each in headings}
    # a name of the reference, whose heading mkdocstrings makes
    return anchor in known or f"::: {anchor}\n" in text or f'id="{anchor}"' in text


@pytest.mark.parametrize("name", contracts())
def test_contracts_fit_on_a_chain(name: str) -> None:
    built = artifact(name)
    assert 0 < len(built.runtime) <= MAX_RUNTIME_SIZE
    assert len(built.runtime) < len(built.creation) <= 2 * MAX_RUNTIME_SIZE
    functions = {entry["name"] for entry in built.abi if entry["type"] == "function"}
    assert functions == built.selectors.keys()
    # those that only calls bring along have none
    assert bool(functions) == (built.group != "calls")


def test_one_version_everywhere() -> None:
    version = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]["version"]
    changes = re.findall(r"^## \[(\d[^\]]*)\]", (ROOT / "CHANGELOG.md").read_text("utf-8"), re.MULTILINE)
    assert shackled.__version__ == version
    assert changes[0] == version
    packages = [f"{folder}/{name}" for folder in NPM_PACKAGES for name in ("package.json", "package-lock.json")]
    for name in ("contracts/npm/package.json", *packages):
        assert json.loads((ROOT / name).read_text("utf-8"))["version"] == version
    assert f"\nversion: {version}\n" in (ROOT / "CITATION.cff").read_text("utf-8")
