"""Measure what pictures cost in gas: the snapshot of the tests, and the tables of `python -m benchmarks`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Section:
    """A part of the results: its text, and the exact figures."""

    title: str
    text: str
    data: dict[str, Any]
