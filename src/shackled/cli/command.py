"""Commands of click that are made of functions, and groups that load a command when it is called."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields, is_dataclass
from importlib import import_module
from inspect import Parameter, signature
from pathlib import Path
from types import NoneType
from typing import Annotated, Any, Protocol, get_args, get_origin, get_type_hints

import click

from .option import Argument, Declared, Option
from .output import STRICT


class Group(Protocol):
    """Several options that a command takes as one parameter, whose annotation has this as its second part."""

    def parameters(self) -> list[Parameter]:
        """Return the options as parameters of a function."""

    def take(self, values: dict[str, Any]) -> Any:
        """Remove the values of the options from those of a command, and return what the command takes."""


class Fields:
    """The fields of a dataclass as a group of options."""

    def __init__(self, kind: Any) -> None:
        """Take the dataclass."""
        self._kind = kind

    def parameters(self) -> list[Parameter]:
        """Return a parameter for each field."""
        hints = get_type_hints(self._kind, include_extras=True)
        return [
            Parameter(each.name, Parameter.KEYWORD_ONLY, default=each.default, annotation=hints[each.name])
            for each in fields(self._kind)
        ]

    def take(self, values: dict[str, Any]) -> Any:
        """Return an instance of the dataclass."""
        return self._kind(**{each.name: values.pop(each.name) for each in fields(self._kind)})


#: Inputs, and the options that are needed most, which help lists first; those of a look without the title of a group.
COMMON = (
    *("input", "inputs", "output"),
    *("size", "background", "color", "azimuth", "elevation", "max_triangles", "turntable"),
)


class Command(click.Command):
    """A command whose help also lists its arguments, and its options by title."""

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
    """Return the command of a function: of each parameter an option or argument, of a group several.

    more: other parameters of click.
    """
    groups: dict[str, Group] = {}
    found: list[Parameter] = []
    for each in signature(function, eval_str=True).parameters.values():
        group = Fields(each.annotation) if is_dataclass(each.annotation) else _second(each.annotation)
        if isinstance(group, Declared):
            found.append(each)
        else:
            groups[each.name] = group
            found += group.parameters()
    if any(each.name in COMMON[3:] for each in found):
        found.sort(key=lambda each: COMMON.index(each.name) if each.name in COMMON else len(COMMON))

    def callback(**values: Any) -> Any:
        # several values, of which there may be none, are a tuple
        given = {key: (list(value) or None) if isinstance(value, tuple) else value for key, value in values.items()}
        for key, group in groups.items():
            given[key] = group.take(given)
        try:
            return function(**given)
        except KeyboardInterrupt:
            # for which click would print an empty line
            raise click.Abort from None

    return Command(
        name,
        callback=callback,
        params=[*map(_parameter, found), *more],
        help=inspect.getdoc(function),
        context_settings=CONTEXT,
    )


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


def _second(annotation: Any) -> Any:
    """Return what declares an annotated parameter."""
    assert get_origin(annotation) is Annotated, annotation
    return get_args(annotation)[1]


def _parameter(each: Parameter) -> click.Parameter:
    """Return the option or argument of a parameter."""
    kind, declared = get_args(each.annotation)[:2]
    if NoneType in get_args(kind):
        kind = get_args(kind)[0]
    is_many = get_origin(kind) is list
    kind = get_args(kind)[0] if is_many else kind
    is_required = each.default is Parameter.empty
    more: dict[str, Any] = {"type": _type(kind, declared), "required": is_required}
    if not is_required and not is_many:
        more["default"] = each.default
    if not declared.names:
        metavar = (declared.metavar if is_required else f"[{declared.metavar}]") + "..." * is_many
        return Argument(each.name, declared.text, nargs=-1 if is_many else 1, metavar=metavar, **more)
    more |= {"is_flag": kind is bool, "show_default": kind is not bool, "multiple": is_many}
    more |= {"help": declared.text, "metavar": declared.metavar, "envvar": declared.envvar}
    return Option([each.name, *declared.names], declared.panel, **more)


def _type(kind: Any, declared: Declared) -> Any:
    if kind is bool:
        return None  # a flag with a type is never set by click 8.2.0
    if kind is Path:
        return click.Path(path_type=Path)
    if declared.min is None and declared.max is None:
        return kind
    return (click.IntRange if kind is int else click.FloatRange)(declared.min, declared.max)
