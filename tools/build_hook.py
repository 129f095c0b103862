"""Put the sources of the contracts' libraries, if npm has installed them, and the Creator into wheels and sdists.

Hatchling runs this. Explorers verify contracts with their sources: see `shackled.artifacts.standard_input`. The page of
the Creator is that of build/. If `make page` has not built it there, or something has changed since, it is built now,
where Node and npm are. A wheel that is built from an sdist has the same files as one that is built here.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

#: What the page is made of.
PAGE_SOURCES = (
    "web/src",
    "web/build.mjs",
    "web/package-lock.json",
    "src/shackled",
    "tools/build_page.py",
    "examples/showcase.py",
)


class BuildHook(BuildHookInterface):  # type: ignore[type-arg]
    """A build hook for wheels and sdists."""

    def dependencies(self) -> list[str]:
        """Return what must be installed for the build: all that the package needs, if it draws the page's pictures."""
        project = tomllib.loads(Path(self.root, "pyproject.toml").read_text("utf-8"))["project"]
        return list(project["dependencies"]) if has_node() and not is_page_built(Path(self.root)) else []

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Add the sources that the artifacts name. An editable installation reads those of the checkout."""
        if version == "editable":
            return
        root = Path(self.root)
        artifacts = (root / "src" / "shackled" / "artifacts").glob("[A-Z]*.json")
        paths = {path for each in artifacts for path in json.loads(each.read_text("utf-8"))["sources"]}
        # each file, with its place in a wheel
        found: dict[Path, str] = {}
        for path in sorted(paths):
            places = [root / "contracts" / folder / path for folder in ("src", "node_modules")]
            file = next((place for place in places if place.is_file()), None)
            if file is None:
                self.app.display_warning(f"without {path}, which npm ci installs in contracts/")
            else:
                found[file] = f"shackled/artifacts/sources/{path}"
        if fault := build_page(root):
            self.app.display_warning(f"without the page of the Creator: {fault}")
        else:
            found |= {root / "build" / name: f"shackled/web/{name}" for name in ("page", "creator.html")}
        here = self.target_name == "sdist"
        build_data["force_include"] |= {
            str(path): path.relative_to(root).as_posix() if here else place for path, place in found.items()
        }


def build_page(root: Path) -> str:
    """Build the page, unless it is there. Return why it cannot be built; an empty text if it is there."""
    if is_page_built(root):
        return ""
    if not has_node():
        return "it needs Node 20 or newer and npm"
    lock, installed = (root / "web" / name for name in ("package-lock.json", "node_modules/.package-lock.json"))
    modules = os.pathsep.join([str(root), str(root / "src"), os.environ.get("PYTHONPATH", "")])
    commands = [["-m", "tools.build_page"]]
    if not installed.is_file() or installed.stat().st_mtime < lock.stat().st_mtime:
        commands.insert(0, ["tools/prepare.py", "node", "web"])
    try:
        for command in commands:
            subprocess.run([sys.executable, *command], cwd=root, env=os.environ | {"PYTHONPATH": modules}, check=True)
    except (OSError, subprocess.CalledProcessError) as error:
        return str(error)
    return ""


def has_node() -> bool:
    """Return whether Node and npm are in the PATH."""
    return all(map(shutil.which, ("node", "npm")))


def is_page_built(root: Path) -> bool:
    """Return whether build/ has the page, and what it is made of is not newer."""
    built = [root / "build" / "page" / "index.html", root / "build" / "creator.html"]
    places = [root / name for name in PAGE_SOURCES]
    sources = [path for place in places for path in (place, *place.rglob("*")) if "__pycache__" not in path.parts]
    changed = max(path.stat().st_mtime for path in sources if path.is_file())
    return all(path.is_file() and path.stat().st_mtime >= changed for path in built)
