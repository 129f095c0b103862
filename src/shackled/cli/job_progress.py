"""What `shackled render` shows on stderr while the parts of a picture are rendered."""

from __future__ import annotations

import sys
import time

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

from ..parallel import Listener, Outline

#: Seconds that a job may take without a bar.
PATIENCE = 1.0


class JobProgress(Listener):
    """Says what a job of several parts is going to cost, and shows a bar on a terminal if it takes a while."""

    def __init__(self) -> None:
        """Nothing is shown yet."""
        self._console = Console(stderr=True)
        self._bar: Progress | None = None
        self._done, self._total = 0, 0
        self._started = time.monotonic()

    def planned(self, outline: Outline) -> None:
        """The job is about to begin."""
        self._total, self._started = outline.pixels, time.monotonic()
        if outline.parts > 1:
            frames = f"{outline.frames} frames, " if outline.frames > 1 else ""
            cost = "" if outline.gas is None else f", about {_rounded(outline.gas):,} gas"
            print(f"{frames}{outline.parts} calls{cost}", file=sys.stderr)

    def advanced(self, pixels: int) -> None:
        """So many pixels are finished."""
        self._done += pixels
        late = time.monotonic() - self._started > PATIENCE
        if self._bar is None and late and self._console.is_terminal and self._done < self._total:
            self._bar = Progress(
                TextColumn("rendering"),
                BarColumn(),
                TaskProgressColumn(),
                TimeRemainingColumn(),
                console=self._console,
                transient=True,
            )
            self._bar.add_task("rendering", total=self._total)
            self._bar.start()
        if self._bar is not None:
            self._bar.update(self._bar.tasks[0].id, completed=self._done)

    def warned(self, text: str) -> None:
        """Something went wrong that the job gets over."""
        line = f"shackled: {' '.join(text.split())}"
        if self._bar is not None:
            self._bar.console.print(line, markup=False, highlight=False, soft_wrap=True)
        else:
            print(line, file=sys.stderr)

    def ended(self) -> None:
        """The job is over."""
        if self._bar is not None:
            self._bar.stop()
            self._bar = None


def _rounded(gas: int) -> int:
    """Two digits that mean something: it is an estimate."""
    unit: int = 10 ** max(0, len(str(gas)) - 2)
    return round(gas / unit) * unit
