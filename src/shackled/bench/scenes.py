"""The scenes of the experiments, which need no file.

Those that the original was measured with are the same here to the last unit: whole coordinates, its camera, its light.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..base.checks import Ints
from ..scene._arithmetic import from_euler, rotate
from ..scene._camera import Camera
from ..scene._effects import Background
from ..scene._fields import Projection
from ..scene._light import Light
from ..scene._mesh import Mesh
from ..scene._object import Material, Object
from ..scene._scene import Scene
from .regression import Column

NIGHT = Background((0, 0, 40), (0, 0, 160))
SUN = Light("directional", (1, 2, 3))
GLOSSY = Material("flat", 0.2, 0.7, 0.5, 20)
MATTE = Material("flat", 0.2, 0.7, 0.0)
UNLIT = Material("unlit")

#: The light of the original's scenes: power 2,000 diffuse and 3,000 specular from a distance of 50.
ORIGINAL_MATERIAL = Material("flat", ambient=1, diffuse=0.8, specular=1.2, shininess=10)
ORIGINAL_LIGHT = Light("directional", (-50, 0, 0))
#: Distance of the objects from the camera.
DISTANCE = 2500

CORNERS = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
SIDES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


# ---- scenes of the original ----


def cube(side: int, projection: Projection = "perspective") -> Scene:
    """Make a cube of which three sides are seen, of the same size in the picture on any canvas.

    The original's orthographic camera shows 1000 units a pixel, so that its cube must grow with the canvas.
    """
    half, distance, camera = 500, DISTANCE, Camera()
    if projection == "orthographic":
        half, distance, camera = 215 * side, 1073 * side, Camera(projection="orthographic", half_height=500 * side)
    corners = np.rint(rotate(from_euler((28, -35, 0)), half * np.array(CORNERS)))
    mesh = Mesh(corners, _cube_faces(), (np.array(CORNERS) + 1) // 2 * 255)
    return _as_original(mesh, side, distance, camera)


def equal_triangles(count: int) -> Scene:
    """Make 1 to 16 triangles of the same shape in four rows, 128 x 128 pixels."""
    triangle = np.array([(0, 0, 0), (460, 0, 0), (230, 460, 0)])
    places = [(560 * (i % 4) - 1070, 610 - 560 * (i // 4), 0) for i in range(count)]
    positions = np.concatenate([triangle + place for place in places])
    colors = np.tile([(255, 0, 0), (0, 255, 0), (0, 0, 255)], (count, 1))
    return _as_original(Mesh(positions, np.arange(3 * count).reshape(-1, 3), colors), 128)


def _as_original(mesh: Mesh, side: int, distance: int = DISTANCE, camera: Camera | None = None) -> Scene:
    placed = Object(mesh, (0, 0, -distance), material=ORIGINAL_MATERIAL)
    return Scene([placed], camera or Camera(), [ORIGINAL_LIGHT], NIGHT, width=side, height=side)


# ---- other scenes ----


def turned_cube(size: int, material: Material = GLOSSY, lights: Sequence[Light] = (SUN,)) -> Scene:
    """Make a cube of which three sides are seen, rotated by the contract."""
    turned = Object(cube_mesh(), (0, 0, -DISTANCE), from_euler((35, 30, 10)), material=material)
    return Scene([turned], Camera(), lights, NIGHT, width=size, height=size)


def square(divisions: int, size: int, material: Material = GLOSSY, lights: Sequence[Light] = (SUN,)) -> Scene:
    """Make a square in front of the camera, of 2 * divisions^2 triangles."""
    placed = Object(square_mesh(divisions), (0, 0, -DISTANCE), material=material)
    return Scene([placed], Camera(), lights, NIGHT, width=size, height=size)


def cube_mesh(half: int = 500) -> Mesh:
    """Make a cube about the origin, of 12 triangles, coloured by its corners."""
    corners = np.array(CORNERS)
    return Mesh(half * corners, _cube_faces(), (corners + 1) // 2 * 255)


def square_mesh(divisions: int) -> Mesh:
    """Make a square that faces +z, of 2 * divisions^2 triangles."""
    half = 840  # a multiple of most numbers up to 24
    x, y, faces = grid(divisions)
    x, y = np.rint(half * x), np.rint(half * y)
    share = np.stack([x + half, y + half, half - x], axis=1) / (2 * half)
    return Mesh(np.stack([x, y, 0 * x], axis=1), faces, np.rint(255 * share))


def grid(divisions: int) -> tuple[Column, Column, Ints]:
    """Return x and y from -1 to 1 of the points of a square grid, and its triangles, which face +z."""
    at = np.linspace(-1, 1, divisions + 1)
    x, y = (axis.ravel() for axis in np.meshgrid(at, at))
    points = np.arange(x.size).reshape(divisions + 1, divisions + 1)
    a, b, c, d = (corner.ravel() for corner in (points[:-1, :-1], points[:-1, 1:], points[1:, 1:], points[1:, :-1]))
    return x, y, np.stack([a, b, c, a, c, d], axis=1).reshape(-1, 3)


def _cube_faces() -> list[tuple[int, int, int]]:
    return [face for a, b, c, d in SIDES for face in ((a, b, c), (a, c, d))]
