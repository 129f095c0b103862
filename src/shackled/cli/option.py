"""Declarations of options and arguments of commands, and their names in messages."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import click
from click.core import ParameterSource

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

#: Other words for commands and options than `shackled.words` has for keywords, and what is meant.
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


@dataclass(frozen=True)
class Declared:
    """An option, or without names an argument: its help, the word for its value there, and the title it is under."""

    names: tuple[str, ...]
    text: str
    metavar: str | None
    panel: str | None = None
    envvar: str | None = None
    min: Any = None
    max: Any = None


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


def option(name: str, text: str, kind: str | None = None, panel: str | None = None, **more: Any) -> Any:
    """Declare an option: its names, its help, the word for its value there, and the title under which it is listed."""
    return Declared(tuple(name.split()), text, kind, panel, **more)


def argument(text: str, metavar: str, **more: Any) -> Any:
    """Declare an argument: its help, and the word for it in the usage."""
    return Declared((), text, metavar, **more)


def is_from_environment(name: str) -> bool:
    """Return whether a parameter of the running command has the value of its environment variable."""
    return click.get_current_context().get_parameter_source(name) is ParameterSource.ENVIRONMENT


def option_names() -> dict[str, str]:
    """Return the options of parameters, those of a look too."""
    from ..scene import SETTINGS

    return {setting.name: setting.option.partition("/")[0] for setting in SETTINGS} | OPTIONS


def with_options(message: str) -> str:
    """Return a message of the library in one line, with options in place of the parameters that it names."""
    if "`" in message:
        names = option_names()
        message = re.sub(r"`(\w+)`", lambda match: names.get(match[1], match[0]), message)
    return " ".join(message.split())
