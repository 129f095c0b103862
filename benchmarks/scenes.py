"""Make scenes that need no file."""

from __future__ import annotations

from typing import Unpack

from shackled import Camera, Light, Material, Object, Scene
from shackled.bench.scenes import DISTANCE, GLOSSY, NIGHT, SUN, UNLIT, cube_mesh
from shackled.datasets import teapot
from shackled.scene import stage
from shackled.scene._arithmetic import from_euler
from shackled.scene._fields import Shading
from shackled.scene._settings import LookOptions

#: About a thousand triangles, as the models of the cost table have.
TEAPOT = teapot(4)

LAMP = Light("point", (500, 800, 0))
#: Beside the light of a scene.
SECOND_LIGHT = Light("directional", (1, 0, 0))
MORE_LIGHTS = (SECOND_LIGHT, Light("directional", (-1, 1, 0)), Light("directional", (0, 1, -1)))


def cubes(size: int) -> Scene:
    """Make three cubes that intersect, each with its own material."""
    objects = [
        Object(cube_mesh(), (x, 0, -DISTANCE - x), from_euler((30, turn, 0)), 0.9, material)
        for x, turn, material in ((-500, 20, UNLIT), (0, 50, GLOSSY), (500, 75, Material("smooth", 0.3, 0.6, 0.2, 8)))
    ]
    return Scene(objects, Camera(), (SUN,), NIGHT, width=size, height=size)


def room(size: int) -> Scene:
    """Make the inside of a cube around the camera, cut by the near plane and all sides of the view, lit by a lamp."""
    walls = Object(cube_mesh(1000), (100, 200, -300), from_euler((5, 25, 0)), material=GLOSSY, cull=False)
    lamp = Light("point", (0, 500, -600), (255, 240, 200))
    return Scene([walls], Camera(), (lamp,), NIGHT, width=size, height=size)


def staged_teapot(kind: Shading, size: int | tuple[int, int], **look: Unpack[LookOptions]) -> Scene:
    """Stage the teapot as `shackled render` does, with a look."""
    return stage(TEAPOT, size, material=Material(kind, 0.25, 0.75, 0.3, 24), **look)


def empty(size: int) -> Scene:
    """Make a scene of background only."""
    return Scene([], background=NIGHT, width=size, height=size)
