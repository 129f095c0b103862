"""Functions that are called in other processes, and what becomes of their callers when those end."""

from __future__ import annotations

import os
import signal
import sys
import threading
import time
from collections.abc import Iterator

import pytest

from shackled import InputError, RenderError
from shackled.workers import Worker, WorkerEndedError, WorkerLateError, each, report_progress

prepared: list[int] = []


@pytest.fixture
def worker() -> Iterator[Worker]:
    made = Worker()
    yield made
    made.close()
    assert made.pid is None


def double(number: int) -> int:
    return 2 * number


def refuse(number: int) -> int:
    raise InputError(f"{number} is refused")


class TwoPartError(Exception):
    """Cannot be made again of its message alone."""

    def __init__(self, first: str, second: str) -> None:
        super().__init__(f"{first} and {second}")


def fail_in_two_parts() -> None:
    raise TwoPartError("one", "two")


def count_up(to: int) -> str:
    for done in range(to):
        report_progress(done, to)
    return "counted"


def wait_or_not(seconds: float) -> None:
    time.sleep(seconds)


def vanish() -> None:
    os.kill(os.getpid(), signal.SIGKILL)


def fill(size: int) -> int:
    return len(bytearray(size))


def nothing_to_pickle() -> object:
    return lambda: None


def print_aloud() -> int:
    print("a library says something")
    os.write(1, b"and a program that it started too\n")
    return 7


def prepare(number: int) -> None:
    prepared.append(number)


def what_was_prepared() -> list[int]:
    return prepared


def test_a_function_is_called_in_another_process(worker: Worker) -> None:
    assert worker.pid is None
    assert worker.call(double, 21) == 42
    pid = worker.call(os.getpid)
    assert pid == worker.pid != os.getpid()
    assert worker.call(os.getpid) == pid


def test_errors_come_back_as_they_are(worker: Worker) -> None:
    with pytest.raises(InputError, match=r"^3 is refused$") as raised:
        worker.call(refuse, 3)
    assert "in refuse" in str(raised.value.__cause__)
    with pytest.raises(RenderError, match="one and two"):
        worker.call(fail_in_two_parts)
    with pytest.raises(Exception, match="pickle"):
        worker.call(nothing_to_pickle)
    assert worker.call(double, 1) == 2


def test_what_is_printed_is_no_answer(worker: Worker) -> None:
    assert worker.call(print_aloud) == 7


def test_it_tells_how_far_it_is(worker: Worker) -> None:
    told: list[tuple[int, int]] = []
    assert worker.call(count_up, 3, on_progress=lambda *values: told.append(values)) == "counted"
    assert told == [(0, 3), (1, 3), (2, 3)]
    assert worker.call(count_up, 3) == "counted"


def test_each_new_process_is_prepared() -> None:
    worker = Worker(prepare, 5)
    try:
        assert worker.call(what_was_prepared) == [5]
        with pytest.raises(WorkerEndedError):
            worker.call(vanish)
        assert worker.call(what_was_prepared) == [5]
    finally:
        worker.close()


def test_an_idle_process_that_ended_is_replaced(worker: Worker) -> None:
    pid = worker.call(os.getpid)
    os.kill(pid, signal.SIGKILL)
    assert worker.call(os.getpid) != pid


def test_a_process_that_ends_at_work_is_told_of(worker: Worker) -> None:
    with pytest.raises(WorkerEndedError, match="a worker process ended; is there enough memory"):
        worker.call(vanish)
    assert worker.call(double, 2) == 4


def test_a_late_process_is_ended(worker: Worker) -> None:
    pid = worker.call(os.getpid)
    with pytest.raises(WorkerLateError, match=r"took longer than 0\.2 seconds"):
        worker.call(time.sleep, 600, seconds=0.2)
    assert worker.call(os.getpid, seconds=60) != pid


@pytest.mark.parametrize("end", [Worker.kill, Worker.end, Worker.close])
def test_it_can_be_ended_from_another_thread(worker: Worker, end: object) -> None:
    worker.call(double, 1)
    ended = threading.Timer(0.1, end, (worker,))  # type: ignore[arg-type]
    ended.start()
    with pytest.raises(WorkerEndedError):
        worker.call(time.sleep, 600)
    ended.join()


def test_after_it_was_closed_there_is_no_process() -> None:
    worker = Worker()
    worker.close()
    with pytest.raises(WorkerEndedError, match="closed"):
        worker.call(double, 1)
    assert worker.pid is None


def test_unwanted_work_is_not_begun(worker: Worker) -> None:
    with pytest.raises(WorkerEndedError, match="was cancelled"):
        worker.call(double, 1, cancelled=lambda: True)


@pytest.mark.skipif(sys.platform != "linux", reason="other systems may not know the limit")
def test_memory_is_limited() -> None:
    worker = Worker(memory=2**30)
    try:
        assert worker.call(fill, 2**20) == 2**20
        with pytest.raises(MemoryError):
            worker.call(fill, 2**31)
    finally:
        worker.close()


def test_many_are_shared_out() -> None:
    assert dict(each(double, range(20), 2)) == {number: 2 * number for number in range(20)}
    assert list(each(double, [], 2)) == []
    with pytest.raises(InputError, match="is refused"):
        list(each(refuse, range(3), 2))


def test_who_stops_looking_leaves_no_process() -> None:
    found = each(wait_or_not, [0, 600, 600, 600], 2)
    assert next(found) == (0, None)
    found.close()  # type: ignore[attr-defined]
