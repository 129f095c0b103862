"""Scene files: TOML, or JSON with the same keys. docs/scene-files.md documents the keys and their defaults.

Keys that are settings of a look come from its table, with their kinds and ranges.
"""

from __future__ import annotations

import base64
import math
import os
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from attrs import evolve, frozen
from numpy.typing import ArrayLike, NDArray

from ...base.checks import number
from ...errors import InputError
from .._arithmetic import IDENTITY, from_axis_angle, from_euler, multiply
from .._camera import Camera, half_height_in
from .._crease import shaded
from .._effects import Background, Fog, Hemisphere, Rim, Tone
from .._fields import AXES, FIELDS, FILTERS, LIGHT_KINDS, PROJECTIONS, WRAPS
from .._ground import Ground
from .._light import Light
from .._look import view_of
from .._mesh import Mesh
from .._object import Material, Object
from .._scene import Scene
from .._settings import ScenePart, exclude, settings_of
from .._staging import BACKGROUND, DEFAULT_SIDE, Viewpoint, frame, painted_object, toward_viewer
from .._table import keys_of
from .._texture import Texture
from .._upright import axis_of_file, upright
from .beside import inside
from .content import format_of, parse, read_text
from .mesh_file import READERS, read_model
from .model import MeshPart
from .original import original_scene
from .picture import PICTURE, read_picture
from .table import Table, about

SCENES = (".toml", ".json")

_Read = Callable[[Table, str], Any]
SceneOfPiece = Callable[[str], Scene]

_PIECE = ("piece", "object")
_ROTATION = ("quaternion", "axis", "angle")


@frozen
class Sources:
    """Where a scene file takes meshes and images from.

    piece: returns the scene of a piece of a dataset by its name. folder: of files; None where none can be named.
    """

    piece: SceneOfPiece
    folder: Path | None = None

    def path(self, name: str) -> Path:
        """Return the path of a file in the folder."""
        if self.folder is None:
            hint = "save a scene file in the Creator instead"
            raise InputError(f"a link cannot name files, such as {name!r:.60}; {hint}")
        return inside(self.folder, self.folder / name, name)


def read_scene(path: str | os.PathLike[str], piece: SceneOfPiece) -> Scene:
    """Return the scene of a scene file, or the one that a PNG file carries.

    piece: returns the scene of a piece of a dataset by its name.
    A JSON file with the key `canvasDim` is a scene of the original contracts. InputError, one line that begins with the
    path, if anything is wrong.
    """
    path = Path(path)
    extension = format_of(path, with_note=True)
    if extension == PICTURE:
        return read_picture(path)
    if extension not in SCENES:
        known = ", ".join((*READERS, *SCENES, PICTURE))
        if path.is_dir():
            raise InputError(f"{path} is a directory; a mesh or scene file is needed: {known}")
        raise InputError(f"{path} is neither a mesh nor a scene file by its extension; known are {known}")
    document = parse(path, read_text(path), extension)
    with about(str(path)):
        if extension == ".json" and "canvasDim" in document:
            return original_scene(document)
        return scene_of(document, Sources(piece, path.parent))


def scene_of(document: Mapping[str, Any], sources: Sources) -> Scene:
    """Return the scene of a document whose meshes and images are of these sources."""
    table = Table(document, "", keys_of("Scene"))
    table.table("creator")  # of the Creator: it has no effect here
    width, height = _size(table)
    objects = [each for where, part in table.rows("objects") for each in _objects(part, where, sources)]
    view, camera = _camera(table.table("camera", keys_of("Camera")), width, height, objects)
    given = {"lights": [toward_viewer(view)], "background": BACKGROUND, **_settings(table, "scene")}
    if "tone" in table:
        given["tone"] = Tone(**_settings(table.table("tone", keys_of("Tone")), "tone"))
    return Scene(objects, camera, width=width, height=height, **given)


def _settings(keys: Table, part: ScenePart) -> dict[str, Any]:
    """Return the settings of a part of a scene that a table has."""
    return {
        each.name: each.check(_READ[each.kind](keys, each.name), keys.place(each.name))
        for each in settings_of(part)
        if each.name in keys
    }


def _size(table: Table) -> tuple[int, int]:
    size = table.values.get("size", DEFAULT_SIDE)
    sides = size if isinstance(size, list) else [size, size]
    if len(sides) != 2 or not all(type(side) is int for side in sides):
        raise InputError(f"size must be a number of pixels, or width and height, not {size!r:.60}")
    with about("size"):
        Scene([], width=sides[0], height=sides[1])
    return sides[0], sides[1]


def _background(keys: Table, name: str) -> Any:
    is_table = isinstance(keys.get(name), Mapping)
    return _effect(Background, keys, name) if is_table else keys.color(name)


