"""What the values of a scene have in common: checked fields, and arrays that are compared number by number."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from attrs import Attribute


def checked(name: str, *limits: object) -> dict[str, Any]:
    """Return the metadata of a field whose converter is called with this name, for its messages, and the limits."""
    return {"checked": (name, *limits)}


def with_names(_: type, fields: list[Attribute[Any]]) -> list[Attribute[Any]]:
    """Hand the names and limits of `checked` to the converters of fields; a transformer of fields for attrs."""
    return [_named(field) if "checked" in field.metadata else field for field in fields]


def _named(field: Attribute[Any]) -> Attribute[Any]:
    convert: Callable[..., Any] = field.converter  # type: ignore[assignment]
    arguments = field.metadata["checked"]
    return field.evolve(converter=lambda value: convert(value, *arguments))


def array_key(array: np.ndarray | None) -> object:
    """Return what is compared and hashed in place of an array: arrays of the same numbers have the same key."""
    if array is None:
        return None
    # + 0.0: -0.0 equals 0.0
    return array.shape, (array + 0.0 if array.dtype.kind == "f" else array).tobytes()


def plural(count: int, one: str, many: str = "") -> str:
    """Return a count with its noun, such as "1 light" or "2,000 lights"."""
    return f"{count:,} {one if count == 1 else many or one + 's'}"
