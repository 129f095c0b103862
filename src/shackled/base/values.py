"""What values have in common: checked fields, arrays that are compared and stay read-only, and counts in words."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, ClassVar, Self

import numpy as np
from attrs import Attribute

from .synonyms import Hinted


class Value(Hinted):
    """A base of frozen attrs classes with arrays.

    Unpickling calls the constructor, because NumPy does not restore that an array is read-only.
    """

    __slots__ = ()
    __attrs_attrs__: ClassVar[tuple[Attribute[Any], ...]]

    def __reduce__(self) -> tuple[Callable[..., Any], tuple[type, dict[str, Any]]]:
        values = {each.name: getattr(self, each.name) for each in self.__attrs_attrs__}
        return _rebuild, (type(self), values)

    def __copy__(self) -> Self:
        return self

    def __deepcopy__(self, _: dict[int, Any]) -> Self:
        return self


def _rebuild(kind: Callable[..., Any], values: dict[str, Any]) -> Any:
    return kind(**values)


def checked(name: str, *limits: object) -> dict[str, Any]:
    """Return the metadata of a field whose converter takes a name, for its messages, and limits."""
    return {"checked": (name, *limits)}


def with_names(_: type, fields: list[Attribute[Any]]) -> list[Attribute[Any]]:
    """Hand the names and limits of `checked` to the converters of the fields, and compare arrays by `array_key`.

    It is a `field_transformer` of attrs.
    """
    return [_named(field).evolve(eq_key=array_key) for field in fields]


def _named(field: Attribute[Any]) -> Attribute[Any]:
    convert: Callable[..., Any] = field.converter  # type: ignore[assignment]
    arguments = field.metadata.get("checked")
    return field if arguments is None else field.evolve(converter=lambda value: convert(value, *arguments))


def array_key(value: object) -> object:
    """Return what is compared and hashed in place of a value: arrays of the same numbers have the same key."""
    if not isinstance(value, np.ndarray):
        return value
    # + 0.0: -0.0 equals 0.0
    return value.shape, (value + 0.0 if value.dtype.kind == "f" else value).tobytes()


def listed(names: Sequence[str]) -> str:
    """Return names in words, such as "geth, reth and Erigon"."""
    *others, last = names
    return f"{', '.join(others)} and {last}" if others else last


def plural(count: int, one: str, many: str = "") -> str:
    """Return a count with its noun, such as "1 light" or "2,000 lights"."""
    return f"{count:,} {one if count == 1 else many or one + 's'}"
