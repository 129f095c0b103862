"""Scenes from files, pieces of datasets, meshes, arrays, and objects of trimesh."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import Any, Unpack

import numpy as np
from attrs import evolve, fields

from .base.synonyms import Given, with_synonyms
from .datasets._pieces import Piece, find, require
from .errors import InputError
from .scene._canvas import as_shown
from .scene._fields import Axis
from .scene._files.content import format_of, is_pipe, read_pipe, stored
from .scene._files.gltf.animation import animation_length
from .scene._files.gltf.view import read_view
from .scene._files.link import Link, link_of
from .scene._files.mesh_file import GLTF, READERS, read_model
from .scene._files.model import MeshPart
from .scene._files.picture import PICTURE
from .scene._files.scene_file import SCENES, read_scene
from .scene._files.signatures import format_by_name
from .scene._files.table import about
from .scene._from_others import mesh_of
from .scene._from_trimesh import objects_of, part_of
from .scene._look import look_at
from .scene._mesh import Mesh, is_trimesh
from .scene._object import Object
from .scene._scene import Scene
from .scene._settings import LookOptions, checked_look, settings_of
from .scene._staging import MESH_STAGING
from .scene._turning import frame_count
from .scene._upright import axis_of_file, upright

#: Input of `load`. `Any`: arrays of vertices and faces, or a mesh or scene of trimesh, an optional package.
Thing = str | os.PathLike[str] | Piece | Mesh | Object | Scene | Sequence[Any] | Any

#: Between pieces that stand in a row: a part of the width of the widest.
GAP = 0.2

#: `shackled.replace`: a scene, or a part of one, with other values of some fields.
replace = evolve


def of_arrays(given: Given) -> Given:
    """Return keywords with vertices and faces as one thing."""
    if {"vertices", "faces"} <= given.keys():
        given["thing"] = (given.pop("vertices"), given.pop("faces"))
    return given


@with_synonyms("vertices", "faces", read=of_arrays)
def load(thing: Thing, size: int | tuple[int, int] | None = None, **look: Unpack[LookOptions]) -> Scene:
    """Return the scene of a file, a piece of a dataset, a mesh, arrays, or an object of trimesh.

    thing: the path of a mesh or scene file, or of a PNG file that carries a scene; the name of a piece, such as
    "teapot" or "genesis/12" (a file wins over a piece of the same name); a link of the Creator; a Mesh; an Object;
    (vertices, faces) or (vertices, faces, colors), (n, 3) and (m, 3); a trimesh.Trimesh or trimesh.Scene; a Scene; or a
    list of any of these, which is one scene of all their objects. Meshes, objects and models stay where they are;
    several pieces stand in a row along x. Of a piece only the objects are taken, of a Scene also camera, lights and all
    else, in which several must agree. A list of mesh files or of trimesh.Trimesh is one model, staged like one mesh.
    A mesh is staged: it fills the picture, antialiased, in smooth shading except across creases. A piece is antialiased
    as well. A scene keeps its look except for the given settings.
    size: side of a square picture, or (width, height), in pixels; None for the scene's, or 256 for a mesh or a piece.
    look: settings by the keywords of `LookOptions`, such as color="tomato", smooth=True, rotate=(0, 30, 0),
    background="white", fov=40.
    With a size, mesh files are simplified to what the picture can show, as `max_triangles` says; without one, not.
    InputError, one line, if the input does not exist or is not valid.
    """
    return _loaded(thing, {"size": size, **look}, size is not None)


def load_picture(thing: Thing, size: int | tuple[int, int] | None = None, **look: Unpack[LookOptions]) -> Scene:
    """Return the scene of a picture: as `load` does with a size, or with its default."""
    return _loaded(thing, {"size": size, **look}, True)


def _loaded(thing: Thing, look: Mapping[str, Any], is_picture: bool) -> Scene:
    chosen = checked_look(look)
    with _opened(thing) as found:
        is_posed = isinstance(found, Path) and format_of(found) in GLTF
        made = read_posed(found, chosen, pose_of(chosen)) if is_posed else _made(found, chosen)
        with about(str(found)) if isinstance(found, Path | Link) else nullcontext():
            scene = look_at(made, chosen, name=str(found) if isinstance(found, Path) else "the mesh")
        if is_picture and "max_triangles" not in chosen and is_model(found):
            return as_shown(scene, str(found) if isinstance(found, Path) else "the model")
        return scene


def is_model(thing: Any) -> bool:
    """Return whether an input is a mesh file, or a list of mesh files."""
    if isinstance(thing, list | tuple):
        return all(map(is_model, thing))
    found = _located(thing)
    return isinstance(found, Path) and format_of(found) in READERS


def _located(thing: Any) -> Any:
    return locate(thing) if isinstance(thing, str | os.PathLike) else thing


def _is_data(thing: Any) -> bool:
    """Return whether an input is the content of a file: bytes, an open file, or a pipe."""
    if isinstance(thing, Path):
        return is_pipe(thing)
    # a mesh of meshio has `read`, too
    is_open = hasattr(thing, "read") and not hasattr(thing, "points")
    return is_open or isinstance(thing, bytes | bytearray | memoryview)


@contextmanager
def _opened(thing: Any) -> Iterator[Any]:
    """Yield an input as `_located` returns it, or the path of a file with its content, if that is all it is."""
    found = _located(thing)
    file = getattr(found, "buffer", found)  # of an open file of text
    if not _is_data(found):
        yield found
    elif _is_whole(file):
        yield Path(file.name)
    else:
        name, read = "the data", getattr(file, "read", lambda: file)
        if isinstance(found, Path):
            name, read = str(found), lambda: read_pipe(found)
        try:
            data = read()
        except OSError as error:
            raise InputError(f"{name} cannot be read: {error.strerror or error}") from None
        with stored(data.encode() if isinstance(data, str) else bytes(data), name) as path:
            yield path


def _is_whole(file: Any) -> bool:
    """Return whether an open file has a path, and is at its beginning."""
    try:
        return os.path.samestat(os.fstat(file.fileno()), os.stat(file.name)) and file.tell() == 0
    except (OSError, ValueError, TypeError, AttributeError):
        return False


def locate(input: str | os.PathLike[str]) -> Path | Piece | Link:
    """Return the path of a file, or else the piece of that name, or a link. InputError if there is none of them."""
    if isinstance(input, str) and (link := link_of(input)) is not None:
        return link
    if isinstance(input, str) and "://" in input:
        raise InputError(f"{input} is an address of the web: download the file first")
    path = Path(input)
    name = input if isinstance(input, str) else path.as_posix()
    if format_by_name(path) in (*READERS, *SCENES, PICTURE) or os.path.isfile(path):
        return path
    piece = find(name)
    if piece is not None:
        return piece
    if path.suffix or os.path.exists(path):
        return path  # reading it reports what is wrong
    try:
        return require(name)
    except InputError as error:
        raise InputError(f"{name} does not exist, and {error}") from None


def _unplaced(part: MeshPart, up: Axis = "y") -> Object:
    """Return a part of a model, of which an axis points up, as an object that `look_at` is to place."""
    material = evolve(MESH_STAGING.material, **part.material)
    return Object(part.mesh, (0, 0, 0), upright(up), material=material, opacity=part.opacity, two_sided=part.two_sided)


def _model(path: Path, look: Mapping[str, Any], **pose: Any) -> list[Object]:
    """Return the parts of a mesh file, turned upright unless the look says how."""
    parts = read_model(path, **pose)
    up: Axis = "y" if {"rotate", "up"} & look.keys() else axis_of_file(path, parts)
    return [_unplaced(part, up) for part in parts]


def _in_their_places(parts: list[Object], name: str) -> Scene:
    """Return parts of a model, shaded as when they are staged, but in their own places. name: for notes."""
    staged = look_at(parts, {}, name=name)
    pairs = zip(staged.objects, parts, strict=True)
    back = [evolve(each, position=(0, 0, 0), rotation=part.rotation, scale=1) for each, part in pairs]
    return evolve(staged, objects=back)


def pose_of(look: dict[str, Any]) -> dict[str, Any]:
    """Take the settings of what is read of a glTF file out of a look, and return them."""
    return {setting.name: look.pop(setting.name) for setting in settings_of("file") if setting.name in look}


def read_posed(path: Path, look: Mapping[str, Any], pose: dict[str, Any]) -> list[Object] | Scene:
    """Return what a glTF file holds, with the settings of what is read of it."""
    parts = _model(path, look, **pose)
    if "use_camera" not in pose:
        return parts
    with about(str(path)):
        scene = _in_their_places(parts, str(path))
    camera, lights = read_view(path, scene.bounds.mean(axis=0), **pose)
    return evolve(scene, camera=camera, lights=lights or scene.lights)


def piece_scene(name: str) -> Scene:
    return require(name).make()


def _made(thing: Any, look: Mapping[str, Any]) -> Mesh | list[Object] | Scene:
    """Return the mesh, the parts of a model or the scene of an input."""
    if isinstance(thing, Mesh | Scene):
        return thing
    if isinstance(thing, Path):
        return _model(thing, look) if format_of(thing) in READERS else read_scene(thing, piece_scene)
    if isinstance(thing, Link):
        return thing.scene(piece_scene)
    if isinstance(thing, Piece):
        return evolve(thing.make(), width=MESH_STAGING.side, height=MESH_STAGING.side, antialias=True)
    if isinstance(thing, Object):
        return _staged([thing], look)
    if is_trimesh(thing):
        return _staged(list(objects_of(thing)), look) if hasattr(thing, "graph") else [_unplaced(part_of(thing))]
    if isinstance(thing, list | tuple):
        if thing and _is_input(thing[0]):
            return _combined(thing, look)
        if 2 <= len(thing) <= 4:
            return Mesh(*thing)
        raise InputError(f"vertices and faces are needed, not {len(thing)} parts: {thing!r:.60}")
    if (mesh := mesh_of(thing)) is not None:
        return mesh
    raise InputError(
        "a path, the name of a piece, a Mesh, (vertices, faces), a Scene or a mesh of trimesh is needed, not "
        f"{thing!r:.60}; also the bytes of a file, an open file, or a mesh of PyVista, Open3D or meshio"
    )


def _is_input(thing: Any) -> bool:
    """Return whether a member of a list is an input by itself; otherwise the list may be (vertices, faces)."""
    if isinstance(thing, list | tuple) and thing:
        first = thing[0]
        has_rows = hasattr(first, "__len__") and len(first) > 0 and hasattr(first[0], "__len__")
        return (has_rows and 2 <= len(thing) <= 4) or _is_input(first)
    is_own = isinstance(thing, str | os.PathLike | Piece | Link | Mesh | Object | Scene)
    return is_own or is_trimesh(thing) or _is_data(thing) or hasattr(thing, "points") or hasattr(thing, "vertices")


def _staged(objects: list[Object], look: Mapping[str, Any]) -> Scene:
    width, height = look.get("size", (None, None))
    return Scene(objects) if width is None else Scene(objects, width=width, height=height)


def _combined(things: Sequence[Any], look: Mapping[str, Any]) -> list[Object] | Scene:
    """Return one model, or one scene, of all members of a list."""
    objects: list[Object] = []
    pieces: list[slice] = []
    scenes: list[Scene] = []
    model: list[Object] = []
    models = 0
    for number, thing in enumerate(things):
        with about(f"[{number}]"), _opened(thing) as found:
            if isinstance(found, list | tuple) and found and _is_input(found[0]):
                raise InputError("a list must not hold lists: give one list of all members")
            made = found if isinstance(found, Object) else _made(found, look)
            if isinstance(made, list):
                model, models = [*model, *made], models + 1
                made = _in_their_places(made, str(found) if isinstance(found, Path) else "the mesh")
            elif isinstance(made, Scene) and isinstance(found, Scene | Path | Link):
                scenes.append(made)
            parts = [made] if isinstance(made, Object) else [Object(made)] if isinstance(made, Mesh) else made.objects
            if isinstance(found, Piece):
                pieces.append(slice(len(objects), len(objects) + len(parts)))
            objects += parts
    if models == len(things):
        return model
    if len(pieces) > 1:
        _stand_in_a_row(objects, pieces)
    if not scenes:
        return _staged(objects, look)
    names = [each.name for each in fields(Scene) if each.name != "objects"]
    if "size" in look:
        names = [name for name in names if name not in ("width", "height")]
    differ = [name for name in names if any(getattr(other, name) != getattr(scenes[0], name) for other in scenes)]
    if differ:
        raise InputError(
            f"the scenes of the list differ in {', '.join(differ)}: give a list of their objects, [*one.objects, "
            "*other.objects]"
        )
    return evolve(scenes[0], objects=objects)


def _stand_in_a_row(objects: list[Object], pieces: Sequence[slice]) -> None:
    """Move pieces, given by the places of their objects in the list, apart along x, about the origin."""
    points = [np.concatenate([each.world_positions() for each in objects[piece]])[:, 0] for piece in pieces]
    widths = [float(np.ptp(x)) for x in points]
    gap = GAP * max(widths)
    left = -(sum(widths) + gap * (len(widths) - 1)) / 2
    for piece, x, width in zip(pieces, points, widths, strict=True):
        step = (left - float(x.min()), 0, 0)
        objects[piece] = [evolve(each, position=np.add(each.position, step)) for each in objects[piece]]
        left += width + gap


def load_frames(
    thing: Thing,
    frames: int,
    size: int | tuple[int, int] | None = None,
    **look: Unpack[LookOptions],
) -> tuple[list[Scene], float]:
    """Return scenes at equal steps of the time of an animation of a glTF file, and its length in seconds.

    The first is at time 0, and the last a step before the end, so that a cycle goes on. The model has one scale in all
    of them, and the camera sees all of its poses.

    frames: how many, 2..720. size, look: as in `load`, but for `time`.
    """
    chosen = checked_look({"size": size, **look})
    if "time" in chosen:
        raise InputError("`time` is for one picture: frames take all times of an animation")
    count, pose = frame_count(frames, "an animation"), pose_of(chosen)
    with _opened(thing) as path:
        if not isinstance(path, Path) or format_of(path) not in GLTF:
            name = path if isinstance(path, Path) else thing
            raise InputError(f"{name} has no animation: those of glTF files are read, {' or '.join(GLTF)}")
        with about(str(path)):
            length = animation_length(path, pose.setdefault("animation", 0))
        poses = [read_posed(path, chosen, {**pose, "time": length * step / count}) for step in range(count)]
        models = [each for each in poses if not isinstance(each, Scene)]  # all, unless the file has the camera
        around = np.concatenate([part.world_positions() for parts in models for part in parts]) if models else None
        with about(str(path)):
            return _alike([look_at(each, chosen, around=around) for each in poses]), length


def _alike(scenes: list[Scene]) -> list[Scene]:
    """Return the scenes with the ground and the fog that suit all of them, where those follow from the objects."""
    ground, fogs = scenes[0].ground, [each.fog for each in scenes if each.fog is not None]
    if ground is not None:
        ground = ground.settled(np.concatenate([each.world_positions() for each in scenes]))
    fog = evolve(fogs[0], near=min(f.near for f in fogs), far=max(f.far for f in fogs)) if fogs else None
    return [evolve(each, ground=ground, fog=fog) for each in scenes]
