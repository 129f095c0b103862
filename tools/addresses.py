"""Where the project is found: the one place is the table [tool.shackled] of pyproject.toml.

Hatchling reads it for the Python package, mkdocs for the site, tools/build_package.py for the npm packages. While an
address there is empty, nothing names it: links of a README to files of the repository become their text, and pictures
are left out, since an index of packages could not show them.
"""

from __future__ import annotations

import posixpath
import re
import tomllib
from pathlib import Path
from typing import Any

from hatchling.metadata.plugin.interface import MetadataHookInterface

ROOT = Path(__file__).resolve().parent.parent
#: Code, which stays as it is; or a link or picture: an exclamation mark or none, its text, its target.
LINK = re.compile(r"^```.*?^```$|`[^`]*`|(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^()\s]+)\)", re.DOTALL | re.MULTILINE)


def project() -> dict[str, Any]:
    """Return pyproject.toml."""
    return tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))


def addresses() -> dict[str, str]:
    """Return the addresses: "repository" and "documentation", each empty until there is one."""
    return {name: value.rstrip("/") for name, value in project()["tool"]["shackled"].items()}


def urls() -> dict[str, str]:
    """Return the links that indexes of Python packages show, by label."""
    repository, documentation = addresses()["repository"], addresses()["documentation"]
    found = {"Documentation": documentation} if documentation else {}
    if repository:
        found |= {
            "Repository": repository,
            "Issues": f"{repository}/issues",
            "Changelog": f"{repository}/blob/main/CHANGELOG.md",
        }
    return found


def for_an_index(text: str, folder: str = "") -> str:
    """Return a README, of a folder of the repository, with absolute links to the files of this version.

    Without an address of the repository, links to files become their text, and pictures are left out.
    """
    repository = addresses()["repository"]
    version = project()["project"]["version"]

    def absolute(found: re.Match[str]) -> str:
        mark, words, target = found.groups()
        if target is None or re.match(r"#|[a-z]+:", target):
            return found[0]
        if not repository:
            return "" if mark else words
        path = posixpath.normpath(posixpath.join(folder, target))
        return f"{mark}[{words}]({repository}/{'raw' if mark else 'blob'}/v{version}/{path})"

    return re.sub(r"\n{3,}", "\n\n", LINK.sub(absolute, text))


def with_addresses(package: dict[str, Any], folder: str) -> dict[str, Any]:
    """Return a package.json, of a folder of the repository, with the addresses that there are."""
    repository, documentation = addresses()["repository"], addresses()["documentation"]
    if repository:
        package |= {
            "repository": {"type": "git", "url": f"git+{repository}.git", "directory": folder},
            "bugs": f"{repository}/issues",
        }
    return package | ({"homepage": documentation or repository} if documentation or repository else {})


class Metadata(MetadataHookInterface):
    """What Hatchling asks for the dynamic fields of the Python package."""

    def update(self, metadata: dict[str, Any]) -> None:
        """Set the README and the links."""
        text = for_an_index((ROOT / "README.md").read_text("utf-8"))
        metadata["readme"] = {"content-type": "text/markdown", "text": text}
        metadata["urls"] = urls()


def on_config(config: Any) -> Any:
    """Set the addresses of the site; mkdocs calls this."""
    repository, documentation = addresses()["repository"], addresses()["documentation"]
    if documentation:
        config.site_url = f"{documentation}/"
    if repository:
        config.repo_url = repository
        config.repo_name = "/".join(repository.split("/")[-2:])
        config.edit_uri = "edit/main/docs/"
    return config
