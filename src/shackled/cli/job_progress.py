"""What `shackled render` shows on stderr while the parts of a picture are rendered."""

from __future__ import annotations

from ..parallel import Listener, Outline
from .late_bar import LateBar
from .option import with_options


class JobProgress(Listener):
    """Says what a job of several parts is going to cost, and shows a bar on a terminal if it takes a while."""

    def __init__(self) -> None:
        """The job has just begun."""
        self._bar = LateBar("rendering")
        self._done, self._total = 0, 0

    def planned(self, outline: Outline) -> None:
        """How the job is cut is known now."""
        self._total = outline.pixels
        if outline.parts > 1:
            frames = f"{outline.frames} frames, " if outline.frames > 1 else ""
            cost = "" if outline.gas is None else f", about {_rounded(outline.gas):,} gas"
            self._bar.print(f"{frames}{outline.parts} calls{cost}")

    def advanced(self, pixels: int) -> None:
        """So many pixels are finished."""
        self._done += pixels
        self._bar.set(self._done, self._total)

    def warned(self, text: str) -> None:
        """Something went wrong that the job gets over."""
        self._bar.print(f"shackled: {with_options(text)}")

    def ended(self) -> None:
        """The job is over."""
        self._bar.end()


def _rounded(gas: int) -> int:
    """Two digits that mean something: it is an estimate."""
    unit: int = 10 ** max(0, len(str(gas)) - 2)
    return round(gas / unit) * unit
