"""The fields of scenes are described in one table, contracts/scene_fields.toml."""

from __future__ import annotations

from typing import Any

import attrs
import pytest

import shackled
from shackled.errors import InputError
from shackled.scene import Hemisphere
from shackled.scene._fields import FIELDS

#: Names of fields of Python, where they are others: a light has one vector for its direction or its position, a texture
#: has its size from its pixels.
OTHERS = {"Light": {"position": "vector"}, "Texture": {"width": "pixels", "height": "pixels"}}
CLASSES = {name: getattr(shackled, name, Hemisphere) for name in FIELDS}
#: What classes need besides.
NEEDED: dict[str, dict[str, Any]] = {
    "Object": {"mesh": shackled.Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])},
    "Light": {"kind": "spot", "position": (0, 0, 0), "direction": (0, 0, 1)},
    "Rim": {"color": "white"},
    "Fog": {"color": "white", "near": 1, "far": 2},
    "Ground": {"color": "white"},
    "Scene": {"objects": []},
    "Texture": {"pixels": [[(0, 0, 0)]]},
}


@pytest.mark.parametrize("name", FIELDS)
def test_classes_have_the_fields_of_the_table(name: str) -> None:
    keys = {OTHERS.get(name, {}).get(key, key) for key, field in FIELDS[name].items() if field.only != "file"}
    assert keys == {field.name for field in attrs.fields(CLASSES[name])}


@pytest.mark.parametrize(
    ("name", "key"),
    [
        (name, key)
        for name, fields in FIELDS.items()
        for key, field in fields.items()
        if field.limits and field.only != "file" and key not in OTHERS.get(name, {})
    ],
)
def test_values_beyond_the_range_are_refused(name: str, key: str) -> None:
    low, *high = FIELDS[name][key].limits
    for value in (low - 1, *(limit + 1 for limit in high)):
        with pytest.raises(InputError, match=str(low)):
            CLASSES[name](**{**NEEDED.get(name, {}), key: value})
