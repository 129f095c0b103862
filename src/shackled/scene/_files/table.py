"""Checked access to tables of a TOML or JSON document; every message says where the error is."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from typing import Any, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from ...base.checks import COLORS, Color, Floats, color
from ...errors import InputError

Word = TypeVar("Word", bound=str)


class Table:
    """A table of a document. where: its place for messages, such as `objects[1].material`, "" for the document itself.

    Each method returns the default of an absent key. InputError for a value of another kind, or without a default.
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
        return float(self._checked(key, default, _is_number, "a number"))

    def whole(self, key: str, default: int | None = None) -> int:
        """Return a whole number that is not negative."""
        return int(self._checked(key, default, _is_count, "a whole number, at least 0"))

    def index(self, key: str, count: int, kind: str, default: int | None = None) -> int:
        """Return the number of one of `count` things of a kind."""
        number = self.whole(key, default)
        if number >= count:
            raise InputError(f"{self.place(key)} is {number}, but there are {count} {kind}, numbered from 0")
        return number

    def numbers(self, key: str, default: tuple[float, ...]) -> tuple[float, ...]:
        """Return as many numbers as the default has."""
        count = len(default)
        return tuple(map(float, self._checked(key, default, partial(_is_row, width=count), f"{count} numbers")))

    def series(self, key: str) -> Floats:
        """Return a list of numbers, (n,)."""
        return np.array([_check(value, place, _is_number, "a number") for place, value in self.rows(key)], np.float64)

    def matrix(self, key: str, whole: bool = False, width: int = 3) -> NDArray[Any]:
        """Return rows of `width` numbers, (n, width), none if the key is absent; integers if they must be whole."""
        count = {2: "two", 3: "three", 4: "four"}[width]
        what = f"{count} {'whole ' * whole}numbers"
        is_right = partial(_is_row, width=width, whole=whole)
        rows = [_check(row, place, is_right, what) for place, row in self.rows(key)]
        return np.array(rows, dtype=np.int64 if whole else np.float64).reshape(-1, width)

    def flag(self, key: str, default: bool | None = None) -> bool:
        """Return true or false."""
        return bool(self._checked(key, default, lambda value: isinstance(value, bool), "true or false"))

    def choice(self, key: str, choices: tuple[Word, ...], default: Word | None = None) -> Word:
        """Return one of some words."""
        value = self._checked(key, default, lambda value: value in choices, f"one of {', '.join(choices)}")
        return cast(Word, value)

    def color(self, key: str, default: Color | None = None) -> Color:
        """Return red, green and blue, 0..255, of a list of numbers or a text."""
        value = self._checked(key, default, lambda value: isinstance(value, str) or _is_row(value), COLORS)
        return color(value if isinstance(value, str) else list(value), self.place(key))

    def tables(self, key: str) -> list[Table]:
        """Return the tables of a list; none if the key is absent."""
        return [Table(value, where) for where, value in self.rows(key)]

    def rows(self, key: str) -> list[tuple[str, Any]]:
        """Return the parts of a list, each with its place; none if the key is absent."""
        value = self._checked(key, [], lambda value: isinstance(value, list), "a list")
        return [(f"{self.place(key)}[{number}]", part) for number, part in enumerate(value)]

    def _checked(self, key: str, default: object, is_right: Callable[[Any], bool], what: str) -> Any:
        return _check(self.values.get(key, default), self.place(key), is_right, what)


def _check(value: Any, place: str, is_right: Callable[[Any], bool], what: str) -> Any:
    """Return a value, if it is right. InputError with its place and what it must be, otherwise."""
    if not is_right(value):
        raise InputError(f"{place} must be {what}, not {value!r:.60}")
    return value


@contextmanager
def about(where: str) -> Iterator[None]:
    """Prefix the messages of InputErrors with a place."""
    try:
        yield
    except InputError as error:
        raise InputError(f"{where}: {error}") from None


def _is_number(value: object) -> bool:
    """Return whether a value is a finite number, and not a truth value."""
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) < 1e300


def _is_count(value: Any) -> bool:
    return _is_number(value) and value >= 0 and value % 1 == 0


def _is_row(value: Any, width: int | None = None, whole: bool = False) -> bool:
    """Return whether a value is a list of numbers; width: how many."""
    is_list = isinstance(value, list | tuple) and width in (None, len(value)) and all(map(_is_number, value))
    return is_list and not (whole and any(each % 1 or abs(each) >= 2**53 for each in value))
