"""Calldata of scenes: the ABI encoding of contracts/src/scene/Scene.sol.

Every field of the structs is a word of 32 bytes; lengths and coefficients are Q32 fixed-point numbers, value * 2^32.
"""

from __future__ import annotations

import struct
from collections.abc import Iterable
from itertools import accumulate
from typing import NamedTuple

import numpy as np
from attrs import evolve
from numpy.typing import ArrayLike

from ..artifacts import artifact
from ..base.checks import Color
from ..errors import InputError
from . import _records as record
from ._arithmetic import cosine
from ._files.table import about
from ._in_range import in_range
from ._object import Object
from ._packed import pack, pack_alpha, pack_texture
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


class Rectangle(NamedTuple):
    """A part of the canvas, in pixels from the top left corner."""

    x: int
    y: int
    width: int
    height: int


def encode(selector: bytes, scene: Scene, tile: Rectangle | None = None, *words: int) -> bytes:
    """Return the calldata of a function f(Scene), or f(Scene, Rectangle) if a tile is given, and words after it."""
    if tile is not None:
        across = 0 <= tile.x < tile.x + tile.width <= scene.width
        if not (across and 0 <= tile.y < tile.y + tile.height <= scene.height):
            raise InputError(f"the tile {tile} does not lie on the canvas of {scene.width} x {scene.height} pixels")
    head = [*(tile or ()), *words]
    return selector + _words([32 * (1 + len(head)), *head]) + encode_scene(in_range(scene))


def render_call(scene: Scene) -> bytes:
    """Return the data of the call `Renderer.render`."""
    return encode(artifact("Renderer").selectors["render"], scene)


def encode_scene(scene: Scene) -> bytes:
    """Return the struct Scene of a scene from `in_range`."""
    camera = scene.camera
    head = _words(
        [
            scene.width,
            scene.height,
            *_q32([*camera.eye, *camera.target, *camera.up]),
            PROJECTIONS[camera.projection],
            *_q32([camera.half_height, camera.near or 0.0]),
            _rgb(scene.background.top),
            _rgb(scene.background.bottom),
            int(scene.invert),
            _rgb(scene.ambient_light),
        ]
    )
    words = [len(scene.lights)]
    for light in scene.lights:
        words += [LIGHTS[light.kind], *_q32(light.vector), _rgb(light.color)]
    lights = _words(words)
    structs = [encode_object(o) for o in scene.objects]
    *places, _ = accumulate(map(len, structs), initial=WORD * len(structs))
    objects = _words([len(structs), *places]) + b"".join(structs)
    offsets = accumulate([len(lights), len(objects)], initial=len(head) + 3 * WORD)
    return head + _words(offsets) + lights + objects + _bytes(extensions(scene))


def has_effects(scene: Scene) -> bool:
    """Return whether the EffectsEngine draws a scene: by a record behind that of antialiasing, as in Renderer.sol."""
    return any(kind > record.ANTIALIAS for kind, _ in _records(in_range(scene)))


def extensions(scene: Scene) -> bytes:
    """Return the fields that the structs do not have: records in ascending order of kind and index."""
    return b"".join(_record(kind, index, content) for (kind, index), content in sorted(_records(scene).items()))


def _records(scene: Scene) -> dict[tuple[int, int], bytes]:
    """Return the contents of the records by kind and index."""
    found: dict[tuple[int, int], bytes] = {}
    for index, light in enumerate(scene.lights):
        if light.direction is not None:
            cosines = cosine(light.inner_angle), cosine(light.outer_angle)
            found[record.SPOT, index] = struct.pack(">5q", *_q32([*light.direction, *cosines]))
        if light.shadow:
            found[record.SHADOW, index] = _words([shadow_rule(scene)])
    for index, thing in enumerate(scene.objects):
        mesh, texture, emission = thing.mesh, thing.material.texture, thing.material.emission
        if (opacity := round(thing.opacity / OPACITY_STEP)) < 1 / OPACITY_STEP:
            found[record.OPACITY_OF, index] = opacity.to_bytes(4, "big")
        if texture is not None and mesh.uvs is not None:
            with about(f"objects[{index}]"):
                found[record.TEXTURE_OF, index] = pack_texture(texture, mesh.uvs)
        if texture is not None and texture.alpha is not None:
            found[record.ALPHA_OF, index] = pack_alpha(texture)
        if mesh.opacities is not None:
            levels = mesh.rgba[:, 3].tobytes()
            found[record.OPACITIES_OF, index] = levels + bytes(-len(levels) % WORD)
        if thing.fade is not None:
            inner, outer = _q32(thing.fade)
            inner, outer = min(inner, MAX_INNER_FADE), min(outer, MAX_FADE)
            found[record.GROUND, index] = struct.pack(">2q16x", inner, max(outer, inner + 1))
        if any(emission):
            found[record.EMISSION_OF, index] = _words([_rgb(emission)])
    if scene.antialias:
        found[record.ANTIALIAS, 0] = b""
    if scene.hemisphere is not None:
        found[record.HEMISPHERE, 0] = bytes([*scene.hemisphere.sky, *scene.hemisphere.ground])
    if scene.rim is not None:
        found[record.RIM, 0] = bytes([*scene.rim.color, scene.rim.power])
    if scene.fog is not None:
        near, far = _q32([scene.fog.near, scene.fog.far])
        found[record.FOG, 0] = bytes(scene.fog.color) + struct.pack(">2q", near, max(far, near + 1))
    if scene.tone is not None:
        flags = sum(bit * getattr(scene.tone, name) for name, bit in record.TONE_FLAGS.items())
        found[record.TONE, 0] = struct.pack(">IB", max(round(scene.tone.exposure / EXPOSURE_STEP), 1), flags)
    return found


def shadow_rule(scene: Scene) -> int:
    """Return which faces of culled objects cast shadows: all, or, if they are closed, those turned from the light."""
    casters = [_as_sent(o) for o in scene.objects if o.cull and not o.wireframe and o.is_opaque and o.fade is None]
    return record.SHADOWS_BACK_FACES if are_closed(casters) else record.SHADOWS_ALL


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
    size = len(content) // WORD if kind >= record.LONG_KINDS else len(content)
    return struct.pack(">BHH", kind, index, size) + content


def encode_object(o: Object) -> bytes:
    """Return the struct Object of an object from `in_range`."""
    material = o.material
    fields = [
        *_q32([*o.position, *o.rotation, o.scale]),
        SHADINGS[material.shading],
        *_q32([material.ambient, material.diffuse, material.specular]),
        material.shininess,
        CULL_BACKFACES * o.cull + WIREFRAME * o.wireframe + TWO_SIDED * o.two_sided,
    ]
    mesh = pack(o.mesh, smooth=material.shading == "smooth")
    return _words([32 * (1 + len(fields)), *fields]) + _bytes(mesh)


def _bytes(content: bytes) -> bytes:
    return _words([len(content)]) + content + bytes(-len(content) % 32)


def _q32(values: ArrayLike) -> list[int]:
    """Return numbers as multiples of 2^-32, rounded to nearest, ties to even."""
    return [round(value * ONE) for value in np.asarray(values, dtype=np.float64).tolist()]


def _rgb(color: Color) -> int:
    red, green, blue = color
    return red << 16 | green << 8 | blue


def _words(values: Iterable[int]) -> bytes:
    return b"".join((value % (1 << 256)).to_bytes(32, "big") for value in values)
