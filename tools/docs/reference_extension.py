"""Show constructors of attrs classes in the reference, and the fields of a docstring as a list."""

from __future__ import annotations

import inspect
import re
from importlib import import_module
from typing import Any

import griffe

FIELD = re.compile(r"^`?([a-z_]+(?:, [a-z_]+)*)`?: ")


class Reference(griffe.Extension):
    """Complete what griffe finds in the sources."""

    def on_class(self, *, cls: griffe.Class, **_: Any) -> None:
        """Add the constructor that attrs makes, which is in no source."""
        if "__init__" in cls.members or not any("frozen" in str(each.value) for each in cls.decorators):
            return
        found = getattr(import_module(cls.module.path), cls.name)
        parameters = [
            griffe.Parameter(
                name,
                # what is accepted, by the converter of the field
                annotation=each.annotation if isinstance(each.annotation, str) else None,
                kind=griffe.ParameterKind.positional_or_keyword,
                default=None if each.default is inspect.Parameter.empty else _shown(each.default),
            )
            for name, each in inspect.signature(found).parameters.items()
        ]
        cls.set_member("__init__", griffe.Function("__init__", parameters=griffe.Parameters(*parameters)))

    def on_instance(self, *, obj: griffe.Object, **_: Any) -> None:
        """Make a list of lines such as "size: in pixels"."""
        if obj.docstring is None:
            return
        lines: list[str] = []
        for line in obj.docstring.value.splitlines():
            listed = bool(lines) and lines[-1].startswith(("- ", "    "))
            if FIELD.match(line):
                lines += ["", FIELD.sub(lambda match: f"- `{match[1]}`: ", line)]
            elif listed and line and not (lines[-1].endswith(".") and line[0].isupper()):
                lines.append(f"    {line.strip()}")
            else:
                lines += ["", line] if listed else [line]
        obj.docstring.value = "\n".join(lines)


def _shown(value: object) -> str:
    text = repr(value)
    return text if len(text) < 30 and "NOTHING" not in text else "..."
