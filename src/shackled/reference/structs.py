"""The structs of contracts/src/scene/Scene.sol as the integers of a call: lengths Q32, colours 0xRRGGBB.

`read_value` decodes them by the ABI of the Renderer: the fields of the classes are in the order of the ABI.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ..artifacts import artifact
from ..scene import Rectangle as Rectangle
from .vector import Quaternion, Vector
from .words import signed

PERSPECTIVE, ORTHOGRAPHIC = 0, 1
DIRECTIONAL, POINT = 0, 1
UNLIT, FLAT, SMOOTH = 0, 1, 2
CULL_BACKFACES, WIREFRAME = 1, 2

#: An entry of an ABI that describes a value: its type, and the components of a struct.
Member = Mapping[str, Any]


@dataclass(frozen=True)
class Canvas:
    """The whole picture in pixels."""

    width: int
    height: int


@dataclass(frozen=True)
class Camera:
    """Position, orientation and projection of the camera."""

    eye: Vector
    target: Vector
    up: Vector
    projection: int
    half_height: int
    near: int


@dataclass(frozen=True)
class Background:
    """The colours of the first and the last row of the canvas; rows between are interpolated."""

    top: int
    bottom: int


@dataclass(frozen=True)
class Light:
    """A direction toward the light, or the position of a point light."""

    kind: int
    vector: Vector
    color: int


@dataclass(frozen=True)
class Material:
    """The reflection of a surface."""

    shading: int
    ambient: int
    diffuse: int
    specular: int
    shininess: int


@dataclass(frozen=True)
class Object:
    """A packed mesh with its place in the world."""

    mesh: bytes
    position: Vector
    rotation: Quaternion
    scale: int
    material: Material
    flags: int


@dataclass(frozen=True)
class Scene:
    """A scene."""

    canvas: Canvas
    camera: Camera
    background: Background
    invert: int
    ambient_light: int
    lights: tuple[Light, ...]
    objects: tuple[Object, ...]
    extensions: bytes


_CLASSES = {each.__name__: each for each in (Canvas, Rectangle, Camera, Background, Light, Material, Object, Scene)}


def parameters(function: str) -> list[Member]:
    """Return the parameters of a function of the Renderer."""
    return next(entry["inputs"] for entry in artifact("Renderer").abi if entry.get("name") == function)


def is_dynamic(member: Member) -> bool:
    """Return whether the ABI encodes a value after the others, with an offset in its place."""
    kind = member["type"]
    return kind == "bytes" or kind.endswith("[]") or any(map(is_dynamic, member.get("components", ())))


def size_of(member: Member) -> int:
    """Return the bytes of a value of fixed size, or those of a struct before its dynamic values."""
    return sum(32 if is_dynamic(each) else size_of(each) for each in member.get("components", ())) or 32


def element_of(member: Member) -> Member:
    """Return the description of the elements of an array."""
    return {**member, "type": member["type"].removesuffix("[]")}


def word(data: bytes, position: int) -> int:
    """Return the word at a position of the call, which zeros follow."""
    return int.from_bytes(data[position : position + 32].ljust(32, b"\0"), "big")


def read_value(data: bytes, position: int, member: Member) -> Any:
    """Return the value that begins at a position, whose offsets have been checked."""
    kind = member["type"]
    if kind == "bytes":
        return data[position + 32 : position + 32 + word(data, position)]
    if kind.endswith("[]"):
        element = element_of(member)
        return _read(data, position + 32, [element] * word(data, position))
    if kind == "tuple":
        values = _read(data, position, member["components"])
        struct = _CLASSES.get(member["internalType"].removeprefix("struct ").removesuffix("[]"))
        return values if struct is None else struct(*values)
    return signed(word(data, position)) if kind == "int256" else word(data, position)


def _read(data: bytes, begin: int, members: list[Member]) -> tuple[Any, ...]:
    """Return values that stand side by side; their offsets count from `begin`."""
    values, position = [], begin
    for member in members:
        if is_dynamic(member):
            values.append(read_value(data, begin + word(data, position), member))
            position += 32
        else:
            values.append(read_value(data, position, member))
            position += size_of(member)
    return tuple(values)
