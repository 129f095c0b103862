"""A part of the results."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from shackled.bench.table import millions, table

__all__ = ["Section", "millions", "table"]


@dataclass(frozen=True)
class Section:
    """A part of the results: what people read, and the exact figures."""

    title: str
    text: str
    data: dict[str, Any]
