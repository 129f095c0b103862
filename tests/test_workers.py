"""Functions that are called in other processes, and what becomes of their callers when those end."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Callable

import pytest

from shackled import InputError, RenderError
from shackled.base.workers import WorkerEndedError, each


def double(number: int) -> int:
    return 2 * number


def pid(_: int) -> int:
    return os.getpid()


def refuse(number: int) -> int:
    raise InputError(f"{number} is refused")


class TwoPartError(Exception):
    """Cannot be made again of its message alone."""

    def __init__(self, first: str, second: str) -> None:
        super().__init__(f"{first} and {second}")


def fail_in_two_parts(_: int) -> None:
    raise TwoPartError("one", "two")


def vanish_at_1(number: int) -> int:
    if number == 1:
        os.kill(os.getpid(), signal.SIGKILL)
    return number


def nothing_to_pickle(_: int) -> object:
    return lambda: None


def print_aloud(_: int) -> int:
    print("a library says something")
    os.write(1, b"and a program that it started too\n")
    return 7


def only(function: Callable[[int], object], item: int = 3) -> object:
    """What one call returns."""
    ((index, result),) = each(function, [item], 2)
    assert index == 0
    return result


def test_many_are_shared_out() -> None:
    assert dict(each(double, range(20), 2)) == {number: 2 * number for number in range(20)}
    assert list(each(double, [], 2)) == []
    assert list(each(pid, [5], 1)) == [(0, os.getpid())]
    pids = {found for _, found in each(pid, range(20), 2)}
    assert len(pids) <= 2
    assert os.getpid() not in pids


def test_errors_come_back_as_they_are() -> None:
    with pytest.raises(InputError, match=r"^3 is refused") as raised:
        only(refuse)
    assert "in refuse" in raised.value.__notes__[0]
    with pytest.raises(RenderError, match="one and two"):
        only(fail_in_two_parts)
    with pytest.raises(Exception, match="pickle"):
        only(nothing_to_pickle)


def test_what_is_printed_is_no_answer() -> None:
    assert only(print_aloud) == 7


def test_a_process_that_ends_is_the_failure_of_one_item() -> None:
    """Another takes its place."""
    assert dict(each(vanish_at_1, range(8), 2, lambda _: -1)) == {0: 0, 1: -1} | {n: n for n in range(2, 8)}
    with pytest.raises(WorkerEndedError, match="a worker process ended; is there enough memory"):
        list(each(vanish_at_1, range(4), 2))


def test_who_stops_looking_leaves_no_process() -> None:
    found = each(time.sleep, [0, 600, 600, 600], 2)
    assert next(found) == (0, None)
    started = time.monotonic()
    found.close()  # type: ignore[attr-defined]
    assert time.monotonic() - started < 60
