"""Put the sources of the contracts' libraries, if npm has installed them, and the Creator into wheels and sdists.

Hatchling runs this. Explorers verify contracts with their sources: see `shackled.artifacts.standard_input`. The page of
the Creator is there if `make page` has built it. A wheel that is built from an sdist has the same files as one that is
built here.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class BuildHook(BuildHookInterface):  # type: ignore[type-arg]
    """A build hook for wheels and sdists."""

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
        built = {root / "build" / name: f"shackled/web/{name}" for name in ("page", "creator.html")}
        if all(path.exists() for path in built):
            found |= built
        else:
            self.app.display_warning("without the Creator, which make page builds")
        here = self.target_name == "sdist"
        build_data["force_include"] |= {
            str(path): path.relative_to(root).as_posix() if here else place for path, place in found.items()
        }
