"""The bar for what takes a while."""

from __future__ import annotations

import io
import threading
import time
from typing import Any

import pytest
from rich.console import Console

from shackled.cli import progress
from shackled.cli.progress import LateBar


@pytest.fixture
def screen(monkeypatch: pytest.MonkeyPatch) -> io.StringIO:
    """What a terminal is told."""
    text = io.StringIO()

    def terminal(**_: Any) -> Console:
        return Console(file=text, force_terminal=True, width=80)

    monkeypatch.setattr(progress, "Console", terminal)
    return text


def wait_for(screen: io.StringIO, words: str) -> None:
    end = time.monotonic() + 20
    while words not in screen.getvalue() and time.monotonic() < end:
        time.sleep(0.01)
    assert words in screen.getvalue()


def test_what_is_quick_has_no_bar(screen: io.StringIO) -> None:
    with LateBar("rendering", 30):
        pass
    assert screen.getvalue() == ""


def test_what_is_slow_has_one(screen: io.StringIO) -> None:
    with LateBar("rendering", 0.01) as bar:
        wait_for(screen, "rendering")
        assert "%" not in screen.getvalue()
        bar.set(3, 4)
        wait_for(screen, "75%")
        bar.print("a warning")
        wait_for(screen, "a warning")
    # its thread has ended too
    assert not [thread for thread in threading.enumerate() if isinstance(thread, threading.Timer)]


def test_nothing_moves_where_nobody_looks(capsys: pytest.CaptureFixture[str]) -> None:
    with LateBar("rendering", 0.0) as bar:
        bar.set(1, 2)
        bar.print("a warning")
        time.sleep(0.05)
    assert capsys.readouterr() == ("", "a warning\n")
