"""Progress bars on stderr."""

from __future__ import annotations

import sys
import threading

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

from ..parallel import Listener, Outline
from .option import with_options

#: Seconds before a bar is shown.
PATIENCE = 1.0


class LateBar:
    """A bar that appears on a terminal when a task takes longer than a second, and is removed at its end.

    It is thread-safe, and a context manager.
    """

    def __init__(self, what: str, patience: float = PATIENCE) -> None:
        """Start the timer. what: the label of the bar."""
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
        """Set the progress of the task; before the first call, the bar shows activity only."""
        with self._lock:
            self._done, self._total = done, total
            if self._bar is not None:
                self._bar.update(self._bar.tasks[0].id, completed=done, total=total)

    def print(self, line: str) -> None:
        """Print a line on stderr, above the bar if there is one."""
        with self._lock:
            if self._bar is not None:
                self._bar.console.print(line, markup=False, highlight=False, soft_wrap=True)
            else:
                print(line, file=sys.stderr, flush=True)

    def print_result(self, line: str) -> None:
        """Print a line on stdout; above the bar if that is on the same terminal."""
        with self._lock:
            if self._bar is not None and sys.stdout.isatty():
                self.print(line)
            else:
                print(line, flush=True)

    def end(self) -> None:
        """Remove the bar; it does not appear again."""
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
                # results would be wrapped, and go to stderr
                redirect_stdout=False,
            )
            self._bar.add_task(self._what, total=self._total or None, completed=self._done)
            self._bar.start()


class Notes(Listener):
    """A listener that prints warnings only."""

    def warned(self, text: str) -> None:
        """Print a warning."""
        print(f"shackled: {with_options(text)}", file=sys.stderr, flush=True)


class JobProgress(Listener):
    """A listener that prints the estimated cost of a job of several parts, and shows a bar while it runs."""

    def __init__(self) -> None:
        """Start the timer of the bar."""
        self._bar = LateBar("rendering")
        self._done, self._total = 0, 0

    def planned(self, outline: Outline) -> None:
        """Print the number of calls and their estimated gas."""
        self._total = outline.pixels
        if outline.parts > 1:
            frames = f"{outline.frames} frames, " if outline.frames > 1 else ""
            self._bar.print(f"{frames}{outline.parts} calls, about {_rounded(outline.gas):,} gas")

    def advanced(self, pixels: int) -> None:
        """Count finished pixels."""
        self._done += pixels
        self._bar.set(self._done, self._total)

    def warned(self, text: str) -> None:
        """Print a warning above the bar."""
        self._bar.print(f"shackled: {with_options(text)}")

    def ended(self) -> None:
        """Remove the bar."""
        self._bar.end()


def _rounded(gas: int) -> int:
    """Return a number rounded to two significant digits."""
    unit: int = 10 ** max(0, len(str(gas)) - 2)
    return round(gas / unit) * unit
