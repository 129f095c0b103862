"""The answer of `shadows`: which faces one light reaches, which it does not, and the functions that say where."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

#: Entries of faces; others are offsets of lists.
LIT, DARK = 0, 1
#: Bytes of an entry. In words of a list: how many functions a shadow has, and whether it is the last one, both in its
#: first word; rows and coefficients.
ENTRY_SIZE = 4
LAST = 1 << 8
LEFT_AT, RIGHT_AT, BOTTOM_AT, TOP_AT, CONSTANT_AT, Y_AT, X_AT = 32, 48, 64, 80, 96, 160, 208
#: Where the four samples of a pixel are, in eighths of it.
SAMPLES = ((-1, -3), (3, -1), (-3, 1), (1, 3))


class Function(NamedTuple):
    """x * X + y * Y + constant, where X and Y are the place on the canvas in eighths of a pixel."""

    x: int
    y: int
    constant: int


class Shadow(NamedTuple):
    """What a face casts on another: where all functions are at least 0, in the rows from top to before bottom, and the
    columns from left to before right.
    """

    top: int
    bottom: int
    left: int
    right: int
    functions: tuple[Function, ...]


#: LIT, DARK, or what shades parts of a face, ordered by the first row.
Entry = int | list[Shadow]


@dataclass(frozen=True)
class Table:
    """What is shaded.

    faces: of each object, of each face LIT, DARK, or what shades parts of it.
    """

    light: int
    faces: list[list[Entry]]

    def encode(self) -> bytes:
        """Return the answer of the contract: where entries of objects begin, an entry for each face, and lists."""
        head, entries, lists = b"", b"", b""
        count = sum(map(len, self.faces))
        size = 32 * len(self.faces)
        begin = size + (ENTRY_SIZE * count + 31 & ~31)
        for faces in self.faces:
            head += (size + len(entries)).to_bytes(32, "big")
            for entry in faces:
                number = entry if isinstance(entry, int) else begin + len(lists)
                entries += number.to_bytes(ENTRY_SIZE, "big")
                lists += b"" if isinstance(entry, int) else b"".join(words_of(entry))
        return (head + entries).ljust(begin, b"\0") + lists


def dark_samples(entry: Entry, column: int, row: int) -> list[bool]:
    """Return which of the samples of a pixel of the canvas are in the shadow on a face."""
    if isinstance(entry, int):
        return [entry == DARK] * 4
    shadows = [each for each in entry if each.top <= row < each.bottom and each.left <= column < each.right]
    return [any(covers(each, 8 * column + x, 8 * row + y) for each in shadows) for x, y in SAMPLES]


def covers(shadow: Shadow, x: int, y: int) -> bool:
    """Return whether a place on the canvas, in eighths of a pixel, is shaded."""
    return all(f.x * x + f.y * y + f.constant >= 0 for f in shadow.functions)


def words_of(shadows: Sequence[Shadow]) -> Iterable[bytes]:
    """Yield the words of a list."""
    for shadow in shadows:
        head = len(shadow.functions) | (shadow is shadows[-1]) * LAST
        for f in shadow.functions:
            word = head | shadow.left << LEFT_AT | shadow.right << RIGHT_AT
            word |= shadow.bottom << BOTTOM_AT | shadow.top << TOP_AT
            word |= (f.constant & (1 << 64) - 1) << CONSTANT_AT
            word |= (f.y & (1 << 48) - 1) << Y_AT | (f.x & (1 << 48) - 1) << X_AT
            yield word.to_bytes(32, "big")
            head = 0
