"""The sheet of the whole collection."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image as PillowImage

from shackled import render
from shackled.datasets.genesis import generate, render_sheet, seed_of
from shackled.errors import InputError


def test_pieces_stand_in_rows(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SHACKLED_CACHE", str(tmp_path / "cache"))
    told: list[tuple[int, int]] = []
    render_sheet(tmp_path / "sheet.png", 5, 32, 2, lambda done, total: told.append((done, total)))
    assert told == [(done, 5) for done in range(6)]
    with PillowImage.open(tmp_path / "sheet.png") as picture:
        pixels = np.array(picture)
    assert pixels.shape == (64, 96, 3)
    for number in range(5):
        x, y = 32 * (number % 3), 32 * (number // 3)
        expected = render(generate(seed_of(number)).scene(), 32).pixels
        np.testing.assert_array_equal(pixels[y : y + 32, x : x + 32], expected)
    assert not pixels[32:, 64:].any()
    assert len(list((tmp_path / "cache").rglob("*.png"))) == 5  # with which an interrupted run goes on


@pytest.mark.parametrize(
    ("path", "count", "size", "message"),
    [
        ("sheet.jpg", 4, 16, r"^the sheet sheet\.jpg must end in \.png$"),
        ("nowhere/sheet.png", 4, 16, r"^the folder nowhere of the sheet sheet\.png does not exist$"),
        ("sheet.png", 1025, 16, r"^the number of pieces of a sheet must be .* 1024, not 1025$"),
        ("sheet.png", 4, 0, r"^the size of a piece in pixels must be .* 1024, not 0$"),
    ],
)
def test_what_cannot_be(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, path: str, count: int, size: int, message: str
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InputError, match=message):
        render_sheet(path, count, size)
