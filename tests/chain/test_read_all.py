"""Reading many things at a time."""

from __future__ import annotations

import threading

import pytest

from shackled.chain import read_all


def test_the_order_and_the_progress() -> None:
    reported: list[tuple[int, int]] = []
    found = list(read_all(lambda value: 2 * value, range(200), lambda done, total: reported.append((done, total))))
    assert found == [2 * value for value in range(200)]
    assert reported == [(done, 200) for done in range(1, 201)]


def test_several_are_read_at_a_time() -> None:
    together = threading.Barrier(4, timeout=20)
    list(read_all(lambda _: together.wait(), range(4)))


def test_an_endless_list_is_not_held() -> None:
    """A node may say that there are any number of things."""
    asked: list[int] = []

    def fail(value: int) -> None:
        asked.append(value)
        raise LookupError(value)

    with pytest.raises(LookupError):
        list(read_all(fail, range(2**62)))
    assert len(asked) < 100
