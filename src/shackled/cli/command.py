"""Commands of click that are made of functions, and groups that load a command when it is called."""

from __future__ import annotations

import inspect
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import Field, fields, is_dataclass
from importlib import import_module
from inspect import signature
from typing import Any, get_type_hints

import click

from .option import Argument, parameter
from .output import STRICT


class Command(click.Command):
    """A command whose help also lists its arguments, and its options by title."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Read the arguments. A file whose name begins with a dash, as a shell gives it for *, is not an option."""
        names = {name for each in self.params for name in (*each.opts, *each.secondary_opts)}
        end = args.index("--") if "--" in args else len(args)
        for place, each in enumerate(args[:end]):
            if each.startswith("-") and each not in ("-", *names) and os.path.isfile(each):
                args[place] = os.path.join(os.curdir, each)
        return super().parse_args(ctx, args)

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the arguments and options."""
        panels: dict[str, list[tuple[str, str]]] = {}
        for each in self.get_params(ctx):
            if isinstance(each, Argument):
                panels.setdefault("Arguments", []).append((each.make_metavar(ctx), each.text))
            elif (row := each.get_help_record(ctx)) is not None:
                panels.setdefault(getattr(each, "panel", None) or "Options", []).append(row)
        for title, rows in panels.items():
            with formatter.section(title):
                formatter.write_dl(rows)


def command(function: Callable[..., Any], name: str, more: Sequence[click.Parameter] = ()) -> Command:
    """Return the command of a function: of each parameter an option or argument, of a dataclass those of its fields.

    A function that takes any keyword has the options of a look. more: other parameters of click.
    """
    given = signature(function, eval_str=True).parameters.values()
    found = [parameter(each.name, each.annotation, each.default) for each in given if isinstance(each.default, Field)]
    groups: dict[str, Any] = {each.name: each.annotation for each in given if is_dataclass(each.annotation)}
    for kind in groups.values():
        hints = get_type_hints(kind)
        found += [parameter(each.name, hints[each.name], each) for each in fields(kind)]
    has_look = any(each.kind is each.VAR_KEYWORD for each in given)
    if has_look:
        from .look_options import take_look, with_look

        found = with_look(found)

    def callback(**values: Any) -> Any:
        look = take_look(values) if has_look else {}
        for key, kind in groups.items():
            values[key] = kind(**{each.name: values.pop(each.name) for each in fields(kind)})
        try:
            return function(**values, **look)
        except KeyboardInterrupt:
            # for which click would print an empty line
            raise click.Abort from None

    text = inspect.getdoc(function)
    return Command(name, callback=callback, params=[*found, *more], help=text, context_settings=CONTEXT)


#: How every command reads its arguments and prints its help.
CONTEXT = {"help_option_names": ["-h", "--help"], "max_content_width": 120}


class CommandGroup(click.Group):
    """Commands by name, each a function or group in a module that is loaded when the command is called."""

    #: Commands that have the option --strict.
    strict: frozenset[str] = frozenset()

    def __init__(self, name: str, places: Mapping[str, str | click.Command], text: str, **more: Any) -> None:
        """Take groups, or modules of this package and functions, as "token.sale:mint", by the names of the commands."""
        super().__init__(name, help=text, context_settings=CONTEXT, **more)
        self.places = places

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Read the arguments; none is a request for help."""
        return super().parse_args(ctx, args or ["--help"])

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the names of the commands."""
        return list(self.places)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Load a command; None if there is none of this name."""
        place = self.places.get(cmd_name)
        if place is None or isinstance(place, click.Command):
            return place
        module, _, name = place.partition(":")
        loaded = import_module(f".{module}", __package__)
        # "list" would hide that of Python
        function = getattr(loaded, f"{name.replace('-', '_')}{'_' * (name == 'list')}")
        return command(function, cmd_name, [STRICT] if cmd_name in self.strict else [])
