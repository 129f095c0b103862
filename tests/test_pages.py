"""Figures are written between the marks of a page, and nowhere else."""

from __future__ import annotations

from pathlib import Path

import pytest
from tools import pages

TEXT = "Before\n<!-- begin one -->\nold\n<!-- end one -->\nbetween\n<!-- begin two -->\nold\n<!-- end two -->\nafter\n"


@pytest.fixture
def page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(pages, "ROOT", tmp_path)
    path = tmp_path / "page.md"
    path.write_text(TEXT, "utf-8")
    return path


def test_a_page_is_filled(page: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert pages.update({page: "new {}".format}, "make it", check=True) == 1
    assert capsys.readouterr() == ("", "page.md is not up to date: run make it\n")
    assert page.read_text("utf-8") == TEXT
    assert pages.update({page: "new {}".format}, "make it") == 0
    assert capsys.readouterr().out == "written: page.md\n"
    assert page.read_text("utf-8") == TEXT.replace("old", "new one", 1).replace("old", "new two")
    assert pages.update({page: "new {}".format}, "make it", check=True) == 0


def test_a_page_without_marks_is_told(page: Path) -> None:
    page.write_text("nothing\n", "utf-8")
    with pytest.raises(SystemExit, match=r"page\.md has no marks"):
        pages.update({page: str}, "make it")
