"""Scenes as scene files in JSON."""

from __future__ import annotations

import base64
import json
from collections.abc import Mapping
from typing import Any

from attrs import asdict

from .._camera import Camera
from .._effects import Background, Fog, Hemisphere, Rim
from .._ground import Ground
from .._light import Light
from .._object import Object
from .._settings import ScenePart, settings_of
from .._table import keys_of
from .._texture import Texture


def encode_document(document: Mapping[str, Any]) -> bytes:
    """Return the bytes of a scene file in JSON; the document has the parts of a scene as they are in Python."""
    return f"{json.dumps(document, default=_plain)}\n".encode("ascii")


def _is_given(_: object, value: object) -> bool:
    return value is not None


def fields_of(value: object, part: ScenePart) -> dict[str, Any]:
    """Return the settings that are fields of a value and not None; an object has no colour of its own."""
    fields = {each.name: getattr(value, each.name, None) for each in settings_of(part)}
    return {name: found for name, found in fields.items() if found is not None}


def _texture_keys(texture: Texture | None) -> dict[str, Any]:
    if texture is None:
        return {}
    names = ("width", "height", "filter", "wrap", "cutoff")[: 4 if texture.alpha is None else 5]
    levels = {"pixels": texture.pixels, "alpha": texture.alpha}
    packed = {name: base64.b64encode(each.tobytes()).decode() for name, each in levels.items() if each is not None}
    return {"texture": {**{name: getattr(texture, name) for name in names}, **packed}}


def _plain(value: Any) -> Any:
    """Return what JSON has for an array, or for a part of a scene."""
    if isinstance(value, Background | Camera | Hemisphere | Rim | Fog | Ground):
        return asdict(value, filter=_is_given)
    if isinstance(value, Object):
        return {
            "mesh": {name: part for name in keys_of("Mesh") if (part := getattr(value.mesh, name)) is not None},
            "position": value.position,
            "rotation": {"quaternion": value.rotation},
            "scale": value.scale,
            "material": {**fields_of(value.material, "material"), **_texture_keys(value.material.texture)},
            **fields_of(value, "object"),
            **({} if value.fade is None else {"fade": value.fade}),
        }
    if not isinstance(value, Light):
        return value.tolist()
    place = "direction" if value.kind == "directional" else "position"
    keys = {"kind": value.kind, place: value.vector, "color": value.color}
    if value.kind == "spot":
        keys |= {name: getattr(value, name) for name in ("direction", "inner_angle", "outer_angle")}
    return keys | ({"shadow": True} if value.shadow else {})
