"""Icons: solids with a pose, a light and a background."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from attrs import evolve
from numpy.typing import ArrayLike, NDArray

from ...scene import (
    NORMAL_UNIT,
    Background,
    Camera,
    Light,
    LookOptions,
    Material,
    Mesh,
    Object,
    Scene,
    stage,
    view_axes,
)
from .. import Piece
from .modelling import Solid

DULL = Material("smooth", ambient=0.42, diffuse=0.68, specular=0, shininess=10)
GLOSSY = Material("smooth", ambient=0.4, diffuse=0.66, specular=0.5, shininess=36)
METAL = Material("smooth", ambient=0.42, diffuse=0.68, specular=0.6, shininess=24)
FACETED = Material("flat", ambient=0.44, diffuse=0.68, specular=0.3, shininess=16)
SPARKLING = Material("flat", ambient=0.58, diffuse=0.54, specular=0.4, shininess=10)

#: Toward the light, right, up and toward the viewer: from the upper left, low enough for upright objects.
LIGHT = (-0.45, 0.5, 0.9)

#: `half_height` of the camera: a long lens, with little perspective distortion.
LENS = 0.2

#: Edges are sharp where a surface turns by more than these degrees.
CREASE = 42.0


@dataclass(frozen=True)
class IconModel:
    """A model with its pose, light and background."""

    name: str
    title: str
    model: Callable[[], Solid]
    material: Material
    look: LookOptions
    licence: str = "MIT"
    crease: float = CREASE

    def scene(self) -> Scene:
        """Return the scene, 128 x 128 pixels."""
        mesh = self.model().mesh(self.crease if self.material.shading == "smooth" else None)
        scene = stage(mesh, material=self.material, **self.look)
        return evolve(scene, objects=_cheaper(scene.objects[0], scene.camera))

    def piece(self) -> Piece:
        """Return the icon as a piece of the dataset."""
        return Piece(f"icons/{self.name}", "icons", self.title, self.licence, self.scene)


def icon(
    title: str,
    top: str,
    bottom: str,
    material: Material = DULL,
    *,
    view: tuple[float, float] = (20, 12),
    turn: ArrayLike = (0, 0, 0),
    light: ArrayLike = LIGHT,
    margin: float = 0.06,
    licence: str = "MIT",
    crease: float = CREASE,
) -> Callable[[Callable[[], Solid]], IconModel]:
    """Declare an icon, named as the function that models it.

    top, bottom: the colours of the background. view: azimuth and elevation of the viewer; turn: of the model about x, y
    and z; all in degrees. light: direction toward the only light, in the directions right, up and toward the viewer.
    margin: as in `load`. crease: as in `Solid.mesh`.
    """
    look = LookOptions(
        rotate=turn,
        azimuth=view[0],
        elevation=view[1],
        half_height=LENS,
        margin=margin,
        background=Background(top, bottom),
        lights=Light("directional", np.asarray(light) @ np.stack(view_axes(*view))),
        cull=True,
    )
    return lambda model: IconModel(model.__name__, title, model, material, look, licence, crease)


def _cheaper(o: Object, camera: Camera) -> list[Object]:
    """Return objects that look the same and cost less gas.

    The nearest triangles come first, since what they hide is not lit; flat parts are separated, since they need no
    normals.
    """
    faces = o.mesh.faces
    distance = np.linalg.norm(o.world_positions() - camera.eye, axis=1)[faces].mean(axis=1)
    order = np.argsort(distance, kind="stable")
    if o.mesh.normals is None:
        return [evolve(o, mesh=evolve(o.mesh, faces=faces[order]))]
    normals = o.mesh.normals[faces[order]]
    flat = np.abs(normals - normals[:, :1]).max(axis=(1, 2)) < 1 / NORMAL_UNIT
    parts = []
    if flat.any():
        material = evolve(o.material, shading="flat")
        parts.append(evolve(o, mesh=_part(o.mesh, faces[order[flat]], smooth=False), material=material))
    if not flat.all():
        parts.append(evolve(o, mesh=_part(o.mesh, faces[order[~flat]], smooth=True)))
    flat_is_nearer = flat.any() and distance[order[flat]].mean() < distance.mean()
    return parts if flat_is_nearer else parts[::-1]


def _part(mesh: Mesh, faces: NDArray[np.int64], smooth: bool) -> Mesh:
    """Return some of the faces, in that order, with the vertices that they need."""
    columns: list[NDArray[np.float64]] = [mesh.positions, mesh.colors.astype(np.float64)]
    if smooth and mesh.normals is not None:
        columns.append(mesh.normals)
    table, numbers = np.unique(np.hstack(columns)[faces.reshape(-1)], axis=0, return_inverse=True)
    return Mesh(table[:, :3], numbers.reshape(-1, 3), table[:, 3:6].astype(np.uint8), table[:, 6:] if smooth else None)
