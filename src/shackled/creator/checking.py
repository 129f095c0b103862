"""Whether the fields of a state lie in the ranges of their controls, with one clear message where one does not."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

from ..checks import choice, color
from ..errors import InputError
from .controls import Control, control

#: Fields of three numbers.
VECTORS = ("position", "rotation", "target")

#: Numbers keep so many digits, which is more than a picture shows, and keeps links short.
DIGITS = 6


def tidy(value: float) -> float:
    """A number of 6 digits, without the noise of arithmetic about 0."""
    return 0.0 if abs(value) < 1e-9 else float(f"{value:.{DIGITS}g}")


def check_fields(part: Any, place: str, name: str, optional: bool = False) -> None:
    """Checks all fields of a frozen dataclass, and brings them to their types.

    place: of its controls. name: for people. optional: whether None passes.
    """
    for field in fields(part):
        label = f"the {field.name} of the {name}"
        if field.name in VECTORS:
            values = getattr(part, field.name)
            if not isinstance(values, list | tuple) or len(values) != 3:
                raise InputError(f"{label} must be 3 numbers, not {values!r:.60}")
            axes = [control(f"{place}.{field.name}.{axis}") for axis in "xyz"]
            checked = tuple(_number(value, label, axis) for value, axis in zip(values, axes, strict=True))
            object.__setattr__(part, field.name, checked)
        else:
            check_field(part, field.name, control(f"{place}.{field.name}"), label, optional)


def check_field(part: Any, name: str, of: Control, label: str, optional: bool) -> None:
    """Checks one field by its control, and brings it to its type. InputError if it is wrong."""
    value = getattr(part, name)
    if value is None and optional:
        return
    if of.kind == "choice":
        choices = tuple(each for each, _ in of.choices)
        if not isinstance(value, str) or value not in choices:
            raise InputError(f"{label} must be one of {', '.join(choices)}, not {value!r:.60}")
        value = choice(value, label, choices)
    elif of.kind == "color":
        if not isinstance(value, str) or len(value) != 7:
            raise InputError(f"{label} must be a colour #rrggbb, not {value!r:.60}")
        value = "#{:02x}{:02x}{:02x}".format(*color(value, label))
    else:
        value = _number(value, label, of)
    object.__setattr__(part, name, value)


def _number(value: object, label: str, of: Control) -> float:
    right = f"a {'whole ' if of.whole else ''}number from {of.low:g} to {of.high:g}"
    if not isinstance(value, int | float) or isinstance(value, bool) or not of.low <= value <= of.high:
        raise InputError(f"{label} must be {right}, not {value!r:.60}")
    if not of.whole:
        return float(value) + 0.0  # no -0.0
    if value % 1:
        raise InputError(f"{label} must be {right}, not {value!r:.60}")
    return int(value)
