"""Where experiments are made: several processes, and a bar that shows how far they are."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from types import TracebackType
from typing import TypeVar

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

from ..workers import each

Item = TypeVar("Item")
Result = TypeVar("Result")


class Lab:
    """A context in which experiments are made."""

    def __init__(self, quick: bool = False, processes: int | None = None, rpc: str | None = None) -> None:
        """With as many processes as cores, unless `processes` says how many: embedded EVMs hold Python's lock, so that
        threads would not help.

        quick: whether a few small scenes suffice, to see that everything works. rpc: a node to be measured too.
        """
        self.rpc = rpc
        self.quick = quick
        self.processes = processes or os.cpu_count() or 1
        self._progress = Progress(
            TextColumn("{task.description:10}"),
            BarColumn(),
            MofNCompleteColumn(),
            TimeElapsedColumn(),
            TimeRemainingColumn(),
            console=Console(stderr=True),
        )

    def __enter__(self) -> Lab:
        self._progress.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._progress.stop()

    def map(
        self, label: str, function: Callable[[Item], Result], items: Iterable[Item], alone: bool = False
    ) -> list[Result]:
        """`function` of each item, in their order.

        Both are pickled and sent to other processes, unless there is but one, or `alone`: one after the other in this
        process, where times are to be measured.
        """
        items = list(items)
        task = self._progress.add_task(label, total=len(items))
        results: dict[int, Result] = {}
        if alone or self.processes == 1:
            found: Iterator[tuple[int, Result]] = ((place, function(item)) for place, item in enumerate(items))
        else:
            found = each(function, items, self.processes)
        for place, result in found:
            results[place] = result
            self._progress.advance(task)
        return [results[place] for place in range(len(items))]
