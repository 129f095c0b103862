"""Scenes as scene files in JSON."""

from __future__ import annotations

import base64
import json
from typing import TYPE_CHECKING, Any

from attrs import asdict

from .._effects import Background, Fog, Hemisphere, Rim
from .._ground import Ground
from .._light import Light
from .._settings import Part, settings_of
from .._table import keys_of
from .._texture import Texture

if TYPE_CHECKING:
    from .._scene import Scene


def encode_scene_file(scene: Scene) -> bytes:
    """Return the bytes of a scene file in JSON, such that loading it gives the same scene."""
    document = {
        "size": [scene.width, scene.height],
        **_fields(scene, "scene"),
        **({} if scene.tone is None else {"tone": _fields(scene.tone, "tone")}),
        "camera": asdict(scene.camera, filter=_is_given),
        "objects": [
            {
                "mesh": {name: value for name in keys_of("Mesh") if (value := getattr(thing.mesh, name)) is not None},
                "position": thing.position,
                "rotation": {"quaternion": thing.rotation},
                "scale": thing.scale,
                "material": {**_fields(thing.material, "material"), **_texture_keys(thing.material.texture)},
                **_fields(thing, "object"),
                **({} if thing.fade is None else {"fade": list(thing.fade)}),
            }
            for thing in scene.objects
        ],
    }
    return f"{json.dumps(document, default=_plain)}\n".encode("ascii")


def _is_given(_: object, value: object) -> bool:
    return value is not None


def _fields(value: object, part: Part) -> dict[str, Any]:
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
    """Return what JSON has for an array, or for a background, a light or an effect."""
    if isinstance(value, Background | Hemisphere | Rim | Fog | Ground):
        return asdict(value, filter=_is_given)
    if not isinstance(value, Light):
        return value.tolist()
    place = "direction" if value.kind == "directional" else "position"
    keys = {"kind": value.kind, place: value.vector, "color": value.color}
    if value.kind == "spot":
        keys |= {name: getattr(value, name) for name in ("direction", "inner_angle", "outer_angle")}
    return keys | ({"shadow": True} if value.shadow else {})
