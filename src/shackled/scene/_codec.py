"""Calldata of scenes: the ABI encoding of contracts/src/scene/Scene.sol.

Every field of the structs is a word of 32 bytes; lengths and coefficients are Q32 fixed-point numbers, value * 2^32.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from attrs import evolve
from numpy.typing import ArrayLike

from ..artifacts import artifact
from ..checks import Color
from ..errors import InputError
from ._arithmetic import cosine
from ._files.table import about
from ._fit import fit
from ._light import Light
from ._object import Object
from ._packed import pack, pack_alpha, pack_texture
from ._records import (
    ALPHA_OF,
    ANTIALIAS,
    EMISSION_OF,
    FOG,
    GROUND,
    HEMISPHERE,
    LONG_KINDS,
    OPACITIES_OF,
    OPACITY_OF,
    RIM,
    SHADOW,
    SHADOWS_ALL,
    SHADOWS_BACK_FACES,
    SPOT,
    TEXTURE_OF,
    TONE,
    TONE_FILMIC,
    TONE_GAMMA,
)
from ._scene import Scene
from ._staging import are_closed

ONE = 1 << 32

PROJECTIONS = {"perspective": 0, "orthographic": 1}
LIGHTS = {"directional": 0, "point": 1, "spot": 1}
SHADINGS = {"unlit": 0, "flat": 1, "smooth": 2}
#: Bytes of a word.
WORD = 32
#: The unit of opacities.
OPACITY_STEP = 2.0**-24
#: The unit of exposures.
EXPOSURE_STEP = 2.0**-16

CULL_BACKFACES = 1
WIREFRAME = 2
TWO_SIDED = 4

#: The largest outer and inner radius of a ground, Q32; both are floats.
MAX_FADE, MAX_INNER_FADE = 1 << 58, (1 << 58) - 64


@dataclass(frozen=True)
class Rectangle:
    """A part of the canvas, in pixels from the top left corner."""

    x: int
    y: int
    width: int
    height: int


def encode(selector: bytes, scene: Scene, tile: Rectangle | None = None, *words: int) -> bytes:
    """Return the calldata of a function f(Scene), or f(Scene, Rectangle) if a tile is given, and words after it."""
    rectangle: list[int] = []
    if tile is not None:
        rectangle = [tile.x, tile.y, tile.width, tile.height]
        across = 0 <= tile.x < tile.x + tile.width <= scene.width
        if not (across and 0 <= tile.y < tile.y + tile.height <= scene.height):
            raise InputError(f"the tile {tile} does not lie on the canvas of {scene.width} x {scene.height} pixels")
    head = [*rectangle, *words]
    return selector + _words([32 * (1 + len(head)), *head]) + encode_scene(fit(scene))


def render_call(scene: Scene) -> bytes:
    """Return the data of the call `Renderer.render`."""
    return encode(artifact("Renderer").selectors["render"], scene)


def encode_scene(scene: Scene) -> bytes:
    """Return the struct Scene of a scene from `fit`."""
    camera = scene.camera
    head = _words(
        [
            scene.width,
            scene.height,
            *_q32(camera.eye),
            *_q32(camera.target),
            *_q32(camera.up),
            PROJECTIONS[camera.projection],
            *_q32([camera.half_height, camera.near or 0.0]),
            _rgb(scene.background.top),
            _rgb(scene.background.bottom),
            int(scene.invert),
            _rgb(scene.ambient_light),
        ]
    )
    lights = _words([len(scene.lights)]) + b"".join(map(_light, scene.lights))
    objects = _array_of_dynamic([encode_object(o) for o in scene.objects])
    more = extensions(scene)
    first = len(head) + 3 * 32
    offsets = [first, first + len(lights), first + len(lights) + len(objects)]
    return head + _words([*offsets]) + lights + objects + _bytes(more)


def extensions(scene: Scene) -> bytes:
    """Return the fields that the structs do not have: records in ascending order of kind and index."""
    records = []
    for index, light in enumerate(scene.lights):
        if light.direction is not None:
            cosines = [cosine(angle) for angle in (light.inner_angle, light.outer_angle)]
            numbers = [*_q32(light.direction), *_q32(cosines)]
            records.append(_record(SPOT, index, b"".join(number.to_bytes(8, "big", signed=True) for number in numbers)))
    for index, thing in enumerate(scene.objects):
        opacity = round(thing.opacity / OPACITY_STEP)
        if opacity < 1 / OPACITY_STEP:
            records.append(_record(OPACITY_OF, index, opacity.to_bytes(4, "big")))
    if scene.antialias:
        records.append(_record(ANTIALIAS, 0, b""))
    if scene.hemisphere is not None:
        records.append(_record(HEMISPHERE, 0, bytes([*scene.hemisphere.sky, *scene.hemisphere.ground])))
    if scene.rim is not None:
        records.append(_record(RIM, 0, bytes([*scene.rim.color, scene.rim.power])))
    if scene.fog is not None:
        near, far = _q32([scene.fog.near, scene.fog.far])
        distances = near.to_bytes(8, "big") + max(far, near + 1).to_bytes(8, "big")
        records.append(_record(FOG, 0, bytes(scene.fog.color) + distances))
    if scene.tone is not None:
        exposure = max(round(scene.tone.exposure / EXPOSURE_STEP), 1)
        flags = TONE_FILMIC * scene.tone.filmic + TONE_GAMMA * scene.tone.gamma
        records.append(_record(TONE, 0, exposure.to_bytes(4, "big") + bytes([flags])))
    for index, thing in enumerate(scene.objects):
        if thing.material.texture is not None and thing.mesh.uvs is not None:
            with about(f"objects[{index}]"):
                records.append(_record(TEXTURE_OF, index, pack_texture(thing.material.texture, thing.mesh.uvs)))
    for index, thing in enumerate(scene.objects):
        if thing.mesh.opacities is not None:
            levels = thing.mesh.rgba[:, 3].tobytes()
            records.append(_record(OPACITIES_OF, index, levels + bytes(-len(levels) % WORD)))
    for index, light in enumerate(scene.lights):
        if light.shadow:
            records.append(_record(SHADOW, index, shadow_rule(scene).to_bytes(32, "big")))
    for index, thing in enumerate(scene.objects):
        if thing.fade is not None:
            inner, outer = _q32(thing.fade)
            inner, outer = min(inner, MAX_INNER_FADE), min(outer, MAX_FADE)
            radii = inner.to_bytes(8, "big") + max(outer, inner + 1).to_bytes(8, "big")
            records.append(_record(GROUND, index, radii.ljust(32, b"\0")))
    for index, thing in enumerate(scene.objects):
        if any(thing.material.emission):
            records.append(_record(EMISSION_OF, index, _words([_rgb(thing.material.emission)])))
    for index, thing in enumerate(scene.objects):
        if thing.material.texture is not None and thing.material.texture.alpha is not None:
            records.append(_record(ALPHA_OF, index, pack_alpha(thing.material.texture)))
    return b"".join(records)


def shadow_rule(scene: Scene) -> int:
    """Return which faces of culled objects cast shadows: all, or those turned away from the light, if all of them
    together are closed.
    """
    casters = [_as_sent(o) for o in scene.objects if o.cull and not o.wireframe and o.is_opaque and o.fade is None]
    return SHADOWS_BACK_FACES if are_closed(casters) else SHADOWS_ALL


def _as_sent(o: Object) -> Object:
    """Return the object with the place that its Q32 numbers give it, where a decoded one is."""
    position, rotation, scale = (np.rint(np.multiply(each, ONE)) / ONE for each in (o.position, o.rotation, o.scale))
    return evolve(o, position=position, rotation=rotation, scale=scale)


def _record(kind: int, index: int, content: bytes) -> bytes:
    if index >> 16:
        raise InputError(
            "objects with an opacity, a texture, a fade or an emission must be among the first 65,536 of a scene, "
            f"not number {index:,}"
        )
    size = len(content) // WORD if kind >= LONG_KINDS else len(content)
    return bytes([kind]) + index.to_bytes(2, "big") + size.to_bytes(2, "big") + content


def _light(light: Light) -> bytes:
    return _words([LIGHTS[light.kind], *_q32(light.vector), _rgb(light.color)])


def encode_object(o: Object) -> bytes:
    """Return the struct Object of an object from `fit`."""
    material = o.material
    fields = [
        *_q32(o.position),
        *_q32(o.rotation),
        *_q32([o.scale]),
        SHADINGS[material.shading],
        *_q32([material.ambient, material.diffuse, material.specular]),
        material.shininess,
        CULL_BACKFACES * o.cull + WIREFRAME * o.wireframe + TWO_SIDED * o.two_sided,
    ]
    mesh = pack(o.mesh, smooth=material.shading == "smooth")
    return _words([32 * (1 + len(fields)), *fields]) + _bytes(mesh)


def _bytes(content: bytes) -> bytes:
    return _words([len(content)]) + content + bytes(-len(content) % 32)


def _array_of_dynamic(items: list[bytes]) -> bytes:
    offsets, end = [], 32 * len(items)
    for item in items:
        offsets.append(end)
        end += len(item)
    return _words([len(items), *offsets]) + b"".join(items)


def _q32(values: ArrayLike) -> list[int]:
    """Return numbers as multiples of 2^-32, rounded to nearest, ties to even."""
    return [round(value * ONE) for value in np.asarray(values, dtype=np.float64).tolist()]


def _rgb(color: Color) -> int:
    red, green, blue = color
    return red << 16 | green << 8 | blue


def _words(values: Iterable[int]) -> bytes:
    return b"".join((value % (1 << 256)).to_bytes(32, "big") for value in values)
