"""No figure of benchmarks/tokens.json may rise unnoticed."""

from __future__ import annotations

import pytest

pytest.importorskip("pyrevm", reason="a chain with state needs it")

from pathlib import Path

from benchmarks import tokens

PAGE = Path(__file__).resolve().parents[2] / "docs" / "tokens.md"


@pytest.fixture(scope="module")
def measured() -> tokens.Figures:
    return tokens.take()


def test_the_figures_are_those_that_are_recorded(measured: tokens.Figures) -> None:
    assert measured == tokens.recorded(), "if that has a good reason, run: python -m benchmarks.tokens"


def test_minting_is_cheaper_than_the_original(measured: tokens.Figures) -> None:
    for name, original in tokens.ORIGINAL.items():
        assert measured[name] < 0.65 * original


def test_the_documentation_has_them(measured: tokens.Figures) -> None:
    assert tokens.table(tokens.recorded()) in PAGE.read_text("utf-8")
