"""Tables and JSON of commands are safe for any terminal, and complete; the bar for what takes a while."""

from __future__ import annotations

import io
import json
import sys
import threading
import time

import pytest

from shackled.cli.output import print_json, print_table
from shackled.cli.progress import LateBar

ADDRESS = "0x" + "5b" * 20


def test_a_table_shows_untrusted_text_as_it_is(capsys: pytest.CaptureFixture[str]) -> None:
    print_table(("name", "[red]a[/b]", "\x1b[2Jb"), [("[bold]c", "\x9b31m", "d\ne")])
    head, row = capsys.readouterr().out.splitlines()
    assert head.split() == ["name", "[red]a[/b]", "?[2Jb"]
    assert row.split() == ["[bold]c", "?31m", "d?e"]


def test_numbers_are_aligned_to_the_right_and_never_shortened(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "40")
    rows = [("Engine", ADDRESS, "1,234", "12"), ("total", "", "12,345", "")]
    print_table(("contract", "address", "gas", "estimate"), rows)
    head, first, last = capsys.readouterr().out.splitlines()
    assert head.index("address") == first.index(ADDRESS)
    assert first.index("1,234") == last.index("12,345") + 1
    assert len(head.rstrip()) == len(first.rstrip())


def test_sentences_that_begin_with_a_number_are_not_numbers(capsys: pytest.CaptureFixture[str]) -> None:
    print_table(("token", "problem", "size"), [("1", "0 bytes", "1,024 x 8"), ("2", "a long problem", "8 x 8")])
    _, first, last = capsys.readouterr().out.splitlines()
    assert first.index("0 bytes") == last.index("a long problem")
    assert len(first.rstrip()) == len(last.rstrip())


def test_json_has_no_characters_that_a_terminal_obeys_or_cannot_encode(capsys: pytest.CaptureFixture[str]) -> None:
    document = {"name": "\x9b31m \udcff é"}
    print_json(document)
    out = capsys.readouterr().out
    assert out.isascii()
    assert json.loads(out) == document


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


def test_only_what_is_slow_has_a_bar(monkeypatch: pytest.MonkeyPatch) -> None:
    screen = terminal(monkeypatch)
    with LateBar("what is quick", 30):
        pass
    assert screen.getvalue() == ""
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
