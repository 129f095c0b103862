"""Notes: what of an input is left out or changed, one line each on stderr, or an error with --strict."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, Literal, cast

import click

from ..errors import InputWarning
from ..untrusted import plain
from .option import Option, with_options

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
    help="Stop with an error where a part of a file would be left out or changed.",
)