def _effect(kind: type[Any], keys: Table, name: str) -> Any:
    """Return what a table has the fields of."""
    inside = keys.table(name, keys_of(kind.__name__))
    fields = FIELDS[kind.__name__].items()
    given = {name: _READ[each.kind](inside, name) for name, each in fields if name in inside or each.needed}
    with about(inside.where):
        return kind(**given)


#: How the values of kinds are read, besides their ranges and choices.
_READ: dict[str, _Read] = {
    "whole": Table.whole,
    "number": Table.number,
    "vector": lambda keys, name: keys.numbers(name, (0, 0, 0)),
    "pair": lambda keys, name: keys.numbers(name, (0, 0)),
    "flag": Table.flag,
    "color": Table.color,
    "choice": Table.get,
    "lights": lambda keys, name: [_light(part, where) for where, part in keys.rows(name)],
    "background": _background,
    "hemisphere": partial(_effect, Hemisphere),
    "rim": partial(_effect, Rim),
    "fog": partial(_effect, Fog),
    "ground": partial(_effect, Ground),
}


def _camera(keys: Table, width: int, height: int, objects: list[Object]) -> tuple[Viewpoint, Camera]:
    given = _settings(keys, "camera")
    exclude(given, keys.place)
    for name in ("eye", "target", "up"):
        for needed in ("eye", "target"):
            if name in given and needed not in given:
                raise InputError(f"camera.{name} needs a camera.{needed}, too; without any of them, all is seen")
    projection = keys.choice("projection", PROJECTIONS, "perspective")
    orthographic = projection == "orthographic"
    with about("camera"):
        half_height = half_height_in(given, orthographic)
        view = view_of(given, width, height, orthographic)
        if "eye" in given:
            if orthographic and half_height is None:
                raise InputError("an orthographic camera with an eye needs half_height, in world units")
            places = {name: given[name] for name in ("eye", "target", "up") if name in given}
            camera = Camera(**places, projection=projection)
            if not camera.up.any() or np.array_equal(camera.eye, camera.target):
                raise InputError("eye and target must differ, and up must not be (0, 0, 0)")
        else:
            points = [np.zeros((0 if objects else 1, 3)), *(thing.world_positions() for thing in objects)]
            camera = frame(np.concatenate(points), view)
        half_height = camera.half_height if half_height is None else half_height
        return view, evolve(camera, half_height=half_height, near=given.get("near"))


def _light(value: object, where: str) -> Light:
    kind = Table(value, where).choice("kind", LIGHT_KINDS)
    own = {name: field for name, field in FIELDS["Light"].items() if not field.lights or kind in field.lights}
    keys = Table(value, where, tuple(own))
    for name, field in own.items():
        if field.needed and name not in keys:
            raise InputError(f"{where} must have a {name}, as its kind is {kind}")
    given = {name: _READ[field.kind](keys, name) for name, field in own.items() if name in keys}
    with about(where):
        return Light(**({"toward": given.pop("direction")} if kind == "directional" else {}), **given)


def _objects(value: object, where: str, sources: Sources) -> list[Object]:
    """Return the objects of a table: one, or one for each texture of the mesh file that it names."""
    keys = Table(value, where, keys_of("Object"))
    parts = _parts(keys, where, sources)
    given = _settings(keys, "object")
    surface = keys.table("material", keys_of("Material"))
    fields = _settings(surface, "material")
    # a mesh from a file or a piece is given normals, one in the table is as it is
    shading = fields.get("shading", "flat")
    limits = FIELDS["Object"]["crease"].limits
    crease = number(keys.number("crease"), keys.place("crease"), *limits) if "crease" in keys else None
    is_inside = isinstance(mesh := keys.get("mesh"), Mapping) and "piece" not in mesh
    if not is_inside or crease is not None:
        fields["shading"] = "flat"
    if "texture" in surface:
        fields["texture"] = _texture(surface, sources)
    position, scale = keys.numbers("position", (0, 0, 0)), keys.number("scale", 1)
    axis = keys.choice("up_axis", AXES, "y")
    if not isinstance(name := keys.get("mesh"), str):
        if "up_axis" in keys:
            raise InputError(f"{keys.place('up_axis')} is for meshes of files")
    elif "up_axis" not in keys and "rotation" not in keys:
        axis = axis_of_file(sources.path(name), parts)
    rotation = multiply(_rotation(keys), upright(axis))
    if "fade" in keys:
        given["fade"] = keys.numbers("fade", (0, 0))
    color = given.pop("color", None)
    with about(where):
        objects = []
        for part in parts:
            own = {name: part.material[name] for name in ("texture", "emission") if name in part.material}
            own_fields = {"opacity": part.opacity, "two_sided": part.two_sided}
            thing = Object(part.mesh, position, rotation, scale, Material(**(own | fields)), **(own_fields | given))
            thing = shaded(thing, shading, crease, anew=crease is not None)
            objects.append(thing if color is None else painted_object(thing, color))
        return objects


