"""Progress bars on stderr."""

from __future__ import annotations

import shutil
import sys
import threading
import time

from ..parallel._scheduler import Listener, Outline
from .option import with_options

#: Seconds before a bar is shown, and between two pictures of it.
PATIENCE = 1.0
PAUSE = 0.1
#: Seconds between two lines of a log, where there is no terminal.
LOG_PAUSE = 10.0
#: Characters of a bar.
WIDTH = 40


class LateBar:
    """A bar that appears on a terminal when a task takes longer than a second, and is removed at its end.

    Where stderr is no terminal, it is a line every ten seconds.
    It is thread-safe, and a context manager.
    """

    #: Of what is counted.
    unit = ""

    def __init__(self, what: str, patience: float = PATIENCE) -> None:
        """Start the timer. what: the label of the bar."""
        self._what = what
        self._done, self._total = 0, 0
        self._shown, self._drawn, self._logged = False, 0.0, 0.0
        self._started = time.monotonic()
        self._lock = threading.RLock()
        self._timer: threading.Timer | None = None
        if sys.stderr is not None and sys.stderr.isatty():
            self._timer = threading.Timer(patience, self._show)
            self._timer.daemon = True
            self._timer.start()

    def set(self, done: int, total: int | None, what: str | None = None) -> None:
        """Set the progress of the task; before the first call, the bar has its label only. what: another label."""
        with self._lock:
            if what is not None and what != self._what:
                self._what, self._started = what, time.monotonic()
            self._done, self._total = done, total or 0
            if time.monotonic() - self._drawn >= PAUSE:
                self._draw()
            spent = time.monotonic() - self._started
            if self._timer is None and done and total and spent - self._logged >= LOG_PAUSE:
                self._logged = spent
                left = spent * (total / done - 1)
                text = f"{self._what}: {done:,} of {total:,}{self.unit} in {spent:.0f} s, about {left:.0f} s left"
                print(text, file=sys.stderr, flush=True)

    def print(self, line: str, to_stdout: bool = False) -> None:
        """Print a line on stderr or stdout, above the bar if there is one on the same terminal."""
        with self._lock:
            if not to_stdout or sys.stdout.isatty():
                self._clear()
            print(line, file=sys.stdout if to_stdout else sys.stderr, flush=True)
            self._draw()

    def warned(self, text: str) -> None:
        """Print a warning of the library above the bar."""
        self.print(f"shackled: {with_options(text)}")

    def end(self) -> None:
        """Remove the bar; it does not appear again."""
        with self._lock:
            timer, self._timer = self._timer, None
            self._clear()
            self._shown = False
        if timer is not None:
            timer.cancel()

    def __enter__(self) -> LateBar:
        return self

    def __exit__(self, *_: object) -> None:
        self.end()

    def _show(self) -> None:
        with self._lock:
            self._shown = self._timer is not None
            self._draw()

    def _draw(self) -> None:
        if not self._shown:
            return
        self._drawn = time.monotonic()
        text = self._what
        if self._total:
            part = min(1.0, self._done / self._total)
            left = (self._drawn - self._started) * (1 / part - 1) if part else 0
            text += f" {'#' * round(WIDTH * part):.<{WIDTH}} {100 * part:3.0f}% {left // 60:3.0f}:{left % 60:02.0f}"
        elif self._done:
            text += f" {self._done:,}"
        # not up to the edge, where some terminals begin a new line
        width = shutil.get_terminal_size().columns - 1
        print(f"\r{text:{width}.{width}}", end="", file=sys.stderr, flush=True)

    def _clear(self) -> None:
        if self._shown:
            print(f"\r{' ' * (shutil.get_terminal_size().columns - 1)}\r", end="", file=sys.stderr, flush=True)


class Notes(Listener):
    """A listener that prints warnings only."""

    def warned(self, text: str) -> None:
        """Print a warning."""
        print(f"shackled: {with_options(text)}", file=sys.stderr, flush=True)


class JobProgress(LateBar, Listener):
    """A bar that shows the progress of a job; it also prints the estimated cost of a job of several parts."""

    unit = " pixels"

    def __init__(self) -> None:
        """Start the timer of the bar."""
        super().__init__("rendering")

    def planned(self, outline: Outline) -> None:
        """Print the number of calls and their estimated gas."""
        self._total = outline.pixels
        if outline.parts > 1:
            frames = f"{outline.frames} frames, " if outline.frames > 1 else ""
            self.print(f"{frames}{outline.parts} calls, about {int(float(f'{outline.gas:.2g}')):,} gas")

    def advanced(self, pixels: int) -> None:
        """Count finished pixels."""
        self.set(self._done + pixels, self._total)

    def ended(self) -> None:
        """Remove the bar."""
        self.end()
