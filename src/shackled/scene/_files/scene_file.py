"""Scene files of our own: TOML, or JSON with the same keys. `docs/scene-files.md` tells the keys and their defaults."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any, cast

import numpy as np
from attrs import evolve
from numpy.typing import ArrayLike

from ...errors import InputError
from ...whole_file import check_output_file, write_output
from .._background import Background
from .._camera import DEFAULT_HALF_HEIGHT, Camera, half_height_of
from .._light import INNER_ANGLE, LIGHT_KINDS, OUTER_ANGLE, Light, LightKind
from .._material import Material, Shading
from .._mesh import Mesh
from .._object import Object
from .._rotation import from_axis_angle, from_euler
from .._scene import DEFAULT_SIDE, Scene
from .._staging import AZIMUTH, BACKGROUND, ELEVATION, MARGIN, Look, frame, key_light, painted
from .mesh_file import read_mesh
from .table import Table, about

_SCENE = ("size", "invert", "ambient_light", "background", "camera", "lights", "objects")
_BACKGROUND = ("top", "bottom")
_CAMERA = ("eye", "target", "up", "azimuth", "elevation", "margin", "projection", "fov", "half_height", "near")
_LIGHT = ("kind", "direction", "position", "color", "inner_angle", "outer_angle")
_OBJECT = ("mesh", "position", "rotation", "scale", "color", "material", "cull", "wireframe", "opacity")
_MESH = ("positions", "faces", "colors", "normals")
_MATERIAL = ("shading", "ambient", "diffuse", "specular", "shininess")
_ROTATION = ("quaternion", "axis", "angle")

_WHITE = (255, 255, 255)
_NO_ROTATION = (0.0, 0.0, 0.0, 1.0)


def scene_of(document: Mapping[str, Any], folder: Path) -> Scene:
    """Return the scene of a document whose meshes are files relative to `folder`.

    InputError says where in the document it is wrong.
    """
    table = Table(document, "", _SCENE)
    width, height = _size(table)
    objects = [_object(part, where, folder) for where, part in table.rows("objects")]
    keys = table.table("camera", _CAMERA)
    look = Look(
        width=width,
        height=height,
        azimuth=keys.number("azimuth", AZIMUTH),
        elevation=keys.number("elevation", ELEVATION),
        margin=keys.number("margin", MARGIN),
    )
    return Scene(
        objects=objects,
        camera=_camera(keys, look, objects),
        lights=[_light(part, where) for where, part in table.rows("lights")]
        if "lights" in table
        else [key_light(look)],
        background=_background(table),
        ambient_light=table.color("ambient_light", _WHITE),
        invert=table.flag("invert", False),
        width=width,
        height=height,
    )


def write_scene(scene: Scene, path: str | os.PathLike[str]) -> None:
    """Write a scene as JSON, with its meshes inside, such that loading it gives the same scene.

    InputError where the path is wrong, OutputError where the disk is full or fails.
    """
    path = Path(path)
    if path.suffix.lower() != ".json":
        raise InputError(f"the scene {path} must end in .json")
    write_output(check_output_file(path, "scene"), encode_scene_file(scene))


def encode_scene_file(scene: Scene) -> bytes:
    """Return the bytes of a scene file in JSON, such that loading it gives the same scene."""
    camera = scene.camera
    document = {
        "size": [scene.width, scene.height],
        "invert": scene.invert,
        "ambient_light": scene.ambient_light,
        "background": {"top": scene.background.top, "bottom": scene.background.bottom},
        "camera": {
            "eye": camera.eye,
            "target": camera.target,
            "up": camera.up,
            "projection": camera.projection,
            "half_height": camera.half_height,
            **({} if camera.near is None else {"near": camera.near}),
        },
        "lights": [_lamp(light) for light in scene.lights],
        "objects": [
            {
                "mesh": {
                    "positions": thing.mesh.positions,
                    "faces": thing.mesh.faces,
                    "colors": thing.mesh.colors,
                    **({} if thing.mesh.normals is None else {"normals": thing.mesh.normals}),
                },
                "position": thing.position,
                "rotation": {"quaternion": thing.rotation},
                "scale": thing.scale,
                "material": {key: getattr(thing.material, key) for key in _MATERIAL},
                "cull": thing.cull,
                "wireframe": thing.wireframe,
                "opacity": thing.opacity,
            }
            for thing in scene.objects
        ],
    }
    text = json.dumps(document, default=lambda array: array.tolist())
    return f"{text}\n".encode("ascii")


def _lamp(light: Light) -> dict[str, Any]:
    """Return the keys of a light."""
    place = "direction" if light.kind == "directional" else "position"
    keys = {"kind": light.kind, place: light.vector, "color": light.color}
    if light.kind == "spot":
        keys |= {name: getattr(light, name) for name in ("direction", "inner_angle", "outer_angle")}
    return keys


def _size(table: Table) -> tuple[int, int]:
    size = table.get("size")
    if size is None:
        return DEFAULT_SIDE, DEFAULT_SIDE
    sides = size if isinstance(size, list) else [size, size]
    if len(sides) != 2 or not all(type(side) is int for side in sides):
        raise InputError(f"size must be a number of pixels, or width and height, not {size!r:.60}")
    with about("size"):
        Scene([], width=sides[0], height=sides[1])
    return sides[0], sides[1]


def _background(table: Table) -> Background:
    value = table.get("background")
    if value is None:
        return BACKGROUND
    if not isinstance(value, Mapping):
        return Background(table.color("background", (0, 0, 0)))
    keys = table.table("background", _BACKGROUND)
    top = keys.color("top", (0, 0, 0))
    return Background(top, keys.color("bottom", top))


def _camera(keys: Table, look: Look, objects: list[Object]) -> Camera:
    keys.only_one_of("fov", "half_height")
    keys.only_one_of("eye", "azimuth")
    keys.only_one_of("eye", "elevation")
    keys.only_one_of("eye", "margin")
    if ("eye" in keys) != ("target" in keys):
        there, missing = ("eye", "target") if "eye" in keys else ("target", "eye")
        raise InputError(
            f"camera.{there} needs a camera.{missing}; without both the camera is placed so that all is seen"
        )
    if "up" in keys and "eye" not in keys:
        raise InputError("camera.up needs a camera.eye and a camera.target")
    orthographic = keys.choice("projection", "perspective", ("perspective", "orthographic")) == "orthographic"
    if orthographic and "fov" in keys:
        raise InputError(
            "camera.fov is for the perspective projection; the orthographic one has half_height, in world units"
        )
    with about("camera"):
        half_height = keys.number("half_height", DEFAULT_HALF_HEIGHT)
        if "fov" in keys:
            half_height = half_height_of(keys.number("fov", 50))
        if "eye" in keys:
            if orthographic and "half_height" not in keys:
                raise InputError("an orthographic camera with an eye needs half_height, in world units")
            camera = Camera(
                keys.numbers("eye", (0, 0, 0)),
                keys.numbers("target", (0, 0, 0)),
                keys.numbers("up", (0, 1, 0)),
                "orthographic" if orthographic else "perspective",
                half_height,
            )
            if not camera.up.any():
                raise InputError("up must not be (0, 0, 0)")
            if np.array_equal(camera.eye, camera.target):
                raise InputError("eye and target are the same point")
        else:
            placed = evolve(look, projection="orthographic" if orthographic else "perspective", half_height=half_height)
            points = [thing.world_positions() for thing in objects]
            camera = frame(np.concatenate(points) if points else np.zeros((1, 3)), placed)
            if orthographic and "half_height" in keys:
                camera = evolve(camera, half_height=half_height)
        return evolve(camera, near=keys.number("near", 0)) if "near" in keys else camera


def _light(value: object, where: str) -> Light:
    keys = Table(value, where, _LIGHT)
    kind = cast(LightKind, keys.choice("kind", "", LIGHT_KINDS))
    color = keys.color("color", _WHITE)
    if kind == "spot":
        for needed in ("position", "direction"):
            if needed not in keys:
                raise InputError(f"{where} must have a {needed}, as its kind is spot")
        place, direction = keys.numbers("position", (0, 0, 0)), keys.numbers("direction", (0, 0, 0))
        inner, outer = keys.number("inner_angle", INNER_ANGLE), keys.number("outer_angle", OUTER_ANGLE)
        with about(where):
            return Light(kind, place, color, direction, inner, outer)
    needed, other = ("direction", "position") if kind == "directional" else ("position", "direction")
    if needed not in keys or other in keys:
        raise InputError(f"{where} must have a {needed}, and no {other}, as its kind is {kind}")
    for name in ("inner_angle", "outer_angle"):
        if name in keys:
            raise InputError(f"{where} must have no {name}, as its kind is {kind}")
    with about(where):
        return Light(kind, keys.numbers(needed, (0, 0, 0)), color)


def _object(value: object, where: str, folder: Path) -> Object:
    keys = Table(value, where, _OBJECT)
    mesh = _mesh(keys, where, folder)
    if "color" in keys:
        mesh = painted(mesh, keys.color("color", _WHITE))
    position, rotation, scale = keys.numbers("position", (0, 0, 0)), _rotation(keys), keys.number("scale", 1)
    material = _material(keys)
    cull, wireframe = keys.flag("cull", True), keys.flag("wireframe", False)
    opacity = keys.number("opacity", 1)
    with about(where):
        return Object(mesh, position, rotation, scale, material, cull, wireframe, opacity)


def _mesh(keys: Table, where: str, folder: Path) -> Mesh:
    value = keys.get("mesh")
    if isinstance(value, str) and value:
        with about(keys.place("mesh")):
            return read_mesh(folder / value)
    if value is None or isinstance(value, str):
        raise InputError(f"{where} needs a mesh: the path of a file, relative to the scene file")
    inside = keys.table("mesh", _MESH)
    with about(inside.where):
        return Mesh(
            inside.matrix("positions"),
            inside.matrix("faces", whole=True),
            inside.matrix("colors", whole=True) if "colors" in inside else None,
            inside.matrix("normals") if "normals" in inside else None,
        )


def _rotation(keys: Table) -> ArrayLike:
    value = keys.get("rotation")
    if value is None:
        return _NO_ROTATION
    if not isinstance(value, Mapping):
        return from_euler(keys.numbers("rotation", (0, 0, 0)))
    inside = keys.table("rotation", _ROTATION)
    inside.only_one_of("quaternion", "axis")
    inside.only_one_of("quaternion", "angle")
    if "quaternion" in inside:
        return inside.numbers("quaternion", _NO_ROTATION)
    if "axis" not in inside or "angle" not in inside:
        raise InputError(f"{inside.where} must have a quaternion, or an axis and an angle in degrees")
    with about(inside.where):
        return from_axis_angle(inside.numbers("axis", (0, 0, 0)), inside.number("angle", 0))


def _material(keys: Table) -> Material:
    inside = keys.table("material", _MATERIAL)
    default = Look().material
    shading = inside.choice("shading", default.shading, ("unlit", "flat", "smooth"))
    with about(inside.where):
        return Material(
            cast(Shading, shading),
            ambient=inside.number("ambient", default.ambient),
            diffuse=inside.number("diffuse", default.diffuse),
            specular=inside.number("specular", default.specular),
            shininess=round(inside.number("shininess", default.shininess)),
        )
