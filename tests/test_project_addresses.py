"""What names the project's addresses: nothing while they are empty; with them, every README has absolute links."""

from __future__ import annotations

import re
from types import SimpleNamespace

import pytest
from tools import addresses

README = (addresses.ROOT / "README.md").read_text("utf-8")
REPOSITORY, SITE = "https://host.example/owner/shackled", "https://site.example/shackled"


def publish(monkeypatch: pytest.MonkeyPatch, repository: str, documentation: str) -> None:
    project = addresses.project()
    project["tool"]["shackled"] = {"repository": repository, "documentation": documentation}
    monkeypatch.setattr(addresses, "project", lambda: project)


def test_the_citation_names_the_repository() -> None:
    named = re.findall(r"^repository-code: (.*)$", (addresses.ROOT / "CITATION.cff").read_text("utf-8"), re.MULTILINE)
    assert named == list(filter(None, [addresses.addresses()["repository"]]))


def test_without_addresses_nothing_names_one(monkeypatch: pytest.MonkeyPatch) -> None:
    publish(monkeypatch, "", "")
    assert addresses.urls() == {}
    assert addresses.with_addresses({"name": "a"}, "web") == {"name": "a"}
    assert vars(addresses.on_config(SimpleNamespace())) == {}
    text = addresses.for_an_index(README)
    assert re.findall(r"\]\((?!#)[^)]*\)", text) == []
    assert "- In a web page and in Jupyter: `<shackled-view>`, npm." in text
    assert addresses.for_an_index("[costs](#what-it-costs)") == "[costs](#what-it-costs)"


def test_with_addresses(monkeypatch: pytest.MonkeyPatch) -> None:
    publish(monkeypatch, REPOSITORY + "/", SITE)  # as somebody may write them
    found = addresses.urls()
    assert found["Repository"] == REPOSITORY
    assert found["Documentation"] == SITE
    version = f"v{addresses.project()['project']['version']}"
    text = addresses.for_an_index(README)
    assert f"![A rotating rocket]({REPOSITORY}/raw/{version}/docs/images/gallery/turntable.gif)" in text
    assert f"[security]({REPOSITORY}/blob/{version}/contracts/SECURITY.md)" in text
    assert [link for link in re.findall(r"\]\(([^)#]+)", text) if not link.startswith("https://")] == []
    assert len(re.findall(r"\]\(", text)) == len(re.findall(r"\]\(", README))
    package = addresses.with_addresses({"name": "a"}, "web")
    assert package["repository"]["url"] == f"git+{REPOSITORY}.git"
    assert package["homepage"] == SITE
    site = addresses.on_config(SimpleNamespace())
    assert (site.repo_url, site.repo_name, site.site_url) == (REPOSITORY, "owner/shackled", f"{SITE}/")
    # links of a folder, and code
    text = "[a](../docs/b.md#c) `[d](e)` [`f`](g.md)\n```\n[h](i)\n```\n"
    base = f"{REPOSITORY}/blob/{version}"
    made = f"[a]({base}/docs/b.md#c) `[d](e)` [`f`]({base}/web/g.md)\n```\n[h](i)\n```\n"
    assert addresses.for_an_index(text, "web") == made