def _parts(keys: Table, where: str, sources: Sources) -> list[MeshPart]:
    value = keys.get("mesh")
    if sources.folder is None and isinstance(value, Mapping) and "file" in value:  # one that was opened on the page
        raise InputError(f"{where} needs a file that was opened in the Creator; save a scene file there instead")
    if isinstance(value, str) and value:
        with about(keys.place("mesh")):
            return read_model(sources.path(value))
    if value is None or isinstance(value, str):
        raise InputError(f"{where} needs a mesh: the path of a file, relative to the scene file")
    if isinstance(value, Mapping) and "piece" in value:
        return [MeshPart(_mesh_of_piece(keys.table("mesh", _PIECE), sources))]
    inside = keys.table("mesh", keys_of("Mesh"))
    # with alpha if the first row has one
    has_alpha = any(isinstance(row, list) and len(row) == 4 for _, row in inside.rows("colors")[:1])
    with about(inside.where):
        mesh = Mesh(
            inside.matrix("positions"),
            inside.matrix("faces", whole=True),
            inside.matrix("colors", whole=True, width=3 + has_alpha) if "colors" in inside else None,
            inside.matrix("normals") if "normals" in inside else None,
            inside.matrix("uvs", width=2) if "uvs" in inside else None,
            inside.series("opacities") if "opacities" in inside else None,
        )
    return [MeshPart(mesh)]


def _mesh_of_piece(keys: Table, sources: Sources) -> Mesh:
    """Return the mesh of an object of a piece of a dataset, in its own coordinates."""
    name = keys.get("piece")
    if not isinstance(name, str):
        raise InputError(f"{keys.place('piece')} must be the name of a piece, not {name!r:.60}")
    with about(keys.place("piece")):
        objects = sources.piece(name).objects
    return objects[keys.index("object", len(objects), "objects", 0)].mesh


def _texture(surface: Table, sources: Sources) -> Texture:
    """Return a texture: the path of an image, relative to the scene file, or its pixels."""
    keys = Table({"image": value}, "") if isinstance(value := surface.get("texture"), str) else None
    keys = keys or surface.table("texture", keys_of("Texture"))
    filter, wrap = keys.choice("filter", FILTERS, FILTERS[1]), keys.choice("wrap", WRAPS, WRAPS[0])
    cutoff = keys.whole("cutoff", 0)
    keys.only_one_of("image", "pixels")
    with about(surface.place("texture")):
        if "pixels" not in keys:
            image = keys.get("image")
            if not isinstance(image, str) or not image:
                raise InputError("a texture needs an image: the path of a file, relative to the scene file")
            return Texture.open(sources.path(image), filter, wrap, alpha=keys.flag("alpha", False), cutoff=cutoff)
        width, height = keys.whole("width"), keys.whole("height")
        alpha = _levels(keys, "alpha", (height, width), "bytes") if "alpha" in keys else None
        pixels = _levels(keys, "pixels", (height, width, 3), "red, green and blue bytes")
        return Texture(pixels, filter, wrap, alpha, cutoff)


def _levels(keys: Table, name: str, shape: tuple[int, ...], what: str) -> NDArray[np.uint8]:
    try:
        data = base64.b64decode(keys.get(name), validate=True)
    except (TypeError, ValueError):
        raise InputError(f"{name} must be {what} in base64") from None
    if len(data) != math.prod(shape):
        raise InputError(f"{shape[1]} x {shape[0]} {name} need {math.prod(shape):,} bytes, not {len(data):,}")
    return np.frombuffer(data, np.uint8).reshape(shape)


def _rotation(keys: Table) -> ArrayLike:
    value = keys.get("rotation")
    if value is None:
        return IDENTITY
    if not isinstance(value, Mapping):
        return from_euler(keys.numbers("rotation", (0, 0, 0)))
    inside = keys.table("rotation", _ROTATION)
    inside.only_one_of("quaternion", "axis")
    inside.only_one_of("quaternion", "angle")
    if "quaternion" in inside:
        return inside.numbers("quaternion", (0, 0, 0, 1))
    if "axis" not in inside or "angle" not in inside:
        raise InputError(f"{inside.where} must have a quaternion, or an axis and an angle in degrees")
    with about(inside.where):
        return from_axis_angle(inside.numbers("axis", (0, 0, 0)), inside.number("angle"))
