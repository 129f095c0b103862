"""Scenes from files, pieces of datasets, meshes, arrays, and objects of trimesh."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Unpack

from attrs import evolve

from .datasets import Piece, find, require
from .errors import InputError
from .scene import (
    MESH_STAGING,
    PICTURE,
    READERS,
    SCENES,
    LookOptions,
    Mesh,
    MeshPart,
    Object,
    Scene,
    about,
    checked_look,
    is_trimesh,
    look_at,
    objects_of,
    part_of,
    read_model,
    read_scene,
)

#: Input of `load`. `Any`: arrays of vertices and faces, or a mesh or scene of trimesh, an optional package.
Thing = str | os.PathLike[str] | Piece | Mesh | Object | Scene | Sequence[Any] | Any


def load(thing: Thing, size: int | tuple[int, int] | None = None, **look: Unpack[LookOptions]) -> Scene:
    """Return the scene of a file, a piece of a dataset, a mesh, arrays, or an object of trimesh.

    thing: the path of a mesh or scene file, or of a PNG file that carries a scene; the name of a piece, such as
    "teapot" or "genesis/12" (a file wins over a piece of the same name); a Mesh; an Object, or a list of these;
    (vertices, faces) or (vertices, faces, colors), (n, 3) and (m, 3); a trimesh.Trimesh or trimesh.Scene; or a Scene.
    A mesh is staged: it fills the picture, antialiased, in smooth shading except across creases. A scene keeps its look
    except for the given settings.
    size: side of a square picture, or (width, height), in pixels; None for the scene's, or 256 for a mesh.
    look: settings by the keywords of `LookOptions`, such as color="tomato", smooth=True, rotate=(0, 30, 0),
    background="white", fov=40.
    InputError, one line, if the input does not exist or is not valid.
    """
    chosen = checked_look({"size": size, **look})
    found = locate(thing) if isinstance(thing, str | os.PathLike) else thing
    if isinstance(found, Path):
        if found.suffix.lower() in READERS:
            thing = [_unplaced(part) for part in read_model(found)]
        else:
            thing = read_scene(found)
        with about(str(found)):
            return look_at(thing, chosen)
    return look_at(_made(found, chosen), chosen)


def locate(input: str | os.PathLike[str]) -> Path | Piece:
    """Return the path of a file, or else the piece of that name. InputError if there is neither."""
    path = Path(input)
    name = input if isinstance(input, str) else path.as_posix()
    if path.suffix.lower() in (*READERS, *SCENES, PICTURE) or os.path.isfile(path):
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


def _unplaced(part: MeshPart) -> Object:
    """Return a part of a model as an object, which `look_at` is to place."""
    return Object(part.mesh, material=evolve(MESH_STAGING.material, **part.material), opacity=part.opacity)


def _made(thing: Any, look: dict[str, Any]) -> Mesh | list[Object] | Scene:
    """Return the mesh, the parts of a model or the scene of an input that is not a file."""
    if isinstance(thing, Mesh | Scene):
        return thing
    if isinstance(thing, Piece):
        return thing.make()
    objects: list[Object | Mesh] = []
    if isinstance(thing, Object):
        objects = [thing]
    elif is_trimesh(thing):
        if not hasattr(thing, "graph"):
            return [_unplaced(part_of(thing))]
        objects = list(objects_of(thing))
    elif isinstance(thing, list | tuple):
        if not thing or not all(isinstance(part, Mesh | Object) for part in thing):
            if 2 <= len(thing) <= 4:
                return Mesh(*thing)
            raise InputError(f"vertices and faces are needed, not {len(thing)} parts: {thing!r:.60}")
        objects = list(thing)
    else:
        raise InputError(
            "a path, the name of a piece, a Mesh, (vertices, faces), a Scene or a mesh of trimesh is needed, not "
            f"{thing!r:.60}"
        )
    width, height = look.get("size", (None, None))
    return Scene(objects) if width is None else Scene(objects, width=width, height=height)
