"""Check every bound that the pipeline relies on."""

from __future__ import annotations

from .extensions import check_extensions
from .mesh import NORMALS, WIDE
from .scene_errors import Reverted
from .structs import (
    DIRECTIONAL,
    ORTHOGRAPHIC,
    PERSPECTIVE,
    POINT,
    SMOOTH,
    Camera,
    Light,
    Member,
    Object,
    Rectangle,
    Scene,
    element_of,
    is_dynamic,
    size_of,
    word,
)

MAX_CANVAS = 2048
MAX_LIGHTS = 4
MAX_SHININESS = 128
MAX_COORDINATE = 1 << 58
MAX_EXTENT = 1 << 59
MAX_COEFFICIENT = 4 << 32


def check_layout(data: bytes, begin: int, struct: Member) -> None:
    """Follow the offsets and lengths of a struct of the call before anything is read through them.

    begin: of the struct, from which its offsets count.
    """
    position, arrays = begin, []
    for member in struct["components"]:
        if is_dynamic(member):
            element = element_of(member)
            size = 1 if member["type"] == "bytes" else 32 if is_dynamic(element) else size_of(element)
            arrays.append((element, check_tail(data, begin, position, size) + 32))
        position += 32 if is_dynamic(member) else size_of(member)
    for element, first in arrays:
        if element["type"] == "tuple" and is_dynamic(element):
            for position in range(first, first + 32 * word(data, first - 32), 32):
                start = first + word(data, position)
                if start + size_of(element) > len(data):
                    raise Reverted("MalformedScene", position=position)
                check_layout(data, start, element)


def check_tail(data: bytes, base: int, position: int, size: int) -> int:
    """Check that the offset at `position`, which counts from `base`, leads to an array that lies within the call.

    size: bytes of an element. Returns where the length of the array is.
    """
    tail = base + word(data, position)
    if tail + 32 > len(data):
        raise Reverted("MalformedScene", position=position)
    if tail + 32 + word(data, tail) * size > len(data):
        raise Reverted("MalformedScene", position=tail)
    return tail


def check_scene(scene: Scene, tile: Rectangle) -> None:
    """Check everything but the vertex numbers of the faces, which the primitive assembly checks."""
    width, height = scene.canvas.width, scene.canvas.height
    if not (1 <= width <= MAX_CANVAS and 1 <= height <= MAX_CANVAS):
        raise Reverted("CanvasSize", width=width, height=height)
    if (
        not (1 <= tile.width <= width and 1 <= tile.height <= height)
        or tile.x > width - tile.width
        or tile.y > height - tile.height
    ):
        raise Reverted("RectangleOutsideCanvas", x=tile.x, y=tile.y, width=tile.width, height=tile.height)
    check_camera(scene.camera)
    check_color(scene.background.top)
    check_color(scene.background.bottom)
    check_color(scene.ambient_light)
    if scene.invert > 1:
        raise Reverted("NotAFlag", value=scene.invert)
    if len(scene.lights) > MAX_LIGHTS:
        raise Reverted("TooManyLights", count=len(scene.lights))
    for index, light in enumerate(scene.lights):
        check_light(light, index)
    for index, obj in enumerate(scene.objects):
        check_object(obj, index)
    check_extensions(scene)


def check_camera(camera: Camera) -> None:
    """Check the numbers of the camera."""
    if camera.projection > ORTHOGRAPHIC:
        raise Reverted("UnknownProjection", projection=camera.projection)
    perspective = camera.projection == PERSPECTIVE
    lowest, highest = (1 << 22, 1 << 42) if perspective else (1 << 20, 1 << 58)
    if not lowest <= camera.half_height <= highest:
        raise Reverted("HalfHeightOutOfRange", halfHeight=camera.half_height)
    if not (1 if perspective else -MAX_COORDINATE) <= camera.near <= MAX_COORDINATE:
        raise Reverted("NearOutOfRange", near=camera.near)
    for vector in (camera.eye, camera.target, camera.up):
        if not all(map(in_range, vector)):
            raise Reverted("CameraOutOfRange", x=vector[0], y=vector[1], z=vector[2])


def check_light(light: Light, index: int) -> None:
    """Check the numbers of a light."""
    if light.kind > POINT:
        raise Reverted("UnknownLight", light=index, kind=light.kind)
    if not all(map(in_range, light.vector)):
        raise Reverted("LightOutOfRange", light=index, x=light.vector[0], y=light.vector[1], z=light.vector[2])
    if light.color > 0xFFFFFF:
        raise Reverted("LightNotAColor", light=index, value=light.color)
    if light.kind == DIRECTIONAL and not any(light.vector):
        raise Reverted("LightWithoutDirection", light=index)


def check_object(obj: Object, index: int) -> None:
    """Check the numbers of an object."""
    bits, has_normals = check_mesh(obj.mesh, index)
    if not all(map(in_range, obj.position)):
        raise Reverted("PositionOutOfRange", object=index, x=obj.position[0], y=obj.position[1], z=obj.position[2])
    material = obj.material
    if material.shading > SMOOTH:
        raise Reverted("UnknownShading", object=index, shading=material.shading)
    if material.shading == SMOOTH and not has_normals:
        raise Reverted("NoNormals", object=index)
    for coefficient in (material.ambient, material.diffuse, material.specular):
        if not 0 <= coefficient <= MAX_COEFFICIENT:
            raise Reverted("CoefficientOutOfRange", object=index, value=coefficient)
    if not 1 <= material.shininess <= MAX_SHININESS:
        raise Reverted("ShininessOutOfRange", object=index, shininess=material.shininess)
    if obj.flags > 3:
        raise Reverted("UnknownFlags", object=index, flags=obj.flags)
    if not 0 <= obj.scale <= MAX_EXTENT >> (bits - 1):
        raise Reverted("ScaleOutOfRange", object=index, scale=obj.scale)
    if not all(map(in_range, obj.rotation)):
        x, y, z, w = obj.rotation
        raise Reverted("RotationOutOfRange", object=index, x=x, y=y, z=z, w=w)
    if not any(obj.rotation):
        raise Reverted("RotationIsZero", object=index)


def check_mesh(mesh: bytes, index: int) -> tuple[int, bool]:
    """Check the header and the length of a mesh; return the bits of a coordinate, and whether it has normals."""
    length, header = len(mesh), int.from_bytes(mesh[:5].ljust(5, b"\0"), "big")
    kind = header >> 32
    if length < 5 or kind > NORMALS + WIDE:
        raise Reverted("MeshHeader", object=index, format=kind, length=length)
    bits, has_normals = (24 if kind & WIDE else 16), bool(kind & NORMALS)
    vertex_size = 3 * bits // 8 + (7 if has_normals else 3)
    expected = 5 + ((header >> 16) & 0xFFFF) * vertex_size + (header & 0xFFFF) * 6
    if length != expected:
        raise Reverted("MeshLength", object=index, expected=expected, actual=length)
    return bits, has_normals


def check_color(value: int) -> None:
    """Check that a colour is 0xRRGGBB."""
    if value > 0xFFFFFF:
        raise Reverted("NotAColor", value=value)


def in_range(value: int) -> bool:
    """Return whether a coordinate is within 2^26 units."""
    return -MAX_COORDINATE <= value <= MAX_COORDINATE
