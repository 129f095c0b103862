"""Notes: what of an input is left out or changed, one line each on stderr, or an error with --strict."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps
from inspect import Parameter, signature
from typing import Annotated, Any, Literal, cast

from ..errors import InputWarning
from ..untrusted import plain
from .option import option, with_options

#: What becomes of notes, as `warnings` calls it.
Action = Literal["always", "error", "ignore"]

_STRICT = option("--strict", "Stop with an error where a part of a file would be left out or changed.", None, "Files")


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


def with_strict(command: Callable[..., None]) -> Callable[..., None]:
    """Return the command with the option --strict."""
    given = signature(command, eval_str=True)
    strict = Parameter("strict", Parameter.KEYWORD_ONLY, default=False, annotation=Annotated[bool, _STRICT])

    @wraps(command)
    def whole(strict: bool, **values: Any) -> None:
        with noting("error" if strict else action()):
            command(**values)

    # typer reads both
    parameters = [*given.parameters.values(), strict]
    whole.__signature__ = given.replace(  # type: ignore[attr-defined]
        parameters=[each.replace(kind=Parameter.KEYWORD_ONLY) for each in parameters]
    )
    whole.__annotations__ = {each.name: each.annotation for each in parameters}
    return whole
