"""What the command line changes about a scene."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from attrs import evolve

from ..datasets import Piece
from ..errors import InputError
from ..render import simplify_scene
from ..scene.background import Background
from ..scene.camera import Camera, Projection, half_height_of
from ..scene.files.load import load as load_file
from ..scene.files.mesh_file import READERS
from ..scene.light import Light
from ..scene.material import Shading
from ..scene.object import Object
from ..scene.rotation import from_euler
from ..scene.scene import Scene
from ..scene.staging import Look
from ..scene.turning import middle, turn

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class Changes:
    """What is to be different from the scene as it is loaded; None leaves it.

    max_triangles: meshes of more are simplified. rotation: degrees about x, then y, then z, about the middle of the
    scene.
    """

    size: tuple[int, int] | None = None
    max_triangles: int | None = None
    rotation: Vector | None = None
    eye: Vector | None = None
    target: Vector | None = None
    up: Vector | None = None
    projection: Projection | None = None
    fov: float | None = None
    half_height: float | None = None
    near: float | None = None
    lights: Sequence[Light] = ()
    shading: Shading | None = None
    ambient: float | None = None
    diffuse: float | None = None
    specular: float | None = None
    shininess: int | None = None
    color: tuple[int, int, int] | None = None
    background: Background | None = None
    cull: bool | None = None
    wireframe: bool | None = None
    opacity: float | None = None
    invert: bool | None = None


def load_changed(source: Path | Piece, changes: Changes) -> Scene:
    """The scene of a file or piece, with the changes. A mesh is framed as it will be seen.

    Who made a piece, and on what terms it may be used, is said on stderr where that matters.
    """
    if isinstance(source, Path) and source.suffix.lower() in READERS:
        scene = load_file(source, _look(changes))
    else:
        scene = source.make() if isinstance(source, Piece) else load_file(source)
        if isinstance(source, Piece) and source.notice:
            print(source.notice, file=sys.stderr)
        if changes.rotation is not None:
            scene = turn(scene, changes.rotation)
    if changes.size is not None:
        scene = evolve(scene, width=changes.size[0], height=changes.size[1])
    scene = evolve(
        scene,
        objects=[_change_object(o, changes) for o in scene.objects],
        camera=_change_camera(scene, changes),
        lights=changes.lights or scene.lights,
        background=scene.background if changes.background is None else changes.background,
        invert=scene.invert if changes.invert is None else changes.invert,
    )
    return scene if changes.max_triangles is None else simplify_scene(scene, changes.max_triangles)


def _look(changes: Changes) -> Look:
    chosen: dict[str, Any] = {}
    if changes.size is not None:
        chosen["width"], chosen["height"] = changes.size
    if changes.rotation is not None:
        chosen["rotation"] = from_euler(changes.rotation)
    if changes.projection is not None:
        chosen["projection"] = changes.projection
    half_height = _half_height(changes, changes.projection or "perspective")
    if half_height is not None and changes.projection != "orthographic":
        chosen["half_height"] = half_height
    return Look(**chosen)


def _change_object(o: Object, changes: Changes) -> Object:
    material = evolve(o.material, **_given(changes, "shading", "ambient", "diffuse", "specular", "shininess"))
    mesh = o.mesh
    if changes.color is not None:
        mesh = evolve(mesh, colors=np.tile(changes.color, (len(mesh.positions), 1)))
    return evolve(o, mesh=mesh, material=material, **_given(changes, "cull", "wireframe", "opacity"))


def _change_camera(scene: Scene, changes: Changes) -> Camera:
    camera = evolve(scene.camera, **_given(changes, "eye", "target", "up"))
    half_height, near = camera.half_height, camera.near
    projection = changes.projection or camera.projection
    if projection != camera.projection:
        # what the camera looks at keeps its size
        near = None
        forward = camera.target - camera.eye
        length = np.linalg.norm(forward)
        distance = float((middle(scene) - camera.eye) @ forward / length) if length else 0.0
        if distance > 0:
            half_height *= distance if projection == "orthographic" else 1 / distance
    chosen = _half_height(changes, projection)
    return evolve(
        camera,
        projection=projection,
        half_height=half_height if chosen is None else chosen,
        near=near if changes.near is None else changes.near,
    )


def _half_height(changes: Changes, projection: Projection) -> float | None:
    if changes.fov is None:
        return changes.half_height
    if changes.half_height is not None:
        raise InputError("--fov and --half-height say the same in two ways: give one of them")
    if projection == "orthographic":
        raise InputError("an orthographic camera has no field of view: give --half-height instead of --fov")
    return half_height_of(changes.fov)


def _given(changes: Changes, *names: str) -> dict[str, Any]:
    return {name: value for name in names if (value := getattr(changes, name)) is not None}
