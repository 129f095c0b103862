"""Show the progress of `shackled gas` on stderr: the bracket as it narrows."""

from __future__ import annotations

import sys
from types import TracebackType

from rich.console import Console
from rich.live import Live
from rich.table import Table
from rich.text import Text

from ..gas import SearchStep

#: Number of steps shown at a time.
ROWS = 12
BAR = 32


class Progress:
    """The progress of a measurement: live on a terminal, a line per step elsewhere unless it is quiet."""

    def __init__(self, quiet: bool) -> None:
        """Start nothing yet. quiet: show progress on a terminal only."""
        self._console = Console(stderr=True)
        self._quiet = quiet
        self._steps: list[SearchStep] = []
        self._live: Live | None = None

    def __enter__(self) -> Progress:
        """Start the display."""
        if self._console.is_terminal:
            self._live = Live(console=self._console)
            self._live.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Stop the display and leave its last content."""
        if self._live is not None:
            self._live.stop()

    def step(self, step: SearchStep) -> None:
        """Show a step of the search."""
        self._steps.append(step)
        if self._live is not None:
            self._live.update(self._view())
        elif not self._quiet:
            verdict = "sufficient" if step.enough else "insufficient"
            print(f"call {len(self._steps):2}: {step.limit:>14,} {verdict}; {bracket(step)}", file=sys.stderr)

    def _view(self) -> Table:
        table = Table("call", "gas limit", "", "remaining", "bracket", box=None, header_style="dim")
        table.columns[0].justify = table.columns[1].justify = "right"
        first = max(0, len(self._steps) - ROWS)
        for number, step in enumerate(self._steps[first:], first + 1):
            verdict = Text("sufficient", "green") if step.enough else Text("insufficient", "red")
            table.add_row(str(number), f"{step.limit:,}", verdict, _bar(step), bracket(step))
        return table


def bracket(step: SearchStep) -> str:
    """Return the bounds of the gas after a step."""
    return f"{step.lower:,} < gas" + ("" if step.upper is None else f" <= {step.upper:,}")


def _bar(step: SearchStep) -> Text:
    """Return a bar with a character for each call that the search still needs."""
    return Text("█" * (BAR if step.upper is None else min(BAR, (step.upper - step.lower - 1).bit_length())))
