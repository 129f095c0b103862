"""Put the sources of the contracts into a wheel, those of the libraries if npm has installed them, and the Creator.

Hatchling runs this. Explorers verify contracts with their sources: see `shackled.artifacts.standard_input`. The page of
the Creator is there if `make page` has built it.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class WheelSources(BuildHookInterface):  # type: ignore[type-arg]
    """A build hook for wheels."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Add the sources that the artifacts name. An editable installation reads those of the checkout."""
        if version == "editable":
            return
        root = Path(self.root)
        artifacts = (root / "src" / "shackled" / "artifacts").glob("[A-Z]*.json")
        paths = {path for each in artifacts for path in json.loads(each.read_text("utf-8"))["sources"]}
        for path in sorted(paths):
            places = (root / "contracts" / folder / path for folder in ("src", "node_modules"))
            found = next((place for place in places if place.is_file()), None)
            if found is None:
                self.app.display_warning(f"without {path}, which npm ci installs in contracts/")
            else:
                build_data["force_include"][str(found)] = f"shackled/artifacts/sources/{path}"
        built = {name: root / "build" / name for name in ("page", "creator.html")}
        if not all(path.exists() for path in built.values()):
            self.app.display_warning("without the Creator, which make page builds")
            return
        build_data["force_include"] |= {str(path): f"shackled/web/{name}" for name, path in built.items()}
