"""What pictures cost in gas: the snapshot that tests compare with, and the tables of `python -m benchmarks`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Section:
    """A part of the results: what people read, and the exact figures."""

    title: str
    text: str
    data: dict[str, Any]
