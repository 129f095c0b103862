"""Extension records: what a scene, its lights and its objects have beyond the fields of their structs."""

from __future__ import annotations

from .scene_errors import Reverted
from .structs import POINT, Scene

#: Kinds of records.
SPOT, OPACITY, ANTIALIAS = 1, 2, 3
#: The first kind of which sizes are told in words of 32 bytes.
LONG_KINDS = 8
#: Bytes of kind, index and size; and of the content, by kind.
HEADER = 5
SIZES = {SPOT: 40, OPACITY: 4, ANTIALIAS: 0}
#: One, as Q24.
OPAQUE = 1 << 24
#: The bounds of coordinates, 2^26 units, and one, Q32.
MAX_COORDINATE, ONE = 1 << 58, 1 << 32

#: The contents by kind and index.
Records = dict[tuple[int, int], bytes]


def check_extensions(scene: Scene) -> None:
    """Check every record."""
    data = scene.extensions
    counts = {SPOT: len(scene.lights), OPACITY: len(scene.objects), ANTIALIAS: 1}
    place, least = 0, 0
    while place != len(data):
        content = data[place + HEADER :]
        if len(data) - place < HEADER or (size := size_of(data[place:])) > len(content):
            raise Reverted("ExtensionCutOff", position=place)
        key = int.from_bytes(data[place : place + 3], "big")
        kind, index = key >> 16, key & 0xFFFF
        if key < least:
            raise Reverted("ExtensionOrder", kind=kind, index=index)
        least = key + 1
        place += HEADER + size
        if kind > ANTIALIAS:
            # an effect, which the engine checks
            continue
        if kind not in SIZES:
            raise Reverted("UnknownExtension", kind=kind, index=index)
        if size != SIZES[kind]:
            raise Reverted("ExtensionSize", kind=kind, index=index, expected=SIZES[kind], actual=size)
        if index >= counts[kind]:
            raise Reverted("ExtensionIndex", kind=kind, index=index, count=counts[kind])
        if kind == SPOT:
            if scene.lights[index].kind != POINT:
                raise Reverted("SpotIsNoPoint", light=index)
            check_spot(content[:size], index)
        if kind == OPACITY:
            opacity = int.from_bytes(content[:size], "big")
            if opacity >= OPAQUE:
                raise Reverted("OpacityOutOfRange", object=index, opacity=opacity)


def size_of(record: bytes) -> int:
    """Return the size of the content of a record, in bytes."""
    return int.from_bytes(record[3:HEADER], "big") * (1 if record[0] < LONG_KINDS else 32)


def check_spot(content: bytes, index: int) -> None:
    """Check the numbers of a spot light."""
    x, y, z, inner, outer = spot_numbers(content)
    if not all(-MAX_COORDINATE <= value <= MAX_COORDINATE for value in (x, y, z)):
        raise Reverted("SpotOutOfRange", light=index, x=x, y=y, z=z)
    if not (x or y or z):
        raise Reverted("SpotWithoutDirection", light=index)
    if inner > ONE or outer < -ONE or inner < outer:
        raise Reverted("SpotAngles", light=index, cosInner=inner, cosOuter=outer)


def read_records(data: bytes) -> Records:
    """Return the records of a scene that was checked."""
    records = {}
    while data:
        size = size_of(data)
        records[data[0], int.from_bytes(data[1:3], "big")] = data[HEADER : HEADER + size]
        data = data[HEADER + size :]
    return records


def is_antialiased(records: Records) -> bool:
    """Return whether each pixel has four samples."""
    return any(kind >= ANTIALIAS for kind, _ in records)


def has_effects(records: Records) -> bool:
    """Return whether the scene has records of effects."""
    return any(kind > ANTIALIAS for kind, _ in records)


def spot_numbers(content: bytes) -> tuple[int, ...]:
    """Return the direction (x, y, z), and the cosines of the inner and the outer angle, Q32."""
    return tuple(int.from_bytes(content[i : i + 8], "big", signed=True) for i in range(0, 40, 8))
