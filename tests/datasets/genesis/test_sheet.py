"""The sheet of the whole collection."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
from PIL import Image as PillowImage

from shackled import render
from shackled.datasets.genesis import generate, render_sheet, seed_of
from shackled.errors import InputError


@pytest.fixture(autouse=True)
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("SHACKLED_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache"


def test_pieces_stand_in_rows(tmp_path: Path) -> None:
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


def test_a_run_that_was_stopped_goes_on(tmp_path: Path, cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def stop(done: int, total: int) -> None:
        if done == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        render_sheet(tmp_path / "sheet.png", 4, 16, 1, stop)
    assert not (tmp_path / "sheet.png").exists()
    kept = {path: os.stat(path).st_mtime_ns for path in cache.rglob("*.png")}
    assert len(kept) == 2
    render_sheet(tmp_path / "sheet.png", 4, 16, 1)
    now = {path: os.stat(path).st_mtime_ns for path in cache.rglob("*.png")}
    assert len(now) == 4
    assert kept.items() <= now.items()


@pytest.mark.parametrize(
    ("path", "count", "size", "message"),
    [
        ("sheet.jpg", 4, 16, r"^the sheet sheet\.jpg must end in \.png$"),
        ("nowhere/sheet.png", 4, 16, r"^the folder nowhere of the sheet sheet\.png does not exist$"),
        ("sheet.png", 0, 16, r"^the number of pieces of a sheet must be .* 1024, not 0$"),
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
