"""Scenes from calldata: the inverse of `_codec`, for untrusted bytes."""

from __future__ import annotations

import math
import struct
from collections.abc import Mapping
from typing import Any

import numpy as np
from attrs import evolve

from ..artifacts import artifact
from ..base.checks import number
from ..errors import InputError
from . import _records as record
from ._camera import Camera
from ._codec import (
    CULL_BACKFACES,
    EXPOSURE_STEP,
    LIGHTS,
    ONE,
    OPACITY_STEP,
    PROJECTIONS,
    SHADINGS,
    TWO_SIDED,
    WIREFRAME,
    WORD,
    encode_object,
    extensions,
    render_call,
)
from ._constants import MAX_COORDINATE
from ._effects import Background, Fog, Hemisphere, Rim, Tone
from ._files.table import about
from ._ground import Ground
from ._light import Light
from ._object import Material, Object
from ._packed import unpack, unpack_alpha, unpack_texture
from ._scene import Scene

#: Contents of records by kind and index.
Records = Mapping[tuple[int, int], bytes]


def decode(data: bytes) -> Scene:
    """Return the scene of a call `Renderer.render`, such that `render_call` makes the same call of it again.

    data: the selector and the argument in the ABI's standard encoding, untrusted. InputError for everything that the
    contracts refuse, and for calls that `render_call` would make otherwise: of another encoding, with numbers that a
    float does not hold, or of a scene that it would move and scale. `Chain.call` runs them as they are.
    """
    scene = read_call(data)
    if (again := render_call(scene)) == data:
        return scene
    pairs = enumerate(zip(data, again, strict=False))
    place = next((at for at, (one, other) in pairs if one != other), min(len(data), len(again)))
    raise InputError(
        f"the call is not the one that Shackled makes of its scene: from byte {place:,} on they differ, and the picture"
        " could change; open_chain().call('Renderer', data) of shackled.chain draws the call as it is"
    )


def read_call(data: bytes) -> Scene:
    """Return the scene of a call as `decode` does, also where `render_call` would make another call of it."""
    # each part is read where the one before it ends, whatever the offsets say, so that no byte is read twice
    if data[:4] != artifact("Renderer").selectors["render"]:
        raise InputError("it is no call of render(Scene): its first four bytes are those of another function")
    words = _Words(data[4:])
    words.whole()  # the offset of the scene
    width, height = words.whole(), words.whole()
    camera = _camera(words)
    background = Background(words.color(), words.color())
    invert, ambient_light = words.whole(), words.color()
    words.take(3 * WORD)  # the offsets of lights, objects and extensions
    lights = [_light(words, f"lights[{index}]") for index in range(words.whole())]
    count = words.whole()
    words.take(count * WORD)
    objects = [_object(words, f"objects[{index}]") for index in range(count)]
    records = _records(words.bytes())
    lights = [_with_light_records(each, records, index) for index, each in enumerate(lights)]
    objects, ground = _without_ground([_with_records(each, records, index) for index, each in enumerate(objects)])
    return Scene(
        objects,
        camera,
        lights,
        background,
        ambient_light,
        bool(invert),
        width,
        height,
        (record.ANTIALIAS, 0) in records,
        **_effects(records),
        ground=ground,
    )


class _Words:
    """The words of an argument, read one after the other; InputError where it ends before."""

    def __init__(self, data: bytes) -> None:
        self.data = data
        self.place = 0

    def take(self, size: int) -> bytes:
        if size > len(self.data) - self.place:
            raise InputError(f"the call is cut off: it ends after {4 + len(self.data):,} bytes, but declares more")
        self.place += size
        return self.data[self.place - size : self.place]

    def whole(self) -> int:
        return int.from_bytes(self.take(WORD), "big")

    def numbers(self, count: int) -> list[float]:
        """Return Q32 numbers."""
        return [int.from_bytes(self.take(WORD), "big", signed=True) / ONE for _ in range(count)]

    def color(self) -> tuple[int, int, int]:
        value = self.whole()
        return value >> 16, value >> 8 & 255, value & 255

    def bytes(self) -> bytes:
        content = self.take(self.whole())
        self.take(-len(content) % WORD)
        return content


def _named(numbers: Mapping[str, int], value: int) -> str:
    """Return the first name of a number, or, for the error of who takes it, the number."""
    return next((name for name, number in numbers.items() if number == value), str(value))


def _camera(words: _Words) -> Camera:
    eye, target, up = (words.numbers(3) for _ in range(3))
    projection = _named(PROJECTIONS, words.whole())
    half_height, near = words.numbers(2)
    is_endless = projection == "orthographic" and near == -MAX_COORDINATE
    return Camera(eye, target, up, projection, half_height, None if is_endless else near)


def _light(words: _Words, where: str) -> Light:
    with about(where):
        return Light(_named(LIGHTS, words.whole()), words.numbers(3), words.color())


