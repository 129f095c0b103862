"""The answer of `shadows`: which faces one light reaches, which it does not, and the functions that say where."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

#: Entries of faces; others are offsets of lists.
LIT, DARK = 0, 1
#: Bytes of an entry. In words of a list: whether the shadow ends at an edge, or begins; whether it is the last one;
#: rows of samples and coefficients.
ENTRY_SIZE = 4
ENDS, LAST = 1, 1 << 8
BOTTOM_AT, TOP_AT, CONSTANT_AT, Y_AT, X_AT = 64, 80, 96, 160, 208
#: Where the four samples of a pixel are, in eighths of it; each is in a row of its own.
SAMPLES = ((-1, -3), (3, -1), (-3, 1), (1, 3))


class Edge(NamedTuple):
    """An edge of shadows, of the rows of samples from top to before bottom, four for each row of pixels.

    A place on the canvas, in eighths of a pixel, is to the right of it where x * X + y * Y + constant is at least 0.
    There are so many more shadows to the right of it than to the left.
    """

    top: int
    bottom: int
    more: int
    x: int
    y: int
    constant: int


#: LIT, DARK, or the edges of what shades parts of a face, ordered by the first row of pixels.
Entry = int | list[Edge]


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
    return [
        sum(
            edge.more
            for edge in entry
            if edge.top <= 4 * row + k < edge.bottom
            and edge.x * (8 * column + x) + edge.y * (8 * row + y) + edge.constant >= 0
        )
        > 0
        for k, (x, y) in enumerate(SAMPLES)
    ]


def words_of(edges: Sequence[Edge]) -> Iterable[bytes]:
    """Yield the words of a list."""
    for number, edge in enumerate(edges):
        last = number == len(edges) - 1
        word = last * LAST | (edge.more < 0) * ENDS | edge.bottom << BOTTOM_AT | edge.top << TOP_AT
        word |= (edge.constant & (1 << 64) - 1) << CONSTANT_AT
        word |= (edge.y & (1 << 48) - 1) << Y_AT | (edge.x & (1 << 48) - 1) << X_AT
        yield word.to_bytes(32, "big")
