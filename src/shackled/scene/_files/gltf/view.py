"""The cameras and lights of a glTF document."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from attrs import evolve
from numpy.typing import ArrayLike

from ....base.checks import Floats
from ....base.values import plural
from ....errors import InputError, warn
from ..._arithmetic import units
from ..._camera import Camera
from ..._constants import MAX_LIGHTS
from ..._fields import LIGHT_KINDS
from ..._light import Light
from ..._texture import to_srgb
from ..table import about
from .document import Document
from .nodes import Node
from .read import nodes_of

_LIGHTS = "KHR_lights_punctual"


@np.errstate(all="ignore")
def read_view(
    path: Path, middle: ArrayLike, use_camera: str | int, animation: str | int | None = None, time: float | None = None
) -> tuple[Camera, list[Light]]:
    """Return a camera of a file, by its name or number, and the lights, the brightest of which is white."""
    with about(str(path)):
        gltf = Document(path)
        nodes = nodes_of(gltf, animation, time)
        lights = _lights(gltf, nodes, np.asarray(middle))
        if len(lights) > MAX_LIGHTS:
            warn(f"{path}: left out: {plural(len(lights) - MAX_LIGHTS, 'light')}, the weakest: {MAX_LIGHTS} are drawn")
        return _camera(gltf, nodes, use_camera), lights[:MAX_LIGHTS]


def _camera(gltf: Document, nodes: Mapping[int, Node], name: str | int) -> Camera:
    keys = gltf.named(name, "cameras", "camera")
    with_camera = (node for node in nodes.values() if "camera" in node.keys)
    node = next((n for n in with_camera if gltf.item(n.keys, "camera", "cameras").where == keys.where), None)
    if node is None:
        raise InputError(f"no node has {keys.where}")
    kind = keys.choice("type", ("perspective", "orthographic"))
    lens = keys.table(kind)
    half_height = math.tan(lens.number("yfov") / 2) if kind == "perspective" else lens.number("ymag")
    eye, back = node.matrix[:3, 3], _back(node)
    with about(keys.where):
        return Camera(eye, eye - back, node.matrix[:3, 1], kind, half_height, lens.number("znear"))


def _lights(gltf: Document, nodes: Mapping[int, Node], middle: Floats) -> list[Light]:
    """Return the lights that are shown, the brightest first."""
    declared = gltf.keys.table("extensions").table(_LIGHTS).tables("lights")
    found: list[tuple[float, Floats, Light]] = []
    for node in nodes.values():
        keys = node.keys.table("extensions").table(_LIGHTS)
        if not node.is_shown or "light" not in keys:
            continue
        light = declared[keys.index("light", len(declared), "lights")]
        kind = light.choice("type", LIGHT_KINDS)
        place, back = node.matrix[:3, 3], _back(node)
        strength = light.number("intensity", 1)
        if kind != "directional":
            strength /= max(float(np.sum((place - middle) ** 2)), 1e-12)
        given: dict[str, Any] = {}
        if kind == "spot":
            cone = light.table("spot")
            inner, outer = cone.number("innerConeAngle", 0), cone.number("outerConeAngle", math.pi / 4)
            given = {"direction": -back, "inner_angle": math.degrees(inner), "outer_angle": math.degrees(outer)}
        with about(light.where):
            made = Light(kind, back if kind == "directional" else place, **given)
        found.append((strength, np.array(light.numbers("color", (1, 1, 1))), made))
    most = max((strength * color.max() for strength, color, _ in found), default=0)
    found = sorted((each for each in found if most > 0), key=lambda each: -each[0])
    return [evolve(light, color=to_srgb(strength * color / most).astype(int)) for strength, color, light in found]


def _back(node: Node) -> Floats:
    """Return the direction of z; as at rest for a node that is scaled to nothing, as hidden ones are."""
    back = units(node.matrix[:3, 2])
    return back if back.any() else np.array([0.0, 0.0, 1.0])
