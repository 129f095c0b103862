"""Pictures of the documentation that can be turned, in a site that is served by http."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from mkdocs.commands.build import build
from mkdocs.config import load_config
from tools.page_server import static

from shackled import render

ROOT = Path(__file__).resolve().parent.parent
PAGE = "# Pictures\n\n![A crown](images/crown.png)\n\n![No scene](images/plain.png)\n"


@pytest.fixture
def site(tmp_path: Path) -> Path:
    """A small site, made by mkdocs with the hook."""
    docs = tmp_path / "docs"
    (docs / "images").mkdir(parents=True)
    (docs / "index.md").write_text("# Nothing\n\n![No scene](images/plain.png)\n")
    (docs / "pictures.md").write_text(PAGE)
    image = render("icons/crown", (48, 40))
    image.save(docs / "images" / "crown.png")
    image.save(docs / "images" / "plain.png", scene=False)
    (tmp_path / "mkdocs.yml").write_text(
        f"site_name: A\ntheme: {{name: null, custom_dir: theme}}\nplugins: []\nhooks: [{ROOT}/tools/docs/turnable.py]\n"
    )
    (tmp_path / "theme").mkdir()
    (tmp_path / "theme" / "main.html").write_text("<!doctype html><body>{{ page.content }}")
    build(load_config(str(tmp_path / "mkdocs.yml")))
    return tmp_path / "site"


def test_pictures_with_a_scene_are_turned(site: Path) -> None:
    page = (site / "pictures" / "index.html").read_text()
    assert page.count("<shackled-view") == 1
    assert '<img alt="A crown" src="../images/crown.png" /></shackled-view>' in page
    assert '<img alt="No scene" src="../images/plain.png" />' in page
    assert "<script" not in (site / "index.html").read_text()


def test_in_chromium(site: Path, browser: Any) -> None:
    with static(site) as served, browser.new_page() as tab:
        tab.goto(f"{served.address}pictures/")
        tab.wait_for_function("() => document.querySelector('shackled-view').picture")
        found = tab.evaluate("document.querySelector('shackled-view').picture.sha256")
    assert found == render("icons/crown", (48, 40)).sha256
