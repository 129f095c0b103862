"""Declarations of options and arguments of commands, and their names in messages."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import Field, field
from pathlib import Path
from typing import Any, get_args

import click
from click.core import ParameterSource

from ..errors import InputError

#: The options of parameters that messages of the library name in backticks.
OPTIONS = {
    **{
        name: f"--{name.replace('_', '-')}"
        for name in (
            *("address", "any_chain", "arg", "cluster", "contract", "contracts", "evm", "fit", "frames", "gas_limit"),
            *("jobs", "licence", "max_fee", "max_triangles", "one_call", "port", "salt", "setup", "size", "tile"),
            *("transparent", "verify"),
        )
    },
    "on": "--evm",
    "timeout": "--rpc-timeout",
    "url": "--rpc",
    "urls": "--rpc",
}

#: Other words for commands and options than `shackled.base.synonyms` has for keywords, and what is meant.
MEANT = {
    "mint": "store, which mints no token; `shackled token mint` does",
    "turntable": "render INPUT --turntable FRAMES",
    "animate": "render INPUT --frames N",
    "convert": "export",
    "serve": "creator",
    "gui": "creator",
    "--chain": "--evm",
    "--fps": "--duration",
    "--height": "--size",
    "--license": "--licence",
    "--network": "--rpc",
    "--out": "--output",
    "--processes": "--jobs",
    "--res": "--size",
    "--threads": "--jobs",
    "--width": "--size",
    "--workers": "--jobs",
}


class Option(click.Option):
    """An option of a command. panel: the title under which it is listed."""

    def __init__(self, names: Sequence[str], panel: str | None = None, **more: Any) -> None:
        """Take the names, the title, and what click takes."""
        super().__init__(names, **more)
        self.panel = panel


class Argument(click.Argument):
    """An argument of a command, with its help."""

    def __init__(self, name: str, text: str, **more: Any) -> None:
        """Take the name, the help, and what click takes."""
        super().__init__([name], **more)
        self.text = text


def option(names: str, text: str, metavar: str | None = None, panel: str | None = None, **more: Any) -> Any:
    """Declare an option as the default of a parameter of a command, or of a field of a dataclass of options.

    text: its help. metavar: the word for its value there. panel: the title under which it is listed. more: what click
    takes; `default`; `min` and `max`; and `parse`, a function of the text and of the name of the option that returns
    the value. An option is required if its type has no None and it has no default.
    """
    told = {"names": names.split(), "text": text, "metavar": metavar, "panel": panel}
    return field(default=more.pop("default", None), metadata=told | more)


def argument(text: str, metavar: str, **more: Any) -> Any:
    """Declare an argument, as `option` does."""
    return option("", text, metavar, **more)


def parameter(name: str, kind: Any, declared: Field[Any]) -> click.Parameter:
    """Return the option or argument that is declared for a parameter of this type."""
    more: dict[str, Any] = dict(declared.metadata)
    names, text, panel, metavar = (more.pop(key) for key in ("names", "text", "panel", "metavar"))
    kind, *rest = get_args(kind) or (kind,)
    is_many, is_flag = rest == [...], kind is bool
    default = False if is_flag and not rest and declared.default is None else declared.default
    more.setdefault("required", default is None and not rest)
    if not more["required"] and not is_many:
        more["default"] = default
    limits = {key: more.pop(key) for key in ("min", "max") if key in more}
    if (parse := more.pop("parse", None)) is not None:
        kind, called = more.get("type", str), names[-1] if names else f"the {metavar.lower()}"
        more["callback"] = lambda _, __, value: value if value in (None, ()) else parse(value, called)
    elif limits:
        kind = (click.IntRange if kind is int else click.FloatRange)(**limits)
    # a flag with a type is never set by click 8.2.0
    more["type"] = None if is_flag else click.Path(path_type=Path) if kind is Path else kind
    if names:
        more |= {"is_flag": is_flag, "show_default": not is_flag, "multiple": is_many, "metavar": metavar}
        return Option([name, *names], panel, help=text, **more)
    more["metavar"] = (metavar if more["required"] else f"[{metavar}]") + "..." * is_many
    return Argument(name, text, nargs=-1 if is_many else 1, **more)


def exclude(name: str, value: object, others: Mapping[str, object]) -> None:
    """Raise InputError if an option was given, and another one that it excludes."""
    for other, given in others.items():
        if _is_given(value) and _is_given(given):
            raise InputError(f"{name} and {other} exclude each other: give one of them")


def need(needed: str, is_there: object, given: Mapping[str, object]) -> None:
    """Raise InputError if one of these options was given without the one that it needs."""
    for name, value in given.items():
        if _is_given(value) and not is_there:
            raise InputError(f"{name} needs {needed}")


def _is_given(value: object) -> bool:
    return value is not None and value is not False and value != ()


def is_from_environment(name: str) -> bool:
    """Return whether a parameter of the running command has the value of its environment variable."""
    return click.get_current_context().get_parameter_source(name) is ParameterSource.ENVIRONMENT


def option_names() -> dict[str, str]:
    """Return the options of parameters, those of a look too."""
    from ..scene._settings import SETTINGS

    return {setting.name: setting.option.partition("/")[0] for setting in SETTINGS} | OPTIONS


def with_options(message: str) -> str:
    """Return a message of the library in one line, with options in place of the parameters that it names."""
    if "`" in message:
        names = option_names()

        def named(match: re.Match[str]) -> str:
            option, value = names.get(match[1]), match[2]
            if option is None or value is None:
                return option or match[0]
            return option.replace("--", "--no-", 1) if value == "False" else f"{option} {value}"

        message = re.sub(r"`(\w+)(?:=([^`]+))?`", named, message)
    return " ".join(message.split())
