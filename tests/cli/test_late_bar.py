"""The bar for what takes a while."""

from __future__ import annotations

import io
import sys
import threading
import time

import pytest

from shackled.cli.progress import LateBar


class Terminal(io.StringIO):
    """What a terminal is told."""

    def isatty(self) -> bool:
        return True


def terminal(monkeypatch: pytest.MonkeyPatch) -> io.StringIO:
    text = Terminal()
    monkeypatch.setattr(sys, "stderr", text)
    return text


def wait_for(screen: io.StringIO, words: str) -> None:
    end = time.monotonic() + 20
    while words not in screen.getvalue() and time.monotonic() < end:
        time.sleep(0.01)
    assert words in screen.getvalue()


def test_what_is_quick_has_no_bar(monkeypatch: pytest.MonkeyPatch) -> None:
    screen = terminal(monkeypatch)
    with LateBar("rendering", 30):
        pass
    assert screen.getvalue() == ""


def test_what_is_slow_has_one(monkeypatch: pytest.MonkeyPatch) -> None:
    screen = terminal(monkeypatch)
    with LateBar("rendering", 0.01) as bar:
        wait_for(screen, "rendering")
        assert "%" not in screen.getvalue()
        time.sleep(0.11)
        bar.set(3, 4)
        wait_for(screen, "75%")
        bar.print("a warning")
        wait_for(screen, "a warning\n")
    # nothing of it is left
    *_, last = screen.getvalue().rstrip("\r").split("\r")
    assert last.strip() == ""
    # its thread has ended too
    assert not [thread for thread in threading.enumerate() if isinstance(thread, threading.Timer)]


def test_nothing_moves_where_nobody_looks(capsys: pytest.CaptureFixture[str]) -> None:
    with LateBar("rendering", 0.0) as bar:
        bar.set(1, 2)
        bar.print("a warning")
        time.sleep(0.05)
    assert capsys.readouterr() == ("", "a warning\n")
