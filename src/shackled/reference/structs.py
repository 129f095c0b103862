"""What a caller hands to the renderer, as the integers of the call: lengths Q32, colours 0xRRGGBB."""

from __future__ import annotations

from dataclasses import dataclass

from .vector import Quaternion, Vector

PERSPECTIVE, ORTHOGRAPHIC = 0, 1
DIRECTIONAL, POINT = 0, 1
UNLIT, FLAT, SMOOTH = 0, 1, 2
CULL_BACKFACES, WIREFRAME = 1, 2


@dataclass(frozen=True)
class Canvas:
    """The whole picture in pixels."""

    width: int
    height: int


@dataclass(frozen=True)
class Rectangle:
    """The part of the canvas to draw, in pixels from the top left corner."""

    x: int
    y: int
    width: int
    height: int


@dataclass(frozen=True)
class Camera:
    """Where the eye is and how it projects."""

    eye: Vector
    target: Vector
    up: Vector
    projection: int
    half_height: int
    near: int


@dataclass(frozen=True)
class Light:
    """A direction toward the light, or the position of a point light."""

    kind: int
    vector: Vector
    color: int


@dataclass(frozen=True)
class Material:
    """How a surface answers light."""

    shading: int
    ambient: int
    diffuse: int
    specular: int
    shininess: int


@dataclass(frozen=True)
class Object:
    """A packed mesh with its place in the world.

    mesh_header: what stands where its first 5 bytes belong, even if the mesh is shorter.
    """

    mesh: bytes
    mesh_header: int
    position: Vector
    rotation: Quaternion
    scale: int
    material: Material
    flags: int


@dataclass(frozen=True)
class Scene:
    """Everything that a picture is made from."""

    canvas: Canvas
    camera: Camera
    background_top: int
    background_bottom: int
    invert: int
    ambient_light: int
    lights: tuple[Light, ...]
    objects: tuple[Object, ...]
    extensions: bytes
