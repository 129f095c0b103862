"""Who is remembered, and who is not."""

from __future__ import annotations

from typing import Any, cast

import pytest

pytest.importorskip("nicegui", reason="the page needs nicegui")

from shackled.creator.pool import Pool
from shackled.creator.scene import Facts
from shackled.creator.state import Source, State
from shackled.creator.web import visitors
from shackled.creator.web.visitors import Visitors
from shackled.errors import InputError

STATE, FACTS, POOL = State(Source("piece", "cube")), cast(Facts, None), cast(Pool, None)


def test_names_differ_and_are_long() -> None:
    everybody = Visitors(POOL)
    names = {everybody.add(STATE, FACTS).name for _ in range(50)}
    assert len(names) == 50
    assert min(map(len, names)) >= 24
    assert everybody.find("") is None


def test_who_is_gone_makes_room(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(visitors, "MOST", 3)
    everybody = Visitors(POOL)
    first, *others = [everybody.add(STATE, FACTS) for _ in range(3)]
    for each in others:
        each._send = cast(Any, print)
    last = everybody.add(STATE, FACTS)
    assert everybody.find(first.name) is None
    assert everybody.find(others[0].name) is others[0]
    last._send = cast(Any, print)
    with pytest.raises(InputError, match="3 visitors"):
        everybody.add(STATE, FACTS)


def test_whose_page_is_gone_is_forgotten() -> None:
    everybody = Visitors(POOL)
    gone, here = everybody.add(STATE, FACTS), everybody.add(STATE, FACTS)
    here._send = cast(Any, print)
    for each in (gone, here):
        everybody.drop(each)
    assert everybody.find(gone.name) is None
    assert everybody.find(here.name) is here


def test_who_is_long_gone_is_forgotten(monkeypatch: pytest.MonkeyPatch) -> None:
    everybody = Visitors(POOL)
    first = everybody.add(STATE, FACTS)
    first.seen -= visitors.PATIENCE + 1
    everybody.add(STATE, FACTS)
    assert everybody.find(first.name) is None