def _object(words: _Words, where: str) -> Object:
    words.whole()  # the offset of the mesh
    position, rotation, (scale,) = words.numbers(3), words.numbers(4), words.numbers(1)
    with about(where):
        shading, (ambient, diffuse, specular) = _named(SHADINGS, words.whole()), words.numbers(3)
        material = Material(shading, ambient, diffuse, specular, words.whole())
        flags, mesh = words.whole(), unpack(words.bytes())
        cull, wireframe, two_sided = (bool(flags & each) for each in (CULL_BACKFACES, WIREFRAME, TWO_SIDED))
        return Object(mesh, position, rotation, scale, material, cull, wireframe, two_sided=two_sided)


def _records(data: bytes) -> Records:
    records = {}
    place = 0
    while place < len(data):
        header = data[place : place + record.RECORD_HEADER].ljust(record.RECORD_HEADER, b"\0")
        kind, index, size = struct.unpack(">BHH", header)
        place += record.RECORD_HEADER
        content = data[place : place + size * (WORD if kind >= record.LONG_KINDS else 1)]
        if kind not in record.SIZES or record.SIZES[kind] not in (None, len(content)):
            raise InputError(f"an extension of kind {kind} and {len(content)} bytes is not known")
        records[kind, index] = content
        place += len(content)
    return records


def _with_light_records(light: Light, records: Records, index: int) -> Light:
    light = evolve(light, shadow=(record.SHADOW, index) in records)
    if (content := records.get((record.SPOT, index))) is None:
        return light
    *direction, inner, outer = (each / ONE for each in struct.unpack(">5q", content))
    with about(f"lights[{index}]"):
        # the arc cosine errs by a few units in the last place, far less than half a step of Q32
        angles = (math.degrees(math.acos(number(each, "the cosine of an angle", -1, 1))) for each in (inner, outer))
        return Light.spot(light.vector, direction, light.color, *angles, shadow=light.shadow)


def _with_records(thing: Object, records: Records, index: int) -> Object:
    mesh, material, changes = thing.mesh, thing.material, dict[str, Any]()
    with about(f"objects[{index}]"):
        if (content := records.get((record.OPACITY_OF, index))) is not None:
            changes["opacity"] = int.from_bytes(content, "big") * OPACITY_STEP
        if (content := records.get((record.TEXTURE_OF, index))) is not None:
            texture, uvs = unpack_texture(content, len(mesh.positions))
            if (alpha := records.get((record.ALPHA_OF, index))) is not None:
                texture = unpack_alpha(alpha, texture)
            mesh, material = evolve(mesh, uvs=uvs), evolve(material, texture=texture)
        if (content := records.get((record.OPACITIES_OF, index))) is not None:
            mesh = evolve(mesh, opacities=np.frombuffer(content[: len(mesh.positions)], np.uint8) / 255)
        if (content := records.get((record.GROUND, index))) is not None:
            changes["fade"] = [each / ONE for each in struct.unpack(">2q16x", content)]
        if (content := records.get((record.EMISSION_OF, index))) is not None:
            material = evolve(material, emission=_Words(content).color())
        return evolve(thing, mesh=mesh, material=material, **changes)


def _without_ground(objects: list[Object]) -> tuple[list[Object], Ground | None]:
    """Return the objects without the last one, and the ground that it is; all of them, if it is none."""
    if not objects or (fade := objects[-1].fade) is None:
        return objects, None
    *others, last = objects
    (x, height, z), (inner, radius), color = last.position, fade, last.mesh.colors[0]
    for given in (None, inner):
        ground = Ground(color, height, radius, (x, z), given)
        if _bytes_of(ground.under(np.zeros((0, 3)))) == _bytes_of(last):
            return others, ground
    return objects, None


def _bytes_of(thing: Object) -> bytes:
    return encode_object(thing) + extensions(Scene([thing], Camera()))


def _effects(records: Records) -> dict[str, Any]:
    """Return the effects of the scene, by the names of its fields."""
    found: dict[str, Any] = {}
    if (content := records.get((record.HEMISPHERE, 0))) is not None:
        found["hemisphere"] = Hemisphere(tuple(content[:3]), tuple(content[3:]))
    if (content := records.get((record.RIM, 0))) is not None:
        found["rim"] = Rim(tuple(content[:3]), content[3])
    if (content := records.get((record.FOG, 0))) is not None:
        found["fog"] = Fog(tuple(content[:3]), *(each / ONE for each in struct.unpack(">2q", content[3:])))
    if (content := records.get((record.TONE, 0))) is not None:
        exposure, flags = struct.unpack(">IB", content)
        set_flags = {name: bool(flags & bit) for name, bit in record.TONE_FLAGS.items()}
        found["tone"] = Tone(exposure * EXPOSURE_STEP, **set_flags)
    return found
