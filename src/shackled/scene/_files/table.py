"""Checked access to tables of a TOML or JSON document; every message says where the error is."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from ...checks import COLORS, Color, color
from ...errors import InputError

Word = TypeVar("Word", bound=str)


class Table:
    """A table of a document.

    where: its place in the document for messages, such as `objects[1].material`, empty for the document itself. Each
    reading method returns the default where the key is absent, and raises InputError where its value is of another
    kind, or absent without a default.
    """

    def __init__(self, value: object, where: str, known: tuple[str, ...] | None = None) -> None:
        """Take a table. known: the keys that it may have; None for any."""
        if not isinstance(value, Mapping):
            keys = f" with keys of {', '.join(known)}" if known else ""
            raise InputError(f"{where} must be a table{keys}, not {value!r:.60}")
        for key in value:
            if known is not None and key not in known:
                place = f" in {where}" if where else ""
                raise InputError(f"unknown key {key!r}{place}; known are {', '.join(known)}")
        self.values = dict(value)
        self.where = where

    def __contains__(self, key: str) -> bool:
        """Return whether the key is there."""
        return key in self.values

    def place(self, key: str) -> str:
        """Return the place of a key in the document."""
        return f"{self.where}.{key}" if self.where else key

    def get(self, key: str) -> Any:
        """Return the value, of any kind, or None."""
        return self.values.get(key)

    def table(self, key: str, known: tuple[str, ...] | None = None) -> Table:
        """Return the table inside; an empty one if the key is absent."""
        return Table(self.values.get(key, {}), self.place(key), known)

    def only_one_of(self, *keys: str) -> None:
        """Refuse two of the keys together."""
        given = [key for key in keys if key in self]
        if len(given) > 1:
            raise InputError(f"{self.place(given[0])} and {given[1]} exclude each other")

    def number(self, key: str, default: float | None = None) -> float:
        """Return a finite number."""
        value: Any = self.values.get(key, default)
        if not is_number(value):
            raise InputError(f"{self.place(key)} must be a number, not {value!r:.60}")
        return float(value)

    def whole(self, key: str, default: int | None = None) -> int:
        """Return a whole number that is not negative."""
        value: Any = self.values.get(key, default)
        if not is_number(value) or value < 0 or value % 1:
            raise InputError(f"{self.place(key)} must be a whole number, at least 0, not {value!r:.60}")
        return int(value)

    def numbers(self, key: str, default: tuple[float, ...]) -> tuple[float, ...]:
        """Return as many numbers as the default has."""
        value, count = self.values.get(key, default), len(default)
        if not isinstance(value, list | tuple) or len(value) != count or not all(is_number(part) for part in value):
            raise InputError(f"{self.place(key)} must be {count} numbers, not {value!r:.60}")
        return tuple(float(part) for part in value)

    def series(self, key: str) -> NDArray[np.float64]:
        """Return a list of numbers, (n,)."""
        for place, value in self.rows(key):
            if not is_number(value):
                raise InputError(f"{place} must be a number, not {value!r:.60}")
        return np.array([value for _, value in self.rows(key)], dtype=np.float64)

    def matrix(self, key: str, whole: bool = False, width: int = 3) -> NDArray[Any]:
        """Return rows of `width` numbers, (n, width), none if the key is absent; integers if they must be whole."""
        rows, kind = self.rows(key), "whole numbers" if whole else "numbers"
        count = {2: "two", 3: "three", 4: "four"}[width]
        for place, row in rows:
            if not isinstance(row, list) or len(row) != width or not all(is_number(value) for value in row):
                raise InputError(f"{place} must be {count} {kind}, not {row!r:.60}")
            if whole and not all(value % 1 == 0 and abs(value) < 2**53 for value in row):
                raise InputError(f"{place} must be {count} {kind}, not {row!r:.60}")
        table: NDArray[Any] = np.array([row for _, row in rows], dtype=np.int64 if whole else np.float64)
        return table.reshape(-1, width)

    def flag(self, key: str, default: bool | None = None) -> bool:
        """Return true or false."""
        value = self.values.get(key, default)
        if not isinstance(value, bool):
            raise InputError(f"{self.place(key)} must be true or false, not {value!r:.60}")
        return value

    def choice(self, key: str, choices: tuple[Word, ...], default: Word | None = None) -> Word:
        """Return one of some words."""
        value = self.values.get(key, default)
        if value not in choices:
            raise InputError(f"{self.place(key)} must be one of {', '.join(choices)}, not {value!r:.60}")
        return cast(Word, value)

    def color(self, key: str, default: Color | None = None) -> Color:
        """Return red, green and blue, 0..255, of a list of numbers or a text."""
        value = self.values.get(key, default)
        if isinstance(value, str):
            return color(value, self.place(key))
        if not isinstance(value, list | tuple) or not all(is_number(part) for part in value):
            raise InputError(f"{self.place(key)} must be {COLORS}, not {value!r:.60}")
        return color(list(value), self.place(key))

    def rows(self, key: str) -> list[tuple[str, object]]:
        """Return the parts of a list, each with its place; none if the key is absent."""
        value = self.values.get(key, [])
        if not isinstance(value, list):
            raise InputError(f"{self.place(key)} must be a list, not {value!r:.60}")
        return [(f"{self.place(key)}[{number}]", part) for number, part in enumerate(value)]


@contextmanager
def about(where: str) -> Iterator[None]:
    """Prefix the messages of InputErrors with a place."""
    try:
        yield
    except InputError as error:
        raise InputError(f"{where}: {error}") from None


def is_number(value: object) -> bool:
    """Return whether a value is a finite number, and not a truth value."""
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) < 1e300
