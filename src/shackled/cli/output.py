"""Output of commands: results on stdout, notes on stderr, both safe for a terminal."""

from __future__ import annotations

import re
import sys
from collections.abc import Sequence

from ..untrusted import plain

#: A number or a size, such as 1,024 x 768 or 1.2e-07, and not an address or a sentence.
NUMBER = r"\d(?!x)[\d,. xe%-]*"


def print_line(text: str) -> None:
    """Print a line of the result."""
    print(plain(text), flush=True)


def print_note(text: str) -> None:
    """Print a line that is not part of the result."""
    print(plain(text), file=sys.stderr, flush=True)


def print_table(head: Sequence[str], rows: Sequence[Sequence[str]], *, to_stderr: bool = False) -> None:
    """Print a table, never shortened. Columns with numbers and sizes, except the first, are aligned to the right."""
    shown = [[plain(cell) for cell in row] for row in (head, *rows)]
    columns = []
    for number, cells in enumerate(zip(*shown, strict=True)):
        is_number = number > 0 and any(re.fullmatch(NUMBER, cell) for cell in cells[1:])
        width = max(map(len, cells))
        columns.append([cell.rjust(width) if is_number else cell.ljust(width) for cell in cells])
    for row in zip(*columns, strict=True):
        print("  ".join(row).rstrip(), file=sys.stderr if to_stderr else sys.stdout, flush=True)
