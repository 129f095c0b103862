"""A scene as triangles before the camera, in float64, from the numbers that the user gave.

Nothing here is shared with what makes the numbers of a call: positions are those of the Scene. Only normals are rounded
to the ten bits that a mesh holds of them, and a near plane that the user leaves open is where `near_plane` puts it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shackled import Camera, Light, Material, Scene
from shackled.scene._in_range import near_plane
from shackled.scene._mesh import vertex_normals

Array = NDArray[np.float64]

#: Steps of a coordinate of a normal, as the mesh format has them.
NORMAL_STEPS = 511

#: The cosines of a cone that is wider than all directions.
ALL_THROUGH = (-1.0, -2.0)


@dataclass(frozen=True)
class Solid:
    """An object in the space of the camera: right, up, and toward the viewer.

    corners, colors, normals: (n, 3, 3) of the corners of n triangles. facing: (n, 3) their own unit normals.
    first: the number of its first triangle, counted through all objects.
    """

    corners: Array
    colors: Array
    normals: Array
    facing: Array
    material: Material
    cull: bool
    two_sided: bool
    first: int


@dataclass(frozen=True)
class Lamp:
    """A light in the space of the camera: the place of a point light, or the direction toward one that is far away.

    axis, cosines: where a spot light points, and the cosines of its angles, the inner one first.
    """

    is_point: bool
    vector: Array
    color: Array
    axis: Array
    cosines: tuple[float, float]


@dataclass(frozen=True)
class World:
    """All that is seen. half_height and near are those of the camera."""

    width: int
    height: int
    perspective: bool
    half_height: float
    near: float
    solids: list[Solid]
    lamps: list[Lamp]
    ambient: Array

    @property
    def corners(self) -> Array:
        """(n, 3, 3), of the triangles of all objects."""
        return np.concatenate([np.empty((0, 3, 3)), *(solid.corners for solid in self.solids)])


def before_camera(scene: Scene) -> World:
    """The world of a scene, wires left out."""
    camera = scene.camera
    eye, axes = _floats(camera.eye), _axes(camera)
    solids: list[Solid] = []
    first = 0
    for o in scene.objects:
        mesh, turn = o.mesh, rotation(o.rotation)
        points, faces = _floats(mesh.positions), mesh.faces
        corners = ((_floats(o.position) - eye) + o.scale * points[faces] @ turn.T) @ axes.T
        normals = vertex_normals(points, faces) if mesh.normals is None else _floats(mesh.normals)
        normals = np.rint(unit(normals) * NORMAL_STEPS) / NORMAL_STEPS
        facing = unit(np.cross(points[faces[:, 1]] - points[faces[:, 0]], points[faces[:, 2]] - points[faces[:, 0]]))
        if not o.wireframe:
            solids.append(
                Solid(
                    corners=corners,
                    colors=_floats(mesh.colors)[faces],
                    normals=normals[faces] @ turn.T @ axes.T,
                    facing=facing @ turn.T @ axes.T,
                    material=o.material,
                    cull=o.cull,
                    two_sided=o.two_sided,
                    first=first,
                )
            )
        first += len(faces) * (not o.wireframe)
    lamps = [_lamp(light, eye, axes) for light in scene.lights]
    near = near_plane(scene) if camera.projection == "perspective" or camera.near is not None else -np.inf
    return World(
        scene.width,
        scene.height,
        camera.projection == "perspective",
        camera.half_height,
        near,
        solids,
        lamps,
        _floats(scene.ambient_light),
    )


def _lamp(light: Light, eye: Array, axes: Array) -> Lamp:
    is_point = light.kind != "directional"
    axis, cosines = np.zeros(3), ALL_THROUGH
    if light.kind == "spot":
        axis = unit(_floats(light.direction)) @ axes.T
        inner, outer = (float(np.cos(np.radians(angle))) for angle in (light.inner_angle, light.outer_angle))
        cosines = inner, outer
    return Lamp(is_point, (_floats(light.vector) - eye * is_point) @ axes.T, _floats(light.color), axis, cosines)


def background(scene: Scene) -> Array:
    """(H, 1, 3): the colours of the rows where nothing is drawn."""
    top, bottom = _floats(scene.background.top), _floats(scene.background.bottom)
    part = np.arange(scene.height)[:, None, None] / max(scene.height - 1, 1)
    return np.asarray(top + (bottom - top) * part)


def rotation(quaternion: ArrayLike) -> Array:
    """The matrix of a quaternion (x, y, z, w) of any length."""
    x, y, z, w = unit(_floats(quaternion))
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def unit(v: Array) -> Array:
    """Unit vectors along the last axis; zero for zero."""
    largest = np.abs(v).max(axis=-1, keepdims=True)
    v = np.divide(v, largest, out=np.zeros_like(v), where=largest > 0)
    length = np.linalg.norm(v, axis=-1, keepdims=True)
    return np.asarray(np.divide(v, length, out=np.zeros_like(v), where=length > 0))


def _axes(camera: Camera) -> Array:
    """Right, up and toward the viewer, as rows."""
    back = unit(_floats(camera.eye) - _floats(camera.target))
    right = unit(np.cross(unit(_floats(camera.up)), back))
    return np.array([right, np.cross(back, right), back])


def _floats(values: ArrayLike | None) -> Array:
    return np.asarray(values, dtype=np.float64)
