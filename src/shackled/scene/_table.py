"""Fields of attrs classes that are described in contracts/scene_fields.toml."""

from __future__ import annotations

from typing import Any, Final

from attrs import Attribute

from ..base.values import checked, with_names
from ._fields import FIELDS

#: In place of a default: that of the table.
USUAL: Final[Any] = object()


def from_table(kind: type, fields: list[Attribute[Any]]) -> list[Attribute[Any]]:
    """Give fields what the table says of those of their class: defaults, and names and limits for their converters.

    It is a `field_transformer` of attrs, as `with_names` is, which it includes.
    """
    return with_names(kind, [_described(field, kind.__name__) for field in fields])


def _described(field: Attribute[Any], of: str) -> Attribute[Any]:
    if (own := FIELDS[of].get(field.name)) is None:
        return field
    if field.default is USUAL:
        field = field.evolve(default=own.default)
    # one without a kind is checked by its own converter
    if not own.kind or field.metadata:
        return field
    return field.evolve(metadata=checked(own.called, *own.limits, *filter(None, [own.choices])))


def keys_of(of: str) -> tuple[str, ...]:
    """Return the keys that a class has in scene files."""
    return tuple(name for name, field in FIELDS[of].items() if field.only != "class")
