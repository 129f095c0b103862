"""Output of commands: results on stdout, notes on stderr, both safe for a terminal.

A note tells what of an input is left out or changed; with --strict it is an error.
"""

from __future__ import annotations

import json
import re
import sys
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any, Literal, cast

import click

from ..base.untrusted import plain
from ..errors import InputWarning
from .option import Option, with_options

#: A number or a size, such as 1,024 x 768 or 1.2e-07, and not an address or a sentence.
NUMBER = r"\d(?!x)[\d,. xe%-]*"


def print_line(text: str) -> None:
    """Print a line of the result."""
    print(plain(text), flush=True)


def print_note(text: str) -> None:
    """Print a line that is not part of the result."""
    print(plain(text), file=sys.stderr, flush=True)


def print_json(document: Any) -> None:
    """Print a JSON document in one line, in ASCII, which every terminal and encoding can show."""
    print(json.dumps(document))


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


#: What becomes of notes, as `warnings` calls it.
Action = Literal["always", "error", "ignore"]


@contextmanager
def noting(action: Action) -> Iterator[None]:
    """Print each note once, make it an error, or ignore it. Other warnings are shown as before."""
    with warnings.catch_warnings():
        warnings.simplefilter(action, InputWarning)
        show, printed = warnings.showwarning, set[str]()

        def showwarning(message: Warning | str, category: type[Warning], *place: Any, **more: Any) -> None:
            if not issubclass(category, InputWarning):
                show(message, category, *place, **more)
            elif str(message) not in printed:
                printed.add(str(message))
                print(f"shackled: note: {plain(with_options(str(message)))}", file=sys.stderr)

        warnings.showwarning = showwarning
        yield


def action() -> Action:
    """Return what becomes of notes now."""
    found = next((each[0] for each in warnings.filters if each[2] is InputWarning), "always")
    return cast(Action, found)


def _stop(context: click.Context, _: click.Parameter, value: bool) -> None:
    if value:
        context.with_resource(noting("error"))


#: The option of commands that read files.
STRICT = Option(
    ["--strict"],
    "Files",
    is_flag=True,
    expose_value=False,
    callback=_stop,
    help="Stop with an error if part of a file would be left out or changed.",
)
