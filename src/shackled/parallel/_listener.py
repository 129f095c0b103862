"""Who is told how a job goes."""

from __future__ import annotations

import warnings
from dataclasses import dataclass


@dataclass(frozen=True)
class Outline:
    """What a job is going to be. gas: an estimate of what it will use, None if there is none."""

    parts: int
    frames: int
    pixels: int
    gas: int | None


class Listener:
    """Told of a job; this one keeps quiet but for warnings. Threads may call it, one at a time."""

    def planned(self, outline: Outline) -> None:
        """The job is about to begin."""

    def advanced(self, pixels: int) -> None:
        """So many pixels are finished, in this or an earlier run; less than 0 if some have to be rendered again."""

    def warned(self, text: str) -> None:
        """Something went wrong that the job gets over."""
        warnings.warn(text, RuntimeWarning, stacklevel=2)

    def ended(self) -> None:
        """The job is over, one way or the other."""
