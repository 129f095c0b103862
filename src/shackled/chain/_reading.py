"""Reading many things from a chain at a time."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

Value = TypeVar("Value")
Read = TypeVar("Read")
#: Maximum number of concurrent requests, and of those that wait for a thread.
MAX_REQUESTS, MAX_WAITING = 6, 96
#: Called with the number of what is read, and that of all.
Report = Callable[[int, int], None]


def read_all(read: Callable[[Value], Read], values: Sequence[Value], report: Report | None = None) -> Iterator[Read]:
    """Yield what `read` returns of each value, in order; several are read concurrently."""
    with ThreadPoolExecutor(MAX_REQUESTS) as pool:
        for begin in range(0, len(values), MAX_WAITING):
            some = values[begin : begin + MAX_WAITING]
            for done, found in enumerate(pool.map(read, some), begin + 1):
                if report is not None:
                    report(done, len(values))
                yield found
