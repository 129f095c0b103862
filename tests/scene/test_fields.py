"""The fields of scenes are described in one table, contracts/scene_fields.toml."""

from __future__ import annotations

import tomllib
from typing import Any

import attrs
import pytest
from tools import scene_fields

import shackled
from shackled.errors import InputError
from shackled.scene import Hemisphere
from shackled.scene._fields import FIELDS

TABLE = tomllib.loads(scene_fields.TABLE.read_text("utf-8"))
#: Names of fields of Python, where they are others: a light has one vector for its direction or its position, a texture
#: has its size from its pixels.
OTHERS = {"Light": {"position": "vector"}, "Texture": {"width": "pixels", "height": "pixels"}}
CLASSES = {name: getattr(shackled, name, Hemisphere) for name in FIELDS}


@pytest.mark.parametrize("name", FIELDS)
def test_classes_have_the_fields_of_the_table(name: str) -> None:
    rows = {key: row for key, row in TABLE[name]["fields"].items() if row.get("only") != "file"}
    found = {field.name: field for field in attrs.fields(CLASSES[name])}
    assert {OTHERS.get(name, {}).get(key, key) for key in rows} == set(found)


#: Of classes that need some.
NEEDED: dict[str, dict[str, Any]] = {
    "Object": {"mesh": shackled.Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])},
    "Light": {"kind": "spot", "position": (0, 0, 0), "direction": (0, 0, 1)},
    "Rim": {"color": "white"},
    "Fog": {"color": "white", "near": 1, "far": 2},
    "Ground": {"color": "white"},
    "Scene": {"objects": []},
}


@pytest.mark.parametrize("name", FIELDS)
def test_values_beyond_the_range_are_refused(name: str) -> None:
    kind = CLASSES[name]
    for key, row in TABLE[name]["fields"].items():
        limits = row.get("range", [])
        if row.get("only") == "file" or name == "Texture" or not limits:
            continue
        for value in (limits[0] - 1, *(limit + 1 for limit in limits[1:])):
            given = {**NEEDED.get(name, {}), key: value}
            with pytest.raises(InputError, match=str(limits[0])):
                kind(**given)
