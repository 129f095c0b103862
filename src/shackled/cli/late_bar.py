"""A bar on stderr, for what may take a while."""

from __future__ import annotations

import sys
import threading

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

#: Seconds that something may take without a bar.
PATIENCE = 1.0


class LateBar:
    """Appears on a terminal as soon as something takes longer than a second, and is gone when it is over.

    Several threads may use it. As a context it ends with what is in it.
    """

    def __init__(self, what: str, patience: float = PATIENCE) -> None:
        """what: is done, for people."""
        self._what = what
        self._console = Console(stderr=True)
        self._bar: Progress | None = None
        self._done, self._total = 0, 0
        self._lock = threading.RLock()
        self._timer: threading.Timer | None = None
        if self._console.is_terminal:
            self._timer = threading.Timer(patience, self._show)
            self._timer.daemon = True
            self._timer.start()

    def set(self, done: int, total: int) -> None:
        """How far it is; before, only that it goes on is shown."""
        with self._lock:
            self._done, self._total = done, total
            if self._bar is not None:
                self._bar.update(self._bar.tasks[0].id, completed=done, total=total)

    def print(self, line: str) -> None:
        """Prints a line on stderr, above the bar if there is one."""
        with self._lock:
            if self._bar is not None:
                self._bar.console.print(line, markup=False, highlight=False, soft_wrap=True)
            else:
                print(line, file=sys.stderr, flush=True)

    def end(self) -> None:
        """Takes the bar away; it does not come again."""
        with self._lock:
            timer, self._timer = self._timer, None
            bar, self._bar = self._bar, None
        if timer is not None:
            timer.cancel()
        if bar is not None:
            bar.stop()

    def __enter__(self) -> LateBar:
        return self

    def __exit__(self, *_: object) -> None:
        self.end()

    def _show(self) -> None:
        with self._lock:
            if self._timer is None:
                return
            self._bar = Progress(
                TextColumn(self._what),
                BarColumn(),
                TaskProgressColumn(),
                TimeRemainingColumn(),
                console=self._console,
                transient=True,
            )
            self._bar.add_task(self._what, total=self._total or None, completed=self._done)
            self._bar.start()
