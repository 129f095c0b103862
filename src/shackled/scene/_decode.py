"""Scenes from calldata: the inverse of `_codec`, for untrusted bytes."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from attrs import evolve

from ..artifacts import artifact
from ..errors import InputError
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
from ._effects import EXPOSURES, Background, Fog, Hemisphere, Rim, Tone
from ._files.table import about
from ._fit import MAX_COORDINATE, MAX_SCALE
from ._ground import Ground
from ._light import MAX_LIGHTS, Light
from ._mesh import Mesh
from ._object import COEFFICIENTS, EXPONENTS, Material, Object
from ._packed import WIDE, unpack, unpack_alpha, unpack_texture
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
    OWNERS,
    RECORD_HEADER,
    RIM,
    SHADOW,
    SIZES,
    SPOT,
    TEXTURE_OF,
    TONE,
    TONE_FILMIC,
    TONE_GAMMA,
)
from ._scene import Scene
from ._staging import MAX_SIDE

#: Words of a struct Scene before its arrays, of a light, and of an object before its mesh.
SCENE_WORDS, LIGHT_WORDS, OBJECT_WORDS = 21, 5, 15

#: Contents of records by kind and index.
Records = Mapping[tuple[int, int], bytes]


def decode(data: bytes) -> Scene:
    """Return the scene of a call `Renderer.render`, such that `render_call` makes the same call of it again.

    data: the selector and the argument in the ABI's standard encoding, untrusted. What it declares is compared with its
    length before anything is allocated. InputError for everything that the contracts refuse, and for calls that
    `render_call` would make otherwise: of another encoding, with numbers that a float does not hold, or of a scene that
    it would move and scale. `Chain.call` runs them as they are.
    """
    scene = read_call(data)
    if (again := render_call(scene)) != data:
        raise InputError(_difference(data, again))
    return scene


def read_call(data: bytes) -> Scene:
    """Return the scene of a call as `decode` does, also where `render_call` would make another call of it."""
    if data[:4] != artifact("Renderer").selectors["render"]:
        raise InputError("it is no call of render(Scene): its first four bytes are those of another function")
    words = _Words(data[4:])
    words.offset("the scene", WORD)
    begin = words.place
    width, height = words.whole("its width", 1, MAX_SIDE), words.whole("its height", 1, MAX_SIDE)
    camera = _camera(words)
    background = Background(words.color("the top of the background"), words.color("the bottom of the background"))
    invert = words.whole("invert", 0, 1)
    ambient_light = words.color("the ambient light")
    to_lights, to_objects, to_extensions = (words.whole(f"the offset of {name}") for name in _PARTS)
    words.expect(_PARTS[0], begin + to_lights)
    lights = [_light(words, f"lights[{index}]") for index in range(words.count("lights", LIGHT_WORDS, MAX_LIGHTS))]
    words.expect(_PARTS[1], begin + to_objects)
    count = words.count("objects", 1)
    first = words.place
    offsets = [words.whole("the offset of an object") for _ in range(count)]
    objects = []
    for index, offset in enumerate(offsets):
        words.expect(f"objects[{index}]", first + offset)
        objects.append(_object(words, f"objects[{index}]"))
    words.expect(_PARTS[2], begin + to_extensions)
    records = _records(words.bytes("the extensions"), {"scene": 1, "light": len(lights), "object": len(objects)})
    if words.place != len(words.data):
        raise InputError(f"{len(words.data) - words.place:,} bytes follow the scene; none must")
    lights = [evolve(each, shadow=(SHADOW, index) in records) for index, each in enumerate(lights)]
    objects, ground = _without_ground([_with_records(each, records, index) for index, each in enumerate(objects)])
    return Scene(
        objects,
        camera,
        [_with_spot(each, records.get((SPOT, index)), f"lights[{index}]") for index, each in enumerate(lights)],
        background,
        ambient_light,
        bool(invert),
        width,
        height,
        (ANTIALIAS, 0) in records,
        **_effects(records),
        ground=ground,
    )


def _difference(data: bytes, again: bytes) -> str:
    """Return the message for a call that `render_call` makes otherwise."""
    # the offsets of the parts are the last words of the scene
    begin = 4 + WORD * (1 + SCENE_WORDS - len(_PARTS))
    offsets = [int.from_bytes(data[at : at + WORD], "big") for at in range(begin, begin + len(_PARTS) * WORD, WORD)]
    place = next((at for at, (one, other) in enumerate(zip(data, again, strict=False)) if one != other), len(again))
    part = ("the camera or the canvas", *_PARTS)[sum(place >= 4 + WORD + offset for offset in offsets)]
    return (
        f"the call is not the one that Shackled makes of its scene: from byte {place:,} on, in {part}, they differ, "
        "and the picture could change; open_chain().call('Renderer', data) of shackled.chain draws the call as it is"
    )


_PARTS = ("the lights", "the objects", "the extensions")


class _Words:
    """The words of an argument, read one after the other. Every method raises InputError where they are wrong."""

    def __init__(self, data: bytes) -> None:
        self.data = data
        self.place = 0

    def take(self, size: int, what: str) -> bytes:
        """Return the next bytes."""
        if size > len(self.data) - self.place:
            raise InputError(f"the call is cut off: {what} would lie beyond its end")
        self.place += size
        return self.data[self.place - size : self.place]

    def whole(self, what: str, low: int = 0, high: int = 2**64) -> int:
        """Return a number that is not negative."""
        value = int.from_bytes(self.take(WORD, what), "big")
        if not low <= value <= high:
            shown = f"{value:,}" if value < 2**64 else "a larger number"
            raise InputError(f"{what} must be from {low:,} to {high:,}, not {shown}")
        return value

    def number(self, what: str, low: float = -MAX_COORDINATE, high: float = MAX_COORDINATE) -> float:
        """Return a Q32 number."""
        return _number(int.from_bytes(self.take(WORD, what), "big", signed=True), what, low, high)

    def vector(self, what: str, size: int = 3) -> list[float]:
        """Return coordinates."""
        return [self.number(what) for _ in range(size)]

    def color(self, what: str) -> tuple[int, int, int]:
        """Return red, green and blue."""
        value = self.whole(f"{what} as a colour", 0, 0xFFFFFF)
        return value >> 16, value >> 8 & 255, value & 255

    def choice(self, what: str, names: Mapping[str, int]) -> str:
        """Return the name of a number."""
        value = self.whole(what, 0, max(names.values()))
        return next(name for name, number in names.items() if number == value)

    def count(self, what: str, words: int, most: int | None = None) -> int:
        """Return the length of an array. words: of an element, at least. most: elements."""
        count = self.whole(f"the number of {what}", 0, 2**64 if most is None else most)
        if count * words * WORD > len(self.data) - self.place:
            raise InputError(f"the call is cut off: it has no space for {count:,} {what}")
        return count

    def bytes(self, what: str) -> bytes:
        """Return bytes, of which zeros fill the last word."""
        size = self.whole(f"the length of {what}")
        content = self.take(size, what)
        if any(self.take(-size % WORD, what)):
            raise InputError(f"zeros must fill the last word of {what}")
        return content

    def offset(self, what: str, expected: int) -> None:
        """Read an offset, which must be the expected one."""
        if self.whole(f"the offset of {what}") != expected:
            raise InputError(f"{what} must follow what is before it, as in the ABI's standard encoding")

    def expect(self, what: str, place: int) -> None:
        """Check that an offset led to the next word."""
        if self.place != place:
            raise InputError(f"{what} must follow what is before it, as in the ABI's standard encoding")


def _number(value: int, what: str, low: float, high: float) -> float:
    if not low * ONE <= value <= high * ONE:
        raise InputError(f"{what} must be from {low:.10g} to {high:.10g}")
    result = value / ONE
    if result * ONE != value:
        raise InputError(f"{what} has more digits than a float holds: the picture could not be made again exactly")
    return result


def _camera(words: _Words) -> Camera:
    eye, target, up = (words.vector(f"the camera's {name}") for name in ("eye", "target", "up"))
    projection = words.choice("the camera's projection", PROJECTIONS)
    orthographic = projection == "orthographic"
    half_height = words.number(
        "the camera's half_height", *((2.0**-12, 2.0**26) if orthographic else (2.0**-10, 2.0**10))
    )
    near: float | None = words.number("the camera's near distance", -MAX_COORDINATE if orthographic else 1 / ONE)
    if orthographic and near == -MAX_COORDINATE:
        near = None
    return Camera(eye, target, up, projection, half_height, near)


def _light(words: _Words, where: str) -> Light:
    kind = "point" if words.whole(f"the kind of {where}", 0, 1) == LIGHTS["point"] else "directional"
    vector, color = words.vector(f"the vector of {where}"), words.color(f"the colour of {where}")
    with about(where):
        return Light(kind, vector, color)


def _object(words: _Words, where: str) -> Object:
    words.offset(f"the mesh of {where}", OBJECT_WORDS * WORD)
    position, rotation = words.vector(f"the position of {where}"), words.vector(f"the rotation of {where}", 4)
    scale = words.number(f"the scale of {where}", 0)
    shading = words.choice(f"the shading of {where}", SHADINGS)
    ambient, diffuse, specular = (
        words.number(f"the {name} coefficient of {where}", *COEFFICIENTS) for name in ("ambient", "diffuse", "specular")
    )
    shininess = words.whole(f"the shininess of {where}", *EXPONENTS)
    flags = words.whole(f"the flags of {where}", 0, CULL_BACKFACES + WIREFRAME + TWO_SIDED)
    packed = words.bytes(f"the mesh of {where}")
    with about(where):
        mesh = unpack(packed)
        if scale > (most := MAX_SCALE[24 if packed[0] & WIDE else 16]):
            raise InputError(f"the scale of its mesh must be at most {most:g}, not {scale:g}")
        if shading == "smooth" and mesh.normals is None:
            raise InputError("smooth shading needs a mesh with normals")
        material = Material(shading, ambient, diffuse, specular, shininess)
        cull, wireframe, two_sided = (bool(flags & each) for each in (CULL_BACKFACES, WIREFRAME, TWO_SIDED))
        return Object(mesh, position, rotation, scale, material, cull, wireframe, two_sided=two_sided)


def _records(data: bytes, counts: Mapping[str, int]) -> Records:
    """Return the records of the extensions. counts: of what a record may belong to."""
    records: dict[tuple[int, int], bytes] = {}
    place, last = 0, -1
    while place < len(data):
        header = data[place : place + RECORD_HEADER]
        size = int.from_bytes(header[3:], "big")
        size *= WORD if header[0] >= LONG_KINDS else 1
        content = data[place + RECORD_HEADER : place + RECORD_HEADER + size]
        if len(header) < RECORD_HEADER or len(content) < size:
            raise InputError(f"the extensions are cut off at byte {place}")
        key = int.from_bytes(header[:3], "big")
        kind, index = key >> 16, key & 0xFFFF
        if key <= last:
            raise InputError(f"the extensions must ascend by kind and index; {kind}, {index} does not")
        if kind not in SIZES or SIZES[kind] not in (None, size):
            raise InputError(f"an extension of kind {kind} and {len(content)} bytes is not known")
        if index >= (count := counts[OWNERS[kind]]):
            raise InputError(f"an extension belongs to number {index} of {count}, counted from 0")
        records[kind, index] = content
        place, last = place + RECORD_HEADER + len(content), key
    return records


def _with_spot(light: Light, record: bytes | None, where: str) -> Light:
    if record is None:
        return light
    if light.kind != "point":
        raise InputError(f"{where} must be a point light to have a cone")
    x, y, z, inner, outer = (int.from_bytes(record[at : at + 8], "big", signed=True) for at in range(0, 40, 8))
    direction = [_number(value, f"the direction of {where}", -MAX_COORDINATE, MAX_COORDINATE) for value in (x, y, z)]
    # the arc cosine errs by a few units in the last place, far less than half a step of Q32
    cosines = [_number(value, f"a cosine of {where}", -1, 1) for value in (inner, outer)]
    with about(where):
        inner_angle, outer_angle = (math.degrees(math.acos(each)) for each in cosines)
        return Light.spot(light.vector, direction, light.color, inner_angle, outer_angle, shadow=light.shadow)


def _with_records(thing: Object, records: Records, index: int) -> Object:
    if (OPACITY_OF, index) in records:
        opacity = int.from_bytes(records[OPACITY_OF, index], "big") * OPACITY_STEP
        if opacity >= 1:
            raise InputError("an opacity in the extensions must be below 1")
        thing = evolve(thing, opacity=opacity)
    if (TEXTURE_OF, index) in records:
        with about(f"the texture of objects[{index}]"):
            texture, uvs = unpack_texture(records[TEXTURE_OF, index], len(thing.mesh.positions))
            if (ALPHA_OF, index) in records:
                texture = unpack_alpha(records[ALPHA_OF, index], texture)
        thing = evolve(thing, mesh=evolve(thing.mesh, uvs=uvs), material=evolve(thing.material, texture=texture))
    elif (ALPHA_OF, index) in records:
        raise InputError(f"objects[{index}] has an alpha of texels, but no texture")
    if (record := records.get((OPACITIES_OF, index))) is not None:
        thing = evolve(thing, mesh=_with_opacities(thing.mesh, record, f"objects[{index}]"))
    if (record := records.get((GROUND, index))) is not None:
        if any(record[16:]):
            raise InputError("zeros must fill the word of a ground in the extensions")
        radii = [int.from_bytes(record[at : at + 8], "big") for at in (0, 8)]
        thing = evolve(thing, fade=[_number(each, "a radius of a ground", 0, MAX_COORDINATE) for each in radii])
    if (record := records.get((EMISSION_OF, index))) is not None:
        emission = _Words(record).color(f"the emission of objects[{index}]")
        if not any(emission):
            raise InputError("an emission in the extensions must not be black")
        thing = evolve(thing, material=evolve(thing.material, emission=emission))
    return thing


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


def _with_opacities(mesh: Mesh, record: bytes, where: str) -> Mesh:
    count = len(mesh.positions)
    levels, rest = record[:count], record[count:]
    if len(levels) < count or len(rest) != -count % WORD or any(rest):
        raise InputError(f"the opacities of {where} must be {count:,} bytes, and zeros that fill the last word")
    if min(levels) == 255:
        raise InputError(f"one of the opacities of {where} must be below 255")
    return evolve(mesh, opacities=np.frombuffer(levels, np.uint8) / 255)


def _effects(records: Records) -> dict[str, Any]:
    """Return the effects of the scene, by the names of its fields."""
    found: dict[str, Any] = {}
    if (record := records.get((HEMISPHERE, 0))) is not None:
        found["hemisphere"] = Hemisphere(tuple(record[:3]), tuple(record[3:]))
    if (record := records.get((RIM, 0))) is not None:
        found["rim"] = Rim(tuple(record[:3]), record[3])
    if (record := records.get((FOG, 0))) is not None:
        numbers = [int.from_bytes(record[at : at + 8], "big") for at in (3, 11)]
        near, far = (_number(each, "a distance of the fog", 0, MAX_COORDINATE) for each in numbers)
        found["fog"] = Fog(tuple(record[:3]), near, far)
    if (record := records.get((TONE, 0))) is not None:
        exposure, flags = int.from_bytes(record[:4], "big") * EXPOSURE_STEP, record[4]
        if not EXPOSURE_STEP <= exposure <= EXPOSURES[1] or flags > TONE_FILMIC | TONE_GAMMA:
            raise InputError("the tone in the extensions has an exposure beyond its range, or unknown flags")
        found["tone"] = Tone(exposure, bool(flags & TONE_FILMIC), bool(flags & TONE_GAMMA))
    return found
