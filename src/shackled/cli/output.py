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
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    stream = sys.stderr if to_stderr else sys.stdout
    table = Table(box=None, pad_edge=False, header_style="bold")
    for number, title in enumerate(head):
        is_number = number > 0 and any(re.fullmatch(NUMBER, row[number]) for row in rows)
        table.add_column(Text(plain(title)), justify="right" if is_number else "left")
    for row in rows:
        table.add_row(*(Text(plain(cell)) for cell in row))
    # a narrow terminal breaks lines: in a narrow table, addresses and prices would lose digits
    Console(file=stream, width=1000).print(table)
