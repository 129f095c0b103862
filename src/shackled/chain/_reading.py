"""Reading many things from a chain at a time."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

Value = TypeVar("Value")
Read = TypeVar("Read")
#: Maximum number of concurrent requests.
MAX_REQUESTS = 6
#: Called with the number of what is read, and that of all.
Report = Callable[[int, int], None]


def read_all(read: Callable[[Value], Read], values: Sequence[Value], report: Report | None = None) -> Iterator[Read]:
    """Yield what `read` returns of each value, in order; several are read concurrently."""
    with ThreadPoolExecutor(MAX_REQUESTS) as pool:
        for done, found in enumerate(pool.map(read, values), 1):
            if report is not None:
                report(done, len(values))
            yield found
