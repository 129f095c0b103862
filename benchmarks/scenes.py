"""Scenes of our own, which need no file."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from shackled import Background, Camera, Light, Material, Mesh, Object, Scene
from shackled.datasets.teapot import teapot
from shackled.scene.material import Shading
from shackled.scene.rotation import from_euler
from shackled.scene.staging import Look, stage

#: About a thousand triangles, as the models of the cost table have.
TEAPOT = teapot(4)

NIGHT = Background((0, 0, 40), (0, 0, 160))
SUN = Light("directional", (1, 2, 3))
LAMP = Light("point", (500, 800, 0))
#: The material of the rows of the cost table that name none.
GLOSSY = Material("flat", 0.2, 0.7, 0.5, 20)
UNLIT = Material("unlit")

#: How far before the camera the things below stand.
DISTANCE = 2500

CORNERS = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
SIDES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


def cube_mesh(half: int = 500) -> Mesh:
    """A cube about the origin, 12 triangles, coloured by its corners."""
    corners = np.array(CORNERS)
    faces = [face for a, b, c, d in SIDES for face in ((a, b, c), (a, c, d))]
    return Mesh(half * corners, faces, (corners + 1) // 2 * 255)


def square_mesh(divisions: int, half: int = 840) -> Mesh:
    """A square that faces +z, cut into 2 * divisions^2 triangles; 840 is a multiple of most numbers up to 24."""
    at = np.rint(np.linspace(-half, half, divisions + 1))
    x, y = (axis.ravel() for axis in np.meshgrid(at, at))
    grid = np.arange(x.size).reshape(divisions + 1, divisions + 1)
    a, b, c, d = (corner.ravel() for corner in (grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]))
    faces = np.stack([a, b, c, a, c, d], axis=1).reshape(-1, 3)
    share = np.stack([x + half, y + half, half - x], axis=1) / (2 * half)
    return Mesh(np.stack([x, y, 0 * x], axis=1), faces, np.rint(255 * share))


def before_camera(mesh: Mesh, size: int, material: Material = GLOSSY, lights: Sequence[Light] = (SUN,)) -> Scene:
    """The mesh in front of the default camera."""
    return Scene([Object(mesh, (0, 0, -DISTANCE), material=material)], Camera(), lights, NIGHT, width=size, height=size)


def cube(size: int, material: Material = GLOSSY, lights: Sequence[Light] = (SUN,)) -> Scene:
    """A cube of which three sides are seen."""
    turned = Object(cube_mesh(), (0, 0, -DISTANCE), from_euler((35, 30, 10)), material=material)
    return Scene([turned], Camera(), lights, NIGHT, width=size, height=size)


def cubes(size: int) -> Scene:
    """Three cubes that pass through each other, each with a material of its own."""
    objects = [
        Object(cube_mesh(), (x, 0, -DISTANCE - x), from_euler((30, turn, 0)), 0.9, material)
        for x, turn, material in ((-500, 20, UNLIT), (0, 50, GLOSSY), (500, 75, Material("smooth", 0.3, 0.6, 0.2, 8)))
    ]
    return Scene(objects, Camera(), (SUN,), NIGHT, width=size, height=size)


def room(size: int) -> Scene:
    """The inside of a cube around the camera, cut by the near plane and by all sides of the view, lit by a lamp."""
    walls = Object(cube_mesh(1000), (100, 200, -300), from_euler((5, 25, 0)), material=GLOSSY, cull=False)
    lamp = Light("point", (0, 500, -600), (255, 240, 200))
    return Scene([walls], Camera(), (lamp,), NIGHT, width=size, height=size)


def square(divisions: int, size: int, material: Material = GLOSSY, lights: Sequence[Light] = (SUN,)) -> Scene:
    """A square before the camera, in 2 * divisions^2 triangles."""
    return before_camera(square_mesh(divisions), size, material, lights)


def staged_teapot(shading: Shading, size: int | tuple[int, int], **look: object) -> Scene:
    """The teapot as `shackled render` shows a mesh; `look` changes fields of its Look."""
    width, height = (size, size) if isinstance(size, int) else size
    material = Material(shading, 0.25, 0.75, 0.3, 24)
    return stage(TEAPOT, Look(width, height, material=material, **look))  # type: ignore[arg-type]


def empty(size: int) -> Scene:
    """Nothing but background."""
    return Scene([], background=NIGHT, width=size, height=size)
