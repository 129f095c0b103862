"""What the parts of a scene have in common."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

import numpy as np


class Value:
    """A dataclass whose instances are equal if all their fields are; arrays are compared number by number."""

    def __eq__(self, other: object) -> bool:
        """Compares all fields."""
        if type(self) is not type(other):
            return NotImplemented
        return all(_same(own, its) for own, its in zip(_values(self), _values(other), strict=True))

    def __hash__(self) -> int:
        """Of all fields."""
        # + 0.0: -0.0 equals 0.0
        return hash(tuple((each + 0.0).tobytes() if isinstance(each, np.ndarray) else each for each in _values(self)))


def plural(count: int, one: str, many: str = "") -> str:
    """Such as "1 light" or "2,000 lights"."""
    return f"{count:,} {one if count == 1 else many or one + 's'}"


def _values(value: Any) -> list[Any]:
    return [getattr(value, field.name) for field in fields(value)]


def _same(one: Any, other: Any) -> bool:
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        return np.array_equal(one, other)
    return bool(one == other)
